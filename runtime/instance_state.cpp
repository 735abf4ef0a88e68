#include "runtime/instance_state.h"
#include "gpu/barriers.h"

#include <algorithm>

namespace supple::runtime {

Status InstanceState::create(const gpu::Device& device, uint32_t capacity, VkDeviceSize bytes, const char* name) {
    const gpu::BufferRequest request{name, capacity * bytes,
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                     gpu::MemoryPurpose::cages};
    Result<gpu::BufferSet> set = gpu::BufferSet::create(device, {&request, 1}, gpu::MemoryKind::deviceLocal);
    if (!set) {
        return set.error();
    }
    set_ = std::make_shared<gpu::BufferSet>(std::move(*set));
    device_ = &device;
    bytes_ = bytes;
    capacity_ = capacity;
    return success();
}

void InstanceState::takeOver(InstanceState& other, uint32_t count) {
    if (other.bytes_ != bytes_) {
        return;
    }
    // If nothing was recorded since the other one took over, what it takes is still where it was.
    moved_ = other.start_.due() ? other.moved_ : other.set_;
    movedCount_ = other.start_.due() ? std::min(count, other.movedCount_) : count;
    source_ = other.start_;
    sourceMoved_ = other.moved_;
    sourceCount_ = std::min(count, other.movedCount_);
}

void InstanceState::recordMove(VkCommandBuffer commandBuffer) const {
    // The entry barrier of a frame lets transfers write, but not read what stages wrote.
    gpu::memoryBarrier(*device_, commandBuffer,
                       {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
    const VkBufferCopy region{0, 0, movedCount_ * bytes_};
    device_->vk.CmdCopyBuffer(commandBuffer, moved_->buffer(0), buffer(), 1, &region);
}

VkDeviceSize InstanceState::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame,
                                         std::span<const uint32_t> newSlots) {
    if (set_ == nullptr) {
        return 0;
    }
    const auto zero = [&](uint32_t first, uint32_t count) {
        if (count > 0) {
            device_->vk.CmdFillBuffer(commandBuffer, buffer(), first * bytes_, count * bytes_, 0);
        }
        return count * bytes_;
    };
    VkDeviceSize written = 0;
    std::span<const uint32_t> slots = newSlots;
    if (start_.due()) {
        start_.record(frame);
        if (moved_ != nullptr && movedCount_ > 0) {
            recordMove(commandBuffer);
            written += movedCount_ * bytes_;
        }
        written += zero(movedCount_, capacity_ - movedCount_);
        // Some of those that have moved may be new since then.
        slots =
            slots.first(static_cast<size_t>(std::lower_bound(slots.begin(), slots.end(), movedCount_) - slots.begin()));
        if (!slots.empty()) {
            gpu::memoryBarrier(*device_, commandBuffer,
                               {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
        }
    }
    // Slots side by side at once.
    for (size_t first = 0, end = 0; first < slots.size(); first = end) {
        while (end < slots.size() && slots[end] - slots[first] == end - first) {
            ++end;
        }
        written += zero(slots[first], static_cast<uint32_t>(end - first));
    }
    return written;
}

void InstanceState::beginFrame(uint64_t completedFrame) {
    if (moved_ != nullptr && start_.recordedBy(completedFrame)) {
        moved_ = nullptr;
        movedCount_ = 0;
    }
    if (source_.recordedBy(completedFrame)) {
        sourceMoved_ = nullptr;
    }
}

void InstanceState::cancelFrame(uint64_t frame) {
    // All instances are new in the frame after. A frame that moved nothing has left everything where it was.
    start_.cancelFrame(frame);
    if (moved_ != nullptr && source_.recordedIn(frame)) {
        source_.cancelFrame(frame);
        moved_ = sourceMoved_;
        movedCount_ = sourceCount_;
    }
}

} // namespace supple::runtime
