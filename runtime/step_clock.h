// Which steps of their springs the instances of a group have run, and which are due: on a grid of times, whatever the
// frame rate.
#pragma once

#include "shaders/shared/pose.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace supple::runtime {

/// Where an instance stands, but for what root motion has travelled.
struct StepPlace {
    glm::dmat3 linear{1.0};
    glm::dvec3 position{0.0};
    bool operator==(const StepPlace&) const = default;
};
/// Straight between two, 0 to 1; turned the shorter way.
[[nodiscard]] StepPlace placeBetween(const StepPlace& a, const StepPlace& b, double part);
/// How the model's frame at `before` lies in that at `now`. Nothing moves if `now` flattens.
[[nodiscard]] StepPlace placeWithin(const StepPlace& now, const StepPlace& before);
/// The direction of the world's down, within it.
[[nodiscard]] glm::vec3 downWithin(const StepPlace& place);
/// A velocity of the world, within it: in its units. 0 if the place flattens; never absurdly large.
[[nodiscard]] glm::vec3 velocityWithin(const StepPlace& place, const glm::dvec3& velocity);
/// Three rows of it.
[[nodiscard]] std::array<glm::vec4, 3> rowsOf(const StepPlace& place);

/// The last step at or before a time.
[[nodiscard]] int64_t lastStepAt(double time);
[[nodiscard]] constexpr double timeOfStep(int64_t step) {
    return static_cast<double>(step) / shared::kStepsASecond;
}

/// A wind that is set from time to time. Each call counts for the steps from its time on.
class Wind {
public:
    void set(const glm::dvec3& velocity, double time);
    /// As if no frame had had steps: what was set last blows in all that come. A recording that begins late tells no
    /// more than that.
    void settle();
    [[nodiscard]] const glm::dvec3& at(int64_t step) const;
    /// A frame has asked for its steps: later calls change the wind of later ones.
    void endFrame(uint64_t frame);
    void cancelFrame(uint64_t frame);

private:
    struct Change {
        int64_t first = 0; ///< step
        glm::dvec3 velocity{0.0};
    };
    /// What blows before all changes, and these, by rising steps. More than a frame has steps are of no use.
    struct Course {
        glm::dvec3 before{0.0};
        std::array<Change, shared::kMostDueSteps + 1> changes;
        uint32_t count = 0;
        void add(const Change& change);
        [[nodiscard]] const glm::dvec3& last() const { return count > 0 ? changes[count - 1].velocity : before; }
    };
    Course course_;
    bool isAsked_ = false; ///< a frame has asked for its steps
    // What that frame has found.
    uint64_t frame_ = 0;
    Course undo_;
};

/// Asking allocates nothing.
class StepClock {
public:
    StepClock() = default; ///< not taken
    /// `findsDown`: for each step, where down is.
    StepClock(uint32_t capacity, bool findsDown) : findsDown_(findsDown), slots_(capacity) { undo_.reserve(capacity); }
    /// False: no instance runs steps. Then take() and hasBefore() may not be called, and all else counts for nothing.
    [[nodiscard]] bool isTaken() const { return !slots_.empty(); }

    /// The instance begins anew with its next step: tails at rest in the pose.
    void settle(uint32_t slot);
    void settleAll();
    /// At a time of the group it is elsewhere, and has not moved there. Unless root motion travels, it goes on there as
    /// it has moved in the last step.
    void jump(uint32_t slot, double time);
    /// Its place is set at a time of the group: if root motion travels, it stands there from then on; else it goes
    /// there, straight from where it was in the last frame.
    void place(uint32_t slot, double time);

    /// A call changes what is played or where, at a time of the group. Whether steps that are due are posed by what was
    /// played before.
    [[nodiscard]] bool change(uint32_t slot, double time);
    [[nodiscard]] bool hasBefore(uint32_t slot) const { return slots_[slot].changed != kNoTime; }

    /// The wind about all instances, from a time of the group on.
    void setWind(const glm::dvec3& velocity, double time) { wind_.set(velocity, time); }
    void takeWind(const StepClock& other) { wind_ = other.wind_; }

    static constexpr uint32_t kNone = 0xFFFFFFFFu;
    /// The steps that an instance runs in a frame.
    struct Due {
        int64_t first = 0;
        uint32_t count = 0;
        bool settles = false;
        uint32_t skipped = 0; ///< if it settles: steps that are left out since the last that it ran; 0: nothing is left
        float part = 0.0f;    ///< of the way from the step before the last to the last, that is shown
        uint32_t jump = kNone;                            ///< the one to which it has not moved
        bool moves = false;                               ///< else all rows are the identity
        std::array<bool, shared::kMostDueSteps> before{}; ///< posed by what was played before the last call
        std::array<std::array<glm::vec4, 3>, shared::kMostDueSteps> rows{};
        /// What is soft runs none of them; else, if it wakes, the last alone, behind so many since it ran (0: at rest).
        bool softSleeps = false, softWakes = false;
        uint32_t softSkipped = 0;
        bool blows = false;   ///< else there is no wind in any of them
        bool hasDown = false; ///< whether `down` is found
        // What the world has, in the frame that the host places:
        std::array<glm::vec3, shared::kMostDueSteps> down{};
        std::array<glm::vec3, shared::kMostDueSteps> wind{}; ///< a velocity
    };
    /// It has run them from now on. Frames come with rising numbers. `runsSoft`: else what is soft sleeps.
    [[nodiscard]] Due take(uint32_t slot, uint64_t frame, double time, const StepPlace& place, bool travels,
                           bool runsSoft = true);
    /// All that run steps in the frame have taken them.
    void endFrame(uint64_t frame) { wind_.endFrame(frame); }
    /// What the frame's steps have done never happens.
    void cancelFrame(uint64_t frame);

    /// Takes over the first `count` slots, with their state on the device and what a frame that is cancelled undoes.
    void takeOver(const StepClock& other, uint32_t count);

private:
    static constexpr int64_t kNever = std::numeric_limits<int64_t>::min();
    static constexpr double kNoTime = std::numeric_limits<double>::infinity();
    struct Slot {
        int64_t last = kNever;     ///< the last step that was run
        int64_t softLast = kNever; ///< and by what is soft
        StepPlace atLast;          ///< where it stood then
        StepPlace inFrame;         ///< and in the last frame that had it
        double frameTime = 0.0;
        double placed = 0.0;
        double changed = kNoTime; ///< since when what is played differs from what the last frame had
        double jumped = kNoTime;
        bool isElsewhere = false; ///< it has not moved from `inFrame` to where it stands now
        StepPlace move;           ///< the last step's, as placeWithin()
    };
    [[nodiscard]] static Due begun(const Slot& own, double time); ///< without what it has been told
    static void beginSoft(Slot& own, Due& due, bool runs);
    [[nodiscard]] static StepPlace placeAt(const Slot& own, double stepTime, double time, const StepPlace& place,
                                           bool travels);
    /// Runs the steps that are due through where it has been.
    void move(Slot& own, Due& due, double time, const StepPlace& place, bool travels) const;
    void findAir(Due& due, uint32_t step, const StepPlace& place) const; ///< down and the wind

    Wind wind_;
    bool findsDown_ = false;
    std::vector<Slot> slots_;
    struct Undo {
        uint32_t slot = 0;
        Slot before;
    };
    std::vector<Undo> undo_; ///< of undoFrame_
    uint64_t undoFrame_ = 0;
};

} // namespace supple::runtime
