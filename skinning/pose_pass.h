// The pose pass: what instances play, sampled, layered and put together on the device into the poses that the deform
// pass reads.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/pose.h"

namespace supple::skinning {

class PosePass {
public:
    [[nodiscard]] static Result<PosePass> create(const gpu::Device& device);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// Each records one dispatch over a window of instances; a barrier stands between the two.
    void recordLocals(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::PosePush& push) const;
    void recordPalette(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::PosePush& push) const;

private:
    void record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::PosePush& push, VkPipeline pipeline,
                uint64_t groups) const;

    const gpu::Device* device_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::PipelineHandle locals_, palette_;
};

} // namespace supple::skinning
