// A command buffer of a thread's own.
#pragma once

#include "host/device.h"

#include <cstdlib>

namespace supple::test {

/// Its Vulkan calls are made past Supple's function table, so no test makes them fail. Where the driver refuses them,
/// the process ends.
class Recorder {
public:
    explicit Recorder(const host::Device& device) : device_(device.handle()) {
        const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                               device.queueFamily()};
        need(vkCreateCommandPool(device_, &poolInfo, nullptr, &pool_));
        VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = pool_;
        info.commandBufferCount = 1;
        need(vkAllocateCommandBuffers(device_, &info, &commands_));
    }
    ~Recorder() { vkDestroyCommandPool(device_, pool_, nullptr); }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Nothing recorded before may be pending.
    VkCommandBuffer begin() {
        need(vkResetCommandPool(device_, pool_, 0));
        VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        need(vkBeginCommandBuffer(commands_, &info));
        return commands_;
    }
    void end() { need(vkEndCommandBuffer(commands_)); }
    [[nodiscard]] VkCommandBuffer handle() const { return commands_; }

private:
    static void need(VkResult result) {
        if (result != VK_SUCCESS) {
            std::abort();
        }
    }

    VkDevice device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

} // namespace supple::test
