// The pose pass: what instances play, sampled, layered and put together on the device into the poses that the deform
// pass reads.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/pose.h"
#include "skinning/deform_pass.h"

namespace supple::skinning {

class PosePass {
public:
    [[nodiscard]] static Result<PosePass> create(const gpu::Device& device);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// What instances may play beyond clips that are blended; code for the rest costs time even where no one runs it.
    struct Features {
        bool roots = false; ///< root motion
        bool adds = false;  ///< additive layers
    };
    /// Each records one dispatch over a window of instances; a barrier stands between the two.
    void recordLocals(VkCommandBuffer commandBuffer, VkDescriptorSet set, Features features,
                      const shared::PosePush& push) const;
    void recordPalette(VkCommandBuffer commandBuffer, VkDescriptorSet set, SkinningMode mode,
                       const shared::PosePush& push) const;

private:
    void record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::PosePush& push, VkPipeline pipeline,
                uint64_t groups) const;

    const gpu::Device* device_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::PipelineHandle locals_[2][2]; ///< by Features: roots, adds
    gpu::PipelineHandle palette_[2];   ///< by SkinningMode
};

} // namespace supple::skinning
