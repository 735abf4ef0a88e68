// Charts of texture coordinates under the blending surface, in double (docs/smooth_uvs.md).
#pragma once

#include "surface/blend/weights.h"
#include "surface/uv_levels.h"

#include <array>
#include <vector>

namespace supple::surface::blend {

/// The charts of a UV set, over the channel of the mesh. A run of faces that a seam cuts off has a chart like a
/// boundary's, which passes through its value; everywhere else charts are of the surface's own classes.
struct UvCharts {
    struct Corner {
        uint32_t chart = 0, sector = 0;
    };
    std::vector<std::array<glm::dvec2, kCoefficients>> coefficients; ///< by chart
    std::vector<ChartClass> classes;                                 ///< by chart
    std::vector<Corner> corners;                                     ///< per corner of the mesh's cage
};

/// `begin`: the cage that `mesh` was made of, as beginCharts() gives it. `uvs`: one per corner of it.
[[nodiscard]] Result<UvCharts> makeUvCharts(const Mesh& mesh, const RefinedMesh& begin,
                                            const std::vector<glm::vec2>& uvs, cage::UvMode mode);

} // namespace supple::surface::blend
