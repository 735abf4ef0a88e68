// The kernels that construct coefficients of P_m. Private to surface/pm.
#pragma once

#include "shaders/shared/pm.h"
#include "surface/scheme.h"

namespace supple::surface::pm {

/// By kind of fan.
inline constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::pmVertex, shared::kRegularFan, "supple P_m vertex, regular"},
    {Kernel::pmVertex, shared::kFewFan, "supple P_m vertex"},
    {Kernel::pmVertex, shared::kManyFan, "supple P_m vertex, many spokes"},
    {Kernel::pmVertex, shared::kCreasedFan, "supple P_m vertex, creased"},
};
/// By class of patches, from polar on.
inline constexpr KindOfKernel kFacetKernels[] = {
    {Kernel::pmFacet, shared::kPolarPatch, "supple P_m facet, polar"},
    {Kernel::pmFacet, shared::kP3Patch, "supple P_m facet, triangle"},
    {Kernel::pmFacet, shared::kP4Patch, "supple P_m facet, quad"},
    {Kernel::pmFacet, shared::kP5Patch, "supple P_m facet, pentagon"},
};

} // namespace supple::surface::pm
