// The kernels of queries of many rays (shaders/queries/tree.glsl): trees over pieces in the frame's poses, and rays
// that go through them.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/queries.h"

namespace supple::runtime {

class TreeKernels {
public:
    /// Both must outlive the kernels.
    [[nodiscard]] static Result<TreeKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipelines, if they are not there.
    [[nodiscard]] Status prepare();
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }

    /// What a turn records, with a barrier (compute to compute) before each. Their places in shared::kTreeDispatches.
    enum class Pass : uint32_t { fit, refit, cast };
    /// `sizes`: where the device has written them, those of the turn from element `first` on.
    void record(gpu::Dispatches& dispatches, Pass pass, const gpu::BoundSet& set, const shared::QueryPush& push,
                VkBuffer sizes, uint32_t first) const;

private:
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel kernels_[shared::kTreeDispatches];
};

} // namespace supple::runtime
