// A function table between Supple and the driver: counts what crosses per frame, keeps or drops barriers, fails an
// allocation, hides a feature, makes timestamps up. One test at a time uses it; state is reset by wrappedVulkan().
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>
#include <vulkan/vulkan.h>

namespace supple::test {

struct WrappedVulkan {
    // counted
    uint64_t maps = 0, flushes = 0, updates = 0, invalidates = 0;
    uint64_t copies = 0, copiedBytes = 0;
    uint64_t watchedBytes = 0; ///< copied into `watched`
    uint64_t fills = 0, barriers = 0, allocations = 0;
    uint64_t dispatches = 0, indirectDispatches = 0;
    uint64_t workgroups = 0; ///< of all vkCmdDispatch
    std::set<VkPipeline> pipelinesBound;
    uint64_t queryReads = 0, queryCopies = 0;          ///< vkGetQueryPoolResults, vkCmdCopyQueryPoolResults
    std::vector<VkBufferMemoryBarrier> bufferBarriers; ///< of all vkCmdPipelineBarrier
    std::vector<std::pair<VkPipelineStageFlags, VkPipelineStageFlags>> bufferBarrierStages; ///< before and after each
    uint64_t unknownStructs = 0; ///< chained into queries, which Vulkan 1.1 does not know
    // provoked
    int64_t dropBarrier = -1;    ///< index of the vkCmdPipelineBarrier to leave out
    int64_t failAllocation = -1; ///< index of the vkAllocateMemory that fails
    int64_t failBuffer = -1;     ///< index of the vkCreateBuffer that fails
    VkResult allocationFailure = VK_ERROR_OUT_OF_DEVICE_MEMORY, bufferFailure = VK_ERROR_OUT_OF_HOST_MEMORY;
    VkResult queryFailure = VK_SUCCESS; ///< when not a success: of vkGetQueryPoolResults
    uint64_t ticksAPass = 0;            ///< when not 0: timestamps read are this far apart, one from the next
    uint64_t buffers = 0;
    std::string_view hiddenFunction;    ///< of the device, which then does not have it
    const char* watchedName = nullptr;  ///< of buffers
    std::set<VkBuffer> watched;         ///< those that were given the name
    uint32_t apiVersion = 0;            ///< when not 0: what the device says. Below 1.2 nothing newer than 1.1 is there
    uint32_t maxStorageBufferRange = 0; ///< when not 0: what the device says
    uint32_t maxTexelBufferElements = 0;    ///< the same
    uint32_t maxComputeWorkGroupCountX = 0; ///< the same
    /// When another: what the device says.
    VkPhysicalDeviceType deviceType = VK_PHYSICAL_DEVICE_TYPE_MAX_ENUM;
};

/// The state, reset.
WrappedVulkan& wrappedVulkan();
/// The same state, as it is.
WrappedVulkan& currentWrappedVulkan();
/// What goes into DeviceOptions::suppleGetInstanceProcAddr.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL wrappedGetInstanceProcAddr(VkInstance instance, const char* name);

} // namespace supple::test
