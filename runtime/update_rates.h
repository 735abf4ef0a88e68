// How often the instances of a group are posed: every so many steps of a grid of times, between which they go straight.
#pragma once

#include "shaders/shared/pose.h"
#include "skinning/update_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace supple::runtime {

/// The times between whose poses an instance goes straight.
struct PoseSpan {
    double begin = 0.0, end = 0.0;

    /// Posed at the group's time itself.
    [[nodiscard]] bool isExact() const { return begin == end; }
    /// How far a time within it has come: 0 to 1.
    [[nodiscard]] float partAt(double time) const { return static_cast<float>((time - begin) / (end - begin)); }
};
[[nodiscard]] constexpr PoseSpan exactSpan(double time) {
    return {time, time};
}
/// A time lies between grid times (k * interval - slot mod interval) / 60 s: the same for every frame rate, while
/// instances of neighboring slots come to them in turns.
[[nodiscard]] PoseSpan gridSpan(double time, uint32_t slot, uint32_t interval);

/// How far T goes from one recording to the next.
class TimeSteps {
public:
    void take(double time) {
        last_ = {last_[1], std::isnan(recorded_) ? 0.0 : std::abs(time - recorded_)};
        recorded_ = time;
    }
    /// In steps of the grid: intervals below it pose nearly as often as every frame does, and go straight besides.
    [[nodiscard]] double leastInterval() const {
        constexpr double kFrames = 1.75; // two, of frames that do not come quite evenly
        // A single jump is no frame rate.
        return kFrames * shared::kUpdateSteps * std::min(last_[0], last_[1]);
    }

private:
    double recorded_ = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 2> last_{}; ///< seconds
};

/// What an instance is posed by: how often, or what that depends on.
struct UpdateCourse {
    static constexpr std::array<uint32_t, 3> kIntervals = {2, 4, 8};

    uint32_t asked = 0;            ///< steps of the grid from pose to pose; 0: by the size on the screen
    std::array<float, 3> errors{}; ///< of kIntervals, in extents

    friend bool operator==(const UpdateCourse&, const UpdateCourse&) = default;
};

/// Asking and choosing allocate nothing.
class UpdateRates {
public:
    UpdateRates() = default; ///< not taken
    explicit UpdateRates(uint32_t capacity) : slots_(capacity) {}
    /// False: all instances are posed at the group's time, ever. Only reset(), forget(), asked() and interval() may be
    /// called then.
    [[nodiscard]] bool areTaken() const { return !slots_.empty(); }

    /// A new instance has the slot.
    void reset(uint32_t slot);
    /// What the slot plays has changed. What was chosen for a course stays while the course does.
    void set(uint32_t slot, const UpdateCourse& course);
    /// The interval that was asked for.
    [[nodiscard]] uint32_t asked(uint32_t slot) const { return areTaken() ? slots_[slot].course.asked : 0; }
    /// Its ends are no longer what it plays.
    void forget(uint32_t slot);
    void forgetAll();

    /// Where asked() is 0: the coarsest interval whose error is at most a pixel. It gets coarser only once the
    /// error is less by kHysteresis.
    /// `pixels`: what the character's extent is on the screen, at most. `least`: in steps; shorter intervals save
    /// nothing, and are not chosen.
    void choose(uint32_t slot, float pixels, double least = 0.0);
    static constexpr float kHysteresis = 1.5f;
    /// The next choices do not depend on what was chosen before.
    void forgetChoices();
    /// In steps; 1: it is posed at the group's time.
    [[nodiscard]] uint32_t interval(uint32_t slot) const;

    /// Whether the device has both ends.
    [[nodiscard]] bool holds(uint32_t slot, const PoseSpan& span) const;
    /// The ends that the device lacks, which it has from now on.
    struct Ends {
        uint32_t earlier = 1; ///< number of the span's begin, 1 or 2
        struct Due {
            uint32_t end = 0; ///< its number
            double time = 0.0;
        };
        std::array<Due, 2> due;
        uint32_t dueCount = 0;
    };
    [[nodiscard]] Ends take(uint32_t slot, const PoseSpan& span);

    /// Takes over the first `count` slots; the device has none of their ends.
    void takeOver(const UpdateRates& other, uint32_t count);

private:
    static constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
    static constexpr std::array<double, 2> kNone = {kNever, kNever};
    struct Slot {
        UpdateCourse course;
        uint32_t chosen = 1;
        bool isChosen = false;
        std::array<double, 2> ends = kNone; ///< times of the poses of number 1 and 2
    };
    std::vector<Slot> slots_;
};

} // namespace supple::runtime
