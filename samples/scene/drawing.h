// Draws the market place and all who are there into a picture: one indirect call for all figures, in each of two
// passes.
#pragma once

#include "host/view_draws.h"
#include "looks.h"
#include "props.h"

namespace market {

/// shaders/scene.glsl
struct SceneUniforms {
    glm::mat4 viewProjection;
    glm::mat4 sunViewProjection;
    glm::vec4 eye;
    glm::vec4 sun;                ///< towards it; w: a texel of its map in the world
    glm::vec4 right, up, ahead;   ///< of the camera; right and up reach to the picture's edges
    glm::vec4 feet[kMostFigures]; ///< where figures stand; w: how wide
    glm::uvec4 counts;            ///< of figures
};

class Drawing {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

    Drawing(Device& device, Graph& graph, const Market& market);

    /// Images of a size; nothing may be in flight.
    void resize(VkExtent2D extent);
    void update(uint32_t slot, const Camera& camera, double time);
    /// buffers: what Supple wrote. paint: capacities as colors.
    void addToGraph(uint32_t slot, Resource buffers, bool paint);

    [[nodiscard]] const Image& picture() const { return picture_; }
    [[nodiscard]] Resource pictureUse() const { return pictureUse_; }
    /// Commands that the one call issues at most.
    [[nodiscard]] uint32_t drawCount() const { return draws_.drawCount(0); }

private:
    void createSets();
    void createPipelines();
    void drawAll(VkCommandBuffer commands, uint32_t slot, bool sun, bool paint) const;
    void drawSun(VkCommandBuffer commands, uint32_t slot) const;
    void drawPicture(VkCommandBuffer commands, uint32_t slot, bool paint) const;

    Device& device_;
    Graph& graph_;
    const Market& market_;
    Looks looks_;
    ViewDraws draws_;
    Props props_;
    Buffer propBuffer_;
    VkSampleCountFlagBits samples_;
    Image sunMap_, color_, depth_, picture_;
    Resource sunMapUse_, colorUse_, depthUse_, pictureUse_, drawsUse_;
    Buffer uniforms_[kFramesInFlight];
    VkDescriptorSetLayout sceneLayout_ = VK_NULL_HANDLE, figureLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSets_[kFramesInFlight]{};
    VkDescriptorSet figureSet_ = VK_NULL_HANDLE;
    VkPipeline figures_ = VK_NULL_HANDLE, figureShadows_ = VK_NULL_HANDLE, solids_ = VK_NULL_HANDLE,
               solidShadows_ = VK_NULL_HANDLE, ground_ = VK_NULL_HANDLE, sky_ = VK_NULL_HANDLE;
};

} // namespace market
