// p-rep weights per valence class, computed once in double. They depend on connectivity only.
#pragma once

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
};

/// One valence class: (faces round the vertex, interior or boundary).
struct ValenceClass {
    uint32_t sectors = 0; ///< n in the interior, m on the boundary
    bool boundary = false;
    double c = 0.0; ///< cos(2 pi / effective valence), exactly 0 when regular
    bool sharpCorner = false; ///< boundary, one face, CornerRule::sharp
    // limit point: center*p0 + sum edge[k]*spoke_k + sum face[k]*diagonal_k (k over spokes, sectors)
    double limitCenter = 0.0;
    std::vector<double> limitEdge, limitFace;
    // tangent plane: e1, e2 as the same kind of sum
    double e1Center = 0.0, e2Center = 0.0;
    std::vector<double> e1Edge, e1Face, e2Edge, e2Face;
    // TG[k] = X + e1*cosines[k] + e2*sines[k]; on a boundary the first and last spoke use (2 p0 + p_k)/3 instead
    std::vector<double> cosines, sines;
};

[[nodiscard]] ValenceClass makeValenceClass(uint32_t sectors, bool boundary, const Options& options);

} // namespace supple::surface::prep
