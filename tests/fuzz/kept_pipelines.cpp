#include "tests/fuzz/kept_pipelines.h"

#include <cstring>
#include <map>
#include <string>

namespace supple::fuzz {
namespace {

struct Table {
    PFN_vkGetDeviceProcAddr GetDeviceProcAddr;
    PFN_vkCreateShaderModule CreateShaderModule;
    PFN_vkCreateDescriptorSetLayout CreateDescriptorSetLayout;
    PFN_vkCreatePipelineLayout CreatePipelineLayout;
    PFN_vkCreateComputePipelines CreateComputePipelines;
    PFN_vkDestroyPipeline DestroyPipeline;
};
Table real;

/// What objects are made of. A handle that comes again is written over.
std::map<std::string, size_t> codes; ///< SPIR-V, and its number
std::map<VkShaderModule, size_t> modules;
std::map<VkDescriptorSetLayout, std::string> setLayouts;
std::map<VkPipelineLayout, std::string> layouts;
std::map<std::string, VkPipeline> kept;

void append(std::string& key, const void* data, size_t bytes) {
    key.append(reinterpret_cast<const char*>(&bytes), sizeof(bytes)); // so that two rows never read as one
    if (bytes != 0) {
        key.append(static_cast<const char*>(data), bytes);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const VkResult result = real.CreateShaderModule(device, info, allocator, module);
    if (result == VK_SUCCESS) {
        const std::string code(reinterpret_cast<const char*>(info->pCode), info->codeSize);
        modules[*module] = codes.try_emplace(code, codes.size()).first->second;
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkDescriptorSetLayout* layout) {
    const VkResult result = real.CreateDescriptorSetLayout(device, info, allocator, layout);
    if (result == VK_SUCCESS) {
        std::string key;
        for (uint32_t i = 0; i < info->bindingCount; ++i) {
            const VkDescriptorSetLayoutBinding& b = info->pBindings[i];
            const uint32_t words[] = {b.binding, static_cast<uint32_t>(b.descriptorType), b.descriptorCount,
                                      b.stageFlags};
            append(key, words, sizeof(words));
        }
        setLayouts[*layout] = key;
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                    const VkAllocationCallbacks* allocator, VkPipelineLayout* layout) {
    const VkResult result = real.CreatePipelineLayout(device, info, allocator, layout);
    if (result == VK_SUCCESS) {
        std::string key;
        for (uint32_t i = 0; i < info->setLayoutCount; ++i) {
            const std::string& set = setLayouts[info->pSetLayouts[i]];
            append(key, set.data(), set.size());
        }
        append(key, info->pPushConstantRanges, info->pushConstantRangeCount * sizeof(VkPushConstantRange));
        layouts[*layout] = key;
    }
    return result;
}

/// Layouts of the same definition are compatible, so a pipeline serves them all.
std::string keyOf(const VkComputePipelineCreateInfo& info) {
    std::string key;
    const size_t code = modules[info.stage.module];
    append(key, &code, sizeof(code));
    append(key, info.stage.pName, std::strlen(info.stage.pName));
    const std::string& layout = layouts[info.layout];
    append(key, layout.data(), layout.size());
    if (const VkSpecializationInfo* constants = info.stage.pSpecializationInfo) {
        for (uint32_t i = 0; i < constants->mapEntryCount; ++i) {
            const VkSpecializationMapEntry& entry = constants->pMapEntries[i];
            append(key, &entry.constantID, sizeof(entry.constantID));
            append(key, static_cast<const char*>(constants->pData) + entry.offset, entry.size);
        }
    }
    return key;
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    for (uint32_t i = 0; i < count; ++i) {
        VkPipeline& pipeline = kept[keyOf(infos[i])];
        if (pipeline == VK_NULL_HANDLE) {
            const VkResult result = real.CreateComputePipelines(device, cache, 1, &infos[i], allocator, &pipeline);
            if (result != VK_SUCCESS) {
                return result;
            }
        }
        pipelines[i] = pipeline;
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL keepPipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*) {}

/// Keeps the real function and hands out ours.
template <class F>
PFN_vkVoidFunction instead(F& slot, PFN_vkVoidFunction function, F ours) {
    slot = reinterpret_cast<F>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(ours);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name);

PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction function) {
    const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
    if (is("vkGetDeviceProcAddr")) {
        return instead(real.GetDeviceProcAddr, function, &getDeviceProcAddr);
    }
    if (is("vkCreateShaderModule")) {
        return instead(real.CreateShaderModule, function, &createShaderModule);
    }
    if (is("vkCreateDescriptorSetLayout")) {
        return instead(real.CreateDescriptorSetLayout, function, &createSetLayout);
    }
    if (is("vkCreatePipelineLayout")) {
        return instead(real.CreatePipelineLayout, function, &createPipelineLayout);
    }
    if (is("vkCreateComputePipelines")) {
        return instead(real.CreateComputePipelines, function, &createPipelines);
    }
    if (is("vkDestroyPipeline")) {
        return instead(real.DestroyPipeline, function, &keepPipeline);
    }
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    return wrap(name, real.GetDeviceProcAddr(device, name));
}

} // namespace

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL keepingGetInstanceProcAddr(VkInstance instance, const char* name) {
    return wrap(name, vkGetInstanceProcAddr(instance, name));
}

void destroyKeptPipelines(VkDevice device) {
    for (const auto& [key, pipeline] : kept) {
        real.DestroyPipeline(device, pipeline, nullptr);
    }
    kept.clear();
}

} // namespace supple::fuzz
