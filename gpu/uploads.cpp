#include "gpu/uploads.h"

#include <algorithm>
#include <limits>

namespace supple::gpu {

Status Uploads::setBudget(const Device& device, VkDeviceSize bytes, uint32_t framesInFlight) {
    if (bytes == budget_) {
        return success();
    }
    if (bytes > std::numeric_limits<VkDeviceSize>::max() / framesInFlight) {
        return Error{ErrorCode::limit,
                     "a budget of " + std::to_string(bytes) + " bytes a frame: no memory has as many"};
    }
    BufferSet memory;
    if (bytes > 0) {
        const BufferRequest request{"supple upload budget", bytes * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
        Result<BufferSet> made = BufferSet::create(device, {&request, 1}, MemoryKind::upload);
        if (!made) {
            return made.error();
        }
        memory = std::move(*made);
    }
    if (bounded()) {
        before_.push_back({std::move(memory_), frame_});
    }
    memory_ = std::move(memory);
    budget_ = bytes;
    framesInFlight_ = framesInFlight;
    taken_ = 0;
    return success();
}

void Uploads::beginFrame(uint64_t frame, uint64_t completedFrame) {
    std::erase_if(before_, [&](const Before& old) { return old.lastFrame <= completedFrame; });
    frame_ = frame;
    taken_ = 0;
    frameBytes_ = 0;
    reserved_ = 0;
}

void Uploads::cancelFrame() {
    totalBytes_ -= frameBytes_;
    frameBytes_ = 0;
}

VkDeviceSize Uploads::left() const {
    if (!bounded()) {
        return std::numeric_limits<VkDeviceSize>::max();
    }
    return budget_ - std::min(budget_, std::max(frameBytes_, taken_) + reserved_);
}

Uploads::Piece Uploads::take(VkDeviceSize bytes) {
    const VkDeviceSize offset = frame_ % framesInFlight_ * budget_ + taken_;
    taken_ += bytes;
    return {memory_.buffer(0), offset, memory_.mapped(0) + offset};
}

void Uploads::count(VkDeviceSize bytes) {
    frameBytes_ += bytes;
    totalBytes_ += bytes;
}

void Uploads::countReserved(VkDeviceSize bytes) {
    reserved_ -= std::min(reserved_, bytes);
    count(bytes);
}

} // namespace supple::gpu
