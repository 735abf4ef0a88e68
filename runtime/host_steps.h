// Which steps of the grid of times instances run whose poses the host sets. Their time is that of frames.
#pragma once

#include "runtime/step_clock.h"
#include "shaders/shared/pose.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// A frame's steps are posed straight between the pose of the frame before and its own. Asking allocates nothing.
class HostSteps {
public:
    HostSteps() = default; ///< not taken
    /// `findsDown`: for each step, where down is.
    HostSteps(uint32_t capacity, bool findsDown);
    /// False: no instance runs steps, whatever this is told.
    [[nodiscard]] bool areTaken() const { return clock_.isTaken(); }

    void setPosed(uint32_t slot); ///< it has a pose
    void setBindPose(uint32_t slot);
    void settle(uint32_t slot) { clock_.settle(slot); }
    void settleAll() { clock_.settleAll(); }
    void jump(uint32_t slot) { clock_.jump(slot, time_); }
    void place(uint32_t slot) { clock_.place(slot, time_); }
    void setWind(const glm::dvec3& velocity) { clock_.setWind(velocity, time_); }

    /// A frame begins.
    void setTime(uint64_t frame, double time);
    /// Instances in the bind pose run none.
    [[nodiscard]] bool runs(uint32_t slot) const { return areTaken() && slots_[slot].isPosed; }
    struct Due {
        StepClock::Due steps;
        /// How far each is on the way from the pose of the frame before to that of this one; 1: this one's.
        std::array<float, shared::kMostDueSteps> ways{};
    };
    /// It has run them from now on.
    [[nodiscard]] Due take(uint32_t slot, const StepPlace& place);

    /// All that run steps in the frame have taken them.
    void endFrame() { clock_.endFrame(frame_); }

    /// What the frame's steps have done never happens. The slots that it concerns, until the next frame.
    std::span<const uint32_t> cancelFrame(uint64_t frame);
    /// The first `count` instances, of the same asset, with what a frame that is cancelled undoes. Once.
    void takeOver(const HostSteps& other, uint32_t count);
    void takeWind(const HostSteps& other) { clock_.takeWind(other.clock_); }

private:
    StepClock clock_;
    double time_ = 0.0, timeBefore_ = 0.0; ///< of the last frame, and of that before
    static constexpr uint64_t kNoFrame = ~uint64_t{0};
    uint64_t frame_ = kNoFrame;
    struct Slot {
        bool isPosed = false;
        double time = 0.0; ///< of the last frame that it was shown in
    };
    std::vector<Slot> slots_;
    // What the frame has taken, and the times of these slots before.
    std::vector<uint32_t> taken_;
    std::vector<double> undo_;
};

} // namespace supple::runtime
