#include "host/draw_pipelines.h"

#include "host/pipelines.h"
#include "host/shaders/draw.h"
#include "host/vk_struct.h"

#include <shaders/backdrop_frag.h>
#include <shaders/backdrop_vert.h>
#include <shaders/cage_edge_frag.h>
#include <shaders/cage_edge_vert.h>
#include <shaders/cage_face_frag.h>
#include <shaders/cage_face_vert.h>
#include <shaders/cage_shadow_trim_vert.h>
#include <shaders/cage_shadow_vert.h>
#include <shaders/ground_frag.h>
#include <shaders/ground_vert.h>
#include <shaders/surface_frag.h>
#include <shaders/surface_shadow_trim_frag.h>
#include <shaders/surface_shadow_trim_vert.h>
#include <shaders/surface_shadow_vert.h>
#include <shaders/surface_vert.h>

namespace supple::host {

namespace {

/// Keeps what was made, or says why it was not.
template <class T>
Status keep(Result<T> made, T& out) {
    if (!made)
        return made.error();
    out = *made;
    return success();
}

} // namespace

Result<std::unique_ptr<DrawPipelines>> DrawPipelines::create(Device& device, const DrawFormats& formats) {
    std::unique_ptr<DrawPipelines> pipelines(new DrawPipelines(device));
    if (const Status status = pipelines->createLayouts(); !status)
        return status.error();
    if (const Status status = pipelines->createSamplers(formats.shadow); !status)
        return status.error();
    if (const Status status = pipelines->createShadowPipelines(formats); !status)
        return status.error();
    if (const Status status = pipelines->createFacePipelines(formats); !status)
        return status.error();
    if (const Status status = pipelines->createPicturePipelines(formats); !status)
        return status.error();
    return pipelines;
}

Status DrawPipelines::createLayouts() {
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
    constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    const std::initializer_list<Binding> frame = {
        {shared::kFrameBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
        {shared::kShadowBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kVertex | kFragment},
        {shared::kEnvironmentBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
    };
    const std::initializer_list<Binding> figure = {
        {shared::kSurfaceVertexBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceAttributeBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceUv1Binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceFaceUvBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kInstancesBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kPatchClassBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kFragment},
        {shared::kDeformedCageBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kCageCornerBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kCageEdgeBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceTangentBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceValueBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kLevelBucketBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kLevelPatchBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
    };
    const auto texture = [](uint32_t which) {
        return Binding{shared::kFirstTextureBinding + which, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment};
    };
    const std::initializer_list<Binding> material = {
        {shared::kMaterialBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
        texture(shared::kBaseColor),
        texture(shared::kMetallicRoughness),
        texture(shared::kNormal),
        texture(shared::kOcclusion),
        texture(shared::kEmissive),
        texture(shared::kTrim),
    };
    for (const Status& status :
         {keep(createSetLayout(device_, frame), frameSet), keep(createSetLayout(device_, figure), figureSet),
          keep(createSetLayout(device_, material), materialSet)}) {
        if (!status)
            return status.error();
    }
    return keep(createPipelineLayout(device_, {frameSet, figureSet, materialSet}, sizeof(shared::DrawPush),
                                     kVertex | kFragment),
                layout);
}

Status DrawPipelines::createSamplers(VkFormat shadowFormat) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device_.physicalDevice(), shadowFormat, &properties);
    const bool linear = (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
    auto info = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.minFilter = info.magFilter;
    // Outside the map nothing stands in the light's way.
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    if (const VkResult result = vkCreateSampler(device_.handle(), &info, nullptr, &shadowSampler); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSampler");
    device_.atEnd([device = device_.handle(), sampler = shadowSampler] { vkDestroySampler(device, sampler, nullptr); });
    // One level of the map at a time: the shader mixes them.
    auto environment = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    environment.magFilter = environment.minFilter = VK_FILTER_LINEAR;
    environment.addressModeU = environment.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    environment.maxLod = VK_LOD_CLAMP_NONE;
    if (const VkResult result = vkCreateSampler(device_.handle(), &environment, nullptr, &environmentSampler);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSampler");
    device_.atEnd(
        [device = device_.handle(), sampler = environmentSampler] { vkDestroySampler(device, sampler, nullptr); });
    return success();
}

Status DrawPipelines::createShadowPipelines(const DrawFormats& formats) {
    GraphicsDesc desc{.name = "surface shadow",
                      .layout = layout,
                      .vertexShader = surface_shadow_vert,
                      .depth = formats.shadow,
                      .depthBias = 4.0f,
                      .depthBiasSlope = 1.75f};
    if (const Status status = keep(createGraphicsPipeline(device_, desc), surfaceShadow); !status)
        return status.error();
    desc.name = "cage shadow";
    desc.vertexShader = cage_shadow_vert;
    if (const Status status = keep(createGraphicsPipeline(device_, desc), cageShadow); !status)
        return status.error();
    desc.name = "surface shadow, trimmed";
    desc.vertexShader = surface_shadow_trim_vert;
    desc.fragmentShader = surface_shadow_trim_frag;
    if (const Status status = keep(createGraphicsPipeline(device_, desc), surfaceShadowTrim); !status)
        return status.error();
    desc.name = "cage shadow, trimmed";
    desc.vertexShader = cage_shadow_trim_vert;
    return keep(createGraphicsPipeline(device_, desc), cageShadowTrim);
}

Status DrawPipelines::createFacePipelines(const DrawFormats& formats) {
    GraphicsDesc desc{.layout = layout, .colors = {formats.color}, .depth = formats.depth, .samples = formats.samples};
    for (const bool vertexLit : {false, true}) {
        for (const bool maps : {false, true}) {
            for (const bool blend : {false, true}) {
                const size_t index = Faces{vertexLit, maps, blend}.index();
                desc.constants = {vertexLit ? 1u : 0u, maps ? 1u : 0u};
                desc.blend = blend;
                desc.depthWrite = !blend;
                // Coverage smooths the edges of holes. What blends needs its alpha itself.
                desc.alphaToCoverage = !blend && formats.samples != VK_SAMPLE_COUNT_1_BIT;
                desc.name = "surface";
                desc.vertexShader = surface_vert;
                desc.fragmentShader = surface_frag;
                if (const Status status = keep(createGraphicsPipeline(device_, desc), surfaces_[index]); !status)
                    return status.error();
                if (vertexLit)
                    continue;
                desc.name = "cage face";
                desc.vertexShader = cage_face_vert;
                desc.fragmentShader = cage_face_frag;
                if (const Status status = keep(createGraphicsPipeline(device_, desc), cageFaces_[index]); !status)
                    return status.error();
            }
        }
    }
    return success();
}

Status DrawPipelines::createPicturePipelines(const DrawFormats& formats) {
    const GraphicsDesc opaque{
        .layout = layout, .colors = {formats.color}, .depth = formats.depth, .samples = formats.samples};
    const auto make = [&](const char* name, std::span<const uint32_t> vertex, std::span<const uint32_t> fragment,
                          GraphicsDesc desc, VkPipeline& out) {
        desc.name = name;
        desc.vertexShader = vertex;
        desc.fragmentShader = fragment;
        return keep(createGraphicsPipeline(device_, desc), out);
    };
    GraphicsDesc edges = opaque;
    edges.blend = true;
    edges.depthWrite = false;
    GraphicsDesc strip = opaque;
    strip.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    GraphicsDesc behind = opaque;
    behind.depthWrite = false;
    for (const Status& status : {make("cage edge", cage_edge_vert, cage_edge_frag, edges, cageEdge),
                                 make("ground", ground_vert, ground_frag, strip, ground),
                                 make("backdrop", backdrop_vert, backdrop_frag, behind, backdrop)}) {
        if (!status)
            return status.error();
    }
    return success();
}

} // namespace supple::host
