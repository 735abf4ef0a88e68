// p-rep weights per valence class, computed once in double. They depend on connectivity only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace supple::surface::prep {

/// Length of the tangents at extraordinary vertices. `printed` is the paper's eq. (3) taken literally; `standard` (the
/// API's "default") equals it up to valence 5 and stays close to Catmull-Clark from 6 on. Both are G1.
enum class TangentMode { standard, printed };

/// A boundary vertex with one face: `sharp` interpolates it, `smooth` lets it take part in the boundary B-spline.
enum class CornerRule { sharp, smooth };

struct Options {
    TangentMode tangentMode = TangentMode::standard;
    CornerRule cornerRule = CornerRule::sharp;

    bool operator==(const Options&) const = default;
};

/// One valence class: (faces round the vertex, interior or boundary).
struct ValenceClass {
    uint32_t sectors = 0; ///< n in the interior, m on the boundary
    bool boundary = false;
    double c = 0.0;           ///< cos(2 pi / effective valence), exactly 0 when regular
    bool sharpCorner = false; ///< boundary, one face, CornerRule::sharp
    // limit point: center*p0 + sum edge[k]*spoke_k + sum face[k]*diagonal_k (k over spokes, sectors). The weights sum
    // to 1, those of e1 and e2 to 0: in float, sum over differences from p0 and leave the centre's weight aside
    // (docs/prep.md)
    double limitCenter = 0.0;
    std::vector<double> limitEdge, limitFace;
    // tangent plane: e1, e2 as the same kind of sum
    double e1Center = 0.0, e2Center = 0.0;
    std::vector<double> e1Edge, e1Face, e2Edge, e2Face;
    // TG[k] = X + e1*cosines[k] + e2*sines[k]; on a boundary the first and last spoke use (2 p0 + p_k)/3 instead
    std::vector<double> cosines, sines;
};

/// Interior: sectors >= 3; boundary: sectors >= 1 (what cage::buildTopology lets through).
[[nodiscard]] ValenceClass makeValenceClass(uint32_t sectors, bool boundary, const Options& options);

/// The perturbation of an edge A -> B, one row per coefficient h20, h30, h21, h31 (in the edge's own direction), over
/// the six vectors {A, tA, tB, B, SA, SB}: limit points A, B; tangents tA, tB of the spokes A->B, B->A; SA, SB the sums
/// of the two face coefficients beside the edge at A and at B. All cases of docs/prep.md in one form; every row sums to
/// zero once SA and SB count twice, so the perturbation does not see a translation.
using EdgeWeights = std::array<std::array<double, 6>, 4>;

/// cA, cB: ValenceClass::c of the two ends, exactly 0 where an end is regular; both 0 gives all zeros. Interior edges
/// only (on a boundary edge the perturbation is zero).
[[nodiscard]] EdgeWeights makeEdgeWeights(double cA, double cB);

} // namespace supple::surface::prep
