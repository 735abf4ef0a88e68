// The kernels of queries (shaders/queries/): boxes of instances, what rays meet, hits as hosts have them.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "runtime/queries/nearest_kernels.h"
#include "shaders/shared/queries.h"

namespace supple::runtime {

class QueryKernels {
public:
    /// Both must outlive the kernels.
    [[nodiscard]] static Result<QueryKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipelines, if they are not there.
    [[nodiscard]] Status prepare();
    /// The same of those that find nearest points.
    [[nodiscard]] Status prepareNearest() { return nearest_.prepare(*pipelines_, layout_); }
    [[nodiscard]] const NearestKernels& nearest() const { return nearest_; }
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }

    // The kernels must have been prepared. A barrier (compute to compute) is to come before each but the first.
    void recordBoxes(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    /// For all rays, by as many dispatches as lanes can be numbered in.
    void recordPick(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    /// Hits of triangles, over misses.
    void recordRefine(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    void recordFinish(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;

    /// A lane a piece, an instance and a block of rays or places.
    static void recordPieces(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                             shared::QueryPush push);

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel boxes_, pick_, finish_, refine_;
    NearestKernels nearest_;
};

} // namespace supple::runtime
