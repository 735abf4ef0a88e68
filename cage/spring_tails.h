// The tails of joints that swing in VRM 0.x, whose files do not name them.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::cage {

/// A shorter tail is none.
inline constexpr double kShortestTail = 1e-6;

/// By node: the first of its children by number, or kNone.
[[nodiscard]] std::vector<uint32_t> firstChildren(const Skeleton& skeleton);
/// Where the tail of a joint is in the scene: at its first child, else 7 cm behind the joint, as seen from its parent.
/// Nothing: it has neither. `places`: of nodes in the scene.
[[nodiscard]] std::optional<glm::dvec3> tailInTree(const Skeleton& skeleton, std::span<const uint32_t> firstChild,
                                                   std::span<const glm::dmat4> places, uint32_t node);

} // namespace supple::cage
