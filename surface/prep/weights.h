// The weights of p-rep, per valence class, in double. They depend on connectivity only.
#pragma once

#include "cage/topology.h"
#include "surface/fans.h"
#include "surface/recipe.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::surface::prep {

/// The weights of one valence class: all vertices with the same number of faces that are all interior or all boundary.
/// On a boundary the tangents of the first and the last spoke are (2 p0 + p_k)/3 - X instead.
struct ValenceClass : FanWeights {
    uint32_t sectors = 0; ///< faces: n in the interior, m on the boundary
    bool boundary = false;
    double c = 0.0;           ///< cos(2 pi / effective valence), exactly 0 for regular vertices
    bool sharpCorner = false; ///< boundary, one face, CornerRule::sharp
    // Of the vertex itself. All weights of the limit point sum to 1, those of e1 and e2 to 0. In float, sum differences
    // from the vertex and leave its own weight aside (docs/prep.md).
    double limitCenter = 0.0, e1Center = 0.0, e2Center = 0.0;
};

/// `sectors`: at least 3 in the interior and 1 on a boundary, which cage::buildTopology makes sure of.
[[nodiscard]] ValenceClass makeValenceClass(uint32_t sectors, bool boundary, const Options& options);

/// Whether an edge has a perturbation: it is interior, and one of its ends is irregular.
[[nodiscard]] bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge);

/// The perturbation of an edge A -> B. There is one row per coefficient h20, h30, h21, h31, in the edge's own
/// direction. The columns are six vectors {A, tA, tB, B, SA, SB}: the limit points A and B, the tangents tA and tB of
/// the spokes A->B and B->A, and the sums SA and SB of the two face coefficients beside the edge at A and at B. All
/// cases of docs/prep.md have this form. Every row sums to zero if SA and SB count twice, so a translation does not
/// change the perturbation.
using EdgeWeights = std::array<std::array<double, 6>, 4>;

/// `cA`, `cB`: ValenceClass::c of the two ends, exactly 0 for a regular end. If both are 0, so are all weights. Only
/// for interior edges; boundary edges have no perturbation.
[[nodiscard]] EdgeWeights makeEdgeWeights(double cA, double cB);

} // namespace supple::surface::prep
