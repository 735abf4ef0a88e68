// The kernels that construct coefficients of P_m. Private to surface/pm.
#pragma once

#include "shaders/shared/pm.h"
#include "surface/scheme.h"

namespace supple::surface::pm {

/// By kind of fan.
inline constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::pmVertex, shared::kRegularFan},  {Kernel::pmVertex, shared::kFewFan},
    {Kernel::pmVertex, shared::kManyFan},     {Kernel::pmVertex, shared::kCreasedFan},
    {Kernel::pmVertex, shared::kVariableFan},
};
/// By class of patches, from polar on.
inline constexpr KindOfKernel kFacetKernels[] = {
    {Kernel::pmFacet, shared::kPolarPatch},
    {Kernel::pmFacet, shared::kP3Patch},
    {Kernel::pmFacet, shared::kP4Patch},
    {Kernel::pmFacet, shared::kP5Patch},
};

} // namespace supple::surface::pm
