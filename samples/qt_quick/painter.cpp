#include "painter.h"

#include <algorithm>
#include <span>

namespace qt_quick {

namespace {

VkDescriptorPool createPool(VkDevice device, uint32_t sets, std::span<const VkDescriptorPoolSize> sizes) {
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = sets;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool made = VK_NULL_HANDLE;
    must(vkCreateDescriptorPool(device, &info, nullptr, &made), "vkCreateDescriptorPool");
    return made;
}

VkDescriptorSet allocateSet(VkDevice device, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet made = VK_NULL_HANDLE;
    must(vkAllocateDescriptorSets(device, &info, &made), "vkAllocateDescriptorSets");
    return made;
}

void writeBuffer(VkDevice device, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                 VkDescriptorBufferInfo buffer) {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

void writeTexture(VkDevice device, VkDescriptorSet set, uint32_t binding, VkSampler sampler, VkImageView view) {
    const VkDescriptorImageInfo image{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

VkDescriptorBufferInfo whole(const SuppleBufferRange& range) {
    return {range.buffer, range.offset, range.size};
}

} // namespace

Painter::Painter(const Gpu& gpu) : gpu_(gpu), pipelines_(gpu), sun_(gpu) {
    uniforms_ = createBuffer(gpu, sizeof(FrameUniforms),
                             VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false);
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}};
    framePool_ = createPool(gpu.device, 1, sizes);
    frameSet_ = allocateSet(gpu.device, framePool_, pipelines_.frameSet);
    writeBuffer(gpu.device, frameSet_, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                {uniforms_.buffer, 0, sizeof(FrameUniforms)});
    writeTexture(gpu.device, frameSet_, 1, sun_.sampler(), sun_.view());
}

void Painter::destroy() {
    if (bound_.materials) {
        vkDestroyDescriptorPool(gpu_.device, bound_.pool, nullptr);
        bound_.materials->destroy();
    }
    vkDestroyDescriptorPool(gpu_.device, framePool_, nullptr);
    destroyBuffer(gpu_, uniforms_);
    sun_.destroy();
    pipelines_.destroy();
}

void Painter::unbind(Retired& retired, uint64_t lastFrame) {
    if (bound_.materials)
        retired.add(lastFrame, [gpu = gpu_, old = bound_] {
            vkDestroyDescriptorPool(gpu.device, old.pool, nullptr);
            old.materials->destroy();
        });
    bound_ = {};
}

void Painter::bind(const Characters& characters, Retired& retired, uint64_t lastFrame) {
    unbind(retired, lastFrame);
    bound_.materials = std::make_shared<Materials>(gpu_, characters.asset(), characters.materialCount());
    const auto surfaces = static_cast<uint32_t>(characters.surfaces().size());
    const auto textures = static_cast<uint32_t>(bound_.materials->count());
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3 * surfaces},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, textures}};
    bound_.pool = createPool(gpu_.device, surfaces + textures, sizes);
    const VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    for (const Surface& surface : characters.surfaces()) {
        VkDescriptorSet set = allocateSet(gpu_.device, bound_.pool, pipelines_.surfaceSet);
        writeBuffer(gpu_.device, set, 0, storage, whole(characters.info().instances));
        writeBuffer(gpu_.device, set, 1, storage, whole(surface.streams.vertices));
        writeBuffer(gpu_.device, set, 3, storage, whole(surface.streams.attributes));
        bound_.surfaces.push_back(set);
    }
    for (uint32_t i = 0; i < textures; ++i) {
        VkDescriptorSet set = allocateSet(gpu_.device, bound_.pool, pipelines_.textureSet);
        const Material& material = bound_.materials->of(i);
        writeTexture(gpu_.device, set, 0, material.sampler, material.texture.view);
        bound_.textures.push_back(set);
    }
}

/// One buffer for all frames in flight: the device writes it in its own order.
void Painter::writeUniforms(VkCommandBuffer commands, const FrameUniforms& uniforms) const {
    const VkPipelineStageFlags2 shaders =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = shaders; // of the frame before
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
    vkCmdUpdateBuffer(commands, uniforms_.buffer, 0, sizeof uniforms, &uniforms);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = shaders;
    barrier.dstAccessMask = VK_ACCESS_2_UNIFORM_READ_BIT;
    vkCmdPipelineBarrier2(commands, &dependency);
}

void Painter::draw(VkCommandBuffer commands, const Characters& characters, const Picture& picture,
                   const FrameUniforms& uniforms, Retired& retired, uint64_t frame) {
    bound_.materials->upload(commands, retired, frame);
    writeUniforms(commands, uniforms);
    const std::vector<Surface>& surfaces = characters.surfaces();
    for (const bool colors : {false, true}) {
        if (colors)
            picture.begin(commands);
        else
            sun_.begin(commands);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 0, 1, &frameSet_, 0,
                                nullptr);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, colors ? pipelines_.character : pipelines_.shadow);
        for (uint32_t i = 0; i < surfaces.size(); ++i)
            drawSurface(commands, surfaces[i], i, colors);
        if (!colors) {
            sun_.end(commands);
            continue;
        }
        vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.floor);
        vkCmdDraw(commands, 6, 1, 0, 0);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.backdrop);
        vkCmdDraw(commands, 3, 1, 0, 0);
        picture.end(commands);
    }
}

/// One indirect draw for each of the surface's draw ranges.
void Painter::drawSurface(VkCommandBuffer commands, const Surface& surface, uint32_t number, bool colors) const {
    const SuppleGridOutput& grid = surface.grid;
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 1, 1,
                            &bound_.surfaces[number], 0, nullptr);
    // Meshes (SUPPLE_SCHEME_POLYGONS) have indices of 32 bits.
    vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset,
                         grid.indices.stride == 4 ? VK_INDEX_TYPE_UINT32 : VK_INDEX_TYPE_UINT16);
    for (uint32_t i = 0; i < grid.drawRangeCount; ++i) {
        const SuppleDrawRange& range = grid.drawRanges[i];
        const size_t index = std::min<size_t>(range.material, bound_.textures.size() - 1); // none: the last one
        const Material& material = bound_.materials->of(static_cast<uint32_t>(index));
        DrawPush push{{range.patchCount, range.firstVertex, range.samplesPerPatch, grid.verticesPerInstance},
                      material.metallic,
                      material.roughness,
                      {},
                      {}};
        std::copy(material.factor.begin(), material.factor.end(), push.factor);
        std::copy(material.uvRows.begin(), material.uvRows.end(), push.uvRows);
        vkCmdPushConstants(commands, pipelines_.layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           sizeof push, &push);
        vkCmdSetCullMode(commands, material.doubleSided || !colors ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 2, 1,
                                &bound_.textures[index], 0, nullptr);
        vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer, grid.indirect.offset + i * grid.indirect.stride, 1,
                                 grid.indirect.stride);
    }
}

} // namespace qt_quick
