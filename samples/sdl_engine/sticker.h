// A number on the walker's chest. host/decal.h projects it onto the surface, once. Its points are a point set, which
// Supple evaluates in every frame; their previous positions give motion vectors.
#pragma once

#include "characters.h"

#include "host/decal.h"
#include "host/pipelines.h"

namespace engine {

class Sticker {
public:
    /// `scene`: how the scene is drawn into, but for shaders and layout. A character whose chest is not found has none.
    Sticker(Device& device, const Characters& characters, VkDescriptorSetLayout frameLayout, GraphicsDesc scene);

    /// Behind the characters.
    void draw(VkCommandBuffer commands, VkDescriptorSet frameSet) const;

private:
    struct Push {
        uint32_t pointCount = 0;
        float lift = 0.0f; ///< towards the eye
    };

    void place(Device& device, const Characters& characters, const Decal& decal);

    supple::PointSet points_;
    Buffer places_, indices_;
    Image picture_;
    uint32_t indexCount_ = 0; ///< 0: there is none
    Push push_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace engine
