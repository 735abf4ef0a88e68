// Host memory for data that is uploaded only when it changes.
#pragma once

#include "gpu/buffer_plan.h"

#include <cstddef>
#include <cstdint>

namespace supple::runtime {

/// Holds one copy of the data per frame in flight. Each change takes the next copy. So the newest copy stays whole even
/// if later frames upload it again, and a copy is overwritten only when no frame in flight can still read it.
class ChangeStaging {
public:
    void plan(gpu::BufferPlan& plan, const char* name, VkDeviceSize bytes, uint32_t framesInFlight) {
        bytes_ = bytes;
        copies_ = framesInFlight;
        buffer_ = plan.add({name, bytes * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    }
    /// The memory for a change: becomes the newest copy.
    [[nodiscard]] std::byte* next() {
        newest_ = (newest_ + 1) % copies_;
        return buffer_.mapped() + newest_ * bytes_;
    }
    /// Copies bytes of the newest copy to the device; returns their number.
    VkDeviceSize recordCopy(const gpu::Device& device, VkCommandBuffer commandBuffer, VkDeviceSize from,
                            VkBuffer target, VkDeviceSize to, VkDeviceSize bytes) const {
        if (bytes > 0) {
            const VkBufferCopy region{newest_ * bytes_ + from, to, bytes};
            device.vk.CmdCopyBuffer(commandBuffer, buffer_.buffer(), target, 1, &region);
        }
        return bytes;
    }

private:
    gpu::PlannedBuffer buffer_;
    VkDeviceSize bytes_ = 0;
    uint32_t copies_ = 1;
    VkDeviceSize newest_ = 0;
};

} // namespace supple::runtime
