#include "surface/lod/passes.h"

#include "shaders/shared/surface.h"

namespace supple::surface::lod {

static_assert(sizeof(shared::LodPush) <= gpu::kPushConstantBytes);
static_assert(sizeof(shared::LodSolvePush) <= sizeof(shared::LodPush));
static_assert(shared::kLodRecords % 4 == 0, "records are read as elements");

Passes::Passes(const gpu::Device& device, const Shaders& shaders) : device_(&device), shaders_(shaders) {}

// Nothing is known of where a blend of charts faces.
Passes::Kernel Passes::patchKernel(const LodTables& tables, bool backFaces) {
    return tables.charts ? kChartPatch : backFaces ? kFacingPatch : kPatch;
}

Status Passes::prepare(const gpu::ComputeLayout& layout, const LodTables& tables, bool backFaces) {
    layout_ = layout.pipelineLayout.get();
    const gpu::Constant charts[] = {{gpu::kFirstPassConstant, tables.charts ? VK_TRUE : VK_FALSE}};
    const Kernel patch = patchKernel(tables, backFaces);
    const struct {
        Kernel kernel;
        const gpu::Spirv& spirv;
        std::span<const gpu::Constant> constants;
        const char* name;
    } sources[] = {{tables.charts ? kChartEdge : kEdge, shaders_.edge, charts, "supple levels of edges"},
                   {patch,
                    patch == kChartPatch    ? shaders_.chartPatch
                    : patch == kFacingPatch ? shaders_.facingPatch
                                            : shaders_.patch,
                    {},
                    "supple levels of patches"},
                   {kSolve, shaders_.solve, {}, "supple level budget"},
                   {kPlace, shaders_.place, {}, "supple level places"}};
    for (const auto& [kernel, spirv, constants, name] : sources) {
        // Groups of rates have no patches with levels; the view's budget is solved for them, too.
        const bool asked = kernel == kSolve || !tables.runs.empty();
        if (asked && pipelines_[kernel].get() == VK_NULL_HANDLE) {
            Result<gpu::PipelineHandle> pipeline = gpu::createComputePipeline(*device_, layout, spirv, constants, name);
            if (!pipeline) {
                return pipeline.error();
            }
            pipelines_[kernel] = std::move(*pipeline);
        }
    }
    return success();
}

void Passes::bind(VkCommandBuffer commandBuffer, Kernel kernel, VkDescriptorSet set, const void* push,
                  uint32_t bytes) const {
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_[kernel].get());
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, push);
}

void Passes::dispatch(VkCommandBuffer commandBuffer, Kernel kernel, const Window& window, VkDeviceSize arguments,
                      shared::LodPush push) const {
    push.firstInstance = window.firstInstance;
    push.instanceCount = window.instanceCount;
    if (push.count == 0) {
        return;
    }
    bind(commandBuffer, kernel, window.set, &push, sizeof(push));
    if (window.arguments != VK_NULL_HANDLE) {
        device_->vk.CmdDispatchIndirect(commandBuffer, window.arguments, arguments);
    } else {
        const uint64_t lanes = uint64_t{push.count} * push.instanceCount, local = device_->mapping.localSize;
        gpu::dispatchLinear(*device_, commandBuffer, (lanes + local - 1) / local);
    }
}

void Passes::recordEdges(VkCommandBuffer commandBuffer, const LodTables& tables, const Window& window,
                         VkDeviceSize arguments, shared::LodPush push) const {
    push.count = push.edgeCount;
    dispatch(commandBuffer, tables.charts ? kChartEdge : kEdge, window, arguments, push);
}

void Passes::recordPatches(VkCommandBuffer commandBuffer, const LodTables& tables, const Window& window,
                           VkDeviceSize arguments, const shared::LodPush& push, bool backFaces) const {
    dispatch(commandBuffer, patchKernel(tables, backFaces), window, arguments + sizeof(VkDispatchIndirectCommand),
             push);
}

void Passes::recordSolve(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::LodSolvePush& push) const {
    bind(commandBuffer, kSolve, set, &push, sizeof(push));
    device_->vk.CmdDispatch(commandBuffer, 1, 1, 1);
}

void Passes::recordPlaces(VkCommandBuffer commandBuffer, const Window& window, VkDeviceSize arguments,
                          const shared::LodPush& push) const {
    dispatch(commandBuffer, kPlace, window, arguments + sizeof(VkDispatchIndirectCommand), push);
}

} // namespace supple::surface::lod
