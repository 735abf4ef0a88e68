#include "runtime/host_steps.h"

#include <algorithm>

namespace supple::runtime {

HostSteps::HostSteps(uint32_t capacity, bool findsDown) : clock_(capacity, findsDown), slots_(capacity) {
    taken_.reserve(capacity);
    undo_.reserve(capacity);
}

void HostSteps::setPosed(uint32_t slot) {
    if (areTaken()) {
        slots_[slot].isPosed = true;
    }
}

void HostSteps::setBindPose(uint32_t slot) {
    if (areTaken()) {
        slots_[slot].isPosed = false;
        clock_.settle(slot);
    }
}

void HostSteps::setTime(uint64_t frame, double time) {
    if (frame_ != frame) {
        timeBefore_ = time_;
        frame_ = frame;
        taken_.clear();
        undo_.clear();
    }
    time_ = time;
}

HostSteps::Due HostSteps::take(uint32_t slot, const StepPlace& place) {
    Slot& own = slots_[slot];
    taken_.push_back(slot);
    undo_.push_back(own.time);
    Due due{clock_.take(slot, frame_, time_, place, false), {}};
    const double span = time_ - own.time;
    for (uint32_t k = 0; k < due.steps.count; ++k) {
        const bool onTheWay = !due.steps.settles && span > 0.0 && k < due.steps.jump; // no jump: behind all
        const double way = onTheWay ? (timeOfStep(due.steps.first + k) - own.time) / span : 1.0;
        due.ways[k] = static_cast<float>(std::min(way, 1.0));
    }
    own.time = time_;
    return due;
}

std::span<const uint32_t> HostSteps::cancelFrame(uint64_t frame) {
    if (frame_ != frame) {
        return {};
    }
    clock_.cancelFrame(frame);
    time_ = timeBefore_;
    for (size_t i = 0; i < undo_.size(); ++i) {
        slots_[taken_[i]].time = undo_[i];
    }
    frame_ = kNoFrame; // it may be recorded again
    return taken_;
}

void HostSteps::takeOver(const HostSteps& other, uint32_t count) {
    if (areTaken()) {
        clock_.takeOver(other.clock_, count);
        time_ = other.time_;
        timeBefore_ = other.timeBefore_;
        frame_ = other.frame_;
        std::copy_n(other.slots_.begin(), count, slots_.begin());
        for (size_t i = 0; i < other.taken_.size(); ++i) {
            if (other.taken_[i] < count) {
                taken_.push_back(other.taken_[i]);
                undo_.push_back(other.undo_[i]);
            }
        }
    }
}

} // namespace supple::runtime
