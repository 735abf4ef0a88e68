// What is drawn: the sheets, their poles, the ground and an evening sky, with one shadow map, into a picture.
#pragma once

#include "cloth.h"

namespace cloth {

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
    Scene(Device& device, const Cloth& cloth, VkExtent2D extent);

    /// The whole frame after Supple's. The picture ends as a transfer source.
    void record(VkCommandBuffer commands) const;
    const Image& picture() const { return picture_; }

private:
    void drawSheets(VkCommandBuffer commands, VkPipeline pipeline, bool shadow) const;
    void drawPoles(VkCommandBuffer commands, VkPipeline pipeline, bool shadow) const;

    const Cloth& cloth_;
    Image sunMap_;
    Image color_; ///< of several samples a pixel, resolved into the picture
    Image depth_;
    Image picture_;
    Buffer uniforms_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSet_ = VK_NULL_HANDLE;
    VkDescriptorSet sheetSet_ = VK_NULL_HANDLE;
    VkPipeline sheetShadows_ = VK_NULL_HANDLE;
    VkPipeline poleShadows_ = VK_NULL_HANDLE;
    VkPipeline sheetPipeline_ = VK_NULL_HANDLE;
    VkPipeline polePipeline_ = VK_NULL_HANDLE;
    VkPipeline groundPipeline_ = VK_NULL_HANDLE;
    VkPipeline skyPipeline_ = VK_NULL_HANDLE;
};

} // namespace cloth
