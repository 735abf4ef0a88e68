// The kernels that construct coefficients of the blending surface. Private to surface/blend.
#pragma once

#include "surface/scheme.h"

namespace supple::surface::blend {

/// Kernels that make charts: over the cage, or over what a step of subdivision makes of it.
inline constexpr KindOfKernel kChartKernels[] = {{Kernel::blendChart, 0}, {Kernel::blendChartMeshInPool, 0}};

} // namespace supple::surface::blend
