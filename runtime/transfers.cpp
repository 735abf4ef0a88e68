#include "runtime/transfers.h"

namespace supple::runtime {

void Transfers::add(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    if (buffer == VK_NULL_HANDLE) {
        return;
    }
    VkBufferMemoryBarrier2 barrier = gpu::bufferBarrier(buffer);
    barrier.offset = offset;
    barrier.size = size;
    barrier.srcQueueFamilyIndex = families_.compute;
    barrier.dstQueueFamilyIndex = families_.draw;
    take(barrier);
}

void Releases::take(const VkBufferMemoryBarrier2& barrier) {
    barriers_[count_] = barrier;
    barriers_[count_].srcStageMask = after_.stages;
    barriers_[count_].srcAccessMask = after_.access;
    ++count_;
    if (count_ == kAtOnce) {
        flush();
    }
}

void Releases::flush() {
    if (count_ == 0) {
        return;
    }
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.bufferMemoryBarrierCount = count_;
    info.pBufferMemoryBarriers = barriers_.data();
    device_.vk.CmdPipelineBarrier2(commandBuffer_, &info);
    count_ = 0;
}

void Acquires::take(const VkBufferMemoryBarrier2& barrier) {
    if (count_ < out_.size()) {
        out_[count_] = barrier;
        out_[count_].dstStageMask = use_.stages;
        out_[count_].dstAccessMask = use_.access;
    }
    ++count_;
}

} // namespace supple::runtime
