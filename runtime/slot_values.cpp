#include "runtime/slot_values.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

template <size_t kFloats>
void SlotValues<kFloats>::plan(gpu::BufferPlan& device, const char* name, gpu::BufferPlan& staging,
                               const char* stagingName, uint32_t framesInFlight) {
    const VkDeviceSize bytes = values_.size() * sizeof(Value);
    buffer_ = device.add({name, bytes,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    staging_.plan(staging, stagingName, bytes, framesInFlight);
}

template <size_t kFloats>
void SlotValues<kFloats>::set(uint32_t slot, const Value& value) {
    // By bits: a NaN that stays is no change, and -0 is one.
    if (std::memcmp(&values_[slot], &value, sizeof(Value)) == 0) {
        return;
    }
    values_[slot] = value;
    const bool none = firstChanged_ == endChanged_;
    firstChanged_ = none ? slot : std::min(firstChanged_, slot);
    endChanged_ = none ? slot + 1 : std::max(endChanged_, slot + 1);
}

template <size_t kFloats>
void SlotValues<kFloats>::takeFrom(const SlotValues& other, uint32_t count) {
    std::copy_n(other.values_.begin(), count, values_.begin());
    markAll();
}

template <size_t kFloats>
void SlotValues<kFloats>::markAll() {
    firstChanged_ = 0;
    endChanged_ = static_cast<uint32_t>(values_.size());
}

template <size_t kFloats>
void SlotValues<kFloats>::cancelFrame(uint64_t frame) {
    if (frame_ == frame) {
        markAll();
    }
}

template <size_t kFloats>
VkDeviceSize SlotValues<kFloats>::recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame,
                                               bool all, uint32_t slots) {
    const uint32_t first = all ? 0 : firstChanged_, end = all ? std::max(slots, endChanged_) : endChanged_;
    firstChanged_ = endChanged_ = 0;
    if (first == end) {
        return 0;
    }
    frame_ = frame;
    const VkDeviceSize at = first * sizeof(Value), bytes = (end - first) * sizeof(Value);
    std::memcpy(staging_.next() + at, values_.data() + first, bytes);
    return staging_.recordCopy(device, commandBuffer, at, buffer_.buffer(), at, bytes);
}

template class SlotValues<4>;
template class SlotValues<shared::kMaxCreaseSets>;

} // namespace supple::runtime
