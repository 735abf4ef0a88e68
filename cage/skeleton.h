// What makers of characters check and find out about nodes. All of these throw Refusal (cage/refusal.h).
#pragma once

#include "cage/character.h"
#include "cage/leniency.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage {

/// Nodes nested deeper than this are refused: every level is a step in which a pose's matrices wait for each other.
inline constexpr uint32_t kMaxNodeDepth = 1024;

/// Refuses a matrix whose last row is not 0 0 0 1 but for rounding, and makes it so.
void makeAffine(glm::mat4& matrix, const std::string& element);
/// The same for the matrix of a file, where such a row is a fault that can be mended.
void makeAffine(glm::mat4& matrix, const std::string& element, Leniency& leniency);

/// What messages call a node: its name, or its number if it has none.
[[nodiscard]] std::string nameOf(const Skeleton& skeleton, uint32_t node);

/// From a node to its parent, as it rests.
[[nodiscard]] glm::dmat4 localMatrix(const Node& node);
/// By node: from the node to the scene, as it rests.
[[nodiscard]] std::vector<glm::dmat4> restPlaces(const Skeleton& skeleton);

/// Makes the node of a matrix one of translation, rotation and scale. False: the matrix is not made of these.
[[nodiscard]] bool decompose(Node& node);

/// A rotation (x, y, z, w) as a unit quaternion. One that is a unit quaternion is kept bit by bit.
[[nodiscard]] glm::quat unitRotation(const std::array<double, 4>& rotation, const std::string& element);

/// Fills Skeleton::parentsFirst: level by level, children in the order of their parents, those of one parent by number.
/// Refuses nodes that are their own ancestors, and nodes nested too deep. Parents must be nodes or kNone.
void orderParentsFirst(Skeleton& skeleton);

} // namespace supple::cage
