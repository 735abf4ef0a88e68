// How far off instances are whose poses are made every 2, 4 or 8 steps of a grid of times, and that go straight from
// one to the next between these.
#pragma once

#include "cage/character.h"
#include "skinning/driver_table.h"
#include "skinning/root_motion.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace supple::skinning {

/// Of a clip that plays at its own speed.
struct UpdateErrors {
    static constexpr double kUnknown = std::numeric_limits<double>::infinity();

    /// Every 2, 4 and 8 steps: how far the farthest vertex is from where the clip has it, at most, in extents. Not
    /// known where the clip is shorter and does not close.
    std::array<double, 3> every = {kUnknown, kUnknown, kUnknown};
    /// The clip ends as it begins, so that a loop of it has no seam.
    bool closes = false;
    uint32_t closesWithout = 0; ///< bit a: it closes once the axes a (RootAxes) of the root's movement are taken out

    /// Every so many steps, which need not be whole: the error of the next more that was measured.
    [[nodiscard]] double at(double steps) const;
};

struct UpdateFacts {
    double extent = 0.0;         ///< the diagonal of the box of the rest pose
    uint32_t root = cage::kNone; ///< findRoot
    std::vector<UpdateErrors> ofClips;

    /// Whether a loop has no seam with this taken out of the clip.
    [[nodiscard]] bool closes(uint32_t clip, const RootSelection& taken) const;
};

/// Errors are found at the steps of the grid, of the vertices and shells that skinning/pose_distance.h watches; what
/// morph targets move at most is added. Clips that close are looped, also those that do with the movement of the root
/// taken out. Others are measured within: who plays them is posed exactly at their ends. Not known of clips of more
/// than five minutes, nor once two million poses of nodes have been looked at.
[[nodiscard]] UpdateFacts measureUpdates(const cage::Character& character);
/// The same, if the table of its drivers is there.
[[nodiscard]] UpdateFacts measureUpdates(const cage::Character& character, const DriverTable& drivers);

} // namespace supple::skinning
