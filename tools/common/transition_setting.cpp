#include "tools/common/transition_setting.h"

#include "base/from_chars.h"

#include <array>
#include <cmath>

namespace supple::host {

namespace {

struct Method {
    const char* name;
    TransitionMethod method;
};
constexpr Method kMethods[] = {{"dead-blending", TransitionMethod::deadBlending},
                               {"quintic", TransitionMethod::quintic},
                               {"crossfade", TransitionMethod::crossfade}};

} // namespace

std::vector<std::string> transitionMethods() {
    std::vector<std::string> names;
    for (const Method& method : kMethods) {
        names.emplace_back(method.name);
    }
    return names;
}

Result<std::optional<PlannedTransition>>
planTransition(const TransitionSetting& setting, const std::function<Result<uint32_t>(const std::string&)>& findClip) {
    if (!setting.isThere()) {
        return std::optional<PlannedTransition>();
    }
    const Result<uint32_t> from = findClip(setting.from), to = findClip(setting.to);
    if (!from || !to) {
        return !from ? from.error() : to.error();
    }
    PlannedTransition planned{*from, *to, setting.at, setting.seconds};
    for (const Method& method : kMethods) {
        planned.method = setting.method == method.name ? method.method : planned.method;
    }
    return std::optional(planned);
}

Status parseTransition(const std::string& text, TransitionSetting& setting) {
    const size_t arrow = text.rfind("->"), sign = text.rfind('@', arrow);
    const Error fault{ErrorCode::argument, text + " is not CLIP@SECONDS->CLIP"};
    if (arrow == std::string::npos || sign == std::string::npos || sign == 0 || arrow + 2 == text.size()) {
        return fault;
    }
    const char* const last = text.data() + arrow;
    const auto [end, error] = from_chars(text.data() + sign + 1, last, setting.at);
    if (error != std::errc() || end != last || !std::isfinite(setting.at) || setting.at < 0.0) {
        return fault;
    }
    setting.from = text.substr(0, sign);
    setting.to = text.substr(arrow + 2);
    return success();
}

SupplePlaybackLayer loopingLayer(uint32_t clip, double start, double offset) {
    SupplePlaybackLayer layer{};
    layer.clip = clip;
    layer.flags = SUPPLE_LAYER_LOOP;
    layer.weight = layer.speed = 1.0f;
    layer.startTime = start;
    layer.offset = offset;
    return layer;
}

Status changeClip(Context& context, SuppleInstance instance, const std::optional<SupplePlaybackLayer>& from,
                  const std::optional<SupplePlaybackLayer>& to, const ClipChange& change) {
    const bool crossfades = change.method == TransitionMethod::crossfade;
    std::array<SupplePlaybackLayer, 2> layers{};
    SupplePlaybackDesc desc{};
    desc.structSize = sizeof desc;
    desc.layers = layers.data();
    if (crossfades && from) {
        layers[desc.layerCount++] = *from;
    }
    if (to) {
        SupplePlaybackLayer& layer = layers[desc.layerCount++] = *to;
        if (crossfades) {
            layer.weight = 0.0f;
            layer.fadeWeight = 1.0f;
            layer.fadeStart = change.time;
            layer.fadeDuration = static_cast<float>(change.seconds);
        }
    }
    if (change.method && !crossfades) {
        desc.transition = change.seconds;
        desc.transitionKind =
            change.method == TransitionMethod::quintic ? SUPPLE_TRANSITION_QUINTIC : SUPPLE_TRANSITION_DEAD_BLENDING;
    }
    return context.check(suppleSetPlayback(context.handle(), instance, &desc), "suppleSetPlayback");
}

Status playTransition(Context& context, SuppleGroup group, SuppleInstance instance, const PlannedTransition& transition,
                      double time) {
    const auto setTime = [&](double seconds) {
        return context.check(suppleSetTime(context.handle(), group, seconds), "suppleSetTime");
    };
    const SupplePlaybackLayer from = loopingLayer(transition.from, 0.0);
    Status status = changeClip(context, instance, {}, from, {});
    if (status && time >= transition.at) {
        status = setTime(transition.at);
        status = status ? changeClip(context, instance, from, loopingLayer(transition.to, transition.at),
                                     {transition.method, transition.seconds, transition.at})
                        : status;
    }
    return status ? setTime(time) : status;
}

} // namespace supple::host
