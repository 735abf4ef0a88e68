#include "scene.h"

#include "host/must.h"
#include "host/rendering.h"
#include "shaders/ground_frag.h"
#include "shaders/ground_vert.h"
#include "shaders/text_frag.h"
#include "shaders/text_vert.h"
#include "shaders/wall_vert.h"

#include <stb/stb_easy_font.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstring>

namespace crowd {

namespace {

constexpr uint32_t kSunMapSize = 4096;
constexpr float kTextSize = 2.0f; ///< pixels a unit of stb_easy_font
constexpr uint32_t kMaxTextBytes = 1u << 18;
const glm::vec3 kSunDirection = glm::normalize(glm::vec3(-0.55f, 0.62f, 0.36f));
constexpr VkClearValue kFar{.depthStencil = {1.0f, 0}};

constexpr uint32_t kPushBytes = sizeof(glm::vec4); ///< the wall's

struct TextCorner { // of stb_easy_font
    float x, y, z;
    uint32_t color;
};

} // namespace

Scene::Scene(Device& device, Graph& graph, const Crowd& crowd, bool wall, bool pyramid) : crowd_(crowd), wall_(wall) {
    VkShaderStageFlags seeing = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    seeing |= device.drawMeshTasks() != nullptr ? VK_SHADER_STAGE_MESH_BIT_EXT : 0;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    sunMap_ =
        must(device.createImage({.format = kDepthFormat,
                                 .extent = {kSunMapSize, kSunMapSize},
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    sunMapUse_ = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);
    graph.setImage(sunMapUse_, sunMap_.handle());
    pictureUse_ = graph.addImage();
    depthUse_ = graph.addImage(VK_IMAGE_ASPECT_DEPTH_BIT);
    if (pyramid) {
        pyramid_ = std::make_unique<DepthPyramid>(device);
        pyramidUse_ = graph.addImage();
    }

    const VkDescriptorSetLayout sceneLayout =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, seeing},
                                      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}));
    const VkDescriptorSetLayout textLayout = must(createSetLayout(device, {{0, kStorage, VK_SHADER_STAGE_VERTEX_BIT}}));
    layout_ = must(createPipelineLayout(device, {sceneLayout}, kPushBytes, VK_SHADER_STAGE_VERTEX_BIT));
    textLayout_ = must(createPipelineLayout(device, {textLayout}, sizeof(glm::vec2), VK_SHADER_STAGE_VERTEX_BIT));

    DescriptorPool pool = must(DescriptorPool::create(device, 2 * kFramesInFlight));
    const VkSampler compare = must(createSampler(device, VK_FILTER_LINEAR, true));
    for (uint32_t slot = 0; slot < kFramesInFlight; ++slot) {
        uniforms_[slot] =
            must(device.createBuffer(sizeof(SceneUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
        text_[slot] = must(device.createBuffer(kMaxTextBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload));
        sceneSets_[slot] = must(pool.allocate(sceneLayout));
        pool.write(sceneSets_[slot], {uniformBuffer(0, uniforms_[slot]), sampledImage(1, sunMap_, compare)});
        textSets_[slot] = must(pool.allocate(textLayout));
        pool.write(textSets_[slot], {storageBuffer(0, text_[slot].handle(), 0, kMaxTextBytes)});
    }
    characters_ = crowd.hasLevels() ? makeLevelCharacters(device, graph, crowd, sceneLayout)
                                    : makeFixedCharacters(device, crowd, sceneLayout);
    GraphicsDesc scene{.layout = layout_, .colors = {kColorFormat}, .depth = kDepthFormat};
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    scene.vertexShader = ground_vert;
    scene.fragmentShader = ground_frag;
    groundPipeline_ = must(createGraphicsPipeline(device, scene));
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    scene.vertexShader = wall_vert;
    wallPipeline_ = must(createGraphicsPipeline(device, scene));
    GraphicsDesc text{.layout = textLayout_, .colors = {kColorFormat}, .depth = kDepthFormat, .depthWrite = false};
    text.vertexShader = text_vert;
    text.fragmentShader = text_frag;
    textPipeline_ = must(createGraphicsPipeline(device, text));
}

void Scene::resize(Device& device, Graph& graph, VkExtent2D extent) {
    picture_ =
        must(device.createImage({.format = kColorFormat,
                                 .extent = extent,
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    depth_ = must(device.createImage({.format = kDepthFormat,
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                      .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    if (pyramid_) {
        pyramid_->resize(depth_);
        graph.setImage(pyramidUse_, pyramid_->image());
    }
    graph.setImage(pictureUse_, picture_.handle());
    graph.setImage(depthUse_, depth_.handle());
}

void Scene::update(uint32_t slot, const Camera& camera, const std::vector<std::string>& report) {
    const VkExtent2D extent = picture_.desc().extent;
    const glm::vec2 size{static_cast<float>(extent.width), static_cast<float>(extent.height)};
    SceneUniforms uniforms{};
    uniforms.viewProjection = camera.viewProjection;
    const float reach = 1.45f * crowd_.reach() + 2.0f;
    uniforms.sunViewProjection =
        glm::orthoRH_ZO(-reach, reach, -reach, reach, 0.0f, 4.0f * reach) *
        glm::lookAt(2.0f * reach * kSunDirection, glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    uniforms.eye = glm::vec4(camera.eye, 1.0f);
    uniforms.sunDirection = glm::vec4(kSunDirection, 2.0f * reach / static_cast<float>(kSunMapSize));
    uniforms.viewport = glm::vec4(size, 1.0f / size);
    std::memcpy(uniforms_[slot].mapped(), &uniforms, sizeof uniforms);

    // The report, with a darker copy behind it.
    std::string text;
    for (const std::string& line : report)
        text += line + "\n";
    auto* corners = static_cast<TextCorner*>(text_[slot].mapped());
    textQuads_ = 0;
    for (const bool behind : {true, false}) {
        unsigned char color[4] = {255, 255, 255, 255};
        if (behind)
            std::fill_n(color, 3, static_cast<unsigned char>(20));
        const auto left = static_cast<int>(kMaxTextBytes - textQuads_ * 4 * sizeof(TextCorner));
        TextCorner* const first = corners + size_t{4} * textQuads_;
        const int quads = stb_easy_font_print(7.0f, 7.0f, text.data(), color, first, left);
        for (int i = 0; i < 4 * quads; ++i) {
            first[i].x = kTextSize * first[i].x + (behind ? 1.5f : 0.0f);
            first[i].y = kTextSize * first[i].y + (behind ? 1.5f : 0.0f);
        }
        textQuads_ += static_cast<uint32_t>(quads);
    }
}

void Scene::addToGraph(Graph& graph, uint32_t slot, Resource buffers, bool paint) const {
    characters_->addToGraph(graph, buffers);
    std::vector<Use> sun = characters_->uses(buffers), drawn = sun;
    sun.push_back(writes(sunMapUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true));
    drawn.push_back(reads(sunMapUse_, kSampledInFragment, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL));
    drawn.push_back(writes(pictureUse_, kColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true));
    drawn.push_back(writes(depthUse_, kDepthAttachment, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true));
    graph.add("sun", std::move(sun), [this, slot](VkCommandBuffer commands) {
        const VkRenderingAttachmentInfo depth = attachment(sunMap_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar);
        beginRendering(commands, sunMap_.desc().extent, {}, depth);
        characters_->draw(commands, sceneSets_[slot], true, false);
        vkCmdEndRendering(commands);
    });
    graph.add("draw", std::move(drawn), [this, slot, paint](VkCommandBuffer commands) {
        const VkExtent2D extent = picture_.desc().extent;
        const VkClearValue haze{.color = {{0.85f, 0.87f, 0.89f, 1.0f}}};
        const VkRenderingAttachmentInfo color = attachment(picture_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, haze);
        const VkRenderingAttachmentInfo depth = attachment(depth_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kFar);
        beginRendering(commands, extent, {&color, 1}, depth);
        characters_->draw(commands, sceneSets_[slot], false, paint);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, groundPipeline_);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &sceneSets_[slot], 0,
                                nullptr);
        vkCmdDraw(commands, 4, 1, 0, 0);
        if (wall_) {
            const glm::vec4 wall{0.7f * crowd_.reach(), kWallHeight, 0.2f, kWallAngle};
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof wall, &wall);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, wallPipeline_);
            vkCmdDraw(commands, 36, 1, 0, 0);
        }
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, textPipeline_);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, textLayout_, 0, 1, &textSets_[slot], 0,
                                nullptr);
        const glm::vec2 scale{2.0f / static_cast<float>(extent.width), 2.0f / static_cast<float>(extent.height)};
        vkCmdPushConstants(commands, textLayout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof scale, &scale);
        vkCmdDraw(commands, 6 * textQuads_, 1, 0, 0);
        vkCmdEndRendering(commands);
    });
    if (pyramid_)
        graph.add("pyramid",
                  {reads(depthUse_, kSampledInCompute, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
                   writes(pyramidUse_, kStorageInCompute, VK_IMAGE_LAYOUT_GENERAL, true)},
                  [this](VkCommandBuffer commands) { pyramid_->record(commands); });
}

} // namespace crowd
