// What is special about a fragment's centre: its refinement rule step by step, and its limit point and limit normals.
// Weights in double. Formulas: docs/kernel.md; creases by the rules of OpenSubdiv.
#pragma once

#include "surface/kernel/pattern.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::kernel {

/// Smooth rule of the centre: centre c + spoke (sum of ring 1's spoke points) + face (sum of its face points).
struct CentreWeights {
    double centre = 0.0, spoke = 0.0, face = 0.0;
};
[[nodiscard]] CentreWeights refineWeights(Subdivision subdivision, uint32_t valence);

/// One step of a centre: smooth * (smooth rule) + crease * (3/4 c + 1/8 (spoke first + spoke second)) + corner * c.
struct CentreStep {
    double smooth = 1.0, crease = 0.0, corner = 0.0;
    uint32_t first = 0, second = 0; ///< spokes
};
/// Sharpness at the parent level: of the spokes, and of the vertex.
[[nodiscard]] CentreStep centreStep(std::span<const float> spokeSharpness, float vertexSharpness);

/// Sharpness after `steps` more steps: infinite stays, else less by one a step, not below 0.
[[nodiscard]] float softened(float sharpness, uint32_t steps);

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
