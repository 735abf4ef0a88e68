// What is special about a fragment's centre: its limit point and limit normals. Weights in double. Formulas:
// docs/kernel.md; creases by the rules of OpenSubdiv.
#pragma once

#include "surface/kernel/pattern.h"
#include "surface/subdivision_rules.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::kernel {

/// Weights on the centre [0] and on ring 1 [1 + spiral order].
using CentreMask = std::vector<double>;

/// Sectors between two sharp spokes (all of them at a smooth centre) share one normal: cross(first, second) of two
/// tangents; at corners with more than one sector the sum over the run's sectors h of (E_h - c) x (E_h+1 - c).
struct CentreRun {
    uint32_t firstSector = 0;
    uint32_t sectors = 0;
    bool corner = false; ///< masks are empty then
    CentreMask first, second;
};
struct CentreLimit {
    CentreMask position;
    std::vector<CentreRun> runs; ///< together every sector once
};
/// Sharpness at the last level.
[[nodiscard]] CentreLimit centreLimit(const Fan& fan, std::span<const float> spokeSharpness, float vertexSharpness);

} // namespace supple::surface::kernel
