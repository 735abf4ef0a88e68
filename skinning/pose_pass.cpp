#include "skinning/pose_pass.h"

#include "gpu/device.h"
#include "shaders/pose_locals_comp.h"
#include "shaders/pose_palette_comp.h"

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(PosePush) <= gpu::kPushConstantBytes);

constexpr uint32_t kSharedRowsConstant = gpu::kFirstPassConstant; // shaders/pose/palette.comp

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
    Result<gpu::PipelineHandle> locals =
        gpu::createComputePipeline(device, pass.layout_, pose_locals_comp, {}, "supple pose, local matrices");
    if (!locals) {
        return locals.error();
    }
    pass.locals_ = std::move(*locals);
    const gpu::Constant rows{kSharedRowsConstant, device.mapping.wide ? kAffineElements * kSharedNodes : 1};
    Result<gpu::PipelineHandle> palette =
        gpu::createComputePipeline(device, pass.layout_, pose_palette_comp, {&rows, 1}, "supple pose, palette");
    if (!palette) {
        return palette.error();
    }
    pass.palette_ = std::move(*palette);
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

void PosePass::recordLocals(VkCommandBuffer commandBuffer, VkDescriptorSet set, const PosePush& push) const {
    const uint64_t items = uint64_t{push.nodeCount} + 1 + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    record(commandBuffer, set, push, locals_.get(), (items * push.instanceCount + local - 1) / local);
}

void PosePass::recordPalette(VkCommandBuffer commandBuffer, VkDescriptorSet set, const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    record(commandBuffer, set, push, palette_.get(), (push.instanceCount + local - 1) / local);
}

} // namespace supple::skinning
