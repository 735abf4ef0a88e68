#include "tools/common/simulation.h"

#include "tools/common/transition_setting.h"

#include <algorithm>

namespace supple::host {

Status simulate(Context& context, SuppleGroup group, SuppleInstance instance, uint32_t clip, double begin,
                double time) {
    constexpr double kHop = 8.0 / 60.0; // as many steps as a frame runs
    const bool plays = clip != SUPPLE_REST_POSE && clip != SUPPLE_BIND_POSE;
    const auto setTime = [&](double seconds) {
        return context.check(suppleSetTime(context.handle(), group, seconds), "suppleSetTime");
    };
    Status status = setTime(begin);
    status = status
                 ? changeClip(context, instance, {}, plays ? std::optional(loopingLayer(clip, 0.0)) : std::nullopt, {})
                 : status;
    for (double at = begin; status && at < time; at += kHop) {
        status = setTime(at);
        status = status ? context.evaluate({&group, 1}) : status;
    }
    return status ? setTime(time) : status;
}

} // namespace supple::host
