#include "passes.h"

#include "host/must.h"
#include "host/rendering.h"
#include "shaders/backdrop_frag.h"
#include "shaders/backdrop_vert.h"
#include "shaders/character_frag.h"
#include "shaders/character_shadow_vert.h"
#include "shaders/character_vert.h"
#include "shaders/floor_frag.h"
#include "shaders/floor_vert.h"

#include <algorithm>
#include <cstring>

namespace engine {

namespace {

constexpr uint32_t kSunMapSize = 2048;
constexpr VkFormat kColorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kMotionFormat = VK_FORMAT_R16G16_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr float kSunRadius = 0.045f; // a veiled sun: shadows of a hand's width soften over two metres

/// SuppleRange of shaders/supple_surface.glsl, and the material.
struct RangePush {
    uint32_t patchCount;
    uint32_t firstVertex;
    uint32_t samplesPerPatch;
    uint32_t verticesPerInstance;
    uint32_t firstSlot;
    uint32_t previousWords;
    float metallic;
    float roughness;
    glm::vec4 baseColor;
};

constexpr VkClearValue kFar{.depthStencil = {1.0f, 0}};

} // namespace

Passes::Passes(Device& device, Graph& graph, const Characters& characters)
    : characters_(characters), sun_(sunOverStage()) {
    constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    const VkDescriptorSetLayout frameLayout =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth},
                                      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                                      {2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}));
    // The bindings of shaders/supple_surface.glsl.
    const VkDescriptorSetLayout groupLayout =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}}));
    layout_ = must(createPipelineLayout(device, {frameLayout, groupLayout}, sizeof(RangePush), kBoth));

    sunMap_ =
        must(device.createImage({.format = kDepthFormat,
                                 .extent = {kSunMapSize, kSunMapSize},
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    sunMapUse_ = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);
    graph.setImage(sunMapUse_, sunMap_.handle());
    images_.colorUse = graph.addImage();
    images_.motionUse = graph.addImage();
    images_.depthUse = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);

    DescriptorPool pool = must(DescriptorPool::create(device, 8));
    const VkSampler compare = must(createSampler(device, VK_FILTER_LINEAR, true));
    const VkSampler plain = must(createSampler(device, VK_FILTER_NEAREST));
    for (uint32_t slot = 0; slot < kFramesInFlight; ++slot) {
        uniforms_[slot] =
            must(device.createBuffer(sizeof(FrameUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
        frameSets_[slot] = must(pool.allocate(frameLayout));
        pool.write(frameSets_[slot], {uniformBuffer(0, uniforms_[slot]), sampledImage(1, sunMap_, compare),
                                      sampledImage(2, sunMap_, plain)});
    }
    for (std::size_t i = 0; i < groupSets_.size(); ++i) {
        const SuppleVertexStreams& streams = characters.groups()[i].streams;
        groupSets_[i] = must(pool.allocate(groupLayout));
        pool.write(groupSets_[i],
                   {storageBuffer(0, characters.groups()[i].info.instances), storageBuffer(1, streams.vertices),
                    storageBuffer(2, streams.previousPositions), storageBuffer(3, streams.attributes)});
    }

    shadowPipeline_ = must(createGraphicsPipeline(device, {.layout = layout_,
                                                           .vertexShader = character_shadow_vert,
                                                           .depth = kDepthFormat,
                                                           .depthBias = 1.0f,
                                                           .depthBiasSlope = 1.5f}));
    GraphicsDesc scene{.layout = layout_, .colors = {kColorFormat, kMotionFormat}, .depth = kDepthFormat};
    scene.vertexShader = character_vert;
    scene.fragmentShader = character_frag;
    characterPipeline_ = must(createGraphicsPipeline(device, scene));
    sticker_.emplace(device, characters, frameLayout, scene);
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    scene.vertexShader = floor_vert;
    scene.fragmentShader = floor_frag;
    floorPipeline_ = must(createGraphicsPipeline(device, scene));
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    scene.depthWrite = false;
    scene.vertexShader = backdrop_vert;
    scene.fragmentShader = backdrop_frag;
    backdropPipeline_ = must(createGraphicsPipeline(device, scene));
}

void Passes::resize(Device& device, Graph& graph, VkExtent2D extent) {
    constexpr VkImageUsageFlags kColor = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    images_.color = must(device.createImage({.format = kColorFormat, .extent = extent, .usage = kColor}));
    images_.motion = must(device.createImage({.format = kMotionFormat, .extent = extent, .usage = kColor}));
    images_.depth =
        must(device.createImage({.format = kDepthFormat,
                                 .extent = extent,
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    graph.setImage(images_.colorUse, images_.color.handle());
    graph.setImage(images_.motionUse, images_.motion.handle());
    graph.setImage(images_.depthUse, images_.depth.handle());
    hasPrevious_ = false;
}

void Passes::update(uint32_t slot, uint64_t frame, const Camera& camera, glm::vec2 jitter,
                    const std::vector<Footprint>& footprints) {
    const VkExtent2D extent = images_.color.desc().extent;
    const glm::vec2 size{static_cast<float>(extent.width), static_cast<float>(extent.height)};
    FrameUniforms uniforms{};
    uniforms.viewProjection = camera.viewProjection;
    uniforms.jitteredViewProjection =
        glm::translate(glm::mat4(1.0f), glm::vec3(2.0f * jitter / size, 0.0f)) * camera.viewProjection;
    uniforms.previousViewProjection = hasPrevious_ ? previousViewProjection_ : camera.viewProjection;
    uniforms.sunViewProjection = sun_.viewProjection;
    uniforms.eye = glm::vec4(camera.eye, 1.0f);
    uniforms.sunDirection = glm::vec4(sun_.direction, kSunRadius);
    uniforms.viewport = glm::vec4(size, 1.0f / size);
    for (std::size_t i = 0; i < std::min(footprints.size(), std::size(uniforms.feet)); ++i)
        uniforms.feet[i] = glm::vec4(footprints[i].position, footprints[i].radius);
    uniforms.noise = glm::vec4(static_cast<float>(frame % 32), sun_.width / kSunMapSize, sun_.depth, 0.0f);
    std::memcpy(uniforms_[slot].mapped(), &uniforms, sizeof uniforms);
    previousViewProjection_ = camera.viewProjection;
    hasPrevious_ = true;
}

void Passes::addToGraph(Graph& graph, uint32_t slot, Resource characterBuffers) {
    graph.add("shadows",
              {reads(characterBuffers, kDrawn),
               writes(sunMapUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)},
              [this, slot](VkCommandBuffer commands) { drawShadows(commands, slot); });
    graph.add("scene",
              {reads(characterBuffers, kDrawn),
               reads(sunMapUse_, kSampledInFragment, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
               writes(images_.colorUse, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true),
               writes(images_.motionUse, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true),
               writes(images_.depthUse, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)},
              [this, slot](VkCommandBuffer commands) { drawScene(commands, slot); });
}

/// One indirect draw for each range of each group: it draws all visible instances.
void Passes::drawCharacters(VkCommandBuffer commands, VkPipeline pipeline, uint32_t slot, bool cull) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    for (std::size_t i = 0; i < groupSets_.size(); ++i) {
        const CharacterGroup& group = characters_.groups()[i];
        const SuppleGridOutput& grid = group.grid;
        const VkDescriptorSet sets[] = {frameSets_[slot], groupSets_[i]};
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
        vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset, VK_INDEX_TYPE_UINT16);
        for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
            const SuppleDrawRange& range = grid.drawRanges[r];
            const Look& look = group.looks[r];
            const RangePush push{
                range.patchCount, range.firstVertex, range.samplesPerPatch, grid.verticesPerInstance, 0, 0,
                look.metallic,    look.roughness,    look.baseColor};
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                               sizeof push, &push);
            vkCmdSetCullMode(commands, cull && !look.doubleSided ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE);
            vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer,
                                     grid.indirect.offset + VkDeviceSize{r} * grid.indirect.stride, 1,
                                     grid.indirect.stride);
        }
    }
}

void Passes::drawShadows(VkCommandBuffer commands, uint32_t slot) const {
    beginRendering(commands, sunMap_.desc().extent, {},
                   attachment(sunMap_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    drawCharacters(commands, shadowPipeline_, slot, false);
    vkCmdEndRendering(commands);
}

void Passes::drawScene(VkCommandBuffer commands, uint32_t slot) const {
    // The backdrop fills what nothing else does, so that colors need no clearing.
    const VkRenderingAttachmentInfo colors[] = {
        attachment(images_.color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, {}, VK_ATTACHMENT_LOAD_OP_DONT_CARE),
        attachment(images_.motion, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, {}, VK_ATTACHMENT_LOAD_OP_DONT_CARE)};
    beginRendering(commands, images_.color.desc().extent, colors,
                   attachment(images_.depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    drawCharacters(commands, characterPipeline_, slot, true);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    sticker_->draw(commands, frameSets_[slot]);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &frameSets_[slot], 0, nullptr);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, floorPipeline_);
    vkCmdDraw(commands, 4, 1, 0, 0);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, backdropPipeline_);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
}

} // namespace engine
