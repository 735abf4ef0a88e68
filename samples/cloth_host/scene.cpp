#include "scene.h"

#include "host/must.h"
#include "host/rendering.h"
#include "shaders/cloth_frag.h"
#include "shaders/cloth_vert.h"
#include "shaders/ground_frag.h"
#include "shaders/ground_vert.h"
#include "shaders/pole_frag.h"
#include "shaders/pole_vert.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_vert.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cstring>

namespace cloth {

namespace {

constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkSampleCountFlagBits kSamples = VK_SAMPLE_COUNT_4_BIT;
constexpr uint32_t kSunMapSize = 2048;
constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// SuppleRange of shaders/supple_surface.glsl, and whether the sun looks.
struct SheetPush {
    uint32_t patchCount;
    uint32_t firstVertex;
    uint32_t samplesPerPatch;
    uint32_t verticesPerInstance;
    uint32_t firstSlot;
    uint32_t previousWords;
    uint32_t shadow;
};

struct PolePush {
    glm::vec4 a; ///< w: radius
    glm::vec4 b; ///< w: 1 for the sun's map
};

constexpr uint32_t kPoleVertices = 4 * (24 + 1);
const PolePush kPoles[] = {{{-2.93f, 0.0f, 0.0f, 0.035f}, {-2.93f, 3.95f, 0.0f, 0.0f}},
                           {{0.77f, 0.0f, 0.487f, 0.035f}, {0.77f, 3.80f, 0.487f, 0.0f}},
                           {{0.59f, 3.585f, 0.574f, 0.026f}, {2.48f, 3.585f, -0.341f, 0.0f}}};

constexpr SuppleSyncScope kColorWrites{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                       VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr SuppleSyncScope kDepthWrites{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr SuppleSyncScope kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr SuppleSyncScope kCopied{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};

SceneUniforms lookAtIt(VkExtent2D extent) {
    const glm::vec2 size{static_cast<float>(extent.width), static_cast<float>(extent.height)};
    const glm::vec3 eye{0.5f, 1.75f, 8.7f};
    const glm::vec3 sun = glm::normalize(glm::vec3(-0.34f, 0.72f, 0.55f));
    constexpr float kHalf = 4.2f;
    SceneUniforms uniforms{};
    glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(34.0f), size.x / size.y, 0.5f, 200.0f);
    projection[1][1] = -projection[1][1]; // Vulkan's y points down
    const glm::vec3 up{0.0f, 1.0f, 0.0f};
    uniforms.viewProjection = projection * glm::lookAt(eye, glm::vec3(-0.05f, 1.95f, 0.0f), up);
    const glm::vec3 middle{0.5f, 1.6f, -0.8f};
    uniforms.sunViewProjection =
        glm::orthoRH_ZO(-kHalf, kHalf, -kHalf, kHalf, 0.0f, 20.0f) * glm::lookAt(middle + 10.0f * sun, middle, up);
    uniforms.eye = glm::vec4(eye, 1.0f);
    uniforms.sunDirection = glm::vec4(sun, 0.0f);
    uniforms.viewport = glm::vec4(size, 1.0f / size);
    return uniforms;
}

} // namespace

Scene::Scene(Device& device, const Cloth& cloth, VkExtent2D extent) : cloth_(cloth) {
    sunMap_ =
        must(device.createImage({.format = kDepthFormat,
                                 .extent = {kSunMapSize, kSunMapSize},
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    color_ = must(device.createImage(
        {.format = kColorFormat, .extent = extent, .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, .samples = kSamples}));
    depth_ = must(device.createImage({.format = kDepthFormat,
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                      .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                      .samples = kSamples}));
    picture_ =
        must(device.createImage({.format = kColorFormat,
                                 .extent = extent,
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    const SceneUniforms uniforms = lookAtIt(extent);
    uniforms_ = must(device.createBuffer(sizeof uniforms, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
    std::memcpy(uniforms_.mapped(), &uniforms, sizeof uniforms);

    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const VkDescriptorSetLayout sceneLayout =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth},
                                      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}));
    // The bindings of shaders/supple_surface.glsl; without previous positions, which are 2.
    const VkDescriptorSetLayout sheetLayout =
        must(createSetLayout(device, {{0, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {1, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {3, kStorage, VK_SHADER_STAGE_VERTEX_BIT}}));
    layout_ =
        must(createPipelineLayout(device, {sceneLayout, sheetLayout}, sizeof(PolePush), VK_SHADER_STAGE_VERTEX_BIT));
    DescriptorPool pool = must(DescriptorPool::create(device, 2));
    sceneSet_ = must(pool.allocate(sceneLayout));
    sheetSet_ = must(pool.allocate(sheetLayout));
    pool.write(sceneSet_, {uniformBuffer(0, uniforms_),
                           sampledImage(1, sunMap_, must(createSampler(device, VK_FILTER_LINEAR, true)))});
    const SuppleVertexStreams& streams = cloth.streams();
    pool.write(sheetSet_, {storageBuffer(0, cloth.info().instances), storageBuffer(1, streams.vertices),
                           storageBuffer(3, streams.attributes)});

    GraphicsDesc shadow{.layout = layout_, .depth = kDepthFormat, .depthBias = 1.0f, .depthBiasSlope = 2.0f};
    shadow.vertexShader = cloth_vert;
    sheetShadows_ = must(createGraphicsPipeline(device, shadow));
    shadow.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    shadow.vertexShader = pole_vert;
    poleShadows_ = must(createGraphicsPipeline(device, shadow));

    GraphicsDesc scene{.layout = layout_, .colors = {kColorFormat}, .depth = kDepthFormat, .samples = kSamples};
    scene.vertexShader = cloth_vert;
    scene.fragmentShader = cloth_frag;
    sheetPipeline_ = must(createGraphicsPipeline(device, scene));
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    scene.vertexShader = pole_vert;
    scene.fragmentShader = pole_frag;
    polePipeline_ = must(createGraphicsPipeline(device, scene));
    scene.vertexShader = ground_vert;
    scene.fragmentShader = ground_frag;
    groundPipeline_ = must(createGraphicsPipeline(device, scene));
    scene.depthWrite = false;
    scene.vertexShader = sky_vert;
    scene.fragmentShader = sky_frag;
    skyPipeline_ = must(createGraphicsPipeline(device, scene));
}

void Scene::drawSheets(VkCommandBuffer commands, VkPipeline pipeline, bool shadow) const {
    const SuppleGridOutput& grid = cloth_.grid();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset, VK_INDEX_TYPE_UINT16);
    for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = grid.drawRanges[r];
        const SheetPush push{range.patchCount, range.firstVertex, range.samplesPerPatch, grid.verticesPerInstance, 0, 0,
                             shadow ? 1u : 0u};
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer,
                                 grid.indirect.offset + VkDeviceSize{r} * grid.indirect.stride, 1,
                                 grid.indirect.stride);
    }
}

void Scene::drawPoles(VkCommandBuffer commands, VkPipeline pipeline, bool shadow) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    for (PolePush pole : kPoles) {
        pole.b.w = shadow ? 1.0f : 0.0f;
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof pole, &pole);
        vkCmdDraw(commands, kPoleVertices, 1, 0, 0);
    }
}

void Scene::record(VkCommandBuffer commands) const {
    const VkDescriptorSet sets[] = {sceneSet_, sheetSet_};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);

    imageBarrier(commands, sunMap_, {VK_IMAGE_LAYOUT_UNDEFINED, kSampled},
                 {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthWrites});
    VkRenderingAttachmentInfo depth =
        attachment(sunMap_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, {.depthStencil = {1.0f, 0}});
    beginRendering(commands, sunMap_.desc().extent, {}, depth);
    drawSheets(commands, sheetShadows_, true);
    drawPoles(commands, poleShadows_, true);
    vkCmdEndRendering(commands);
    imageBarrier(commands, sunMap_, {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthWrites},
                 {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kSampled});

    imageBarrier(commands, color_, {VK_IMAGE_LAYOUT_UNDEFINED, kColorWrites},
                 {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColorWrites});
    imageBarrier(commands, picture_, {VK_IMAGE_LAYOUT_UNDEFINED, kCopied},
                 {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColorWrites});
    imageBarrier(commands, depth_, {VK_IMAGE_LAYOUT_UNDEFINED, kDepthWrites},
                 {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthWrites});
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = color_.view(),
                                          .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT,
                                          .resolveImageView = picture_.view(),
                                          .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE, // the sky is everywhere
                                          .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
    depth.imageView = depth_.view();
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    beginRendering(commands, picture_.desc().extent, {&color, 1}, depth);
    drawSheets(commands, sheetPipeline_, false);
    vkCmdSetCullMode(commands, VK_CULL_MODE_FRONT_BIT);
    drawPoles(commands, polePipeline_, false);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, groundPipeline_);
    vkCmdDraw(commands, 4, 1, 0, 0);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, skyPipeline_);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
    imageBarrier(commands, picture_, {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColorWrites},
                 {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kCopied});
}

} // namespace cloth
