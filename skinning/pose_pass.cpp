#include "skinning/pose_pass.h"

#include "gpu/device.h"
#include "shaders/pose_locals_comp.h"
#include "shaders/pose_locals_comp_ADDS.h"
#include "shaders/pose_palette_comp.h"
#include "shaders/pose_roots_comp.h"

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(PosePush) <= gpu::kPushConstantBytes);

// Specialization constants of shaders/pose/palette.comp.
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
    const struct {
        gpu::PipelineHandle* target;
        const gpu::Spirv& spirv;
        const char* name;
    } pipelines[] = {{&pass.locals_[0], pose_locals_comp, "supple pose, local matrices"},
                     {&pass.locals_[1], pose_locals_comp_ADDS, "supple pose, local matrices, additive"},
                     {&pass.roots_, pose_roots_comp, "supple pose, roots"}};
    for (const auto& [target, spirv, name] : pipelines) {
        Result<gpu::PipelineHandle> made = gpu::createComputePipeline(device, pass.layout_, spirv, {}, name);
        if (!made) {
            return made.error();
        }
        *target = std::move(*made);
    }
    return pass;
}

Status PosePass::prepare(SkinningMode mode) {
    gpu::PipelineHandle& palette = palette_[static_cast<size_t>(mode)];
    if (palette.get() != VK_NULL_HANDLE) {
        return success();
    }
    const bool dual = mode == SkinningMode::dualQuaternion;
    const gpu::Constant constants[] = {
        {kSharedRowsConstant, device_->mapping.wide ? kAffineElements * kSharedNodes : 1},
        {kDualQuaternionsConstant, dual ? VK_TRUE : VK_FALSE}};
    Result<gpu::PipelineHandle> made =
        gpu::createComputePipeline(*device_, layout_, pose_palette_comp, constants,
                                   dual ? "supple pose, palette of dual quaternions" : "supple pose, palette");
    if (!made) {
        return made.error();
    }
    palette = std::move(*made);
    return success();
}

void PosePass::record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const PosePush& push, VkPipeline pipeline,
                      uint64_t groups) const {
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    gpu::dispatchLinear(*device_, commandBuffer, groups);
}

void PosePass::recordLocals(VkCommandBuffer commandBuffer, VkDescriptorSet set, bool adds, const PosePush& push) const {
    const uint64_t items = uint64_t{push.nodeCount} + 1 + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    record(commandBuffer, set, push, locals_[adds ? 1 : 0].get(), (items * push.instanceCount + local - 1) / local);
}

void PosePass::recordRoots(VkCommandBuffer commandBuffer, VkDescriptorSet set, const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    record(commandBuffer, set, push, roots_.get(), (push.instanceCount + local - 1) / local);
}

void PosePass::recordPalette(VkCommandBuffer commandBuffer, VkDescriptorSet set, SkinningMode mode,
                             const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    record(commandBuffer, set, push, palette_[static_cast<size_t>(mode)].get(),
           (push.instanceCount + local - 1) / local);
}

} // namespace supple::skinning
