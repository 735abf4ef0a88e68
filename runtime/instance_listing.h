// Which instances the passes of a group work on in a frame: the list on the device, its windows, and which instances
// have a past.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/change_staging.h"
#include "runtime/instance_slots.h"
#include "runtime/instance_windows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

class OutOfSight;

class InstanceListing {
public:
    InstanceListing() = default;
    /// `parts`: those of which the host lists the instances that show them. They must outlive this. Null: it lists
    /// none.
    InstanceListing(InstanceWindows windows, const DrawnParts* parts);
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight);

    [[nodiscard]] const InstanceWindows& windows() const { return windows_; }
    [[nodiscard]] const gpu::PlannedBuffer& buffer() const { return list_; }
    /// What passes read of the list: capacity entries for draws, then as many by window.
    [[nodiscard]] VkDeviceSize passBytes() const { return 2 * VkDeviceSize{windows_.capacity} * sizeof(uint32_t); }
    /// What draws read: all of it if the host lists parts.
    [[nodiscard]] uint32_t drawnEntries() const {
        return windows_.parts.empty() ? windows_.capacity : static_cast<uint32_t>(list_.size() / sizeof(uint32_t));
    }
    /// Bits of the priorities that the last listed instances have.
    [[nodiscard]] uint32_t priorities() const { return priorities_; }

    /// Whether list() would give anything else than the last time: in the frame after a change too, when what was new
    /// has come to have a past.
    [[nodiscard]] bool changed(const InstanceSlots& slots) const {
        return settles_ || slots.version() != listedVersion_;
    }
    /// Where a frame's instances are listed: for draws, by window, for every part.
    struct Lists {
        std::span<uint32_t> all, byWindow, byPart;
    };
    /// The memory for a change.
    [[nodiscard]] Lists next();
    /// Lists the frame's instances by window, as shaders/shared/instances.h has them, and notes them as evaluated.
    void list(const InstanceSlots& slots, std::span<uint32_t> byWindow);
    /// Behind list(): what draws of the host's read.
    void listDrawn(const InstanceSlots& slots, const Lists& lists);
    /// Before list(): the visible slots with flags, as culling takes them (shaders/shared/bounds.h).
    void listForCulling(const InstanceSlots& slots, std::span<uint32_t> all) const;
    /// What the next lists leave out; null: nothing. It must outlive them.
    void leaveOut(const OutOfSight* unseen) { unseen_ = unseen; }
    /// The next lists leave out all instances, or none of them.
    void leaveOutAll(bool all) {
        leavesOutAll_ = all;
        settles_ = true;
    }
    [[nodiscard]] bool leavesOutAll() const { return leavesOutAll_; }
    /// What the next lists leave out is other than before.
    void noteUnseenChanged() { settles_ = true; }
    /// Whether the frame works on the instance in the slot.
    [[nodiscard]] bool worksOn(const InstanceSlots& slots, uint32_t slot) const;
    /// Every instance is new to the next list().
    void forgetAll();

    /// Copies the newest lists to the device; the bytes.
    VkDeviceSize recordCopies(const gpu::Device& device, VkCommandBuffer commandBuffer) const;

private:
    /// How many parts have lists of the host's.
    [[nodiscard]] uint32_t partCount() const { return parts_ != nullptr ? parts_->count() : 0; }
    /// The visible slots of a draw window that show the part, rising; how many.
    [[nodiscard]] uint32_t listPart(const InstanceSlots& slots, uint32_t part, uint32_t window,
                                    std::span<uint32_t> out) const;
    [[nodiscard]] bool hasPast(const InstanceSlots& slots, uint32_t slot) const {
        return lives_[slot] == slots.life(slot);
    }

    InstanceWindows windows_;
    const DrawnParts* parts_ = nullptr;
    const OutOfSight* unseen_ = nullptr;
    bool leavesOutAll_ = false;
    std::vector<uint32_t> lives_; ///< by slot: InstanceSlots::life of what was evaluated last; 0: nothing
    uint64_t listedVersion_ = 0;
    bool settles_ = true; ///< the next list differs though nothing changes
    uint32_t priorities_ = 1;
    gpu::PlannedBuffer list_;
    ChangeStaging staging_;
};

} // namespace supple::runtime
