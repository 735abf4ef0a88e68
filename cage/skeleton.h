// What makers of characters check and find out about nodes. All of these throw Refusal (cage/refusal.h).
#pragma once

#include "cage/character.h"

#include <array>
#include <cstdint>
#include <string>

namespace supple::cage {

/// Nodes nested deeper than this are refused: every level is a step in which a pose's matrices wait for each other.
inline constexpr uint32_t kMaxNodeDepth = 1024;

/// Refuses a matrix whose last row is not 0 0 0 1 but for rounding, and makes it so.
void makeAffine(glm::mat4& matrix, const std::string& element);

/// A rotation (x, y, z, w) as a unit quaternion. One that is a unit quaternion is kept bit by bit.
[[nodiscard]] glm::quat unitRotation(const std::array<double, 4>& rotation, const std::string& element);

/// Fills Skeleton::parentsFirst: level by level, children in the order of their parents, those of one parent by number.
/// Refuses nodes that are their own ancestors, and nodes nested too deep. Parents must be nodes or kNone.
void orderParentsFirst(Skeleton& skeleton);

} // namespace supple::cage
