#include "runtime/culling/bounds_readback.h"

#include "runtime/culling/bounds_kernels.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

BoundsReadback::BoundsReadback(const gpu::Device& device, uint32_t capacity, uint32_t framesInFlight)
    : device_(&device), copyBytes_(capacity * kBoundsBytes), copies_(framesInFlight + size_t{1}) {
    for (Copy& copy : copies_) {
        copy.generations.resize(capacity);
    }
}

Status BoundsReadback::create() {
    const gpu::BufferRequest request{"supple bounds, read back", copyBytes_ * copies_.size(),
                                     VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    Result<gpu::BufferSet> buffer = gpu::BufferSet::create(*device_, {&request, 1}, gpu::MemoryKind::readback);
    if (!buffer) {
        return buffer.error();
    }
    buffer_ = std::move(*buffer);
    return success();
}

void BoundsReadback::record(VkCommandBuffer commandBuffer, uint64_t frame, VkBuffer bounds,
                            const InstanceSlots& slots) {
    Copy& copy = copies_[next_];
    copy.frame = frame;
    const uint32_t end = slots.end();
    for (uint32_t slot = 0; slot < copy.generations.size(); ++slot) {
        copy.generations[slot] = slot < end && slots.shows(slot) ? slots.generation(slot) : 0;
    }
    if (end > 0) {
        const VkBufferCopy region{0, next_ * copyBytes_, end * kBoundsBytes};
        device_->vk.CmdCopyBuffer(commandBuffer, bounds, buffer_.buffer(0), 1, &region);
    }
    next_ = (next_ + 1) % copies_.size();
}

void BoundsReadback::cancelFrame(uint64_t frame) {
    for (Copy& copy : copies_) {
        copy.frame = copy.frame == frame ? 0 : copy.frame;
    }
}

std::optional<BoundsReadback::Box> BoundsReadback::read(uint32_t slot, uint32_t generation) const {
    const Copy* newest = nullptr;
    for (const Copy& copy : copies_) {
        const bool completed = copy.frame != 0 && copy.frame <= completedFrame_;
        newest = completed && (newest == nullptr || copy.frame > newest->frame) ? &copy : newest;
    }
    if (newest == nullptr || newest->generations[slot] != generation) {
        return std::nullopt;
    }
    const auto place = static_cast<VkDeviceSize>(newest - copies_.data());
    float corners[8];
    std::memcpy(corners, buffer_.mapped(0) + place * copyBytes_ + slot * kBoundsBytes, sizeof(corners));
    Box box;
    box.frame = newest->frame;
    std::copy_n(corners, 3, box.bounds.min);
    std::copy_n(corners + 4, 3, box.bounds.max);
    return box;
}

} // namespace supple::runtime
