#include "runtime/step_detail.h"

namespace supple::runtime {

void StepDetail::setSize(uint32_t slot, float pixels, double time) {
    Slot& own = slots_[slot];
    const auto before = own.isKnown ? static_cast<size_t>(own.level) : 0;
    size_t level = 0;
    while (level < kThresholds.size() &&
           pixels < (level < before ? kThresholds[level].above : kThresholds[level].below)) {
        ++level;
    }
    own.level = static_cast<Level>(level);
    const double seconds = time - own.time;
    const bool jumps = !own.isKnown || seconds < 0.0;
    const auto most = jumps ? 1.0f : static_cast<float>(std::min(seconds / kFadeSeconds, 1.0));
    const auto fade = [most](float& shown, bool isShown) {
        shown += std::clamp((isShown ? 1.0f : 0.0f) - shown, -most, most);
    };
    fade(own.shown.springs, own.level < Level::none);
    fade(own.shown.soft, own.level < Level::springs);
    own.shown.lightCloths = own.level != Level::full;
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
