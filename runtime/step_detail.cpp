#include "runtime/step_detail.h"

namespace supple::runtime {

void StepDetail::setSize(uint32_t slot, float pixels, double time) {
    Slot& own = slots_[slot];
    own.sleeps = pixels < (own.isKnown && own.sleeps ? kWakesAbove : kSleepsBelow);
    const float target = own.sleeps ? 0.0f : 1.0f;
    const double seconds = time - own.time;
    if (!own.isKnown || seconds < 0.0) {
        own.fade = target;
    }
    const auto most = static_cast<float>(std::min(std::max(seconds, 0.0) / kFadeSeconds, 1.0));
    own.fade += std::clamp(target - own.fade, -most, most);
    own.isKnown = true;
    own.time = time;
}

void StepDetail::forget(uint32_t slot) {
    if (isTaken()) {
        slots_[slot] = {};
    }
}

void StepDetail::takeOver(const StepDetail& other, uint32_t count) {
    std::copy_n(other.slots_.begin(), std::min({size_t{count}, slots_.size(), other.slots_.size()}), slots_.begin());
}

} // namespace supple::runtime
