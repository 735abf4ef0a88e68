#include "runtime/update_rates.h"

#include <algorithm>
#include <cmath>

namespace supple::runtime {

PoseSpan gridSpan(double time, uint32_t slot, uint32_t interval) {
    const double steps = interval, early = slot % interval;
    const auto at = [&](double k) { return (k * steps - early) / shared::kUpdateSteps; };
    double k = std::floor((time * shared::kUpdateSteps + early) / steps);
    k -= at(k) > time ? 1.0 : 0.0; // the quotient was rounded
    k += at(k + 1.0) <= time ? 1.0 : 0.0;
    return {at(k), at(k + 1.0)};
}

void UpdateRates::reset(uint32_t slot) {
    if (areTaken()) {
        slots_[slot] = {};
    }
}

void UpdateRates::forget(uint32_t slot) {
    if (areTaken()) {
        slots_[slot].ends = kNone;
    }
}

void UpdateRates::set(uint32_t slot, const UpdateCourse& course) {
    if (slots_[slot].course != course) {
        reset(slot);
        slots_[slot].course = course;
    }
    forget(slot);
}

void UpdateRates::forgetAll() {
    for (Slot& slot : slots_) {
        slot.ends = kNone;
    }
}

void UpdateRates::forgetChoices() {
    for (Slot& slot : slots_) {
        slot.isChosen = false;
    }
}

void UpdateRates::choose(uint32_t slot, float pixels, double least) {
    Slot& own = slots_[slot];
    uint32_t best = 1;
    for (size_t n = 0; n < UpdateCourse::kIntervals.size(); ++n) {
        const uint32_t interval = UpdateCourse::kIntervals[n];
        const float most = own.isChosen && interval > own.chosen ? 1.0f / kHysteresis : 1.0f;
        const float error = own.course.errors[n];
        if (interval >= least && (error == 0.0f || error * pixels <= most)) {
            best = interval;
        }
    }
    own.chosen = best;
    own.isChosen = true;
}

uint32_t UpdateRates::interval(uint32_t slot) const {
    if (!areTaken()) {
        return 1;
    }
    const Slot& own = slots_[slot];
    return own.course.asked != 0 ? own.course.asked : own.chosen;
}

bool UpdateRates::holds(uint32_t slot, const PoseSpan& span) const {
    const std::array<double, 2>& ends = slots_[slot].ends;
    return (ends[0] == span.begin && ends[1] == span.end) || (ends[1] == span.begin && ends[0] == span.end);
}

UpdateRates::Ends UpdateRates::take(uint32_t slot, const PoseSpan& span) {
    std::array<double, 2>& ends = slots_[slot].ends;
    // Poses that both spans have stay where they are.
    const size_t first = ends[1] == span.begin || ends[0] == span.end ? 1 : 0;
    Ends result;
    result.earlier = static_cast<uint32_t>(first) + 1;
    const auto need = [&](size_t end, double time) {
        if (ends[end] != time) {
            ends[end] = time;
            result.due[result.dueCount++] = {static_cast<uint32_t>(end) + 1, time};
        }
    };
    need(first, span.begin);
    need(1 - first, span.end);
    return result;
}

void UpdateRates::takeOver(const UpdateRates& other, uint32_t count) {
    std::copy_n(other.slots_.begin(), areTaken() ? count : 0, slots_.begin());
    forgetAll();
}

} // namespace supple::runtime
