// The bounds of a group's instances, copied to where the host reads them frames later.
#pragma once

#include "base/result.h"
#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"
#include "runtime/instance_slots.h"
#include "runtime/instance_windows.h"
#include "supple/supple.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace supple::runtime {

/// A ring of copies, one more than there are frames in flight: whatever is recorded, the newest completed copy stays.
/// Recording and reading allocate nothing.
class BoundsReadback final : public gpu::FrameMember {
public:
    BoundsReadback(const gpu::Device& device, uint32_t capacity, uint32_t framesInFlight);
    [[nodiscard]] Status create();
    [[nodiscard]] gpu::MemoryUse memoryUse() const { return buffer_.use(); }

    /// Behind the bounds of the instances that are listed now, once they may be copied. `bounds`: by slot.
    void record(VkCommandBuffer commandBuffer, uint64_t frame, VkBuffer bounds, const InstanceSlots& slots);
    void beginFrame(uint64_t completedFrame) override { completedFrame_ = completedFrame; }
    void cancelFrame(uint64_t frame) override;

    struct Box {
        SuppleBounds bounds{};
        uint64_t frame = 0;
    };
    /// The box in the newest completed copy, if the instance was listed in it.
    [[nodiscard]] std::optional<Box> read(uint32_t slot, uint32_t generation) const;

private:
    struct Copy {
        uint64_t frame = 0;                ///< 0: none
        std::vector<uint32_t> generations; ///< by slot; 0: it listed no instance
    };
    const gpu::Device* device_;
    VkDeviceSize copyBytes_;
    gpu::BufferSet buffer_;
    std::vector<Copy> copies_;
    size_t next_ = 0; ///< the oldest
    uint64_t completedFrame_ = 0;
};

} // namespace supple::runtime
