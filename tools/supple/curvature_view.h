// Mean and Gaussian curvature of a figure's surface: values for the views kViewMeanCurvature and
// kViewGaussianCurvature.
#pragma once

#include "tools/supple/limit_distance.h"
#include "tools/supple/surface_jets.h"

#include <functional>
#include <vector>

namespace supple::tools {

/// Calls `visit` for every vertex that is a sample of a patch, from many threads. `cage`: the figure's.
using JetVisitor = std::function<void(size_t vertex, const Jets& jets, uint32_t patch, uint32_t sample)>;
[[nodiscard]] Status visitSamples(const PosedSurfaces& posed, const cage::Cage& cage, const SurfaceRules& rules,
                                  const JetVisitor& visit);

/// Where the curvature of every vertex lies on the scale, of which 1/2 is no curvature. `view`: one of the two.
/// `cage`: the figure's. Vertices without patches (of the scheme polygons, of shared samples) have none. Any thread may
/// call it.
[[nodiscard]] Result<std::vector<float>> curvatures(const PosedSurfaces& posed, const cage::Cage& cage,
                                                    const SurfaceRules& rules, uint32_t view);

/// The scale, in multiples of 1 / extent, the diagonal of the box round the cage. It is even round 0 and logarithmic
/// far from it. Of Gaussian curvature the root is shown, with the sign of the curvature: so both views show
/// reciprocals of radii.
[[nodiscard]] std::vector<Legend::Mark> curvatureMarks();

} // namespace supple::tools
