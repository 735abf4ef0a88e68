#include "pipelines.h"

#include "shaders/backdrop_frag.h"
#include "shaders/backdrop_vert.h"
#include "shaders/character_frag.h"
#include "shaders/character_shadow_vert.h"
#include "shaders/character_vert.h"
#include "shaders/floor_frag.h"
#include "shaders/floor_vert.h"

#include <span>
#include <vector>

namespace qt_quick {

namespace {

VkDescriptorSetLayout createSetLayout(VkDevice device, std::span<const VkDescriptorSetLayoutBinding> bindings) {
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout made = VK_NULL_HANDLE;
    must(vkCreateDescriptorSetLayout(device, &info, nullptr, &made), "vkCreateDescriptorSetLayout");
    return made;
}

struct Kind {
    std::span<const uint32_t> vertex;
    std::span<const uint32_t> fragment; ///< none: depth alone
    VkCompareOp compare = VK_COMPARE_OP_LESS;
    bool bias = false;
};

VkShaderModule createModule(VkDevice device, std::span<const uint32_t> code) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkShaderModule made = VK_NULL_HANDLE;
    must(vkCreateShaderModule(device, &info, nullptr, &made), "vkCreateShaderModule");
    return made;
}

VkPipeline createPipeline(VkDevice device, VkPipelineLayout layout, const Kind& kind) {
    const bool colors = !kind.fragment.empty();
    VkPipelineShaderStageCreateInfo stages[2]{};
    for (uint32_t i = 0; i < (colors ? 2u : 1u); ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = createModule(device, i == 0 ? kind.vertex : kind.fragment);
        stages[i].pName = "main";
    }
    const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE; // seen from outside, and the projection points y down
    raster.lineWidth = 1.0f;
    raster.depthBiasEnable = kind.bias;
    raster.depthBiasConstantFactor = 2.0f;
    raster.depthBiasSlopeFactor = 2.5f;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = colors ? kSamples : VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = kind.compare;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = 0xF;
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = colors ? 1 : 0;
    blend.pAttachments = &attachment;
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE};
    const VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, nullptr, 0, 3,
                                                   states};
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = colors ? 1 : 0;
    rendering.pColorAttachmentFormats = &kColorFormat;
    rendering.depthAttachmentFormat = kDepthFormat;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = colors ? 2 : 1;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    VkPipeline made = VK_NULL_HANDLE;
    must(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &made), "vkCreateGraphicsPipelines");
    for (uint32_t i = 0; i < info.stageCount; ++i)
        vkDestroyShaderModule(device, stages[i].module, nullptr);
    return made;
}

} // namespace

Pipelines::Pipelines(const Gpu& on) : gpu(on) {
    const VkShaderStageFlags both = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    const VkDescriptorSetLayoutBinding frame[] = {
        {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, both, nullptr},
        {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}};
    frameSet = createSetLayout(gpu.device, frame);
    // Instances, vertices, attributes. Binding 2 would be previous positions, which nothing here reads.
    const VkDescriptorSetLayoutBinding surface[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr},
        {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr}};
    surfaceSet = createSetLayout(gpu.device, surface);
    const VkDescriptorSetLayoutBinding texture[] = {
        {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}};
    textureSet = createSetLayout(gpu.device, texture);
    const VkDescriptorSetLayout sets[] = {frameSet, surfaceSet, textureSet};
    const VkPushConstantRange push{both, 0, sizeof(DrawPush)};
    const VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 3, sets, 1, &push};
    must(vkCreatePipelineLayout(gpu.device, &info, nullptr, &layout), "vkCreatePipelineLayout");

    shadow = createPipeline(gpu.device, layout, {character_shadow_vert, {}, VK_COMPARE_OP_LESS, true});
    character = createPipeline(gpu.device, layout, {character_vert, character_frag});
    floor = createPipeline(gpu.device, layout, {floor_vert, floor_frag});
    backdrop = createPipeline(gpu.device, layout, {backdrop_vert, backdrop_frag, VK_COMPARE_OP_LESS_OR_EQUAL});
}

void Pipelines::destroy() {
    for (VkPipeline pipeline : {shadow, character, floor, backdrop})
        vkDestroyPipeline(gpu.device, pipeline, nullptr);
    vkDestroyPipelineLayout(gpu.device, layout, nullptr);
    for (VkDescriptorSetLayout set : {frameSet, surfaceSet, textureSet})
        vkDestroyDescriptorSetLayout(gpu.device, set, nullptr);
}

} // namespace qt_quick
