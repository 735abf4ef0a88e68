#include "tools/supple/view_look.h"

#include <algorithm>
#include <iterator>

namespace supple::tools {

namespace {

constexpr uint32_t kCalmFrames = 4; ///< a hand that drags rests between two moves
constexpr double kSlowest = 1.0 / 18.0;
constexpr double kQuickest = 1.0 / 45.0; ///< the next larger picture takes up to 2.25 times as long
constexpr uint32_t kFramesToJudge = 6;

} // namespace

LookStep LookPace::next(Look look, bool same, double seconds) {
    if (look == Look::studio || (look == Look::automatic && !cpuDevice_)) {
        wasFast_ = false;
        calm_ = 0;
        return {};
    }
    calm_ = same ? std::min(calm_ + 1, kCalmFrames + passes_ + 1) : 0;
    if (look == Look::automatic && calm_ > kCalmFrames) {
        wasFast_ = false;
        const uint32_t pass = calm_ - kCalmFrames - 1;
        if (pass < passes_)
            return {.kind = LookStep::Kind::refine, .pass = pass};
        return {.kind = LookStep::Kind::keep};
    }
    if (wasFast_ && !fixed_)
        chooseScale(seconds);
    wasFast_ = true;
    return {.kind = LookStep::Kind::fast, .scaleIndex = scale_};
}

void LookPace::chooseScale(double seconds) {
    fastSeconds_ = fastFrames_ == 0 ? seconds : fastSeconds_ + 0.25 * (seconds - fastSeconds_);
    if (++fastFrames_ < kFramesToJudge)
        return;
    const uint32_t before = scale_;
    if (fastSeconds_ > kSlowest)
        scale_ = std::min<uint32_t>(scale_ + 1, std::size(kFastScales) - 1);
    else if (fastSeconds_ < kQuickest && scale_ > 0)
        --scale_;
    if (scale_ != before)
        fastFrames_ = 0;
}

} // namespace supple::tools
