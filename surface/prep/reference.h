// p-rep on the CPU: the same stages as the shaders, in float or double, for tests and comparisons.
// Paper: T. Ni, Y. Yeo, A. Myles, V. Goel, J. Peters, "GPU Smoothing of Quad Meshes", SMI 2008; formulas in the
// corrected form (see docs/prep.md).
#pragma once

#include "cage/topology.h"
#include "surface/prep/scheme.h"

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::prep {

/// Output of the construction stages. X: one per vertex; tangents (TG) and faceCoefficients (FC): one per spoke slot of
/// the topology; edgeCoefficients (H): four per edge (h20, h30, h21, h31 in the edge's own direction), zero where not
/// perturbed.
template <class T>
struct Coefficients {
    using Vec = glm::vec<3, T>;
    std::vector<Vec> limitPoints;
    std::vector<Vec> limitNormals; ///< unit(e1 x e2), zero where that vanishes
    std::vector<Vec> tangents;
    std::vector<Vec> faceCoefficients; ///< zero in a boundary fan's last slot, which has no sector
    std::vector<std::array<Vec, 4>> edgeCoefficients;
};

/// One patch: g[i + 4 j] bicubic, h[4 e + s] the sparse bi-5 perturbation, s = local (2,0), (3,0), (2,1), (3,1) of face
/// edge e.
template <class T>
struct Patch {
    using Vec = glm::vec<3, T>;
    std::array<Vec, 16> g;
    std::array<Vec, 16> h;
    std::array<Vec, 4> cornerNormals; ///< limit normals, used at smooth one-face corners where Du x Dv vanishes
    std::array<bool, 4> useCornerNormal{};
    bool perturbed = false; ///< an edge carries a perturbation: decided from the valences, never from h
};

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position, du, dv;
    Vec normal; ///< unit(du x dv), or the corner's limit normal at a smooth one-face corner; zero where that vanishes
};

/// Construction: vertex and edge stages. `positions` has one entry per cage vertex; the cage is all quads.
template <class T>
[[nodiscard]] Coefficients<T> construct(const cage::Cage& cage, const cage::Topology& topology,
                                        std::span<const glm::vec<3, T>> positions, const Options& options = {});

/// Patch stage: a gather.
template <class T>
[[nodiscard]] Patch<T> gatherPatch(const cage::Cage& cage, const cage::Topology& topology, const Coefficients<T>& c,
                                   uint32_t face, const Options& options = {});

/// Evaluation at the pair (u, 1-u), (v, 1-v): row collapse, reversal-symmetric sums, in the shaders' order. At one rate
/// n the pairs are (k/n, (n-k)/n); neighbours then agree bit for bit on every shared border sample.
template <class T>
[[nodiscard]] Sample<T> evaluate(const Patch<T>& patch, glm::vec<2, T> u, glm::vec<2, T> v);

} // namespace supple::surface::prep
