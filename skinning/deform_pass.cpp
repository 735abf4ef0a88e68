#include "skinning/deform_pass.h"

#include "shaders/deform_deform_comp.h"

#include <bit>

namespace supple::skinning {

std::vector<uint32_t> buildDeformTable(const cage::Cage& cage, const cage::SkinWeights& weights) {
    const uint32_t vertexCount = cage.vertexCount();
    std::vector<uint32_t> vertices, influences;
    vertices.reserve(4 * (size_t{vertexCount} + 1));
    influences.reserve(2 * weights.influences.size());
    const auto nextElement = [&] { return static_cast<uint32_t>(vertexCount + 1 + influences.size() / 4); };
    for (uint32_t v = 0; v < vertexCount; ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            vertices.push_back(std::bit_cast<uint32_t>(cage.positions[v][axis]));
        }
        vertices.push_back(nextElement());
        const uint32_t end = weights.starts[v + 1];
        for (uint32_t i = weights.starts[v]; i < end; i += 2) {
            const cage::Influence first = weights.influences[i];
            const cage::Influence second = i + 1 < end ? weights.influences[i + 1] : cage::Influence{first.joint, 0.0f};
            influences.insert(influences.end(), {first.joint, std::bit_cast<uint32_t>(first.weight), second.joint,
                                                 std::bit_cast<uint32_t>(second.weight)});
        }
    }
    vertices.insert(vertices.end(), {0u, 0u, 0u, nextElement()});
    vertices.insert(vertices.end(), influences.begin(), influences.end());
    return vertices;
}

Result<DeformPass> DeformPass::create(const gpu::Device& device) {
    using namespace shared;
    const gpu::Binding bindings[] = {
        {kDeformTableBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kDeformTableTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kPaletteBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kPaletteTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kDeformedCageBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
    };
    DeformPass pass;
    pass.device_ = &device;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, sizeof(DeformPush), "supple deform");
    if (!layout) {
        return layout.error();
    }
    pass.layout_ = std::move(*layout);
    Result<gpu::PipelineHandle> pipeline =
        gpu::createComputePipeline(device, pass.layout_, deform_deform_comp, {}, "supple deform");
    if (!pipeline) {
        return pipeline.error();
    }
    pass.pipeline_ = std::move(*pipeline);
    return pass;
}

void DeformPass::record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::DeformPush& push) const {
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    const uint64_t lanes = uint64_t{push.vertexCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    gpu::dispatchLinear(*device_, commandBuffer, (lanes + local - 1) / local);
}

} // namespace supple::skinning
