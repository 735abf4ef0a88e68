// The kernels that construct coefficients of polygons. Private to surface/polygons.
#pragma once

#include "shaders/shared/polygons.h"
#include "surface/scheme.h"

namespace supple::surface::polygons {

/// By kind of faces.
inline constexpr KindOfKernel kFaceKernels[] = {
    {Kernel::polygonsFace, shared::kShortFaces, "supple polygons, faces"},
    {Kernel::polygonsFace, shared::kLongFaces, "supple polygons, long faces"}};
inline constexpr KindOfKernel kFrameKernel{Kernel::polygonsFrame, 0, "supple polygons, frames"};

} // namespace supple::surface::polygons
