#include "gpu/pipeline.h"

#include "gpu/fast_math.h"
#include "shaders/shared/specialization.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace supple::gpu {

Result<ComputeLayout> ComputeLayout::create(const Device& device, std::span<const Binding> bindings, uint32_t pushBytes,
                                            const char* name) {
    ComputeLayout layout;
    std::copy_if(bindings.begin(), bindings.end(), std::back_inserter(layout.bindings),
                 [&](const Binding& binding) { return binding.isIn(device.mapping.wide); });
    const auto countOf = [&](VkDescriptorType type) {
        return static_cast<uint64_t>(std::count_if(layout.bindings.begin(), layout.bindings.end(),
                                                   [&](const Binding& binding) { return binding.type == type; }));
    };
    if (countOf(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) > kMaxStorageBuffers ||
        countOf(VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) > kMaxTexelBuffers) {
        return Error{ErrorCode::vulkan, std::string(name) + ": more bindings than the requirements name"};
    }

    std::vector<VkDescriptorSetLayoutBinding> entries;
    for (const Binding& binding : layout.bindings) {
        entries.push_back({binding.binding, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<uint32_t>(entries.size());
    setInfo.pBindings = entries.data();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkResult result = device.vk.CreateDescriptorSetLayout(device.handle, &setInfo, device.allocator, &setLayout);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("descriptor set layout of ") + name);
    }
    layout.setLayout = SetLayoutHandle(device, setLayout);
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, reinterpret_cast<uint64_t>(setLayout), name);

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    result = device.vk.CreatePipelineLayout(device.handle, &info, device.allocator, &pipelineLayout);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("pipeline layout of ") + name);
    }
    layout.pipelineLayout = PipelineLayoutHandle(device, pipelineLayout);
    device.setName(VK_OBJECT_TYPE_PIPELINE_LAYOUT, reinterpret_cast<uint64_t>(pipelineLayout), name);
    return layout;
}

Result<ComputeLayout> ComputeLayout::ofShared(const Device& device, std::span<const Binding> bindings,
                                              uint32_t pushBytes, const char* name) {
    if (!device.mapping.sharesDispatches) {
        return create(device, bindings, pushBytes, name);
    }
    Result<ComputeLayout> layout = create(device, {}, sizeof(shared::TasksPush), name);
    if (layout) {
        layout->ofTasks = true;
    }
    return layout;
}

Result<PipelineHandle> createComputePipeline(const Device& device, VkPipelineLayout layout, const Spirv& spirv,
                                             std::span<const Constant> constants, const char* name) {
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    std::span<const uint32_t> words = wordsOf(device, spirv);
    std::vector<uint32_t> changed;
    if (device.fastMath) {
        changed = withoutFastMath(words);
        words = changed;
    }
    moduleInfo.codeSize = words.size_bytes();
    moduleInfo.pCode = words.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    VkResult result = device.vk.CreateShaderModule(device.handle, &moduleInfo, device.allocator, &shader);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("shader ") + name);
    }
    const ShaderModuleHandle module(device, shader);

    std::vector<Constant> all = {{shared::kLocalSizeConstant, device.mapping.localSize},
                                 {shared::kExactDivisionConstant, device.mapping.exactDivision ? VK_TRUE : VK_FALSE}};
    for (const Constant& constant : constants) {
        if (constant.id == shared::kLocalSizeConstant) {
            all.front() = constant;
        } else {
            all.push_back(constant);
        }
    }
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const Constant& constant : all) {
        entries.push_back({constant.id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values.push_back(constant.value);
    }
    VkSpecializationInfo specialization{};
    specialization.mapEntryCount = static_cast<uint32_t>(entries.size());
    specialization.pMapEntries = entries.data();
    specialization.dataSize = values.size() * sizeof(uint32_t);
    specialization.pData = values.data();

    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    result =
        device.vk.CreateComputePipelines(device.handle, device.pipelineCache, 1, &info, device.allocator, &pipeline);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("pipeline ") + name);
    }
    device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), name);
    return PipelineHandle(device, pipeline);
}

Result<DescriptorPoolHandle> createDescriptorPool(const Device& device, const ComputeLayout& layout, uint32_t setCount,
                                                  const char* name) {
    std::vector<VkDescriptorPoolSize> sizes; // one a type
    for (const Binding& binding : layout.bindings) {
        const auto known = std::find_if(sizes.begin(), sizes.end(),
                                        [&](const VkDescriptorPoolSize& size) { return size.type == binding.type; });
        if (known == sizes.end()) {
            sizes.push_back({binding.type, setCount});
        } else {
            known->descriptorCount += setCount;
        }
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = setCount;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    const VkResult result = device.vk.CreateDescriptorPool(device.handle, &info, device.allocator, &pool);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("descriptor pool of ") + name);
    }
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, reinterpret_cast<uint64_t>(pool), name);
    return DescriptorPoolHandle(device, pool);
}

Result<VkDescriptorSet> allocateSet(const Device& device, const ComputeLayout& layout, VkDescriptorPool pool,
                                    const char* name) {
    const VkDescriptorSetLayout setLayout = layout.setLayout.get();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &setLayout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = device.vk.AllocateDescriptorSets(device.handle, &info, &set);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("descriptor set of ") + name);
    }
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET, reinterpret_cast<uint64_t>(set), name);
    return set;
}

void writeSet(const Device& device, const ComputeLayout& layout, VkDescriptorSet set,
              std::span<const BoundResource> resources) {
    std::vector<VkWriteDescriptorSet> writes;
    for (const BoundResource& resource : resources) {
        const auto binding = std::find_if(layout.bindings.begin(), layout.bindings.end(),
                                          [&](const Binding& own) { return own.binding == resource.binding; });
        if (binding == layout.bindings.end()) {
            continue;
        }
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = resource.binding;
        write.descriptorCount = 1;
        const bool texels = resource.texels != VK_NULL_HANDLE;
        write.descriptorType = binding->type;
        write.pBufferInfo = texels ? nullptr : &resource.buffer;
        write.pTexelBufferView = texels ? &resource.texels : nullptr;
        writes.push_back(write);
    }
    device.vk.UpdateDescriptorSets(device.handle, static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

void bind(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel, VkDescriptorSet set,
          std::span<const std::byte> push) {
    device.vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline->get());
    device.vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout, 0, 1, &set, 0,
                                    nullptr);
    device.vk.CmdPushConstants(commandBuffer, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               static_cast<uint32_t>(push.size()), push.data());
}

void bindByAddress(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel,
                   std::span<const std::byte> push) {
    device.vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline->get());
    device.vk.CmdPushConstants(commandBuffer, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               static_cast<uint32_t>(push.size()), push.data());
}

uint32_t maxGroupsInX(const Device& device) {
    return std::min(device.limits.maxComputeWorkGroupCount[0], 65535u);
}

void dispatchLinear(const Device& device, VkCommandBuffer commandBuffer, uint64_t groups) {
    const uint64_t limit = maxGroupsInX(device);
    const uint64_t rows = std::max<uint64_t>(1, (groups + limit - 1) / limit);
    // Even rows: the last one would otherwise be nearly empty for a count just above the limit.
    const uint64_t columns = (groups + rows - 1) / rows;
    device.vk.CmdDispatch(commandBuffer, static_cast<uint32_t>(columns), static_cast<uint32_t>(rows), 1);
}

} // namespace supple::gpu
