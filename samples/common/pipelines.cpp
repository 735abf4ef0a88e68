#include "pipelines.h"

namespace sample {

VkDescriptorSetLayout createSetLayout(Device& device, std::initializer_list<Binding> bindings) {
    std::vector<VkDescriptorSetLayoutBinding> list;
    for (const Binding& binding : bindings)
        list.push_back({.binding = binding.binding,
                        .descriptorType = binding.type,
                        .descriptorCount = 1,
                        .stageFlags = binding.stages});
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = static_cast<uint32_t>(list.size()),
                                               .pBindings = list.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    device.atEnd([handle = device.handle(), layout] { vkDestroyDescriptorSetLayout(handle, layout, nullptr); });
    return layout;
}

VkPipelineLayout createPipelineLayout(Device& device, std::initializer_list<VkDescriptorSetLayout> sets,
                                      uint32_t pushBytes, VkShaderStageFlags pushStages) {
    const VkPushConstantRange push{pushStages, 0, pushBytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = static_cast<uint32_t>(sets.size()),
                                          .pSetLayouts = sets.begin(),
                                          .pushConstantRangeCount = pushBytes != 0 ? 1u : 0u,
                                          .pPushConstantRanges = &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
    device.atEnd([handle = device.handle(), layout] { vkDestroyPipelineLayout(handle, layout, nullptr); });
    return layout;
}

namespace {

VkShaderModule createModule(const Device& device, std::span<const uint32_t> words) {
    const VkShaderModuleCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = words.size_bytes(), .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return module;
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, VkShaderModule module) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = which,
            .module = module,
            .pName = "main"};
}

} // namespace

VkPipeline createComputePipeline(Device& device, VkPipelineLayout layout, std::span<const uint32_t> shader) {
    const VkShaderModule module = createModule(device, shader);
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module),
                                           .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateComputePipelines");
    vkDestroyShaderModule(device.handle(), module, nullptr);
    device.atEnd([handle = device.handle(), pipeline] { vkDestroyPipeline(handle, pipeline, nullptr); });
    return pipeline;
}

VkPipeline createGraphicsPipeline(Device& device, const GraphicsDesc& desc) {
    const VkShaderModule vertex = createModule(device, desc.vertexShader);
    std::vector<VkPipelineShaderStageCreateInfo> stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex)};
    if (!desc.fragmentShader.empty())
        stages.push_back(stage(VK_SHADER_STAGE_FRAGMENT_BIT, createModule(device, desc.fragmentShader)));

    const VkPipelineVertexInputStateCreateInfo vertexInput{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = desc.topology};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .depthBiasEnable = desc.depthBias != 0.0f || desc.depthBiasSlope != 0.0f ? VK_TRUE : VK_FALSE,
        .depthBiasConstantFactor = desc.depthBias,
        .depthBiasSlopeFactor = desc.depthBiasSlope,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = desc.samples};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = desc.depth != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE,
        .depthWriteEnable = desc.depthWrite ? VK_TRUE : VK_FALSE,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(
        desc.colors.size(), {.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                               VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT});
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = static_cast<uint32_t>(attachments.size()),
                                                    .pAttachments = attachments.data()};
    const VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                            VK_DYNAMIC_STATE_CULL_MODE};
    const VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                   .dynamicStateCount = 3,
                                                   .pDynamicStates = dynamicStates};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = static_cast<uint32_t>(desc.colors.size()),
                                                  .pColorAttachmentFormats = desc.colors.data(),
                                                  .depthAttachmentFormat = desc.depth};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = static_cast<uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &vertexInput,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &multisample,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = desc.layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    for (const VkPipelineShaderStageCreateInfo& used : stages)
        vkDestroyShaderModule(device.handle(), used.module, nullptr);
    device.atEnd([handle = device.handle(), pipeline] { vkDestroyPipeline(handle, pipeline, nullptr); });
    return pipeline;
}

VkSampler createSampler(Device& device, VkFilter filter, bool compare) {
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = filter,
                                   .minFilter = filter,
                                   .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .compareEnable = compare ? VK_TRUE : VK_FALSE,
                                   .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    device.atEnd([handle = device.handle(), sampler] { vkDestroySampler(handle, sampler, nullptr); });
    return sampler;
}

Write uniformBuffer(uint32_t binding, const Buffer& buffer) {
    return {binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VkDescriptorBufferInfo{buffer.handle(), 0, buffer.size()}};
}

Write storageBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VkDescriptorBufferInfo{buffer, offset, size}};
}

Write storageBuffer(uint32_t binding, const SuppleBufferRange& view) {
    return storageBuffer(binding, view.buffer, view.offset, view.size);
}

Write sampledImage(uint32_t binding, const Image& image, VkSampler sampler, VkImageLayout layout) {
    return {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VkDescriptorImageInfo{sampler, image.view(), layout}};
}

Write storageImage(uint32_t binding, const Image& image) {
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
            VkDescriptorImageInfo{VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL}};
}

DescriptorPool::DescriptorPool(Device& device, uint32_t maxSets) : device_(device.handle()) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, maxSets},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4 * maxSets},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4 * maxSets},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, maxSets},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, maxSets}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = maxSets,
                                          .poolSizeCount = 5,
                                          .pPoolSizes = sizes};
    check(vkCreateDescriptorPool(device_, &info, nullptr, &pool_), "vkCreateDescriptorPool");
    device.atEnd([handle = device_, pool = pool_] { vkDestroyDescriptorPool(handle, pool, nullptr); });
}

VkDescriptorSet DescriptorPool::allocate(VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_, &info, &set), "vkAllocateDescriptorSets");
    return set;
}

void DescriptorPool::write(VkDescriptorSet set, std::initializer_list<Write> writes) {
    std::vector<VkWriteDescriptorSet> list;
    for (const Write& write : writes)
        list.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                        .dstSet = set,
                        .dstBinding = write.binding,
                        .descriptorCount = 1,
                        .descriptorType = write.type,
                        .pImageInfo = std::get_if<VkDescriptorImageInfo>(&write.what),
                        .pBufferInfo = std::get_if<VkDescriptorBufferInfo>(&write.what)});
    vkUpdateDescriptorSets(device_, static_cast<uint32_t>(list.size()), list.data(), 0, nullptr);
}

} // namespace sample
