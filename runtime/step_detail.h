// Which instances are so small on the screen that nobody sees what steps do to them: there they run none.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// What steps do fades out where an instance gets small, and in again. Asking allocates nothing.
class StepDetail {
public:
    StepDetail() = default; ///< not taken
    explicit StepDetail(uint32_t capacity) : slots_(capacity) {}
    /// False: all instances run steps, however small.
    [[nodiscard]] bool isTaken() const { return !slots_.empty(); }

    // Pixels of the character's extent.
    static constexpr float kSleepsBelow = 24.0f, kWakesAbove = 30.0f;
    static constexpr double kFadeSeconds = 0.25; ///< 15 steps
    /// In each frame, by the group's time. An instance whose size was not known before does not fade.
    void setSize(uint32_t slot, float pixels, double time);
    /// How much is shown of what steps do: 0: they are not run, to 1.
    [[nodiscard]] float fade(uint32_t slot) const { return isTaken() ? slots_[slot].fade : 1.0f; }

    /// Another instance has the slot.
    void forget(uint32_t slot);
    void forgetAll() { std::fill(slots_.begin(), slots_.end(), Slot{}); }
    /// Takes over the first `count` slots.
    void takeOver(const StepDetail& other, uint32_t count);

private:
    struct Slot {
        bool isKnown = false, sleeps = false;
        float fade = 1.0f;
        double time = 0.0; ///< of `fade`
    };
    std::vector<Slot> slots_;
};

} // namespace supple::runtime
