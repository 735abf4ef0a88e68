// The kernels that construct coefficients of p-rep. Private to surface/prep.
#pragma once

#include "surface/scheme.h"

namespace supple::surface::prep {

/// By kind of fan.
inline constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::prepVertex, shared::kRegularFan, "supple p-rep vertex, regular"},
    {Kernel::prepVertex, shared::kFewFan, "supple p-rep vertex"},
    {Kernel::prepVertex, shared::kManyFan, "supple p-rep vertex, many spokes"},
};
inline constexpr KindOfKernel kEdgeKernel = {Kernel::prepEdge, 0, "supple p-rep edge"};

} // namespace supple::surface::prep
