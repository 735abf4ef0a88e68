#include "runtime/instance_slots.h"

#include "cage/character.h"

#include <algorithm>

namespace supple::runtime {

InstanceSlots::InstanceSlots(uint32_t capacity, uint32_t firstGeneration, uint32_t partCount)
    : slots_(capacity), hidden_(capacity, partCount) {
    for (Slot& slot : slots_) {
        slot.generation = firstGeneration;
    }
}

std::optional<uint32_t> InstanceSlots::create() {
    while (lowestFree_ < capacity() && slots_[lowestFree_].live) {
        ++lowestFree_;
    }
    if (lowestFree_ == capacity()) {
        return std::nullopt;
    }
    Slot& slot = slots_[lowestFree_];
    slot.live = true;
    slot.visible = true;
    slot.priority = 0;
    hidden_.reset(lowestFree_);
    forget(lowestFree_);
    end_ = std::max(end_, lowestFree_ + 1);
    return lowestFree_++;
}

void InstanceSlots::destroy(uint32_t slot) {
    slots_[slot].live = false;
    hidden_.reset(slot);
    note(true);
    ++slots_[slot].generation;
    if (slots_[slot].generation == 0) {
        slots_[slot].generation = 1; // 0 is never valid
    }
    lowestFree_ = std::min(lowestFree_, slot);
    while (end_ > 0 && !slots_[end_ - 1].live) {
        --end_;
    }
}

void InstanceSlots::takeOver(const InstanceSlots& other, std::span<const uint32_t> parts) {
    for (uint32_t s = 0; s < std::min(capacity(), other.capacity()); ++s) {
        slots_[s] = other.slots_[s];
        ++slots_[s].life;
        for (uint32_t part = 0; part < hidden_.partCount() && other.hidden_.hidesAny(s); ++part) {
            const uint32_t before = parts.empty() ? part : parts[part];
            if (before != cage::kNone && other.hidden_.hides(s, before)) {
                hidden_.set(s, part, true);
            }
        }
    }
    end_ = other.end_;
    lowestFree_ = std::min(other.lowestFree_, capacity());
    ++version_;
}

bool InstanceSlots::holds(uint32_t slot, uint32_t generation) const {
    return slot < capacity() && slots_[slot].live && slots_[slot].generation == generation;
}

bool InstanceSlots::isHidden(uint32_t part) const {
    for (uint32_t s = 0; s < end_; ++s) {
        if (shows(s) && hidden_.hides(s, part)) {
            return true;
        }
    }
    return false;
}

} // namespace supple::runtime
