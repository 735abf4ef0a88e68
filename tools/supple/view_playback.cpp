#include "tools/supple/view_playback.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

namespace {

constexpr double kSameTime = 1e-4; ///< seconds; whoever moves the slider moves it farther

} // namespace

bool ViewPlayback::isShown(const host::Figure& figure, uint32_t clip, double time) const {
    if (clip_ != clip)
        return false;
    const double duration = figure.clipDuration(clip);
    if (duration <= 0.0)
        return true;
    const double apart = std::abs(std::fmod(offset_ + (time_ - start_), duration) - std::fmod(time, duration));
    return std::min(apart, std::abs(duration - apart)) < kSameTime;
}

Status ViewPlayback::show(const host::FigureGroup& group, uint32_t clip, double time,
                          std::optional<host::TransitionMethod> method, double seconds) {
    const host::Figure& figure = group.figure();
    host::Context& context = figure.context();
    Status timed = context.check(suppleSetTime(context.handle(), group.handle(), time_), "suppleSetTime");
    if (!timed || isShown(figure, clip, time))
        return timed;
    const auto layer = [&](uint32_t of, double start, double offset) {
        return of < figure.clips().size() ? std::optional(host::loopingLayer(of, start, offset)) : std::nullopt;
    };
    const uint32_t before = clip_.value_or(clip);
    const std::optional<SupplePlaybackLayer> from = layer(before, start_, offset_);
    if (before == clip || figure.clipDuration(clip) <= 0.0) // time does not go on while something stands
        method.reset();
    clip_ = clip;
    start_ = time_;
    offset_ = time;
    return host::changeClip(context, group.instance(0), from, layer(clip, start_, offset_), {method, seconds, time_});
}

} // namespace supple::tools
