// Temporal anti-aliasing and the way to the screen: one jittered sample a pixel and frame, gathered along the motion
// vectors that Supple's previous positions make possible.
#pragma once

#include "passes.h"

namespace engine {

class Taa {
public:
    Taa(Device& device, Graph& graph);

    /// Nothing may be in flight.
    void resize(Device& device, Graph& graph, const SceneImages& scene);
    /// Where in the pixel this frame samples, -0.5..0.5: sixteen points of the Halton sequence.
    static glm::vec2 jitter(uint64_t frame);
    void addToGraph(Graph& graph, const SceneImages& scene);

    /// 8 bits, sRGB: to be shown or saved.
    const Image& picture() const { return picture_; }
    Resource pictureUse() const { return pictureUse_; }

private:
    DescriptorPool pool_;
    VkSampler linear_ = VK_NULL_HANDLE;
    VkSampler nearest_ = VK_NULL_HANDLE;
    VkPipelineLayout resolveLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout toneLayout_ = VK_NULL_HANDLE;
    VkPipeline resolvePipeline_ = VK_NULL_HANDLE;
    VkPipeline tonePipeline_ = VK_NULL_HANDLE;
    Image histories_[2]; ///< one is read, the other written, in turn
    Resource historyUses_[2];
    VkDescriptorSet resolveSets_[2]{};
    VkDescriptorSet toneSets_[2]{};
    Image picture_;
    Resource pictureUse_;
    uint32_t current_ = 0;
    bool hasHistory_ = false;
};

} // namespace engine
