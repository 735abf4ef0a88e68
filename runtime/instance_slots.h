// Which slots of a group hold an instance, and which of those are seen.
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
    /// Generations begin at `firstGeneration` (not 0).
    InstanceSlots(uint32_t capacity, uint32_t firstGeneration, uint32_t partCount);

    /// The lowest free slot, now taken and visible with all parts; nothing when all are.
    [[nodiscard]] std::optional<uint32_t> create();
    void destroy(uint32_t slot);
    /// Takes the instances of other slots over, which have no more than capacity(), with their generations. They begin
    /// anew. `parts`: by part here, the part there or kNone; empty: the same.
    void takeOver(const InstanceSlots& other, std::span<const uint32_t> parts);
    [[nodiscard]] bool holds(uint32_t slot, uint32_t generation) const;
    [[nodiscard]] uint32_t generation(uint32_t slot) const { return slots_[slot].generation; }

    void setVisible(uint32_t slot, bool visible) {
        note(slots_[slot].visible != visible);
        slots_[slot].visible = visible;
    }
    void setPartVisible(uint32_t slot, uint32_t part, bool visible) { note(hidden_.set(slot, part, !visible)); }
    [[nodiscard]] const HiddenParts& hiddenParts() const { return hidden_; }
    /// Groups of a view: 0..kPriorityCount - 1; 0 when created.
    void setPriority(uint32_t slot, uint32_t priority) {
        note(slots_[slot].priority != priority);
        slots_[slot].priority = priority;
    }
    [[nodiscard]] uint32_t priority(uint32_t slot) const { return slots_[slot].priority; }
    /// The next frame sees the instance as new.
    void forget(uint32_t slot) {
        note(true);
        ++slots_[slot].life;
        ++slots_[slot].birth;
    }

    [[nodiscard]] uint32_t capacity() const { return static_cast<uint32_t>(slots_.size()); }
    /// One past the highest slot in use.
    [[nodiscard]] uint32_t end() const { return end_; }
    /// Whether the slot holds a visible instance.
    [[nodiscard]] bool shows(uint32_t slot) const { return slots_[slot].live && slots_[slot].visible; }
    /// Rises when an instance begins anew in the slot: created or forgotten. What a list remembers of another life is
    /// not the instance's past. Never 0.
    [[nodiscard]] uint32_t life(uint32_t slot) const { return slots_[slot].life; }
    /// The same, but it stays when the instance moves to other slots by takeOver(): for what moves with it.
    [[nodiscard]] uint32_t birth(uint32_t slot) const { return slots_[slot].birth; }
    /// Rises with every change of what lists of instances hold.
    [[nodiscard]] uint64_t version() const { return version_; }
    /// Whether a visible instance hides the part.
    [[nodiscard]] bool isHidden(uint32_t part) const;

private:
    struct Slot {
        uint32_t generation = 1;
        uint32_t life = 1, birth = 1;
        bool live = false;
        bool visible = true;
        uint32_t priority = 0;
    };
    void note(bool change) { version_ += change ? 1 : 0; }

    std::vector<Slot> slots_;
    HiddenParts hidden_;
    uint32_t end_ = 0;
    uint32_t lowestFree_ = 0; ///< none is free below
    uint64_t version_ = 1;
};

} // namespace supple::runtime
