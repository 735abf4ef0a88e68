#include "runtime/instance_slots.h"

#include "shaders/shared/instances.h"

#include <algorithm>

namespace supple::runtime {

InstanceSlots::InstanceSlots(uint32_t capacity, uint32_t firstGeneration, std::vector<PartPatches> partPatches)
    : slots_(capacity), hidden_(capacity, std::move(partPatches)) {
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
    slot.evaluated = false;
    slot.priority = 0;
    hidden_.reset(lowestFree_);
    changed_ = true;
    end_ = std::max(end_, lowestFree_ + 1);
    return lowestFree_++;
}

void InstanceSlots::destroy(uint32_t slot) {
    slots_[slot].live = false;
    hidden_.reset(slot);
    changed_ = true;
    ++slots_[slot].generation;
    if (slots_[slot].generation == 0) {
        slots_[slot].generation = 1; // 0 is never valid
    }
    lowestFree_ = std::min(lowestFree_, slot);
    while (end_ > 0 && !slots_[end_ - 1].live) {
        --end_;
    }
}

bool InstanceSlots::holds(uint32_t slot, uint32_t generation) const {
    return slot < capacity() && slots_[slot].live && slots_[slot].generation == generation;
}

void InstanceSlots::forgetAll() {
    changed_ = true;
    for (Slot& slot : slots_) {
        slot.evaluated = false;
    }
}

void InstanceSlots::listForCulling(std::span<uint32_t> all) const {
    uint32_t count = 0;
    for (uint32_t s = 0; s < end_; ++s) {
        if (slots_[s].live && slots_[s].visible) {
            all[count++] = s | slots_[s].priority << shared::kInstancePriorityShift |
                           (slots_[s].evaluated ? 0 : shared::kInstanceIsNew) |
                           (hidden_.hidesAny(s) ? shared::kInstanceHidesParts : 0);
        }
    }
}

bool InstanceSlots::isHidden(uint32_t part) const {
    for (uint32_t s = 0; s < end_; ++s) {
        if (slots_[s].live && slots_[s].visible && hidden_.hides(s, part)) {
            return true;
        }
    }
    return false;
}

uint32_t InstanceSlots::listPart(uint32_t part, std::span<uint32_t> slots) const {
    uint32_t count = 0;
    for (uint32_t s = 0; s < end_; ++s) {
        if (slots_[s].live && slots_[s].visible && !hidden_.hides(s, part)) {
            slots[count++] = s;
        }
    }
    return count;
}

uint32_t InstanceSlots::list(std::span<uint32_t> all, std::span<uint32_t> byWindow, uint32_t windowSize,
                             std::span<Listed> windows) {
    uint32_t visible = 0;
    priorities_ = 0;
    changed_ = false;
    for (size_t w = 0; w < windows.size(); ++w) {
        const uint32_t first = static_cast<uint32_t>(w) * windowSize;
        const uint32_t last = std::min(first + windowSize, end_);
        Listed listed;
        for (const bool past : {true, false}) {
            for (uint32_t s = first; s < last; ++s) {
                if (slots_[s].live && slots_[s].visible && slots_[s].evaluated == past) {
                    byWindow[first + listed.count++] = (s - first) |
                                                       slots_[s].priority << shared::kInstancePriorityShift |
                                                       (past ? 0 : shared::kInstanceIsNew);
                    priorities_ |= 1u << slots_[s].priority;
                }
            }
            if (past) {
                listed.withPast = listed.count;
            }
        }
        windows[w] = listed;
        changed_ = changed_ || listed.withPast < listed.count;
    }
    for (uint32_t s = 0; s < end_; ++s) {
        slots_[s].evaluated = slots_[s].live && slots_[s].visible;
        if (slots_[s].evaluated) {
            if (!all.empty()) {
                all[visible] = s;
            }
            ++visible;
        }
    }
    return visible;
}

} // namespace supple::runtime
