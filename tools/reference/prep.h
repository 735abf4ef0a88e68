// p-rep on the CPU, in float or double, with the stages of the shaders. For tests and comparisons. Paper: A. Myles,
// Y. I. Yeo, J. Peters, "GPU Conversion of Quad Meshes to Smooth Surfaces", SPM 2008. Formulas: docs/prep.md, where
// errors of the paper are corrected.
#pragma once

#include "cage/topology.h"
#include "surface/prep/weights.h"
#include "tools/reference/jet.h"

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::prep {

/// The output of the construction stages: one limit point X per vertex, one tangent TG and face coefficient FC per
/// spoke of the topology, and four edge coefficients H per edge (h20, h30, h21, h31 in the edge's own direction). H is
/// zero if the edge is not perturbed.
template <class T>
struct Coefficients {
    using Vec = glm::vec<3, T>;
    std::vector<Vec> limitPoints;
    std::vector<Vec> limitNormals; ///< unit(e1 x e2), or zero if that vanishes
    std::vector<Vec> tangents;
    std::vector<Vec> faceCoefficients; ///< zero in a boundary fan's last slot, which has no sector
    std::vector<std::array<Vec, 4>> edgeCoefficients;
};

/// One patch: the bicubic coefficients g[i + 4 j], and the sparse perturbation of degree 5. h[4 e + s] is that of face
/// edge e, with s = 0..3 for the local indices (2,0), (3,0), (2,1), (3,1).
template <class T>
struct Patch {
    using Vec = glm::vec<3, T>;
    std::array<Vec, 16> g;
    std::array<Vec, 16> h;
    std::array<Vec, 4> cornerNormals; ///< limit normals, for smooth corners of one face, where du x dv vanishes
    std::array<bool, 4> useCornerNormal{};
    bool perturbed = false; ///< an edge has a perturbation. Decided from the valences, never from h
};

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
/// order of the shaders. At rate n the pairs are (k/n, (n-k)/n); then neighbours agree bit for bit at every border
/// sample.
template <class T>
[[nodiscard]] Sample<T> evaluate(const Patch<T>& patch, glm::vec<2, T> u, glm::vec<2, T> v);

/// With second derivatives. Its sums have another order than those of evaluate().
[[nodiscard]] SurfaceJet evaluateJet(const Patch<double>& patch, double u, double v);

} // namespace supple::surface::prep
