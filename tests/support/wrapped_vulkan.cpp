#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <string_view>

namespace supple::test {

namespace {

struct Table {
    PFN_vkGetDeviceProcAddr GetDeviceProcAddr;
    PFN_vkGetPhysicalDeviceFeatures2 GetPhysicalDeviceFeatures2;
    PFN_vkMapMemory MapMemory;
    PFN_vkFlushMappedMemoryRanges FlushMappedMemoryRanges;
    PFN_vkAllocateMemory AllocateMemory;
    PFN_vkCreateBuffer CreateBuffer;
    PFN_vkCmdCopyBuffer CmdCopyBuffer;
    PFN_vkCmdFillBuffer CmdFillBuffer;
    PFN_vkCmdBindPipeline CmdBindPipeline;
    PFN_vkCmdDispatch CmdDispatch;
    PFN_vkCmdDispatchIndirect CmdDispatchIndirect;
    PFN_vkCmdPipelineBarrier CmdPipelineBarrier;
    PFN_vkCmdUpdateBuffer CmdUpdateBuffer;
    PFN_vkCmdCopyBuffer2 CmdCopyBuffer2;
    PFN_vkInvalidateMappedMemoryRanges InvalidateMappedMemoryRanges;
    PFN_vkGetPhysicalDeviceProperties2 GetPhysicalDeviceProperties2;
    PFN_vkGetQueryPoolResults GetQueryPoolResults;
    PFN_vkCmdCopyQueryPoolResults CmdCopyQueryPoolResults;
    PFN_vkSetDebugUtilsObjectNameEXT SetDebugUtilsObjectNameEXT;
};
Table real;
WrappedVulkan state;

VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                                         VkMemoryMapFlags flags, void** data) {
    ++state.maps;
    return real.MapMemory(device, memory, offset, size, flags, data);
}
VKAPI_ATTR VkResult VKAPI_CALL flush(VkDevice device, uint32_t count, const VkMappedMemoryRange* ranges) {
    state.flushes += count;
    return real.FlushMappedMemoryRanges(device, count, ranges);
}
VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    if (static_cast<int64_t>(state.allocations++) == state.failAllocation) {
        return state.allocationFailure;
    }
    return real.AllocateMemory(device, info, allocator, memory);
}
VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
    if (static_cast<int64_t>(state.buffers++) == state.failBuffer) {
        return state.bufferFailure;
    }
    return real.CreateBuffer(device, info, allocator, buffer);
}
VKAPI_ATTR void VKAPI_CALL copyBuffer(VkCommandBuffer commands, VkBuffer source, VkBuffer target, uint32_t count,
                                      const VkBufferCopy* regions) {
    ++state.copies;
    for (uint32_t i = 0; i < count; ++i) {
        state.copiedBytes += regions[i].size;
        state.watchedBytes += state.watched.contains(target) ? regions[i].size : 0;
    }
    real.CmdCopyBuffer(commands, source, target, count, regions);
}
VKAPI_ATTR VkResult VKAPI_CALL setName(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
    if (info->objectType == VK_OBJECT_TYPE_BUFFER) {
        const auto buffer = reinterpret_cast<VkBuffer>(info->objectHandle); // NOLINT: a handle as a number
        state.watched.erase(buffer);                                        // handles come again
        if (state.watchedName != nullptr && std::strcmp(info->pObjectName, state.watchedName) == 0) {
            state.watched.insert(buffer);
        }
    }
    return real.SetDebugUtilsObjectNameEXT(device, info);
}
VKAPI_ATTR void VKAPI_CALL fillBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                                      uint32_t value) {
    ++state.fills;
    real.CmdFillBuffer(commands, buffer, offset, size, value);
}
VKAPI_ATTR void VKAPI_CALL bindPipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
    state.pipelinesBound.insert(pipeline);
    real.CmdBindPipeline(commands, point, pipeline);
}
VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
    ++state.dispatches;
    state.workgroups += uint64_t{x} * y * z;
    real.CmdDispatch(commands, x, y, z);
}
VKAPI_ATTR void VKAPI_CALL dispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    ++state.indirectDispatches;
    real.CmdDispatchIndirect(commands, buffer, offset);
}
VKAPI_ATTR void VKAPI_CALL barrier(VkCommandBuffer commands, VkPipelineStageFlags before, VkPipelineStageFlags after,
                                   VkDependencyFlags flags, uint32_t count, const VkMemoryBarrier* global,
                                   uint32_t bufferCount, const VkBufferMemoryBarrier* buffers, uint32_t imageCount,
                                   const VkImageMemoryBarrier* images) {
    state.bufferBarriers.insert(state.bufferBarriers.end(), buffers, buffers + bufferCount);
    state.bufferBarrierStages.insert(state.bufferBarrierStages.end(), bufferCount, {before, after});
    if (static_cast<int64_t>(state.barriers++) != state.dropBarrier) {
        real.CmdPipelineBarrier(commands, before, after, flags, count, global, bufferCount, buffers, imageCount,
                                images);
    }
}
VKAPI_ATTR void VKAPI_CALL updateBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                        VkDeviceSize size, const void* data) {
    ++state.updates;
    real.CmdUpdateBuffer(commands, buffer, offset, size, data);
}
VKAPI_ATTR void VKAPI_CALL copyBuffer2(VkCommandBuffer commands, const VkCopyBufferInfo2* info) {
    ++state.copies;
    for (uint32_t i = 0; i < info->regionCount; ++i) {
        state.copiedBytes += info->pRegions[i].size;
    }
    real.CmdCopyBuffer2(commands, info);
}
VKAPI_ATTR VkResult VKAPI_CALL invalidate(VkDevice device, uint32_t count, const VkMappedMemoryRange* ranges) {
    state.invalidates += count;
    return real.InvalidateMappedMemoryRanges(device, count, ranges);
}
VKAPI_ATTR VkResult VKAPI_CALL queryResults(VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count,
                                            size_t size, void* data, VkDeviceSize stride, VkQueryResultFlags flags) {
    ++state.queryReads;
    if (state.queryFailure < 0) {
        return state.queryFailure;
    }
    const VkResult result = real.GetQueryPoolResults(device, pool, first, count, size, data, stride, flags);
    for (uint32_t i = 0; i < count && state.ticksAPass != 0; ++i) {
        const uint64_t tick = 1000 + (first + i) * state.ticksAPass;
        std::memcpy(static_cast<std::byte*>(data) + i * stride, &tick, sizeof(tick));
    }
    return result;
}
VKAPI_ATTR void VKAPI_CALL copyQueryResults(VkCommandBuffer commands, VkQueryPool pool, uint32_t first, uint32_t count,
                                            VkBuffer target, VkDeviceSize offset, VkDeviceSize stride,
                                            VkQueryResultFlags flags) {
    ++state.queryCopies;
    real.CmdCopyQueryPoolResults(commands, pool, first, count, target, offset, stride, flags);
}
bool isOld() {
    return state.apiVersion != 0 && state.apiVersion < VK_API_VERSION_1_2;
}
/// The functions of devices that Vulkan 1.2 and 1.3 brought, as vulkan_core.h lists them.
constexpr std::string_view kNewerFunctions[] = {
    "vkCmdBeginRenderPass2",
    "vkCmdBeginRendering",
    "vkCmdBindVertexBuffers2",
    "vkCmdBlitImage2",
    "vkCmdCopyBuffer2",
    "vkCmdCopyBufferToImage2",
    "vkCmdCopyImage2",
    "vkCmdCopyImageToBuffer2",
    "vkCmdDrawIndexedIndirectCount",
    "vkCmdDrawIndirectCount",
    "vkCmdEndRenderPass2",
    "vkCmdEndRendering",
    "vkCmdNextSubpass2",
    "vkCmdPipelineBarrier2",
    "vkCmdResetEvent2",
    "vkCmdResolveImage2",
    "vkCmdSetCullMode",
    "vkCmdSetDepthBiasEnable",
    "vkCmdSetDepthBoundsTestEnable",
    "vkCmdSetDepthCompareOp",
    "vkCmdSetDepthTestEnable",
    "vkCmdSetDepthWriteEnable",
    "vkCmdSetEvent2",
    "vkCmdSetFrontFace",
    "vkCmdSetPrimitiveRestartEnable",
    "vkCmdSetPrimitiveTopology",
    "vkCmdSetRasterizerDiscardEnable",
    "vkCmdSetScissorWithCount",
    "vkCmdSetStencilOp",
    "vkCmdSetStencilTestEnable",
    "vkCmdSetViewportWithCount",
    "vkCmdWaitEvents2",
    "vkCmdWriteTimestamp2",
    "vkCreatePrivateDataSlot",
    "vkCreateRenderPass2",
    "vkDestroyPrivateDataSlot",
    "vkGetBufferDeviceAddress",
    "vkGetBufferOpaqueCaptureAddress",
    "vkGetDeviceBufferMemoryRequirements",
    "vkGetDeviceImageMemoryRequirements",
    "vkGetDeviceImageSparseMemoryRequirements",
    "vkGetDeviceMemoryOpaqueCaptureAddress",
    "vkGetPrivateData",
    "vkGetSemaphoreCounterValue",
    "vkQueueSubmit2",
    "vkResetQueryPool",
    "vkSetPrivateData",
    "vkSignalSemaphore",
    "vkWaitSemaphores",
};
/// Whether the device has no such function: the test hides it, or it is of Vulkan 1.1 and enabled no extension. Names
/// of extensions alone end in a capital letter.
bool isHidden(std::string_view name) {
    const bool isNewer = (name.back() >= 'A' && name.back() <= 'Z') ||
                         std::ranges::find(kNewerFunctions, name) != std::end(kNewerFunctions);
    return name == state.hiddenFunction || (isOld() && isNewer);
}
/// Counts the structs that a device of Vulkan 1.1 does not know.
void countUnknown(const void* chain) {
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        const bool known = next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
        state.unknownStructs += isOld() && !known ? 1 : 0;
    }
}
VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice device, VkPhysicalDeviceProperties2* out) {
    countUnknown(out->pNext);
    real.GetPhysicalDeviceProperties2(device, out);
    if (state.apiVersion != 0) {
        out->properties.apiVersion = state.apiVersion;
    }
    VkPhysicalDeviceLimits& limits = out->properties.limits;
    if (state.maxStorageBufferRange != 0) {
        limits.maxStorageBufferRange = state.maxStorageBufferRange;
    }
    if (state.maxTexelBufferElements != 0) {
        limits.maxTexelBufferElements = state.maxTexelBufferElements;
    }
    if (state.maxComputeWorkGroupCountX != 0) {
        limits.maxComputeWorkGroupCount[0] = state.maxComputeWorkGroupCountX;
    }
    if (state.deviceType != VK_PHYSICAL_DEVICE_TYPE_MAX_ENUM) {
        out->properties.deviceType = state.deviceType;
    }
}
VKAPI_ATTR void VKAPI_CALL features(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* out) {
    countUnknown(out->pNext);
    real.GetPhysicalDeviceFeatures2(device, out);
}

/// Keeps the real function and hands out ours.
template <class F>
PFN_vkVoidFunction wrap(F& slot, PFN_vkVoidFunction function, F ours) {
    slot = reinterpret_cast<F>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(ours);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    if (isHidden(name)) {
        return nullptr;
    }
    const PFN_vkVoidFunction function = real.GetDeviceProcAddr(device, name);
    const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
    if (is("vkMapMemory")) {
        return wrap(real.MapMemory, function, &mapMemory);
    }
    if (is("vkFlushMappedMemoryRanges")) {
        return wrap(real.FlushMappedMemoryRanges, function, &flush);
    }
    if (is("vkAllocateMemory")) {
        return wrap(real.AllocateMemory, function, &allocate);
    }
    if (is("vkCreateBuffer")) {
        return wrap(real.CreateBuffer, function, &createBuffer);
    }
    if (is("vkCmdCopyBuffer")) {
        return wrap(real.CmdCopyBuffer, function, &copyBuffer);
    }
    if (is("vkCmdFillBuffer")) {
        return wrap(real.CmdFillBuffer, function, &fillBuffer);
    }
    if (is("vkCmdBindPipeline")) {
        return wrap(real.CmdBindPipeline, function, &bindPipeline);
    }
    if (is("vkCmdDispatch")) {
        return wrap(real.CmdDispatch, function, &dispatch);
    }
    if (is("vkCmdDispatchIndirect")) {
        return wrap(real.CmdDispatchIndirect, function, &dispatchIndirect);
    }
    if (is("vkCmdPipelineBarrier")) {
        return wrap(real.CmdPipelineBarrier, function, &barrier);
    }
    if (is("vkCmdUpdateBuffer")) {
        return wrap(real.CmdUpdateBuffer, function, &updateBuffer);
    }
    if (is("vkCmdCopyBuffer2")) {
        return wrap(real.CmdCopyBuffer2, function, &copyBuffer2);
    }
    if (is("vkGetQueryPoolResults")) {
        return wrap(real.GetQueryPoolResults, function, &queryResults);
    }
    if (is("vkCmdCopyQueryPoolResults")) {
        return wrap(real.CmdCopyQueryPoolResults, function, &copyQueryResults);
    }
    if (is("vkInvalidateMappedMemoryRanges")) {
        return wrap(real.InvalidateMappedMemoryRanges, function, &invalidate);
    }
    return function;
}

} // namespace

WrappedVulkan& wrappedVulkan() {
    state = {};
    return state;
}

WrappedVulkan& currentWrappedVulkan() {
    return state;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL wrappedGetInstanceProcAddr(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction function = vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return wrap(real.GetDeviceProcAddr, function, &getDeviceProcAddr);
    }
    if (std::strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0 && function != nullptr) {
        return wrap(real.SetDebugUtilsObjectNameEXT, function, &setName);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties2") == 0) {
        return wrap(real.GetPhysicalDeviceProperties2, function, &properties);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceFeatures2") == 0) {
        return wrap(real.GetPhysicalDeviceFeatures2, function, &features);
    }
    return function;
}

} // namespace supple::test
