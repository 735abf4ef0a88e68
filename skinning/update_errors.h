// How far off instances are whose poses are made every 2, 4 or 8 steps of a grid of times, and that go straight from
// one to the next between these.
#pragma once

#include "cage/character.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace supple::skinning {

/// Of a clip that plays at its own speed.
struct UpdateErrors {
    static constexpr double kUnknown = std::numeric_limits<double>::infinity();

    /// Every 2, 4 and 8 steps: how far the farthest vertex ever is from where the clip has it, in extents.
    std::array<double, 3> every = {kUnknown, kUnknown, kUnknown};
    /// The clip ends as it begins, so that a loop of it has no seam.
    bool closes = false;

    /// Every so many steps, which need not be whole: the error of the next more that was measured.
    [[nodiscard]] double at(double steps) const;
};

struct UpdateFacts {
    double extent = 0.0; ///< the diagonal of the box of the rest pose
    std::vector<UpdateErrors> ofClips;
};

/// Errors are found at the steps of the grid, of the vertices and shells that skinning/pose_distance.h watches. Clips
/// that close are looped; others stand still behind their ends. Morph targets do not count. Not known of clips of more
/// than five minutes, nor once two million poses of nodes have been looked at.
[[nodiscard]] UpdateFacts measureUpdates(const cage::Character& character);

} // namespace supple::skinning
