// Some floats per slot of a group, uploaded when they change.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"
#include "runtime/change_staging.h"
#include "shaders/shared/surface.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// Nothing is allocated after the constructor. A capacity of 0: there is no buffer.
template <size_t kFloats>
class SlotValues final : public gpu::FrameMember {
public:
    using Value = std::array<float, kFloats>;

    SlotValues() = default;
    /// All have the value `unset`.
    explicit SlotValues(uint32_t capacity, const Value& unset = {}) : unset_(unset), values_(capacity, unset) {
        markAll();
    }
    /// The names must be static.
    void plan(gpu::BufferPlan& device, const char* name, gpu::BufferPlan& staging, const char* stagingName,
              uint32_t framesInFlight);

    void set(uint32_t slot, const Value& value);
    void reset(uint32_t slot) { set(slot, unset_); }
    /// By slot.
    [[nodiscard]] const std::vector<Value>& values() const { return values_; }
    [[nodiscard]] const Value& unset() const { return unset_; }
    /// Takes the values of the first `count` slots of another set.
    void takeFrom(const SlotValues& other, uint32_t count);

    /// Uploads what has changed; with `all`, the first `slots` slots in any case. Returns the bytes.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame, bool all,
                              uint32_t slots);
    void cancelFrame(uint64_t frame) override;
    [[nodiscard]] const gpu::PlannedBuffer& buffer() const { return buffer_; }

private:
    /// The next frame uploads every slot.
    void markAll();

    Value unset_{};
    std::vector<Value> values_;
    uint32_t firstChanged_ = 0, endChanged_ = 0; ///< slots
    gpu::PlannedBuffer buffer_;
    ChangeStaging staging_;
    uint64_t frame_ = 0; ///< the last that uploaded
};

/// The host's own.
using UserData = SlotValues<4>;
/// What instances say of crease sets (shaders/shared/surface.h).
using CreaseAlphas = SlotValues<shared::kMaxCreaseSets>;

extern template class SlotValues<4>;
extern template class SlotValues<shared::kMaxCreaseSets>;

} // namespace supple::runtime
