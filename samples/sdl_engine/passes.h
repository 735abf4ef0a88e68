// What is drawn: the sun's depth map, then the scene with color, motion and depth.
#pragma once

#include "camera.h"
#include "characters.h"

#include "sticker.h"

#include "host/pipelines.h"

namespace engine {

/// shaders/frame.glsl
struct FrameUniforms {
    glm::mat4 viewProjection;
    glm::mat4 jitteredViewProjection;
    glm::mat4 previousViewProjection;
    glm::mat4 sunViewProjection;
    glm::vec4 eye;
    glm::vec4 sunDirection;
    glm::vec4 viewport;
    glm::vec4 feet[4];
    glm::vec4 noise;
};

/// What the scene is drawn into, as large as the screen.
struct SceneImages {
    Image color;
    Image motion;
    Image depth;
    Resource colorUse;
    Resource motionUse;
    Resource depthUse;
};

class Passes {
public:
    Passes(Device& device, Graph& graph, const Characters& characters);

    /// Nothing may be in flight.
    void resize(Device& device, Graph& graph, VkExtent2D extent);
    /// jitter: in pixels.
    void update(uint32_t slot, uint64_t frame, const Camera& camera, glm::vec2 jitter,
                const std::vector<Footprint>& footprints);
    void addToGraph(Graph& graph, uint32_t slot, Resource characterBuffers);

    const SceneImages& images() const { return images_; }

private:
    void drawCharacters(VkCommandBuffer commands, VkPipeline pipeline, uint32_t slot, bool cull) const;
    void drawShadows(VkCommandBuffer commands, uint32_t slot) const;
    void drawScene(VkCommandBuffer commands, uint32_t slot) const;

    const Characters& characters_;
    std::optional<Sticker> sticker_;
    Sun sun_;
    SceneImages images_;
    Image sunMap_;
    Resource sunMapUse_;
    std::array<Buffer, kFramesInFlight> uniforms_;
    std::array<VkDescriptorSet, kFramesInFlight> frameSets_{};
    std::array<VkDescriptorSet, 2> groupSets_{};
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline shadowPipeline_ = VK_NULL_HANDLE;
    VkPipeline characterPipeline_ = VK_NULL_HANDLE;
    VkPipeline floorPipeline_ = VK_NULL_HANDLE;
    VkPipeline backdropPipeline_ = VK_NULL_HANDLE;
    glm::mat4 previousViewProjection_{1.0f};
    bool hasPrevious_ = false;
};

} // namespace engine
