// Four floats of the host's own per slot of a group, uploaded when they change.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"
#include "runtime/change_staging.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// Nothing is allocated after the constructor.
class UserData final : public gpu::FrameMember {
public:
    using Value = std::array<float, 4>;

    UserData() = default;
    /// All zero.
    explicit UserData(uint32_t capacity) : values_(capacity) { markAll(); }
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight);

    void set(uint32_t slot, const Value& value);
    /// By slot.
    [[nodiscard]] const std::vector<Value>& values() const { return values_; }
    /// Takes the values of the first `count` slots of another set.
    void takeFrom(const UserData& other, uint32_t count);

    /// Uploads what has changed; with `all`, the first `slots` slots in any case. Returns the bytes.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame, bool all,
                              uint32_t slots);
    void cancelFrame(uint64_t frame) override;
    [[nodiscard]] const gpu::PlannedBuffer& buffer() const { return buffer_; }

private:
    /// The next frame uploads every slot.
    void markAll();

    std::vector<Value> values_;
    uint32_t firstChanged_ = 0, endChanged_ = 0; ///< slots
    gpu::PlannedBuffer buffer_;
    ChangeStaging staging_;
    uint64_t frame_ = 0; ///< the last that uploaded
};

} // namespace supple::runtime
