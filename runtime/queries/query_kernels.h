// The kernels of queries (shaders/queries/): boxes of instances, what rays meet, hits as hosts have them.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "runtime/queries/nearest_kernels.h"
#include "runtime/queries/tree_kernels.h"
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
    /// Those of many rays, which are prepared by themselves.
    [[nodiscard]] const TreeKernels& trees() const { return trees_; }
    [[nodiscard]] Status prepareTrees() { return trees_.prepare(); }

    // The kernels must have been prepared. A barrier (compute to compute) is to come before each but the first.
    void recordBoxes(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    /// Which instances rays are aimed at.
    void recordAim(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    /// Lists these. A barrier that lets indirect commands be read is to come behind it.
    void recordList(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    /// For kRaysPerLane rays at most. `sizes`: what the list has written.
    void recordPick(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push,
                    VkBuffer sizes) const;
    /// Hits of triangles, over misses.
    void recordRefine(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;
    void recordFinish(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::QueryPush& push) const;

    /// For all rays or places: as many lanes for each block of kRaysPerLane of them, by as many dispatches as lanes can
    /// be numbered in.
    static void recordRays(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                           shared::QueryPush push, uint64_t lanes);
    /// A lane for each of them.
    static void recordEachRay(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                              const shared::QueryPush& push);

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    NearestKernels nearest_;
    TreeKernels trees_;
    gpu::Kernel boxes_, aim_, list_, pick_, finish_, refine_;
};

} // namespace supple::runtime
