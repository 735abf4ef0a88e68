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
    if (const Status status = pipelines->createSampler(formats.shadow); !status)
        return status.error();
    if (const Status status = pipelines->createShadowPipelines(formats); !status)
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
    };
    const std::initializer_list<Binding> material = {
        {shared::kMaterialBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
        {shared::kBaseColorBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
        {shared::kMetallicRoughnessBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
        {shared::kTrimBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
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

Status DrawPipelines::createSampler(VkFormat shadowFormat) {
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
    return keep(createGraphicsPipeline(device_, desc), surfaceShadowTrim);
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
    GraphicsDesc covering = opaque; // the edges of holes
    covering.alphaToCoverage = formats.samples != VK_SAMPLE_COUNT_1_BIT;
    GraphicsDesc lit = covering;
    lit.constant0 = true;
    GraphicsDesc edges = opaque;
    edges.blend = true;
    edges.depthWrite = false;
    GraphicsDesc strip = opaque;
    strip.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    GraphicsDesc behind = opaque;
    behind.depthWrite = false;
    for (const Status& status : {make("surface, lit by vertex", surface_vert, surface_frag, lit, surfaceVertexLit),
                                 make("surface", surface_vert, surface_frag, covering, surface),
                                 make("cage face", cage_face_vert, cage_face_frag, covering, cageFace),
                                 make("cage edge", cage_edge_vert, cage_edge_frag, edges, cageEdge),
                                 make("ground", ground_vert, ground_frag, strip, ground),
                                 make("backdrop", backdrop_vert, backdrop_frag, behind, backdrop)}) {
        if (!status)
            return status.error();
    }
    return success();
}

} // namespace supple::host
