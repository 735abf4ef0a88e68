// The pipelines of host/shaders and the layout they have in common. They live as long as the device.
#pragma once

#include "host/device.h"

#include <memory>
#include <span>

namespace supple::host {

struct DrawFormats {
    VkFormat color = VK_FORMAT_UNDEFINED;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkFormat shadow = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

class DrawPipelines {
public:
    [[nodiscard]] static Result<std::unique_ptr<DrawPipelines>> create(Device& device, const DrawFormats& formats);
    DrawPipelines(const DrawPipelines&) = delete;
    DrawPipelines& operator=(const DrawPipelines&) = delete;

    // Sets 0, 1 and 2 of host/shaders/draw.h.
    VkDescriptorSetLayout frameSet = VK_NULL_HANDLE;
    VkDescriptorSetLayout figureSet = VK_NULL_HANDLE;
    VkDescriptorSetLayout materialSet = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkSampler shadowSampler = VK_NULL_HANDLE;

    VkPipeline surfaceShadow = VK_NULL_HANDLE;
    VkPipeline surfaceShadowTrim = VK_NULL_HANDLE; ///< with holes
    VkPipeline cageShadow = VK_NULL_HANDLE;
    VkPipeline surface = VK_NULL_HANDLE;
    VkPipeline surfaceVertexLit = VK_NULL_HANDLE; ///< the light looked up once a vertex
    VkPipeline cageFace = VK_NULL_HANDLE;
    VkPipeline cageEdge = VK_NULL_HANDLE;
    VkPipeline ground = VK_NULL_HANDLE;
    VkPipeline backdrop = VK_NULL_HANDLE;

private:
    explicit DrawPipelines(Device& device) : device_(device) {}
    [[nodiscard]] Status createLayouts();
    [[nodiscard]] Status createSampler(VkFormat shadowFormat);
    [[nodiscard]] Status createShadowPipelines(const DrawFormats& formats);
    [[nodiscard]] Status createPicturePipelines(const DrawFormats& formats);

    Device& device_;
};

} // namespace supple::host
