// p-rep on the CPU, in float or double, with the stages of the shaders. For tests and comparisons. Paper: A. Myles,
// Y. I. Yeo, J. Peters, "GPU Conversion of Quad Meshes to Smooth Surfaces", SPM 2008. Formulas: docs/prep.md, where
// errors of the paper are corrected.
#pragma once

#include "cpu/jet.h"
#include "cpu/prep_construction.h"

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::prep {

template <class T>
using Coefficients = PointCoefficients<glm::vec<3, T>>;
template <class T>
using Patch = PointPatch<glm::vec<3, T>>;

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position, du, dv;
    Vec normal; ///< unit(du x dv), or the limit normal at a smooth corner of one face; zero if that vanishes
};

/// The construction: vertex stage and edge stage. `positions` has one entry per cage vertex. All faces are quads.
template <class T>
[[nodiscard]] Coefficients<T> construct(const cage::Cage& cage, const cage::Topology& topology,
                                        std::span<const glm::vec<3, T>> positions, const Options& options = {});

/// The patch stage, which only gathers.
template <class T>
[[nodiscard]] Patch<T> gatherPatch(const cage::Cage& cage, const cage::Topology& topology, const Coefficients<T>& c,
                                   uint32_t face, const Options& options = {});

/// Evaluates at the pairs (u, 1-u), (v, 1-v). Rows are collapsed first, and sums are symmetric under reversal, in the
/// order of the shaders. At rate n the pairs are (k/n, (n-k)/n); then neighbors agree bit for bit at every border
/// sample.
template <class T>
[[nodiscard]] Sample<T> evaluate(const Patch<T>& patch, glm::vec<2, T> u, glm::vec<2, T> v);

/// With second derivatives. Its sums have another order than those of evaluate().
[[nodiscard]] SurfaceJet evaluateJet(const Patch<double>& patch, double u, double v);

} // namespace supple::surface::prep
