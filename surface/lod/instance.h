// What one level for a whole instance is measured by.
#pragma once

#include "cage/character.h"

namespace supple::surface::lod {

/// Of a cage in its bind pose, as parts of the diagonal of its box: whatever a pose and a transform do to the box, they
/// are taken to do to edges.
struct InstanceMeasure {
    float longest = 0.0f; ///< edge
    float bend = 0.0f;    ///< the largest second difference of a boundary cubic: that of the cage's vertices along an
                          ///< edge and on beyond its end, over 6, as of the uniform cubic B-spline
};
/// `halvings`: patches are those of the cage refined so many times. `charts`: of the blending surface, whose curves
/// interpolate and bend unevenly.
[[nodiscard]] InstanceMeasure measureInstance(const cage::Cage& cage, uint32_t halvings = 0, bool charts = false);

} // namespace supple::surface::lod
