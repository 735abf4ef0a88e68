#include "skinning/pose_pass.h"

#include "gpu/device.h"
#include "shaders/pose_locals_comp.h"
#include "shaders/pose_palette_comp.h"

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(PosePush) <= gpu::kPushConstantBytes);

// Specialization constants: shaders/pose/locals.comp, palette.comp.
constexpr uint32_t kRootsConstant = gpu::kFirstPassConstant;
constexpr uint32_t kAddsConstant = kRootsConstant + 1;
constexpr uint32_t kSharedRowsConstant = gpu::kFirstPassConstant;
constexpr uint32_t kDualQuaternionsConstant = kSharedRowsConstant + 1;

} // namespace

Result<PosePass> PosePass::create(const gpu::Device& device) {
    const gpu::Binding bindings[] = {
        {kClipTableBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kClipTableTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kStateBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kStateTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kMaskBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kMaskTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kScratchPoseBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kScratchPoseTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kPosedBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kInstanceBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kInstanceTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
    };
    PosePass pass;
    pass.device_ = &device;
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(device, bindings, sizeof(PosePush), "supple pose");
    if (!layout) {
        return layout.error();
    }
    pass.layout_ = std::move(*layout);
    for (uint32_t roots = 0; roots < 2; ++roots) {
        for (uint32_t adds = 0; adds < 2; ++adds) {
            const gpu::Constant constants[] = {{kRootsConstant, roots}, {kAddsConstant, adds}};
            Result<gpu::PipelineHandle> pipeline = gpu::createComputePipeline(device, pass.layout_, pose_locals_comp,
                                                                              constants, "supple pose, local matrices");
            if (!pipeline) {
                return pipeline.error();
            }
            pass.locals_[roots][adds] = std::move(*pipeline);
        }
    }
    const uint32_t rows = device.mapping.wide ? kAffineElements * kSharedNodes : 1;
    for (uint32_t mode = 0; mode < 2; ++mode) {
        const gpu::Constant constants[] = {{kSharedRowsConstant, rows}, {kDualQuaternionsConstant, mode}};
        Result<gpu::PipelineHandle> pipeline =
            gpu::createComputePipeline(device, pass.layout_, pose_palette_comp, constants, "supple pose, palette");
        if (!pipeline) {
            return pipeline.error();
        }
        pass.palette_[mode] = std::move(*pipeline);
    }
    return pass;
}

void PosePass::record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const PosePush& push, VkPipeline pipeline,
                      uint64_t groups) const {
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    gpu::dispatchLinear(*device_, commandBuffer, groups);
}

void PosePass::recordLocals(VkCommandBuffer commandBuffer, VkDescriptorSet set, Features features,
                            const PosePush& push) const {
    const uint64_t items = uint64_t{push.nodeCount} + 1 + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    record(commandBuffer, set, push, locals_[features.roots ? 1 : 0][features.adds ? 1 : 0].get(),
           (items * push.instanceCount + local - 1) / local);
}

void PosePass::recordPalette(VkCommandBuffer commandBuffer, VkDescriptorSet set, SkinningMode mode,
                             const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    record(commandBuffer, set, push, palette_[static_cast<size_t>(mode)].get(),
           (push.instanceCount + local - 1) / local);
}

} // namespace supple::skinning
