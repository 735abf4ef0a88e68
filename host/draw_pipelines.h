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
    VkSampler environmentSampler = VK_NULL_HANDLE;

    /// What faces are drawn with.
    struct Faces {
        bool vertexLit = false; ///< the light is looked up once a vertex; only of the surface
        bool maps = false;      ///< the material has normal, occlusion or emissive maps
        bool blend = false;     ///< over what is there, by alpha

        [[nodiscard]] size_t index() const { return (vertexLit ? 4u : 0u) + (maps ? 2u : 0u) + (blend ? 1u : 0u); }
    };
    [[nodiscard]] VkPipeline surface(const Faces& faces) const { return surfaces_[faces.index()]; }
    [[nodiscard]] VkPipeline cageFace(const Faces& faces) const { return cageFaces_[faces.index()]; }

    VkPipeline surfaceShadow = VK_NULL_HANDLE;
    VkPipeline surfaceShadowTrim = VK_NULL_HANDLE; ///< with holes
    VkPipeline cageShadow = VK_NULL_HANDLE;
    VkPipeline cageShadowTrim = VK_NULL_HANDLE;
    VkPipeline cageEdge = VK_NULL_HANDLE;
    VkPipeline ground = VK_NULL_HANDLE;
    VkPipeline backdrop = VK_NULL_HANDLE;

private:
    explicit DrawPipelines(Device& device) : device_(device) {}
    [[nodiscard]] Status createLayouts();
    [[nodiscard]] Status createSamplers(VkFormat shadowFormat);
    [[nodiscard]] Status createShadowPipelines(const DrawFormats& formats);
    [[nodiscard]] Status createFacePipelines(const DrawFormats& formats);
    [[nodiscard]] Status createPicturePipelines(const DrawFormats& formats);

    Device& device_;
    VkPipeline surfaces_[8]{};
    VkPipeline cageFaces_[4]{};
};

} // namespace supple::host
