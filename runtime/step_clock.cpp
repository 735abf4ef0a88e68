#include "runtime/step_clock.h"

#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace supple::runtime {

StepPlace placeBetween(const StepPlace& a, const StepPlace& b, double part) {
    if (part >= 1.0) {
        return b;
    }
    StepPlace between{b.linear, a.position + (b.position - a.position) * part};
    if (a.linear != b.linear) {
        const glm::dquat from = skinning::nearestRotation(a.linear), to = skinning::nearestRotation(b.linear);
        const double side = glm::dot(from, to) < 0.0 ? -1.0 : 1.0;
        const glm::dmat3 turn(skinning::unit(from * (1.0 - part) + to * (side * part)));
        between.linear = turn * (glm::transpose(glm::dmat3(to)) * b.linear);
    }
    return between;
}

StepPlace placeWithin(const StepPlace& now, const StepPlace& before) {
    if (!(std::abs(glm::determinant(now.linear)) > 1e-30)) {
        return {};
    }
    const glm::dmat3 within = glm::inverse(now.linear);
    return {within * before.linear, within * (before.position - now.position)};
}

glm::vec3 downWithin(const StepPlace& place) {
    const glm::dvec3 down = glm::transpose(place.linear) * glm::dvec3(0.0, -1.0, 0.0);
    const double length = glm::length(down);
    const bool sound = length > 1e-30 && length < 1e30;
    return sound ? glm::vec3(down / length) : glm::vec3(0.0f, -1.0f, 0.0f);
}

glm::vec3 velocityWithin(const StepPlace& place, const glm::dvec3& velocity) {
    if (!(std::abs(glm::determinant(place.linear)) > 1e-30)) {
        return glm::vec3(0.0f);
    }
    constexpr double kMost = 1e6;
    const glm::dvec3 within = glm::inverse(place.linear) * velocity;
    const double length = glm::length(within);
    const bool sound = length < 1e30;
    return sound ? glm::vec3(within * std::min(1.0, kMost / std::max(length, kMost))) : glm::vec3(0.0f);
}

std::array<glm::vec4, 3> rowsOf(const StepPlace& place) {
    std::array<glm::vec4, 3> rows;
    for (int r = 0; r < 3; ++r) {
        rows[static_cast<size_t>(r)] =
            glm::vec4(glm::dvec4(place.linear[0][r], place.linear[1][r], place.linear[2][r], place.position[r]));
    }
    return rows;
}

int64_t lastStepAt(double time) {
    auto step = static_cast<int64_t>(std::floor(time * shared::kStepsASecond));
    step -= timeOfStep(step) > time ? 1 : 0; // the product was rounded
    step += timeOfStep(step + 1) <= time ? 1 : 0;
    return step;
}

void Wind::Course::add(const Change& change) {
    while (count > 0 && changes[count - 1].first >= change.first) {
        --count; // from there on, the later call counts
    }
    if (count == changes.size()) {
        before = changes[0].velocity;
        std::copy(changes.begin() + 1, changes.end(), changes.begin());
        --count;
    }
    changes[count++] = change;
}

void Wind::set(const glm::dvec3& velocity, double time) {
    if (isAsked_) {
        const int64_t last = lastStepAt(time);
        course_.add({timeOfStep(last) < time ? last + 1 : last, velocity});
    } else {
        course_.before = velocity;
    }
}

void Wind::settle() {
    const glm::dvec3 now = course_.last();
    *this = {};
    course_.before = now;
}

const glm::dvec3& Wind::at(int64_t step) const {
    for (uint32_t i = course_.count; i > 0; --i) {
        if (step >= course_.changes[i - 1].first) {
            return course_.changes[i - 1].velocity;
        }
    }
    return course_.before;
}

void Wind::endFrame(uint64_t frame) {
    frame_ = frame;
    undo_ = course_;
    course_.before = course_.last();
    course_.count = 0;
    isAsked_ = true;
}

void Wind::cancelFrame(uint64_t frame) {
    if (frame_ == frame) {
        const Course since = std::exchange(course_, undo_);
        std::for_each_n(since.changes.begin(), since.count, [this](const Change& change) { course_.add(change); });
        undo_ = course_;
    }
}

void StepClock::settle(uint32_t slot) {
    if (isTaken()) {
        slots_[slot].last = kNever;
        std::erase_if(undo_, [slot](const Undo& undo) { return undo.slot == slot; });
    }
}

void StepClock::jump(uint32_t slot, double time) {
    if (isTaken()) {
        slots_[slot].jumped = std::min(slots_[slot].jumped, time);
        slots_[slot].isElsewhere = true;
    }
}

void StepClock::place(uint32_t slot, double time) {
    if (isTaken()) {
        slots_[slot].placed = time;
    }
}

void StepClock::settleAll() {
    wind_.settle();
    undo_.clear();
    for (Slot& slot : slots_) {
        slot.last = kNever;
    }
}

bool StepClock::change(uint32_t slot, double time) {
    if (!isTaken()) {
        return false;
    }
    Slot& own = slots_[slot];
    const int64_t step = lastStepAt(time);
    const bool keeps = own.last != kNever && own.changed == kNoTime && step > own.last &&
                       step - own.last <= int64_t{shared::kMostDueSteps};
    own.changed = keeps ? time : own.changed;
    return keeps;
}

StepPlace StepClock::placeAt(const Slot& own, double stepTime, double time, const StepPlace& place, bool travels) {
    if (travels) {
        return stepTime < std::min(own.jumped, own.placed) ? own.inFrame : place;
    }
    const double span = time - own.frameTime;
    return span > 0.0 ? placeBetween(own.inFrame, place, (stepTime - own.frameTime) / span) : place;
}

StepClock::Due StepClock::begun(const Slot& own, double time) {
    const int64_t step = lastStepAt(time);
    Due due;
    due.settles = own.last == kNever || step < own.last || step - own.last > int64_t{shared::kMostDueSteps};
    if (due.settles && own.last != kNever && step > own.last) {
        due.skipped = static_cast<uint32_t>(std::min<int64_t>(step - own.last, shared::kMostSkippedSteps));
    }
    due.first = due.settles ? step : own.last + 1;
    due.count = static_cast<uint32_t>(step - due.first + 1);
    due.part = std::clamp(static_cast<float>((time - timeOfStep(step)) * shared::kStepsASecond), 0.0f, 1.0f);
    return due;
}

void StepClock::findAir(Due& due, uint32_t step, const StepPlace& place) const {
    if (findsDown_) {
        due.down[step] = downWithin(place);
    }
    const glm::dvec3& wind = wind_.at(due.first + step);
    if (wind != glm::dvec3(0.0)) {
        due.blows = true;
        due.wind[step] = velocityWithin(place, wind);
    }
}

void StepClock::move(Slot& own, Due& due, double time, const StepPlace& place, bool travels) const {
    for (uint32_t k = 0; k < due.count; ++k) {
        if (due.moves && !own.isElsewhere) {
            const StepPlace now = placeAt(own, timeOfStep(due.first + k), time, place, travels);
            own.move = placeWithin(now, own.atLast);
            own.atLast = now;
            findAir(due, k, now);
        }
        due.rows[k] = rowsOf(own.move);
    }
    if (own.isElsewhere) { // and where it would have been at the last step, had it come there
        const double part =
            std::clamp((time - timeOfStep(due.first + due.count - 1)) * shared::kStepsASecond, 0.0, 1.0);
        const StepPlace before = placeBetween({}, own.move, part);
        own.atLast = {place.linear * before.linear, place.linear * before.position + place.position};
        own.isElsewhere = false;
    }
}

void StepClock::beginSoft(Slot& own, Due& due, bool runs) {
    const bool anew = due.settles && due.skipped == 0; // so does what is soft
    const bool wakes = runs && !anew && own.softLast != own.last;
    due.softSleeps = !runs || (wakes && due.count == 0);
    due.softWakes = wakes && !due.softSleeps;
    const int64_t last = due.first + due.count - 1;
    if (due.softWakes && own.softLast != kNever) {
        due.softSkipped = static_cast<uint32_t>(std::min<int64_t>(last - own.softLast, shared::kMostSkippedSteps));
    }
    if (anew) {
        own.softLast = kNever;
    }
    if (!due.softSleeps) {
        own.softLast = last;
    }
}

StepClock::Due StepClock::take(uint32_t slot, uint64_t frame, double time, const StepPlace& place, bool travels,
                               bool runsSoft) {
    if (undoFrame_ != frame) {
        undo_.clear();
        undoFrame_ = frame;
    }
    Slot& own = slots_[slot];
    undo_.push_back({slot, own});
    Due due = begun(own, time);
    beginSoft(own, due, runsSoft);
    due.hasDown = findsDown_;
    if (due.settles) {
        own.atLast = own.inFrame = place;
        own.changed = own.jumped = kNoTime;
        own.isElsewhere = false;
        own.move = {};
    }
    for (uint32_t k = 0; k < due.count; ++k) {
        const double stepTime = timeOfStep(due.first + k);
        due.before[k] = stepTime < own.changed && hasBefore(slot);
        const bool stoodThere = own.jumped != kNoTime && stepTime < own.jumped;
        findAir(due, k, stoodThere ? own.inFrame : place);
        if (stepTime >= own.jumped) {
            due.jump = due.jump == kNone ? k : due.jump;
        }
    }
    // What root motion travels goes on by itself: of a jump nothing is to be seen.
    own.isElsewhere = own.isElsewhere && !travels;
    due.moves = own.isElsewhere ? own.move != StepPlace{} : own.atLast != place || own.inFrame != place;
    if (due.moves || own.isElsewhere) {
        move(own, due, time, place, travels);
    } else if (due.count > 0) {
        own.move = {};
        std::fill_n(due.rows.begin(), due.count, rowsOf(own.move));
    }
    if (due.jump != kNone) {
        own.jumped = kNoTime;
    }
    own.last = lastStepAt(time);
    own.inFrame = place;
    own.frameTime = time;
    own.changed = kNoTime;
    return due;
}

void StepClock::cancelFrame(uint64_t frame) {
    wind_.cancelFrame(frame);
    if (undoFrame_ == frame) {
        // The first of a slot is what it was.
        std::for_each(undo_.rbegin(), undo_.rend(), [&](const Undo& undo) {
            const Slot now = slots_[undo.slot];
            slots_[undo.slot] = undo.before;
            // What calls since then have said stays said.
            slots_[undo.slot].placed = now.placed;
            slots_[undo.slot].jumped = std::min(undo.before.jumped, now.jumped);
            slots_[undo.slot].isElsewhere = undo.before.isElsewhere || now.isElsewhere;
        });
        undo_.clear();
    }
}

void StepClock::takeOver(const StepClock& other, uint32_t count) {
    if (!isTaken()) {
        return;
    }
    std::copy_n(other.slots_.begin(), count, slots_.begin());
    undoFrame_ = other.undoFrame_;
    undo_.clear();
    std::copy_if(other.undo_.begin(), other.undo_.end(), std::back_inserter(undo_),
                 [count](const Undo& undo) { return undo.slot < count; });
}

} // namespace supple::runtime
