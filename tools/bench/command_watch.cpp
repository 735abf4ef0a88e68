#include "tools/bench/command_watch.h"

#include <cstring>
#include <utility>

namespace supple::bench {

struct WatchedRecording {
    CommandWatch* watch;
    // Set before the library can call what stands for them.
    PFN_vkGetDeviceProcAddr getDeviceProcAddr;
    PFN_vkCmdDispatch dispatch;
    PFN_vkCmdDispatchIndirect dispatchIndirect;
    PFN_vkCmdPipelineBarrier pipelineBarrier;
    PFN_vkCmdCopyBuffer copyBuffer;
    PFN_vkCmdCopyBuffer2 copyBuffer2;
    PFN_vkCmdFillBuffer fillBuffer;
    PFN_vkCmdUpdateBuffer updateBuffer;

    static WatchedRecording& now() {
        static WatchedRecording functions;
        return functions;
    }
    static void count(uint32_t WatchedCommands::*what) {
        if (now().watch != nullptr) {
            ++(now().watch->commands_.*what);
        }
    }

    static VKAPI_ATTR void VKAPI_CALL dispatched(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
        count(&WatchedCommands::dispatches);
        now().dispatch(commands, x, y, z);
    }
    static VKAPI_ATTR void VKAPI_CALL dispatchedIndirect(VkCommandBuffer commands, VkBuffer buffer,
                                                         VkDeviceSize offset) {
        count(&WatchedCommands::dispatches);
        now().dispatchIndirect(commands, buffer, offset);
    }
    static VKAPI_ATTR void VKAPI_CALL waited(VkCommandBuffer commands, VkPipelineStageFlags before,
                                             VkPipelineStageFlags after, VkDependencyFlags flags, uint32_t globalCount,
                                             const VkMemoryBarrier* global, uint32_t bufferCount,
                                             const VkBufferMemoryBarrier* buffers, uint32_t imageCount,
                                             const VkImageMemoryBarrier* images) {
        count(&WatchedCommands::barriers);
        now().pipelineBarrier(commands, before, after, flags, globalCount, global, bufferCount, buffers, imageCount,
                              images);
    }
    static VKAPI_ATTR void VKAPI_CALL copied(VkCommandBuffer commands, VkBuffer source, VkBuffer target, uint32_t count,
                                             const VkBufferCopy* regions) {
        WatchedRecording::count(&WatchedCommands::copies);
        now().copyBuffer(commands, source, target, count, regions);
    }
    static VKAPI_ATTR void VKAPI_CALL copied2(VkCommandBuffer commands, const VkCopyBufferInfo2* info) {
        count(&WatchedCommands::copies);
        now().copyBuffer2(commands, info);
    }
    static VKAPI_ATTR void VKAPI_CALL filled(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                             VkDeviceSize size, uint32_t data) {
        count(&WatchedCommands::copies);
        now().fillBuffer(commands, buffer, offset, size, data);
    }
    static VKAPI_ATTR void VKAPI_CALL updated(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                              VkDeviceSize size, const void* data) {
        count(&WatchedCommands::copies);
        now().updateBuffer(commands, buffer, offset, size, data);
    }

    /// The watched function of that name, which remembers the real one; else the real one.
    static PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction real) {
        if (real == nullptr) {
            return nullptr;
        }
        PFN_vkVoidFunction result = real;
        const auto watch = [&](const char* other, auto& kept, auto* own) {
            if (std::strcmp(name, other) == 0) {
                kept = reinterpret_cast<std::remove_reference_t<decltype(kept)>>(real);
                result = reinterpret_cast<PFN_vkVoidFunction>(own);
            }
        };
        watch("vkGetDeviceProcAddr", now().getDeviceProcAddr, &fromDevice);
        watch("vkCmdDispatch", now().dispatch, &dispatched);
        watch("vkCmdDispatchIndirect", now().dispatchIndirect, &dispatchedIndirect);
        watch("vkCmdPipelineBarrier", now().pipelineBarrier, &waited);
        watch("vkCmdCopyBuffer", now().copyBuffer, &copied);
        watch("vkCmdCopyBuffer2", now().copyBuffer2, &copied2);
        watch("vkCmdFillBuffer", now().fillBuffer, &filled);
        watch("vkCmdUpdateBuffer", now().updateBuffer, &updated);
        return result;
    }

    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fromDevice(VkDevice device, const char* name) {
        return wrap(name, now().getDeviceProcAddr(device, name));
    }
    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fromInstance(VkInstance instance, const char* name) {
        return wrap(name, vkGetInstanceProcAddr(instance, name));
    }
};

CommandWatch::CommandWatch() {
    WatchedRecording::now().watch = this;
}

CommandWatch::~CommandWatch() {
    WatchedRecording::now().watch = nullptr;
}

PFN_vkGetInstanceProcAddr CommandWatch::getInstanceProcAddr() {
    return &WatchedRecording::fromInstance;
}

WatchedCommands CommandWatch::take() {
    return std::exchange(commands_, {});
}

} // namespace supple::bench
