// How the level of a whole instance is measured.
#pragma once

#include "cage/character.h"

namespace supple::surface::lod {

/// Lengths of a cage in its bind pose, divided by the diagonal of its box. A pose and a transform are taken to scale
/// edges as they scale the box.
struct InstanceMeasure {
    float longest = 0.0f; ///< the longest edge
    float bend = 0.0f;    ///< the largest second difference of a border cubic: that of the cage vertices along an
                          ///< edge and beyond its end, divided by 6 as for a uniform cubic B-spline
};
/// `halvings`: how often the cage is subdivided before patches are made. `uneven`: how many times as much
/// its curves bend in places as the cage says. `whole`: the cage that `cage` is a piece of; its box counts.
[[nodiscard]] InstanceMeasure measureInstance(const cage::Cage& cage, uint32_t halvings = 0, float uneven = 1.0f,
                                              const cage::Cage* whole = nullptr);

} // namespace supple::surface::lod
