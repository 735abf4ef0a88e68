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
#include <shaders/decal_frag.h>
#include <shaders/decal_frag_TRACED.h>
#include <shaders/decal_vert.h>
#include <shaders/ground_frag.h>
#include <shaders/ground_frag_TRACED.h>
#include <shaders/ground_vert.h>
#include <shaders/prop_frag.h>
#include <shaders/prop_frag_TRACED.h>
#include <shaders/prop_vert.h>
#include <shaders/surface_frag.h>
#include <shaders/surface_frag_TRACED.h>
#include <shaders/surface_shadow_trim_frag.h>
#include <shaders/surface_shadow_trim_vert.h>
#include <shaders/surface_shadow_vert.h>
#include <shaders/surface_vert.h>

namespace supple::host {

namespace {

constexpr float kShadowBias = 4.0f;
constexpr float kShadowBiasSlope = 1.75f;
constexpr float kSmallThings = 3.0f; ///< props are hardly larger than texels of a shadow map: they need more of it

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
    std::unique_ptr<DrawPipelines> pipelines(new DrawPipelines(device, formats));
    if (const Status status = pipelines->createLayouts(); !status)
        return status.error();
    if (const Status status = pipelines->createSamplers(formats.shadow); !status)
        return status.error();
    if (const Status status = pipelines->createShadowPipelines(); !status)
        return status.error();
    if (const Status status = pipelines->createPicturePipelines(); !status)
        return status.error();
    return pipelines;
}

Status DrawPipelines::createLayouts() {
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
    constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    std::vector<Binding> frame = {
        {shared::kFrameBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex | kFragment},
        {shared::kShadowBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kVertex | kFragment},
        {shared::kEnvironmentBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
        {shared::kShadowDepthBinding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kVertex | kFragment},
    };
    if (formats_.traced)
        frame.push_back({shared::kRayBinding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, kFragment});
    const std::initializer_list<Binding> figure = {
        {shared::kSurfaceVertexBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceAttributeBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceUv1Binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kSurfaceFaceUvBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kInstancesBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kPatchBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex | kFragment},
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
        {shared::kLayerTextureBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment,
         shared::kLayerTextureCount},
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

Status DrawPipelines::createShadowPipelines() {
    GraphicsDesc desc{.name = "surface shadow",
                      .layout = layout,
                      .vertexShader = surface_shadow_vert,
                      .depth = formats_.shadow,
                      .depthBias = kShadowBias,
                      .depthBiasSlope = kShadowBiasSlope};
    if (const Status status = keep(createGraphicsPipeline(device_, desc), surfaceShadow); !status)
        return status.error();
    desc.name = "cage shadow";
    desc.vertexShader = cage_shadow_vert;
    return keep(createGraphicsPipeline(device_, desc), cageShadow);
}

Status DrawPipelines::prepare(const Faces& faces) {
    if (faces_.contains(faces))
        return success();
    GraphicsDesc desc{.layout = layout,
                      .constants = {faces.vertexLit ? 1u : 0u, faces.maps ? 1u : 0u, faces.view, faces.material,
                                    faces.blend == Blend::multiply ? 1u : 0u, faces.layerSlots[0],
                                    faces.layerSlots[1]}};
    if (faces.shadow) {
        desc.name = faces.cage ? "cage shadow, trimmed" : "surface shadow, trimmed";
        desc.vertexShader = faces.cage ? std::span<const uint32_t>(cage_shadow_trim_vert) : surface_shadow_trim_vert;
        desc.fragmentShader = surface_shadow_trim_frag;
        desc.depth = formats_.shadow;
        desc.depthBias = kShadowBias;
        desc.depthBiasSlope = kShadowBiasSlope;
    } else {
        desc.name = faces.cage ? "cage face" : "surface";
        desc.vertexShader = faces.cage ? std::span<const uint32_t>(cage_face_vert) : surface_vert;
        desc.fragmentShader = faces.cage        ? std::span<const uint32_t>(cage_face_frag)
                              : formats_.traced ? std::span<const uint32_t>(surface_frag_TRACED)
                                                : surface_frag;
        desc.colors = {formats_.color};
        desc.depth = formats_.depth;
        desc.samples = formats_.samples;
        desc.blend = faces.blend;
        desc.depthWrite = faces.blend == Blend::none;
        // Coverage smooths the edges of holes. What blends needs its alpha itself.
        desc.alphaToCoverage = faces.blend == Blend::none && formats_.samples != VK_SAMPLE_COUNT_1_BIT;
    }
    VkPipeline made = VK_NULL_HANDLE;
    if (const Status status = keep(createGraphicsPipeline(device_, desc), made); !status)
        return status.error();
    faces_[faces] = made;
    return success();
}

Status DrawPipelines::createPicturePipelines() {
    const GraphicsDesc opaque{
        .layout = layout, .colors = {formats_.color}, .depth = formats_.depth, .samples = formats_.samples};
    const auto make = [&](const char* name, std::span<const uint32_t> vertex, std::span<const uint32_t> fragment,
                          GraphicsDesc desc, VkPipeline& out) {
        desc.name = name;
        desc.vertexShader = vertex;
        desc.fragmentShader = fragment;
        return keep(createGraphicsPipeline(device_, desc), out);
    };
    GraphicsDesc edges = opaque;
    edges.blend = Blend::over;
    edges.depthWrite = false;
    GraphicsDesc strip = opaque;
    strip.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    GraphicsDesc behind = opaque;
    behind.depthWrite = false;
    for (const Status& status :
         {make("cage edge", cage_edge_vert, cage_edge_frag, edges, cageEdge),
          make("ground", ground_vert, formats_.traced ? std::span<const uint32_t>(ground_frag_TRACED) : ground_frag,
               strip, ground),
          make("backdrop", backdrop_vert, backdrop_frag, behind, backdrop)}) {
        if (!status)
            return status.error();
    }
    return success();
}

Result<const AttachmentPipelines*> DrawPipelines::attachments() {
    AttachmentPipelines& own = attachments_;
    if (own.decal != VK_NULL_HANDLE)
        return &own;
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT, kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    const std::initializer_list<Binding> bindings = {
        {shared::kAttachmentFrameBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kAttachmentVertexBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kAttachmentInstanceBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
        {shared::kDecalColorBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
        {shared::kDecalNormalBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
    };
    if (const Status status = keep(createSetLayout(device_, bindings), own.set); !status)
        return status.error();
    // With the push constants of `layout`, so that the frame's set stays bound.
    if (const Status status =
            keep(createPipelineLayout(device_, {frameSet, own.set}, sizeof(shared::DrawPush), kVertex | kFragment),
                 own.layout);
        !status)
        return status.error();
    GraphicsDesc shadow{.name = "prop shadow",
                        .layout = own.layout,
                        .vertexShader = prop_vert,
                        .depth = formats_.shadow,
                        .depthBias = kSmallThings * kShadowBias,
                        .depthBiasSlope = kSmallThings * kShadowBiasSlope};
    GraphicsDesc prop{.name = "prop",
                      .layout = own.layout,
                      .vertexShader = prop_vert,
                      .fragmentShader = formats_.traced ? std::span<const uint32_t>(prop_frag_TRACED) : prop_frag,
                      .colors = {formats_.color},
                      .depth = formats_.depth,
                      .samples = formats_.samples};
    GraphicsDesc decal = prop;
    decal.name = "decal";
    decal.vertexShader = decal_vert;
    decal.fragmentShader = formats_.traced ? std::span<const uint32_t>(decal_frag_TRACED) : decal_frag;
    decal.blend = Blend::over;
    decal.depthWrite = false;
    Status made = keep(createGraphicsPipeline(device_, shadow), own.propShadow);
    if (made)
        made = keep(createGraphicsPipeline(device_, prop), own.prop);
    if (made)
        made = keep(createGraphicsPipeline(device_, decal), own.decal);
    return made ? Result<const AttachmentPipelines*>(&own) : made.error();
}

} // namespace supple::host
