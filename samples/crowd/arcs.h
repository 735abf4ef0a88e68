// The demo character walks on the spot. Clips of walks get there: the same walk with a root that moves along an arc.
#pragma once

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
/// A GLB whose clip `walk`, or the first, has copies along arcs, `stride` metres a loop. Without a clip or a skin: as
/// it is.
std::vector<char> withArcs(const std::vector<char>& glb, const std::string& walk, float stride,
                           std::span<const Arc> arcs);

} // namespace crowd
