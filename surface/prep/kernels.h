// The kernels that construct coefficients of p-rep. Private to surface/prep.
#pragma once

#include "surface/scheme.h"

namespace supple::surface::prep {

/// By kind of fan.
inline constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::prepVertex, shared::kRegularFan},
    {Kernel::prepVertex, shared::kFewFan},
    {Kernel::prepVertex, shared::kManyFan},
};
inline constexpr KindOfKernel kEdgeKernel = {Kernel::prepEdge, 0};

/// The same of tables with fan records.
inline constexpr KindOfKernel kRecordVertexKernels[] = {
    {Kernel::prepVertexFanRecords, shared::kRegularFan},
    {Kernel::prepVertexFanRecords, shared::kFewFan},
    {Kernel::prepVertexFanRecords, shared::kManyFan},
};
inline constexpr KindOfKernel kRecordEdgeKernel = {Kernel::prepEdgeFanRecords, 0};

} // namespace supple::surface::prep
