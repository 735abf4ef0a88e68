// The limit point and limit normals at the centre of a fragment. Weights are in double. Formulas: docs/subdivision.md.
// Creases follow the rules of OpenSubdiv.
#pragma once

#include "surface/subdivision/pattern.h"
#include "surface/subdivision_rules.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::subdivision {

/// Weights of the centre ([0]) and of ring 1 ([1 + i], in spiral order).
using CentreMask = std::vector<double>;

/// Sectors between two sharp spokes have the same normal; at a smooth centre all sectors do. It is the cross product of
/// the tangents `first` and `second`. At a corner it is the sum of (E_h - c) x (E_h+1 - c) over the sectors h of the
/// run.
struct CentreRun {
    uint32_t firstSector = 0;
    uint32_t sectors = 0;
    bool corner = false; ///< masks are empty then
    CentreMask first, second;
};
struct CentreLimit {
    CentreMask position;
    std::vector<CentreRun> runs; ///< every sector is in one of them
};
/// Both sharpnesses are those of the last level.
[[nodiscard]] CentreLimit centreLimit(const Fan& fan, std::span<const float> spokeSharpness, float vertexSharpness);

} // namespace supple::surface::subdivision
