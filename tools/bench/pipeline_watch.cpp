#include "tools/bench/pipeline_watch.h"

#include "tools/bench/clocks.h"

#include <cstring>

namespace supple::bench {

struct WatchedFunctions {
    PipelineWatch* watch;
    // Set before the library can call what stands for them.
    PFN_vkGetDeviceProcAddr getDeviceProcAddr;
    PFN_vkCreateShaderModule createShaderModule;
    PFN_vkCreateComputePipelines createComputePipelines;
    PFN_vkSetDebugUtilsObjectNameEXT setName;

    static WatchedFunctions& now() {
        static WatchedFunctions functions;
        return functions;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL shaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                       const VkAllocationCallbacks* allocator, VkShaderModule* out) {
        const double begin = wallSeconds(), cpuBegin = processSeconds();
        const VkResult result = now().createShaderModule(device, info, allocator, out);
        if (PipelineWatch* watch = now().watch; watch != nullptr) {
            watch->moduleBytes_ = info->codeSize;
            watch->moduleSeconds_ = wallSeconds() - begin;
            watch->moduleCpuSeconds_ = processSeconds() - cpuBegin;
        }
        return result;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL computePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                           const VkComputePipelineCreateInfo* infos,
                                                           const VkAllocationCallbacks* allocator, VkPipeline* out) {
        const double begin = wallSeconds(), cpuBegin = processSeconds();
        const VkResult result = now().createComputePipelines(device, cache, count, infos, allocator, out);
        const double cpu = (processSeconds() - cpuBegin) / count;
        if (PipelineWatch* watch = now().watch; watch != nullptr && result == VK_SUCCESS) {
            for (uint32_t i = 0; i < count; ++i) {
                watch->pipelines_.push_back({"", watch->moduleBytes_, (wallSeconds() - begin) / count,
                                             watch->moduleSeconds_, cpu + watch->moduleCpuSeconds_});
                watch->handles_.push_back(out[i]);
            }
        }
        return result;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL objectName(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
        PipelineWatch* watch = now().watch;
        for (size_t i = 0; watch != nullptr && i < watch->handles_.size(); ++i) {
            if (info->objectType == VK_OBJECT_TYPE_PIPELINE &&
                info->objectHandle == reinterpret_cast<uint64_t>(watch->handles_[i])) {
                watch->pipelines_[i].name = info->pObjectName;
            }
        }
        return now().setName(device, info);
    }

    /// The watched function of that name, which remembers the real one; else the real one.
    static PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction real) {
        if (real == nullptr) {
            return nullptr;
        }
        const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
        if (is("vkGetDeviceProcAddr")) {
            now().getDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
            return reinterpret_cast<PFN_vkVoidFunction>(&fromDevice);
        }
        if (is("vkCreateShaderModule")) {
            now().createShaderModule = reinterpret_cast<PFN_vkCreateShaderModule>(real);
            return reinterpret_cast<PFN_vkVoidFunction>(&shaderModule);
        }
        if (is("vkCreateComputePipelines")) {
            now().createComputePipelines = reinterpret_cast<PFN_vkCreateComputePipelines>(real);
            return reinterpret_cast<PFN_vkVoidFunction>(&computePipelines);
        }
        if (is("vkSetDebugUtilsObjectNameEXT")) {
            now().setName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(real);
            return reinterpret_cast<PFN_vkVoidFunction>(&objectName);
        }
        return real;
    }

    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fromDevice(VkDevice device, const char* name) {
        return wrap(name, now().getDeviceProcAddr(device, name));
    }
    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fromInstance(VkInstance instance, const char* name) {
        return wrap(name, vkGetInstanceProcAddr(instance, name));
    }
};

PipelineWatch::PipelineWatch() {
    WatchedFunctions::now().watch = this;
}

PipelineWatch::~PipelineWatch() {
    WatchedFunctions::now().watch = nullptr;
}

PFN_vkGetInstanceProcAddr PipelineWatch::getInstanceProcAddr() {
    return &WatchedFunctions::fromInstance;
}

} // namespace supple::bench
