// Which slots of a group hold an instance, which of those are seen, and which have a past.
#pragma once

#include "runtime/hidden_parts.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// Slots below the capacity, each with a generation that rises when its instance is destroyed.
class InstanceSlots {
public:
    InstanceSlots() = default;
    /// Generations begin at `firstGeneration` (not 0). `partPatches`: how many patches every part has.
    InstanceSlots(uint32_t capacity, uint32_t firstGeneration, std::vector<PartPatches> partPatches = {});

    /// The lowest free slot, now taken and visible with all parts; nothing when all are.
    [[nodiscard]] std::optional<uint32_t> create();
    void destroy(uint32_t slot);
    [[nodiscard]] bool holds(uint32_t slot, uint32_t generation) const;
    [[nodiscard]] uint32_t generation(uint32_t slot) const { return slots_[slot].generation; }

    void setVisible(uint32_t slot, bool visible) {
        changed_ = changed_ || slots_[slot].visible != visible;
        slots_[slot].visible = visible;
    }
    void setPartVisible(uint32_t slot, uint32_t part, bool visible) {
        const bool changes = hidden_.set(slot, part, !visible);
        changed_ = changed_ || changes;
    }
    [[nodiscard]] const HiddenParts& hiddenParts() const { return hidden_; }
    /// Groups of a view: 0..kPriorityCount - 1; 0 when created.
    void setPriority(uint32_t slot, uint32_t priority) {
        changed_ = changed_ || slots_[slot].priority != priority;
        slots_[slot].priority = priority;
    }
    /// Bits of those that the last listed instances have.
    [[nodiscard]] uint32_t priorities() const { return priorities_; }
    /// The next frame sees the instance as new.
    void forget(uint32_t slot) {
        changed_ = changed_ || slots_[slot].evaluated;
        slots_[slot].evaluated = false;
    }
    void forgetAll();

    [[nodiscard]] uint32_t capacity() const { return static_cast<uint32_t>(slots_.size()); }
    /// One past the highest slot in use.
    [[nodiscard]] uint32_t end() const { return end_; }

    /// A window of slots in the frame's list: first those that were evaluated in the frame before, then the new ones.
    struct Listed {
        uint32_t count = 0;
        uint32_t withPast = 0;
    };
    /// Whether list() would give anything else than the last time: in the frame after a change too, when what was new
    /// has come to have a past.
    [[nodiscard]] bool changed() const { return changed_; }
    /// Lists the frame's instances and notes them as evaluated. `all`: the visible slots, rising; it may be empty if
    /// nobody wants them. `byWindow`: as
    /// shaders/shared/instances.h has them, slot numbers from their window's first on, the entries of window w from
    /// w * windowSize on; `windows` is filled in.
    /// The spans hold capacity() entries. Returns the visible.
    uint32_t list(std::span<uint32_t> all, std::span<uint32_t> byWindow, uint32_t windowSize,
                  std::span<Listed> windows);
    /// `all` with flags, as culling takes it (shaders/shared/bounds.h); to be called before list().
    void listForCulling(std::span<uint32_t> all) const;
    /// Behind list(): whether it has listed the slot's instance.
    [[nodiscard]] bool isListed(uint32_t slot) const { return slots_[slot].evaluated; }
    /// Whether a visible instance hides the part.
    [[nodiscard]] bool isHidden(uint32_t part) const;
    /// Behind list(): the visible slots that show the part, rising. Returns how many there are.
    uint32_t listPart(uint32_t part, std::span<uint32_t> slots) const;

private:
    struct Slot {
        uint32_t generation = 1;
        bool live = false;
        bool visible = true;
        bool evaluated = false; ///< in the group's last recorded frame
        uint32_t priority = 0;
    };
    std::vector<Slot> slots_;
    HiddenParts hidden_;
    uint32_t end_ = 0;
    uint32_t lowestFree_ = 0; ///< none is free below
    uint32_t priorities_ = 1;
    bool changed_ = true;
};

} // namespace supple::runtime
