#include "runtime/transfers.h"

namespace supple::runtime {

void Transfers::add(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    if (buffer != VK_NULL_HANDLE) {
        take(buffer, offset, size);
    }
}

void Releases::take(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    VkBufferMemoryBarrier& barrier = barriers_[count_];
    barrier = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER};
    barrier.srcAccessMask = after_.access;
    fill(barrier, buffer, offset, size);
    ++count_;
    if (count_ == kAtOnce) {
        flush();
    }
}

void Releases::flush() {
    if (count_ == 0) {
        return;
    }
    gpu::releaseBuffers(device_, commandBuffer_, {barriers_.data(), count_}, after_.stages);
    count_ = 0;
}

void Acquires::take(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    if (count_ < out_.size()) {
        VkBufferMemoryBarrier2& barrier = out_[count_];
        barrier = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
        barrier.dstStageMask = use_.stages;
        barrier.dstAccessMask = use_.access;
        fill(barrier, buffer, offset, size);
    }
    ++count_;
}

} // namespace supple::runtime
