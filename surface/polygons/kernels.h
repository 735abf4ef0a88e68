// The kernels that construct coefficients of polygons. Private to surface/polygons.
#pragma once

#include "shaders/shared/polygons.h"
#include "surface/scheme.h"

namespace supple::surface::polygons {

/// By kind of faces.
inline constexpr KindOfKernel kFaceKernels[] = {{Kernel::polygonsFace, shared::kShortFaces},
                                                {Kernel::polygonsFace, shared::kLongFaces}};
inline constexpr KindOfKernel kFrameKernel{Kernel::polygonsFrame, 0};

} // namespace supple::surface::polygons
