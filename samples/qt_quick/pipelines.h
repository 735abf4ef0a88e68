// The four pipelines, with the layouts that they have in common.
#pragma once

#include "memory.h"

namespace qt_quick {

constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM; // what Qt takes an image for that it is given
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkSampleCountFlagBits kSamples = VK_SAMPLE_COUNT_4_BIT;

/// One draw: shaders/range.glsl.
struct DrawPush {
    uint32_t range[6]; ///< SuppleRange of supple_surface.glsl
    float metallic;
    float roughness;
    float factor[4];
    float uvRows[8];
};

struct Pipelines {
    explicit Pipelines(const Gpu& gpu);
    void destroy();

    Gpu gpu;
    VkDescriptorSetLayout frameSet = VK_NULL_HANDLE;   ///< uniforms, the sun's depths
    VkDescriptorSetLayout surfaceSet = VK_NULL_HANDLE; ///< what a group hands out, at supple_surface.glsl's bindings
    VkDescriptorSetLayout textureSet = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline shadow = VK_NULL_HANDLE;
    VkPipeline character = VK_NULL_HANDLE;
    VkPipeline floor = VK_NULL_HANDLE;
    VkPipeline backdrop = VK_NULL_HANDLE;
};

} // namespace qt_quick
