#include "drawing.h"

#include "host/must.h"
#include "host/rendering.h"
#include "shaders/figure_frag.h"
#include "shaders/figure_vert.h"
#include "shaders/ground_frag.h"
#include "shaders/ground_vert.h"
#include "shaders/prop_frag.h"
#include "shaders/prop_vert.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_vert.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cstring>

namespace market {

namespace {

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr uint32_t kSunMapSize = 4096;
constexpr float kSunReach = 15.0f; ///< half the side of what the sun's map shows
const glm::vec3 kSunDirection = glm::normalize(glm::vec3(-0.62f, 0.66f, 0.42f));
constexpr VkClearValue kFar{.depthStencil = {1.0f, 0}};
/// Vertices of the shapes of shaders/prop.vert.
constexpr std::array<uint32_t, kShapes> kShapeVertices = {36, 288, 960, 24};

struct Push {
    uint32_t first; ///< figures: of the call, among ViewDraws::drawn(); props: Shape
    uint32_t sun;   ///< 1: into the sun's map
    uint32_t paint; ///< 1: capacities as colors
};

/// Draws that share their textures share a bin.
ViewDraws drawsOf(Device& device, const Market& market, const Looks& looks) {
    const auto binOf = [&](uint32_t figure, const SuppleLevelDraw& draw) {
        return looks.textureSetOf(figure, draw.material);
    };
    return must(ViewDraws::create(device, market.surfaces(), static_cast<uint32_t>(looks.textureSets().size()), binOf));
}

/// Shadows need no textures: all draws share one bin.
ViewDraws shadowDrawsOf(Device& device, const Market& market) {
    return must(ViewDraws::create(device, market.surfaces(), 1, [](uint32_t, const SuppleLevelDraw&) { return 0u; }));
}

} // namespace

Drawing::Drawing(Device& device, Graph& graph, const Market& market)
    : device_(device), graph_(graph), market_(market), looks_(device, market), draws_(drawsOf(device, market, looks_)),
      shadowDraws_(shadowDrawsOf(device, market)), props_(makeProps()), samples_(VK_SAMPLE_COUNT_4_BIT) {
    propBuffer_ = must(
        device.uploadBuffer(props_.all.data(), props_.all.size() * sizeof(Prop), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
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
    drawsUse_ = graph.addBuffers();
    createSets();
    createPipelines();
}

void Drawing::createSets() {
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                               kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT, kFragment = VK_SHADER_STAGE_FRAGMENT_BIT,
                                 kBoth = kVertex | kFragment;
    sceneLayout_ = must(createSetLayout(
        device_, {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth}, {1, kImage, kFragment}, {2, kStorage, kVertex}}));
    // The bindings of shaders/supple_surface.glsl at levels of detail, then what the draws are and look like.
    figureLayout_ = must(createSetLayout(device_, {{1, kStorage, kVertex},
                                                   {3, kStorage, kVertex},
                                                   {4, kStorage, kVertex},
                                                   {5, kStorage, kVertex},
                                                   {6, kStorage, kVertex},
                                                   {7, kStorage, kBoth},
                                                   {8, kStorage, kFragment}}));
    textureLayout_ = must(createSetLayout(device_, {{0, kImage, kFragment}, {1, kImage, kFragment}}));
    layout_ = must(createPipelineLayout(device_, {sceneLayout_, figureLayout_, textureLayout_}, sizeof(Push), kBoth));
    const std::vector<Looks::Textures>& textures = looks_.textureSets();
    DescriptorPool pool =
        must(DescriptorPool::create(device_, kFramesInFlight + 4 + static_cast<uint32_t>(textures.size())));
    const VkSampler compare = must(createSampler(device_, VK_FILTER_LINEAR, true));
    for (uint32_t slot = 0; slot < kFramesInFlight; ++slot) {
        uniforms_[slot] =
            must(device_.createBuffer(sizeof(SceneUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
        sceneSets_[slot] = must(pool.allocate(sceneLayout_));
        pool.write(sceneSets_[slot], {uniformBuffer(0, uniforms_[slot]), sampledImage(1, sunMap_, compare),
                                      storageBuffer(2, propBuffer_.handle(), 0, VK_WHOLE_SIZE)});
    }
    const SuppleVertexStreams streams = market_.streams();
    for (const auto& [set, draws] : {std::pair(&figureSet_, &draws_), std::pair(&shadowSet_, &shadowDraws_)}) {
        *set = must(pool.allocate(figureLayout_));
        pool.write(*set, {storageBuffer(1, streams.vertices), storageBuffer(3, streams.attributes),
                          storageBuffer(4, draws->buckets()), storageBuffer(5, draws->patches()),
                          storageBuffer(6, draws->drawn().handle(), 0, VK_WHOLE_SIZE),
                          storageBuffer(7, looks_.looks().handle(), 0, VK_WHOLE_SIZE),
                          storageBuffer(8, looks_.materials().handle(), 0, VK_WHOLE_SIZE)});
    }
    for (const Looks::Textures& pair : textures) {
        textureSets_.push_back(must(pool.allocate(textureLayout_)));
        pool.write(textureSets_.back(), {looks_.textureWrite(0, pair.color), looks_.textureWrite(1, pair.surface)});
    }
}

void Drawing::createPipelines() {
    GraphicsDesc shadow{.layout = layout_,
                        .vertexShader = figure_vert,
                        .depth = kDepthFormat,
                        .depthBias = 1.0f,
                        .depthBiasSlope = 1.5f};
    figureShadows_ = must(createGraphicsPipeline(device_, shadow));
    shadow.vertexShader = prop_vert;
    solidShadows_ = must(createGraphicsPipeline(device_, shadow));
    GraphicsDesc scene{.layout = layout_, .colors = {kFormat}, .depth = kDepthFormat, .samples = samples_};
    const auto pipeline = [&](std::span<const uint32_t> vertexShader, std::span<const uint32_t> fragmentShader) {
        scene.vertexShader = vertexShader;
        scene.fragmentShader = fragmentShader;
        return must(createGraphicsPipeline(device_, scene));
    };
    figures_ = pipeline(figure_vert, figure_frag);
    solids_ = pipeline(prop_vert, prop_frag);
    ground_ = pipeline(ground_vert, ground_frag);
    scene.depthWrite = false;
    sky_ = pipeline(sky_vert, sky_frag);
}

void Drawing::resize(VkExtent2D extent) {
    color_ = must(device_.createImage(
        {.format = kFormat, .extent = extent, .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, .samples = samples_}));
    depth_ = must(device_.createImage({.format = kDepthFormat,
                                       .extent = extent,
                                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                       .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                       .samples = samples_}));
    picture_ =
        must(device_.createImage({.format = kFormat,
                                  .extent = extent,
                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    graph_.setImage(colorUse_, color_.handle());
    graph_.setImage(depthUse_, depth_.handle());
    graph_.setImage(pictureUse_, picture_.handle());
}

void Drawing::update(uint32_t slot, const Camera& camera, double time) {
    SceneUniforms uniforms{};
    uniforms.viewProjection = camera.viewProjection;
    uniforms.sunViewProjection = glm::orthoRH_ZO(-kSunReach, kSunReach, -kSunReach, kSunReach, 0.0f, 4.0f * kSunReach) *
                                 glm::lookAt(glm::vec3(0.0f, 0.0f, -2.5f) + 2.0f * kSunReach * kSunDirection,
                                             glm::vec3(0.0f, 0.0f, -2.5f), glm::vec3(0.0f, 1.0f, 0.0f));
    uniforms.eye = glm::vec4(camera.eye, static_cast<float>(time));
    uniforms.sun = glm::vec4(kSunDirection, 2.0f * kSunReach / static_cast<float>(kSunMapSize));
    uniforms.right = glm::vec4(camera.right, 0.0f);
    uniforms.up = glm::vec4(camera.up, 0.0f);
    uniforms.ahead = glm::vec4(camera.ahead, 0.0f);
    const std::vector<Figure>& cast = market_.cast();
    for (size_t i = 0; i < cast.size(); ++i) {
        const glm::vec3 place(transformOf(cast[i], time)[3]);
        uniforms.feet[i] = glm::vec4(place, (cast[i].kind == Kind::wren ? 0.34f : 0.55f) * cast[i].size);
    }
    uniforms.counts.x = static_cast<uint32_t>(cast.size());
    std::memcpy(uniforms_[slot].mapped(), &uniforms, sizeof uniforms);
}

void Drawing::push(VkCommandBuffer commands, uint32_t first, bool sun, bool paint) const {
    const Push values{first, sun ? 1u : 0u, paint ? 1u : 0u};
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof values,
                       &values);
}

void Drawing::bindSets(VkCommandBuffer commands, uint32_t slot, VkDescriptorSet figures) const {
    const VkDescriptorSet sets[] = {sceneSets_[slot], figures};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
}

void Drawing::drawProps(VkCommandBuffer commands, bool sun) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sun ? solidShadows_ : solids_);
    for (uint32_t shape = 0; shape < kShapes; ++shape) {
        push(commands, shape, sun, false);
        vkCmdDraw(commands, kShapeVertices[shape], props_.runs[shape].count, 0, props_.runs[shape].first);
    }
}

void Drawing::drawSun(VkCommandBuffer commands, uint32_t slot) const {
    beginRendering(commands, sunMap_.desc().extent, {},
                   attachment(sunMap_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    bindSets(commands, slot, shadowSet_);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, figureShadows_);
    push(commands, shadowDraws_.firstDraw(0), true, false);
    shadowDraws_.draw(commands, 0);
    drawProps(commands, true);
    vkCmdEndRendering(commands);
}

void Drawing::drawPicture(VkCommandBuffer commands, uint32_t slot, bool paint) const {
    VkRenderingAttachmentInfo color = attachment(color_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = picture_.view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    beginRendering(commands, picture_.desc().extent, {&color, 1},
                   attachment(depth_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar));
    bindSets(commands, slot, figureSet_);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, figures_);
    for (uint32_t bin = 0; bin < textureSets_.size(); ++bin) {
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 2, 1, &textureSets_[bin], 0,
                                nullptr);
        push(commands, draws_.firstDraw(bin), false, paint);
        draws_.draw(commands, bin);
    }
    drawProps(commands, false);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ground_);
    vkCmdDraw(commands, 6, 1, 0, 0);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sky_);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
}

void Drawing::addToGraph(uint32_t slot, Resource buffers, bool paint) {
    graph_.add("gather", {reads(buffers, ViewDraws::kReads), writes(drawsUse_, ViewDraws::kWrites)},
               [this](VkCommandBuffer commands) {
                   draws_.record(commands);
                   shadowDraws_.record(commands);
               });
    graph_.add("sun",
               {reads(buffers, kDrawn), reads(drawsUse_, kDrawn),
                writes(sunMapUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)},
               [this, slot](VkCommandBuffer commands) { drawSun(commands, slot); });
    graph_.add("draw",
               {reads(buffers, kDrawn), reads(drawsUse_, kDrawn),
                reads(sunMapUse_, kSampledInFragment, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
                writes(colorUse_, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true),
                writes(pictureUse_, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true),
                writes(depthUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true)},
               [this, slot, paint](VkCommandBuffer commands) { drawPicture(commands, slot, paint); });
}

} // namespace market
