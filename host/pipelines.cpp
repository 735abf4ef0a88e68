#include "host/pipelines.h"

namespace supple::host {

Result<VkDescriptorSetLayout> createSetLayout(Device& device, std::span<const Binding> bindings) {
    std::vector<VkDescriptorSetLayoutBinding> list;
    for (const Binding& binding : bindings)
        list.push_back({.binding = binding.binding,
                        .descriptorType = binding.type,
                        .descriptorCount = binding.count,
                        .stageFlags = binding.stages});
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = static_cast<uint32_t>(list.size()),
                                               .pBindings = list.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorSetLayout");
    device.atEnd([handle = device.handle(), layout] { vkDestroyDescriptorSetLayout(handle, layout, nullptr); });
    return layout;
}

Result<VkPipelineLayout> createPipelineLayout(Device& device, std::initializer_list<VkDescriptorSetLayout> sets,
                                              uint32_t pushBytes, VkShaderStageFlags pushStages) {
    const VkPushConstantRange push{pushStages, 0, pushBytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = static_cast<uint32_t>(sets.size()),
                                          .pSetLayouts = sets.begin(),
                                          .pushConstantRangeCount = pushBytes != 0 ? 1u : 0u,
                                          .pPushConstantRanges = &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    if (const VkResult result = vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout); result != VK_SUCCESS)
        return vulkanError(result, "vkCreatePipelineLayout");
    device.atEnd([handle = device.handle(), layout] { vkDestroyPipelineLayout(handle, layout, nullptr); });
    return layout;
}

namespace {

/// A shader module for as long as a pipeline is being made of it.
class ShaderModule {
public:
    ShaderModule(VkDevice device, std::span<const uint32_t> words) : device_(device) {
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = words.size_bytes(),
                                            .pCode = words.data()};
        if (!words.empty())
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

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, const ShaderModule& module) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = which,
            .module = module.handle,
            .pName = "main"};
}

} // namespace

Result<VkPipeline> createComputePipeline(Device& device, VkPipelineLayout layout, std::span<const uint32_t> shader) {
    const ShaderModule module(device.handle(), shader);
    if (module.result != VK_SUCCESS)
        return vulkanError(module.result, "vkCreateShaderModule");
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module),
                                           .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateComputePipelines");
    device.atEnd([handle = device.handle(), pipeline] { vkDestroyPipeline(handle, pipeline, nullptr); });
    return pipeline;
}

namespace {

/// What a pipeline begins and ends with: its shaders, and the pictures that it draws into.
struct Ends {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    std::vector<VkPipelineColorBlendAttachmentState> attachments;
};

VkPipelineColorBlendAttachmentState attachmentState(Blend blend) {
    VkPipelineColorBlendAttachmentState state{.blendEnable = blend != Blend::none ? VK_TRUE : VK_FALSE,
                                              .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
                                              .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                              .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                                VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
    if (blend == Blend::multiply || blend == Blend::add) {
        state.srcColorBlendFactor = blend == Blend::add ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
        state.dstColorBlendFactor = blend == Blend::add ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_SRC_COLOR;
        state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
        state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    }
    return state;
}

/// All that stands between shaders and pictures.
Result<VkPipeline> createBetween(Device& device, const GraphicsDesc& desc, const Ends& ends) {
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
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = desc.samples,
        .alphaToCoverageEnable = desc.alphaToCoverage ? VK_TRUE : VK_FALSE};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = desc.depth != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE,
        .depthWriteEnable = desc.depthWrite ? VK_TRUE : VK_FALSE,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = static_cast<uint32_t>(ends.attachments.size()),
                                                    .pAttachments = ends.attachments.data()};
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
                                            .stageCount = static_cast<uint32_t>(ends.stages.size()),
                                            .pStages = ends.stages.data(),
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
    if (const VkResult result =
            vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
        result != VK_SUCCESS)
        return vulkanError(result, std::string("the pipeline ") + desc.name);
    device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), desc.name);
    device.atEnd([handle = device.handle(), pipeline] { vkDestroyPipeline(handle, pipeline, nullptr); });
    return pipeline;
}

} // namespace

Result<VkPipeline> createGraphicsPipeline(Device& device, const GraphicsDesc& desc) {
    const bool isMesh = !desc.meshShader.empty();
    const ShaderModule first(device.handle(), isMesh ? desc.meshShader : desc.vertexShader);
    const ShaderModule fragment(device.handle(), desc.fragmentShader);
    for (const VkResult result : {first.result, fragment.result}) {
        if (result != VK_SUCCESS)
            return vulkanError(result, "vkCreateShaderModule");
    }
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < desc.constants.size(); ++i)
        entries.push_back({i, i * static_cast<uint32_t>(sizeof(uint32_t)), sizeof(uint32_t)});
    const VkSpecializationInfo specialization{static_cast<uint32_t>(entries.size()), entries.data(),
                                              entries.size() * sizeof(uint32_t), desc.constants.data()};
    Ends ends{.stages = {stage(isMesh ? VK_SHADER_STAGE_MESH_BIT_EXT : VK_SHADER_STAGE_VERTEX_BIT, first)},
              .attachments = std::vector(desc.colors.size(), attachmentState(desc.blend))};
    if (fragment.handle != VK_NULL_HANDLE)
        ends.stages.push_back(stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment));
    for (VkPipelineShaderStageCreateInfo& used : ends.stages)
        used.pSpecializationInfo = &specialization;
    return createBetween(device, desc, ends);
}

namespace {

Result<VkSampler> createSamplerFrom(Device& device, const VkSamplerCreateInfo& info) {
    VkSampler sampler = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateSampler(device.handle(), &info, nullptr, &sampler); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSampler");
    device.atEnd([handle = device.handle(), sampler] { vkDestroySampler(handle, sampler, nullptr); });
    return sampler;
}

} // namespace

Result<VkSampler> createSampler(Device& device, VkFilter filter, bool compare) {
    return createSamplerFrom(device, {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = filter,
                                      .minFilter = filter,
                                      .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .compareEnable = compare ? VK_TRUE : VK_FALSE,
                                      .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL});
}

Result<VkSampler> createTextureSampler(Device& device) {
    return createSamplerFrom(device, {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .minFilter = VK_FILTER_LINEAR,
                                      .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                      .maxLod = VK_LOD_CLAMP_NONE});
}

Result<VkBufferView> createTexels(Device& device, const SuppleBufferRange& range, VkFormat format) {
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = range.buffer,
                                      .format = format,
                                      .offset = range.offset,
                                      .range = range.size};
    VkBufferView view = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateBufferView(device.handle(), &info, nullptr, &view); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateBufferView");
    device.atEnd([handle = device.handle(), view] { vkDestroyBufferView(handle, view, nullptr); });
    return view;
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

Write texels(uint32_t binding, VkBufferView view) {
    return {binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, view};
}

Write sampledImage(uint32_t binding, const Image& image, VkSampler sampler, VkImageLayout layout) {
    return {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VkDescriptorImageInfo{sampler, image.view(), layout}};
}

Write storageImage(uint32_t binding, const Image& image) {
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
            VkDescriptorImageInfo{VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL}};
}

Write accelerationStructure(uint32_t binding, VkAccelerationStructureKHR structure) {
    return {binding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, structure};
}

Result<DescriptorPool> DescriptorPool::create(Device& device, uint32_t maxSets) {
    DescriptorPool pool;
    pool.device_ = device.handle();
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, maxSets},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4 * maxSets},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4 * maxSets},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, maxSets},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, maxSets},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 2 * maxSets},
                                          {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, maxSets}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = maxSets,
                                          .poolSizeCount = device.tracesRays() ? 7u : 6u, // the last needs it
                                          .pPoolSizes = sizes};
    if (const VkResult result = vkCreateDescriptorPool(pool.device_, &info, nullptr, &pool.pool_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorPool");
    device.atEnd([pool] { vkDestroyDescriptorPool(pool.device_, pool.pool_, nullptr); });
    return pool;
}

Result<VkDescriptorSet> DescriptorPool::allocate(VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (const VkResult result = vkAllocateDescriptorSets(device_, &info, &set); result != VK_SUCCESS)
        return vulkanError(result, "vkAllocateDescriptorSets");
    return set;
}

void DescriptorPool::write(VkDescriptorSet set, std::span<const Write> writes) {
    std::vector<VkWriteDescriptorSet> list;
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures;
    structures.reserve(writes.size()); // `list` points at them
    for (const Write& write : writes) {
        const auto* structure = std::get_if<VkAccelerationStructureKHR>(&write.what);
        if (structure != nullptr)
            structures.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
                                  .accelerationStructureCount = 1,
                                  .pAccelerationStructures = structure});
        list.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                        .pNext = structure != nullptr ? &structures.back() : nullptr,
                        .dstSet = set,
                        .dstBinding = write.binding,
                        .dstArrayElement = write.element,
                        .descriptorCount = 1,
                        .descriptorType = write.type,
                        .pImageInfo = std::get_if<VkDescriptorImageInfo>(&write.what),
                        .pBufferInfo = std::get_if<VkDescriptorBufferInfo>(&write.what),
                        .pTexelBufferView = std::get_if<VkBufferView>(&write.what)});
    }
    vkUpdateDescriptorSets(device_, static_cast<uint32_t>(list.size()), list.data(), 0, nullptr);
}

} // namespace supple::host
