#include "host/draw_pipelines.h"

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
#include <vector>

namespace supple::host {

namespace {

struct PipelineDesc {
    const char* name;
    std::span<const uint32_t> vertex;
    std::span<const uint32_t> fragment; ///< empty: depth only
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkCompareOp depthCompare = VK_COMPARE_OP_LESS_OR_EQUAL;
    bool depthWrite = true;
    bool depthBias = false;
    bool blend = false;
    bool alphaToCoverage = false;
    bool lightPerVertex = false;
    VkFormat color = VK_FORMAT_UNDEFINED;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

/// A shader module for as long as a pipeline is being made of it.
class ShaderModule {
public:
    ShaderModule(VkDevice device, std::span<const uint32_t> code) : device_(device) {
        auto info = vkStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        info.codeSize = code.size_bytes();
        info.pCode = code.data();
        result = vkCreateShaderModule(device, &info, nullptr, &handle);
    }
    ~ShaderModule() { vkDestroyShaderModule(device_, handle, nullptr); }
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;

    VkShaderModule handle = VK_NULL_HANDLE;
    VkResult result = VK_SUCCESS;

private:
    VkDevice device_;
};

Result<VkPipeline> createPipeline(Device& device, VkPipelineLayout layout, const PipelineDesc& desc) {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const ShaderModule vertex(device.handle(), desc.vertex);
    if (vertex.result != VK_SUCCESS)
        return vulkanError(vertex.result, "vkCreateShaderModule");
    const VkBool32 lightPerVertex = desc.lightPerVertex ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{0, 0, sizeof lightPerVertex};
    const VkSpecializationInfo specialization{1, &entry, sizeof lightPerVertex, &lightPerVertex};
    const auto addStage = [&](VkShaderStageFlagBits stage, VkShaderModule module) {
        auto info = vkStruct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        info.stage = stage;
        info.module = module;
        info.pName = "main";
        info.pSpecializationInfo = &specialization;
        stages.push_back(info);
    };
    addStage(VK_SHADER_STAGE_VERTEX_BIT, vertex.handle);
    std::unique_ptr<ShaderModule> fragment;
    if (!desc.fragment.empty()) {
        fragment = std::make_unique<ShaderModule>(device.handle(), desc.fragment);
        if (fragment->result != VK_SUCCESS)
            return vulkanError(fragment->result, "vkCreateShaderModule");
        addStage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment->handle);
    }

    const auto vertexInput =
        vkStruct<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    auto assembly =
        vkStruct<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = desc.topology;
    auto viewport = vkStruct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    // Nothing is culled: open cages show their insides, and the shader tells the sides apart.
    auto raster =
        vkStruct<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    raster.depthBiasEnable = desc.depthBias ? VK_TRUE : VK_FALSE;
    raster.depthBiasConstantFactor = 4.0f;
    raster.depthBiasSlopeFactor = 1.75f;
    auto multisample =
        vkStruct<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    multisample.rasterizationSamples = desc.samples;
    multisample.alphaToCoverageEnable = desc.alphaToCoverage ? VK_TRUE : VK_FALSE;
    auto depth =
        vkStruct<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = desc.depthWrite ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = desc.depthCompare;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
    attachment.blendEnable = desc.blend ? VK_TRUE : VK_FALSE;
    attachment.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    attachment.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    attachment.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    auto blend =
        vkStruct<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = desc.color != VK_FORMAT_UNDEFINED ? 1u : 0u;
    blend.pAttachments = &attachment;
    constexpr VkDynamicState kDynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic = vkStruct<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = static_cast<uint32_t>(std::size(kDynamic));
    dynamic.pDynamicStates = kDynamic;
    auto rendering = vkStruct<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    rendering.colorAttachmentCount = blend.attachmentCount;
    rendering.pColorAttachmentFormats = &desc.color;
    rendering.depthAttachmentFormat = desc.depth;

    auto info = vkStruct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering);
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertexInput;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (const VkResult result =
            vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
        result != VK_SUCCESS)
        return vulkanError(result, std::string("the pipeline ") + desc.name);
    device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), desc.name);
    return pipeline;
}

struct Binding {
    uint32_t binding;
    VkDescriptorType type;
    VkShaderStageFlags stages;
};

Status createSetLayout(Device& device, std::span<const Binding> bindings, VkDescriptorSetLayout& out) {
    std::vector<VkDescriptorSetLayoutBinding> entries;
    for (const Binding& binding : bindings)
        entries.push_back({binding.binding, binding.type, 1, binding.stages, nullptr});
    auto info = vkStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<uint32_t>(entries.size());
    info.pBindings = entries.data();
    if (const VkResult result = vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &out);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorSetLayout");
    return success();
}

} // namespace

Result<std::unique_ptr<DrawPipelines>> DrawPipelines::create(Device& device, const DrawFormats& formats) {
    std::unique_ptr<DrawPipelines> pipelines(new DrawPipelines(device));
    if (const Status status = pipelines->createLayouts(); !status)
        return status.error();
    if (const Status status = pipelines->createSampler(formats.shadow); !status)
        return status.error();
    if (const Status status = pipelines->createPipelines(formats); !status)
        return status.error();
    return pipelines;
}

DrawPipelines::~DrawPipelines() {
    const VkDevice device = device_.handle();
    for (const VkPipeline pipeline : {surfaceShadow, surfaceShadowTrim, cageShadow, surface, surfaceVertexLit, cageFace,
                                      cageEdge, ground, backdrop})
        vkDestroyPipeline(device, pipeline, nullptr);
    vkDestroySampler(device, shadowSampler, nullptr);
    vkDestroyPipelineLayout(device, layout, nullptr);
    for (const VkDescriptorSetLayout set : {frameSet, figureSet, materialSet})
        vkDestroyDescriptorSetLayout(device, set, nullptr);
}

Status DrawPipelines::createLayouts() {
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
    constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    constexpr Binding kFrame[] = {
        {shared::kFrameBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
        {shared::kShadowBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kVertex | kFragment},
    };
    constexpr Binding kFigure[] = {
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
    constexpr Binding kMaterial[] = {
        {shared::kBaseColorBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
        {shared::kTrimBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
    };
    if (const Status status = createSetLayout(device_, kFrame, frameSet); !status)
        return status.error();
    if (const Status status = createSetLayout(device_, kFigure, figureSet); !status)
        return status.error();
    if (const Status status = createSetLayout(device_, kMaterial, materialSet); !status)
        return status.error();

    const VkDescriptorSetLayout sets[] = {frameSet, figureSet, materialSet};
    const VkPushConstantRange push{kVertex | kFragment, 0, sizeof(shared::DrawPush)};
    auto info = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = static_cast<uint32_t>(std::size(sets));
    info.pSetLayouts = sets;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    if (const VkResult result = vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout); result != VK_SUCCESS)
        return vulkanError(result, "vkCreatePipelineLayout");
    return success();
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
    return success();
}

Status DrawPipelines::createPipelines(const DrawFormats& formats) {
    const PipelineDesc shadow{.name = "surface shadow",
                              .vertex = surface_shadow_vert,
                              .fragment = {},
                              .depthBias = true,
                              .depth = formats.shadow};
    PipelineDesc shadowTrim = shadow;
    shadowTrim.name = "surface shadow, trimmed";
    shadowTrim.vertex = surface_shadow_trim_vert;
    shadowTrim.fragment = surface_shadow_trim_frag;
    PipelineDesc cageShadowDesc = shadow;
    cageShadowDesc.name = "cage shadow";
    cageShadowDesc.vertex = cage_shadow_vert;
    const bool multisampled = formats.samples != VK_SAMPLE_COUNT_1_BIT;
    const PipelineDesc surfaceDesc{.name = "surface",
                                   .vertex = surface_vert,
                                   .fragment = surface_frag,
                                   .alphaToCoverage = multisampled,
                                   .color = formats.color,
                                   .depth = formats.depth,
                                   .samples = formats.samples};
    PipelineDesc surfaceVertexLitDesc = surfaceDesc;
    surfaceVertexLitDesc.name = "surface, lit by vertex";
    surfaceVertexLitDesc.lightPerVertex = true;
    PipelineDesc cageFaceDesc = surfaceDesc;
    cageFaceDesc.name = "cage face";
    cageFaceDesc.vertex = cage_face_vert;
    cageFaceDesc.fragment = cage_face_frag;
    PipelineDesc cageEdgeDesc = surfaceDesc;
    cageEdgeDesc.name = "cage edge";
    cageEdgeDesc.vertex = cage_edge_vert;
    cageEdgeDesc.fragment = cage_edge_frag;
    cageEdgeDesc.alphaToCoverage = false;
    cageEdgeDesc.blend = true;
    cageEdgeDesc.depthWrite = false;
    PipelineDesc groundDesc = surfaceDesc;
    groundDesc.name = "ground";
    groundDesc.vertex = ground_vert;
    groundDesc.fragment = ground_frag;
    groundDesc.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    groundDesc.alphaToCoverage = false;
    PipelineDesc backdropDesc = groundDesc;
    backdropDesc.name = "backdrop";
    backdropDesc.vertex = backdrop_vert;
    backdropDesc.fragment = backdrop_frag;
    backdropDesc.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    backdropDesc.depthWrite = false;

    const std::pair<const PipelineDesc*, VkPipeline*> all[] = {
        {&shadow, &surfaceShadow},      {&shadowTrim, &surfaceShadowTrim},
        {&cageShadowDesc, &cageShadow}, {&surfaceVertexLitDesc, &surfaceVertexLit},
        {&surfaceDesc, &surface},       {&cageFaceDesc, &cageFace},
        {&cageEdgeDesc, &cageEdge},     {&groundDesc, &ground},
        {&backdropDesc, &backdrop},
    };
    for (const auto& [desc, pipeline] : all) {
        Result<VkPipeline> made = createPipeline(device_, layout, *desc);
        if (!made)
            return made.error();
        *pipeline = *made;
    }
    return success();
}

} // namespace supple::host
