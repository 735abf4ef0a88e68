// Draws the market place and all who are there into a picture. All figures together take one indirect call in the sun's
// map, and one for each pair of textures in the picture.
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
    /// Commands of the view, and indirect calls of the picture.
    [[nodiscard]] uint32_t drawCount() const { return shadowDraws_.drawCount(0); }
    [[nodiscard]] uint32_t callCount() const { return static_cast<uint32_t>(textureSets_.size()); }

private:
    void createSets();
    void createPipelines();
    void bindSets(VkCommandBuffer commands, uint32_t slot, VkDescriptorSet figures) const;
    void push(VkCommandBuffer commands, uint32_t first, bool sun, bool paint) const;
    void drawProps(VkCommandBuffer commands, bool sun) const;
    void drawSun(VkCommandBuffer commands, uint32_t slot) const;
    void drawPicture(VkCommandBuffer commands, uint32_t slot, bool paint) const;

    Device& device_;
    Graph& graph_;
    const Market& market_;
    Looks looks_;
    ViewDraws draws_;       ///< a bin for each of Looks::textureSets
    ViewDraws shadowDraws_; ///< one bin
    Props props_;
    Buffer propBuffer_;
    VkSampleCountFlagBits samples_;
    Image sunMap_, color_, depth_, picture_;
    Resource sunMapUse_, colorUse_, depthUse_, pictureUse_, drawsUse_;
    Buffer uniforms_[kFramesInFlight];
    VkDescriptorSetLayout sceneLayout_ = VK_NULL_HANDLE, figureLayout_ = VK_NULL_HANDLE,
                          textureLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSets_[kFramesInFlight]{};
    VkDescriptorSet figureSet_ = VK_NULL_HANDLE, shadowSet_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> textureSets_;
    VkPipeline figures_ = VK_NULL_HANDLE, figureShadows_ = VK_NULL_HANDLE, solids_ = VK_NULL_HANDLE,
               solidShadows_ = VK_NULL_HANDLE, ground_ = VK_NULL_HANDLE, sky_ = VK_NULL_HANDLE;
};

} // namespace market
