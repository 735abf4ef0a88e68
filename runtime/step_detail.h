// How much of secondary motion instances have by their size on the screen: what nobody sees is not simulated.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// An instance has one of four levels of detail. From full to light, cloths go on from where they are by a spring
/// instead of their constraints. Below, what is soft fades out and sleeps, then springs do. Asking allocates nothing.
class StepDetail {
public:
    enum class Level : uint8_t { full, light, springs, none };

    StepDetail() = default; ///< not taken
    explicit StepDetail(uint32_t capacity) : slots_(capacity) {}
    /// False: all instances have full detail, however small.
    [[nodiscard]] bool isTaken() const { return !slots_.empty(); }

    /// Pixels of the character's extent below which an instance goes on to the next level, and above which it comes
    /// back from there.
    struct Threshold {
        float below, above;
    };
    static constexpr std::array<Threshold, 3> kThresholds = {{{64.0f, 80.0f}, {48.0f, 60.0f}, {24.0f, 30.0f}}};
    static constexpr double kFadeSeconds = 0.25; ///< 15 steps
    /// In each frame, by the group's time. An instance whose size was not known before does not fade.
    void setSize(uint32_t slot, float pixels, double time);

    /// How much is shown of what steps do, from 0: these are not run, to 1.
    struct Shown {
        float springs = 1.0f, soft = 1.0f;
        bool lightCloths = false;
    };
    [[nodiscard]] Shown shown(uint32_t slot) const { return isTaken() ? slots_[slot].shown : Shown{}; }

    /// Another instance has the slot.
    void forget(uint32_t slot);
    void forgetAll() { std::fill(slots_.begin(), slots_.end(), Slot{}); }
    /// Takes over the first `count` slots.
    void takeOver(const StepDetail& other, uint32_t count);

private:
    struct Slot {
        bool isKnown = false;
        Level level = Level::full;
        Shown shown;
        double time = 0.0; ///< of `shown`
    };
    std::vector<Slot> slots_;
};

} // namespace supple::runtime
