// The pipelines of host/shaders and the layout they have in common. They live as long as the device.
#pragma once

#include "host/attachments.h"
#include "host/device.h"
#include "host/material_uniforms.h"
#include "host/pipelines.h"

#include <compare>
#include <map>
#include <memory>
#include <span>

namespace supple::host {

struct DrawFormats {
    VkFormat color = VK_FORMAT_UNDEFINED;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkFormat shadow = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool traced = false; ///< surfaces and floor ask rays what the light sees, instead of shadow maps
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

    /// What faces are drawn with: there is a pipeline for each of these.
    struct Faces {
        bool cage = false;     ///< of the cage instead of the surface
        bool shadow = false;   ///< the shadow of what has holes, and nothing else
        uint32_t material = 0; ///< what it has: shared::kMaterial...
        LayerSlots layerSlots{shared::kNoLayerSlots, shared::kNoLayerSlots};
        uint32_t view = 0;         ///< shared::kView...; 0 of a shadow
        bool vertexLit = false;    ///< the light is looked up once a vertex; only of the surface
        bool maps = false;         ///< the material has normal, occlusion or emissive maps
        Blend blend = Blend::none; ///< multiply and add: glass

        auto operator<=>(const Faces&) const = default;
    };
    /// Makes the pipeline if there is none yet.
    [[nodiscard]] Status prepare(const Faces& faces);
    /// They are prepared.
    [[nodiscard]] VkPipeline operator[](const Faces& faces) const { return faces_.at(faces); }

    /// The pipelines of what sits on the surface. They are made when first asked for.
    [[nodiscard]] Result<const AttachmentPipelines*> attachments();

    VkPipeline surfaceShadow = VK_NULL_HANDLE; ///< without holes
    VkPipeline cageShadow = VK_NULL_HANDLE;
    VkPipeline cageEdge = VK_NULL_HANDLE;
    VkPipeline ground = VK_NULL_HANDLE;
    VkPipeline backdrop = VK_NULL_HANDLE;

private:
    DrawPipelines(Device& device, const DrawFormats& formats) : device_(device), formats_(formats) {}
    [[nodiscard]] Status createLayouts();
    [[nodiscard]] Status createSamplers(VkFormat shadowFormat);
    [[nodiscard]] Status createShadowPipelines();
    [[nodiscard]] Status createPicturePipelines();

    Device& device_;
    DrawFormats formats_;
    std::map<Faces, VkPipeline> faces_;
    AttachmentPipelines attachments_;
};

} // namespace supple::host
