// What is drawn: the crowd, the ground, haze, and a report on top, with one shadow map, into a picture.
#pragma once

#include "common/depth_pyramid.h"
#include "crowd.h"

#include <memory>

namespace crowd {

/// shaders/scene.glsl
struct SceneUniforms {
    glm::mat4 viewProjection;
    glm::mat4 sunViewProjection;
    glm::vec4 eye;
    glm::vec4 sunDirection;
    glm::vec4 viewport;
};

class Scene {
public:
    /// pyramid: one is made of every frame's depth.
    Scene(sample::Device& device, engine::Graph& graph, const Crowd& crowd, bool wall, bool pyramid);

    /// Images of a size; nothing may be in flight.
    void resize(sample::Device& device, engine::Graph& graph, VkExtent2D extent);
    void update(uint32_t slot, const Camera& camera, const std::vector<std::string>& report);
    /// paint: capacities as colors.
    void addToGraph(engine::Graph& graph, uint32_t slot, engine::Resource buffers, bool paint) const;

    [[nodiscard]] const sample::Image& picture() const { return picture_; }
    [[nodiscard]] engine::Resource pictureUse() const { return pictureUse_; }
    /// Null where none is made.
    [[nodiscard]] const sample::DepthPyramid* pyramid() const { return pyramid_.get(); }
    [[nodiscard]] engine::Resource pyramidUse() const { return pyramidUse_; }

private:
    void drawCharacters(VkCommandBuffer commands, uint32_t slot, bool sun, bool paint) const;

    const Crowd& crowd_;
    sample::Image sunMap_, picture_, depth_;
    std::unique_ptr<sample::DepthPyramid> pyramid_;
    engine::Resource sunMapUse_, pictureUse_, depthUse_, pyramidUse_;
    bool wall_ = false;
    sample::Buffer uniforms_[sample::kFramesInFlight];
    sample::Buffer text_[sample::kFramesInFlight];
    uint32_t textQuads_ = 0;
    VkPipelineLayout layout_ = VK_NULL_HANDLE, textLayout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSets_[sample::kFramesInFlight]{}, textSets_[sample::kFramesInFlight]{};
    std::array<VkDescriptorSet, kKinds> kindSets_{};
    VkPipeline sunPipeline_ = VK_NULL_HANDLE, characterPipeline_ = VK_NULL_HANDLE, groundPipeline_ = VK_NULL_HANDLE,
               wallPipeline_ = VK_NULL_HANDLE, textPipeline_ = VK_NULL_HANDLE;
};

} // namespace crowd
