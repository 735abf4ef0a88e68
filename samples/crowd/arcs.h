// The demo character walks on the spot. Clips of walks get there: the same walk with a root that moves along an arc.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crowd {

/// The clip of a walk along a circle, as often as it is asked for.
struct Arc {
    std::string clip; ///< of the new clip
    float radius = 1.0f;
    float turn = 1.0f; ///< 1: to the left, -1: to the right
};
/// The GLB with copies of its clip `walk`, or of its first one, along arcs, `stride` metres a loop, as its last clips.
/// Nothing where it has no clip or no skin.
std::optional<std::vector<char>> withArcs(const std::vector<char>& glb, const std::string& walk, float stride,
                                          std::span<const Arc> arcs);

} // namespace crowd
