// Buffers that several owners request and that one allocation holds.
#pragma once

#include "gpu/memory.h"

#include <vector>

namespace supple::gpu {

/// One buffer of a plan. Its handle and size are valid once the plan has been carried out. A request of 0 bytes gives
/// no buffer: the handle is null and the size 0.
class PlannedBuffer {
public:
    PlannedBuffer() = default;
    PlannedBuffer(const BufferSet& set, size_t index) : set_(&set), index_(index) {}

    [[nodiscard]] VkBuffer buffer() const { return set_ != nullptr ? set_->buffer(index_) : VK_NULL_HANDLE; }
    [[nodiscard]] VkDeviceSize size() const { return set_ != nullptr ? set_->size(index_) : 0; }
    /// Of upload memory only.
    [[nodiscard]] std::byte* mapped() const { return set_->mapped(index_); }

private:
    const BufferSet* set_ = nullptr;
    size_t index_ = 0;
};

/// Owners add what they need; then create() makes all buffers at once.
class BufferPlan {
public:
    /// `target` gets the buffers. It must stay where it is as long as planned buffers are used.
    explicit BufferPlan(BufferSet& target) : target_(&target) {}

    [[nodiscard]] PlannedBuffer add(const BufferRequest& request) {
        requests_.push_back(request);
        return {*target_, requests_.size() - 1};
    }
    /// What all that is added until now takes, each buffer at a multiple of `alignment`.
    [[nodiscard]] VkDeviceSize bytes(VkDeviceSize alignment) const {
        VkDeviceSize sum = 0;
        for (const BufferRequest& request : requests_) {
            sum += roundUp(request.size, alignment);
        }
        return sum;
    }
    /// Makes what is added until now. May be called once more where the target has lost its buffers.
    [[nodiscard]] Status create(const Device& device, MemoryKind kind) const {
        Result<BufferSet> made = BufferSet::create(device, requests_, kind);
        if (!made) {
            return made.error();
        }
        *target_ = std::move(*made);
        return success();
    }

private:
    BufferSet* target_;
    std::vector<BufferRequest> requests_;
};

} // namespace supple::gpu
