// The kernels that find nearest points (shaders/queries/nearest.comp, nearest_finish.comp). They bind what those of
// rays do.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/queries.h"

namespace supple::runtime {

class NearestKernels {
public:
    /// Makes the pipelines, if they are not there. `layout` must outlive them.
    [[nodiscard]] Status prepare(gpu::Pipelines& pipelines, const gpu::ComputeLayout& layout);

    // The kernels must have been prepared. A barrier (compute to compute) is to come before each.
    /// For all places, by as many dispatches as lanes can be numbered in.
    void recordFind(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    void recordFinish(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;

private:
    gpu::Kernel find_, finish_;
};

} // namespace supple::runtime
