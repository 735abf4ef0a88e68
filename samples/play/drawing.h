// Draws the character and the ground into a picture, with one shadow map.
#pragma once

#include "camera.h"
#include "hero.h"
#include "looks.h"

namespace play {

/// shaders/scene.glsl
struct SceneUniforms {
    glm::mat4 viewProjection;
    glm::mat4 sunViewProjection;
    glm::vec4 eye;
    glm::vec4 sun;           ///< towards it; w: a texel of its map in the world
    glm::vec4 viewport;      ///< width, height, and their reciprocals
    glm::vec4 body[kPoints]; ///< balls that take the sky from the ground; w: radius
    glm::vec4 mark;          ///< where the player has pointed; w: 0 without
};
static_assert(kPoints == 22, "kPoints of shaders/scene.glsl");

class Drawing {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

    Drawing(Device& device, Graph& graph, const Hero& hero);

    /// Images of a size; nothing may be in flight.
    void resize(VkExtent2D extent);
    void update(uint32_t slot, const Camera& camera, const BodyPose& pose, const glm::vec4& mark);
    /// buffers: what Supple wrote.
    void addToGraph(uint32_t slot, Resource buffers);

    [[nodiscard]] const Image& picture() const { return picture_; }
    [[nodiscard]] Resource pictureUse() const { return pictureUse_; }

private:
    void createGround();
    void createSets(const Hero& hero);
    void createPipelines();
    void bindSets(VkCommandBuffer commands, uint32_t slot) const;
    void drawHero(VkCommandBuffer commands, bool textured) const;
    void drawGround(VkCommandBuffer commands) const;
    void drawSun(VkCommandBuffer commands, uint32_t slot) const;
    void drawPicture(VkCommandBuffer commands, uint32_t slot) const;

    Device& device_;
    Graph& graph_;
    Looks looks_;
    SuppleGridOutput grid_{};
    Buffer groundVertices_, groundIndices_;
    uint32_t groundIndexCount_ = 0;
    VkSampleCountFlagBits samples_;
    Image sunMap_, color_, depth_, picture_;
    Resource sunMapUse_, colorUse_, depthUse_, pictureUse_;
    Buffer uniforms_[kFramesInFlight];
    VkDescriptorSetLayout sceneLayout_ = VK_NULL_HANDLE, heroLayout_ = VK_NULL_HANDLE, lookLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSet sceneSets_[kFramesInFlight]{};
    VkDescriptorSet heroSet_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> lookSets_; ///< as Looks::all()
    VkPipeline hero_ = VK_NULL_HANDLE, heroShadow_ = VK_NULL_HANDLE, ground_ = VK_NULL_HANDLE,
               groundShadow_ = VK_NULL_HANDLE, sky_ = VK_NULL_HANDLE;
};

} // namespace play
