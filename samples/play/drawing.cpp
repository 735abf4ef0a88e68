#include "drawing.h"

#include "ground.h"
#include "host/draw_target.h"
#include "host/must.h"
#include "host/rendering.h"
#include "shaders/ground_frag.h"
#include "shaders/ground_vert.h"
#include "shaders/ground_vert_SUN.h"
#include "shaders/hero_frag.h"
#include "shaders/hero_vert.h"
#include "shaders/hero_vert_SUN.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_vert.h"

#include <cstring>

namespace play {

namespace {

constexpr uint32_t kSunMapSize = 2048;
constexpr float kSunReach = 2.6f; ///< half the side of what the sun's map shows
constexpr float kSunDepth = 12.0f;
const glm::vec3 kSunDirection = glm::normalize(glm::vec3(0.58f, 0.78f, 0.32f));
constexpr VkClearValue kFar{.depthStencil = {1.0f, 0}};

/// SuppleRange of shaders/supple_surface.glsl, and the material.
struct Push {
    uint32_t patchCount, firstVertex, samplesPerPatch, verticesPerInstance, firstSlot, previousWords;
    float metallic, roughness;
    glm::vec4 baseColor;
};

glm::mat4 sunViewProjection(glm::vec3 middle) {
    return glm::orthoRH_ZO(-kSunReach, kSunReach, -kSunReach, kSunReach, 0.0f, kSunDepth) *
           glm::lookAt(middle + 0.5f * kSunDepth * kSunDirection, middle, glm::vec3(0.0f, 1.0f, 0.0f));
}

} // namespace

Drawing::Drawing(Device& device, Graph& graph, const Hero& hero)
    : device_(device), graph_(graph), looks_(device, hero.asset()), samples_(pictureSamples(device, true)) {
    must(hero.group().gridOutput(grid_), "suppleGetGridOutput");
    sunMap_ =
        must(device.createImage({.format = kDepthFormat,
                                 .extent = {kSunMapSize, kSunMapSize},
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    sunMapUse_ = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);
    graph.setImage(sunMapUse_, sunMap_.handle());
    colorUse_ = graph.addImage();
    depthUse_ = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);
    pictureUse_ = graph.addImage();
    createGround();
    createSets(hero);
    createPipelines();
}

void Drawing::createGround() {
    const GroundMesh mesh = makeGroundMesh();
    groundVertices_ = must(device_.uploadBuffer(mesh.vertices.data(), mesh.vertices.size() * sizeof(GroundMesh::Vertex),
                                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
    groundIndices_ = must(device_.uploadBuffer(mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t),
                                               VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
    groundIndexCount_ = static_cast<uint32_t>(mesh.indices.size());
}

void Drawing::createSets(const Hero& hero) {
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                               kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT, kFragment = VK_SHADER_STAGE_FRAGMENT_BIT,
                                 kBoth = kVertex | kFragment;
    sceneLayout_ = must(createSetLayout(
        device_, {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth}, {1, kImage, kFragment}, {2, kStorage, kVertex}}));
    // The bindings of shaders/supple_surface.glsl.
    heroLayout_ = must(createSetLayout(
        device_, {{0, kStorage, kVertex}, {1, kStorage, kVertex}, {3, kStorage, kVertex}, {4, kStorage, kVertex}}));
    lookLayout_ = must(createSetLayout(device_, {{kColorTexture, kImage, kFragment},
                                                 {kSurfaceTexture, kImage, kFragment},
                                                 {kNormalTexture, kImage, kFragment}}));
    layout_ = must(createPipelineLayout(device_, {sceneLayout_, heroLayout_, lookLayout_}, sizeof(Push), kBoth));
    DescriptorPool pool =
        must(DescriptorPool::create(device_, kFramesInFlight + 1 + static_cast<uint32_t>(looks_.all().size())));
    const VkSampler compare = must(createSampler(device_, VK_FILTER_LINEAR, true));
    for (uint32_t slot = 0; slot < kFramesInFlight; ++slot) {
        uniforms_[slot] =
            must(device_.createBuffer(sizeof(SceneUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
        sceneSets_[slot] = must(pool.allocate(sceneLayout_));
        pool.write(sceneSets_[slot], {uniformBuffer(0, uniforms_[slot]), sampledImage(1, sunMap_, compare),
                                      storageBuffer(2, groundVertices_.handle(), 0, VK_WHOLE_SIZE)});
    }
    SuppleGroupInfo info{};
    must(hero.group().info(info), "suppleGetGroupInfo");
    SuppleVertexStreams streams{};
    must(hero.group().vertexStreams(streams), "suppleGetVertexStreams");
    heroSet_ = must(pool.allocate(heroLayout_));
    pool.write(heroSet_, {storageBuffer(0, info.instances), storageBuffer(1, streams.vertices),
                          storageBuffer(3, streams.attributes), storageBuffer(4, streams.tangents)});
    for (const Look& look : looks_.all()) {
        lookSets_.push_back(must(pool.allocate(lookLayout_)));
        pool.write(lookSets_.back(), looks_.writes(look));
    }
}

void Drawing::createPipelines() {
    GraphicsDesc shadow{.layout = layout_,
                        .vertexShader = hero_vert_SUN,
                        .depth = kDepthFormat,
                        .depthBias = 1.0f,
                        .depthBiasSlope = 1.5f};
    heroShadow_ = must(createGraphicsPipeline(device_, shadow));
    shadow.vertexShader = ground_vert_SUN;
    groundShadow_ = must(createGraphicsPipeline(device_, shadow));
    GraphicsDesc scene{.layout = layout_, .colors = {kFormat}, .depth = kDepthFormat, .samples = samples_};
    const auto pipeline = [&](std::span<const uint32_t> vertexShader, std::span<const uint32_t> fragmentShader) {
        scene.vertexShader = vertexShader;
        scene.fragmentShader = fragmentShader;
        return must(createGraphicsPipeline(device_, scene));
    };
    hero_ = pipeline(hero_vert, hero_frag);
    ground_ = pipeline(ground_vert, ground_frag);
    scene.depthWrite = false;
    sky_ = pipeline(sky_vert, sky_frag);
}

void Drawing::resize(VkExtent2D extent) {
    const bool multisampled = samples_ != VK_SAMPLE_COUNT_1_BIT;
    constexpr VkImageUsageFlags kDrawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (multisampled)
        color_ = must(device_.createImage({.format = kFormat, .extent = extent, .usage = kDrawn, .samples = samples_}));
    depth_ = must(device_.createImage({.format = kDepthFormat,
                                       .extent = extent,
                                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                       .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                       .samples = samples_}));
    picture_ = must(
        device_.createImage({.format = kFormat, .extent = extent, .usage = kDrawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    if (multisampled)
        graph_.setImage(colorUse_, color_.handle());
    graph_.setImage(depthUse_, depth_.handle());
    graph_.setImage(pictureUse_, picture_.handle());
}

void Drawing::update(uint32_t slot, const Camera& camera, const BodyPose& pose, const glm::vec4& mark) {
    const auto width = static_cast<float>(picture_.desc().extent.width),
               height = static_cast<float>(picture_.desc().extent.height);
    const BodyPoints points = pointsOf(pose);
    SceneUniforms uniforms{};
    uniforms.viewProjection = camera.viewProjection(width / height);
    uniforms.sunViewProjection = sunViewProjection(points[kHips]);
    uniforms.eye = glm::vec4(camera.eye, 1.0f);
    uniforms.sun = glm::vec4(kSunDirection, 2.0f * kSunReach / static_cast<float>(kSunMapSize));
    uniforms.viewport = {width, height, 1.0f / width, 1.0f / height};
    for (uint32_t i = 0; i < kPoints; ++i)
        uniforms.body[i] = glm::vec4(points[i], kBody[i].radius);
    uniforms.mark = mark;
    std::memcpy(uniforms_[slot].mapped(), &uniforms, sizeof uniforms);
}

void Drawing::bindSets(VkCommandBuffer commands, uint32_t slot) const {
    const VkDescriptorSet sets[] = {sceneSets_[slot], heroSet_};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
}

/// One command of Supple's for each draw range: of one part and one material.
void Drawing::drawHero(VkCommandBuffer commands, bool textured) const {
    vkCmdBindIndexBuffer(commands, grid_.indices.buffer, grid_.indices.offset, VK_INDEX_TYPE_UINT16);
    for (uint32_t i = 0; i < grid_.drawRangeCount; ++i) {
        const SuppleDrawRange& range = grid_.drawRanges[i];
        const uint32_t index = looks_.indexOf(range.material);
        const Look& look = looks_.all()[index];
        const Push push{range.patchCount, range.firstVertex, range.samplesPerPatch, grid_.verticesPerInstance, 0, 0,
                        look.metallic,    look.roughness,    look.baseColor};
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push,
                           &push);
        if (textured)
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 2, 1, &lookSets_[index], 0,
                                    nullptr);
        vkCmdDrawIndexedIndirect(commands, grid_.indirect.buffer,
                                 grid_.indirect.offset + VkDeviceSize{i} * grid_.indirect.stride, 1,
                                 grid_.indirect.stride);
    }
}

void Drawing::drawGround(VkCommandBuffer commands) const {
    vkCmdBindIndexBuffer(commands, groundIndices_.handle(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, groundIndexCount_, 1, 0, 0, 0);
}

void Drawing::drawSun(VkCommandBuffer commands, uint32_t slot) const {
    beginRendering(commands, sunMap_.desc().extent, {},
                   attachment(sunMap_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    bindSets(commands, slot);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, heroShadow_);
    drawHero(commands, false);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, groundShadow_);
    drawGround(commands);
    vkCmdEndRendering(commands);
}

void Drawing::drawPicture(VkCommandBuffer commands, uint32_t slot) const {
    const bool multisampled = samples_ != VK_SAMPLE_COUNT_1_BIT;
    VkRenderingAttachmentInfo color =
        attachment(multisampled ? color_ : picture_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    if (multisampled) {
        color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = picture_.view();
        color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    beginRendering(commands, picture_.desc().extent, {&color, 1},
                   attachment(depth_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    bindSets(commands, slot);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, hero_);
    drawHero(commands, true);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ground_);
    drawGround(commands);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sky_);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
}

void Drawing::addToGraph(uint32_t slot, Resource buffers) {
    graph_.add(
        "sun",
        {reads(buffers, kDrawn), writes(sunMapUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)},
        [this, slot](VkCommandBuffer commands) { drawSun(commands, slot); });
    std::vector<Use> uses = {reads(buffers, kDrawn),
                             reads(sunMapUse_, kSampledInFragment, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
                             writes(pictureUse_, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true),
                             writes(depthUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)};
    if (samples_ != VK_SAMPLE_COUNT_1_BIT)
        uses.push_back(writes(colorUse_, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true));
    graph_.add("draw", uses, [this, slot](VkCommandBuffer commands) { drawPicture(commands, slot); });
}

} // namespace play
