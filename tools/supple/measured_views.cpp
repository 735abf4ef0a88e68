#include "tools/supple/measured_views.h"

#include "host/shaders/draw.h"
#include "tools/supple/curvature_view.h"

namespace supple::tools {

bool isMeasured(uint32_t view) {
    return view == host::shared::kViewDistance || view == host::shared::kViewMeanCurvature ||
           view == host::shared::kViewGaussianCurvature;
}

Result<std::vector<float>> measuredValues(uint32_t view, const PosedSurfaces& posed, const cage::Cage& cage,
                                          const SurfaceRules& rules) {
    return view == host::shared::kViewDistance ? distancesToLimit(posed, cage) : curvatures(posed, cage, rules, view);
}

} // namespace supple::tools
