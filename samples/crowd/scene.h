// What is drawn: the crowd, the ground, haze, and a report on top, with one shadow map, into a picture.
#pragma once

#include "characters.h"
#include "host/depth_pyramid.h"

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
    Scene(Device& device, Graph& graph, const Crowd& crowd, bool wall, bool pyramid);

    /// Images of a size; nothing may be in flight.
    void resize(Device& device, Graph& graph, VkExtent2D extent);
    void update(uint32_t slot, const Camera& camera, const std::vector<std::string>& report);
    /// paint: capacities as colors.
    void addToGraph(Graph& graph, uint32_t slot, Resource buffers, bool paint) const;

    [[nodiscard]] const Image& picture() const { return picture_; }
    [[nodiscard]] Resource pictureUse() const { return pictureUse_; }
    /// Null where none is made.
    [[nodiscard]] const DepthPyramid* pyramid() const { return pyramid_.get(); }
    [[nodiscard]] Resource pyramidUse() const { return pyramidUse_; }

private:
    const Crowd& crowd_;
    std::unique_ptr<Characters> characters_;
    Image sunMap_, picture_, depth_;
    std::unique_ptr<DepthPyramid> pyramid_;
    Resource sunMapUse_, pictureUse_, depthUse_, pyramidUse_;
    bool wall_ = false;
    Buffer uniforms_[kFramesInFlight];
    Buffer text_[kFramesInFlight];
    uint32_t textQuads_ = 0;
    VkPipelineLayout layout_ = VK_NULL_HANDLE, textLayout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSets_[kFramesInFlight]{}, textSets_[kFramesInFlight]{};
    VkPipeline groundPipeline_ = VK_NULL_HANDLE, wallPipeline_ = VK_NULL_HANDLE, textPipeline_ = VK_NULL_HANDLE;
};

} // namespace crowd
