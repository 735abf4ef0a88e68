// The buffers that a frame hands from the compute queue family to the one that draws.
#pragma once

#include "gpu/device.h"

#include <array>
#include <cstdint>
#include <span>

namespace supple::runtime {

class Transfers {
public:
    /// Null handles are passed over. Bytes from `offset` on change hands.
    void add(VkBuffer buffer, VkDeviceSize offset = 0) {
        if (buffer != VK_NULL_HANDLE) {
            VkBufferMemoryBarrier2& barrier = barriers_[count_++];
            barrier = gpu::bufferBarrier(buffer);
            barrier.offset = offset;
        }
    }
    [[nodiscard]] std::span<VkBufferMemoryBarrier2> barriers() { return {barriers_.data(), count_}; }

private:
    static constexpr size_t kMost = 74; ///< of a group with a surface of every scheme, and its view
    std::array<VkBufferMemoryBarrier2, kMost> barriers_{};
    size_t count_ = 0;
};

} // namespace supple::runtime
