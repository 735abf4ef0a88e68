// The Vulkan entry points Supple uses, looked up through the host's vkGetInstanceProcAddr. Names of core 1.1, but
// for one; the library links no loader.
#pragma once

#include <vulkan/vulkan_core.h>

namespace supple::gpu {

#define SUPPLE_INSTANCE_FUNCTIONS(X)                                                                                   \
    X(GetPhysicalDeviceProperties2)                                                                                    \
    X(GetPhysicalDeviceFeatures2)                                                                                      \
    X(GetPhysicalDeviceMemoryProperties)                                                                               \
    X(GetPhysicalDeviceQueueFamilyProperties)                                                                          \
    X(GetPhysicalDeviceFormatProperties)                                                                               \
    X(EnumerateDeviceExtensionProperties)                                                                              \
    X(GetDeviceProcAddr)

#define SUPPLE_DEVICE_FUNCTIONS(X)                                                                                     \
    X(CreateBuffer)                                                                                                    \
    X(DestroyBuffer)                                                                                                   \
    X(GetBufferMemoryRequirements)                                                                                     \
    X(AllocateMemory)                                                                                                  \
    X(FreeMemory)                                                                                                      \
    X(BindBufferMemory)                                                                                                \
    X(MapMemory)                                                                                                       \
    X(UnmapMemory)                                                                                                     \
    X(CreateBufferView)                                                                                                \
    X(DestroyBufferView)                                                                                               \
    X(CreateShaderModule)                                                                                              \
    X(DestroyShaderModule)                                                                                             \
    X(CreateDescriptorSetLayout)                                                                                       \
    X(DestroyDescriptorSetLayout)                                                                                      \
    X(CreatePipelineLayout)                                                                                            \
    X(DestroyPipelineLayout)                                                                                           \
    X(CreateComputePipelines)                                                                                          \
    X(DestroyPipeline)                                                                                                 \
    X(CreateDescriptorPool)                                                                                            \
    X(DestroyDescriptorPool)                                                                                           \
    X(AllocateDescriptorSets)                                                                                          \
    X(UpdateDescriptorSets)                                                                                            \
    X(CreateQueryPool)                                                                                                 \
    X(DestroyQueryPool)                                                                                                \
    X(GetQueryPoolResults)                                                                                             \
    X(CmdResetQueryPool)                                                                                               \
    X(CmdCopyQueryPoolResults)                                                                                         \
    X(CmdWriteTimestamp)                                                                                               \
    X(CmdPipelineBarrier)                                                                                              \
    X(CmdBindPipeline)                                                                                                 \
    X(CmdBindDescriptorSets)                                                                                           \
    X(CmdPushConstants)                                                                                                \
    X(CmdDispatch)                                                                                                     \
    X(CmdDispatchIndirect)                                                                                             \
    X(CmdCopyBuffer)                                                                                                   \
    X(CmdFillBuffer)                                                                                                   \
    X(CmdUpdateBuffer)

/// Names of core 1.2: null where instance or device is older. Only what needs addresses calls it.
#define SUPPLE_NEWER_FUNCTIONS(X) X(GetBufferDeviceAddress)

/// VK_EXT_debug_utils, loaded only when the host says it enabled the extension.
#define SUPPLE_DEBUG_FUNCTIONS(X)                                                                                      \
    X(SetDebugUtilsObjectNameEXT)                                                                                      \
    X(CmdBeginDebugUtilsLabelEXT)                                                                                      \
    X(CmdEndDebugUtilsLabelEXT)

struct Functions {
#define SUPPLE_DECLARE(name) PFN_vk##name name = nullptr;
    SUPPLE_INSTANCE_FUNCTIONS(SUPPLE_DECLARE)
    SUPPLE_DEVICE_FUNCTIONS(SUPPLE_DECLARE)
    SUPPLE_NEWER_FUNCTIONS(SUPPLE_DECLARE)
    SUPPLE_DEBUG_FUNCTIONS(SUPPLE_DECLARE)
#undef SUPPLE_DECLARE

    /// Both return the name of the first entry point that is missing, or null.
    const char* loadInstance(VkInstance instance, PFN_vkGetInstanceProcAddr getInstanceProcAddr);
    const char* loadDevice(VkInstance instance, VkDevice device, PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                           bool debugUtils);
};

} // namespace supple::gpu
