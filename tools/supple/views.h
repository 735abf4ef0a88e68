// What can be painted on a figure, by the names that the command line and the viewer have for it.
#pragma once

#include "host/shaders/draw.h"

namespace supple::tools {

struct NamedView {
    const char* name;
    uint32_t view; ///< host::shared::kView...
};
inline constexpr NamedView kViews[] = {
    {"shaded", host::shared::kViewShaded},
    {"wire", host::shared::kViewWire},
    {"patches", host::shared::kViewPatches},
    {"normals", host::shared::kViewNormals},
    {"zebra", host::shared::kViewZebra},
    {"highlights", host::shared::kViewHighlights},
    {"isophotes", host::shared::kViewIsophotes},
    {"tangents", host::shared::kViewTangents},
    {"uv", host::shared::kViewUv},
    {"uv1", host::shared::kViewUv1},
    {"vertex-color", host::shared::kViewVertexColor},
    {"base-color", host::shared::kViewBaseColor},
    {"metallic", host::shared::kViewMetallic},
    {"roughness", host::shared::kViewRoughness},
    {"normal-map", host::shared::kViewNormalMap},
    {"occlusion", host::shared::kViewOcclusion},
    {"emissive", host::shared::kViewEmissive},
    {"weights", host::shared::kViewWeights},
    {"distance", host::shared::kViewDistance},
    {"levels", host::shared::kViewLevels},
    {"mean-curvature", host::shared::kViewMeanCurvature},
    {"gaussian-curvature", host::shared::kViewGaussianCurvature},
};

} // namespace supple::tools
