#include "tools/common/transition_setting.h"

#include "base/from_chars.h"

#include <cmath>
#include <iterator>
#include <span>

namespace supple::host {

namespace {

struct Method {
    const char* name;
    TransitionMethod method;
};
constexpr Method kMethods[] = {{"dead-blending", TransitionMethod::deadBlending},
                               {"quintic", TransitionMethod::quintic},
                               {"crossfade", TransitionMethod::crossfade}};

SupplePlaybackLayer looping(uint32_t clip, double start) {
    SupplePlaybackLayer layer{};
    layer.clip = clip;
    layer.flags = SUPPLE_LAYER_LOOP;
    layer.weight = layer.speed = 1.0f;
    layer.startTime = start;
    return layer;
}

SuppleResult play(Context& context, SuppleInstance instance, std::span<const SupplePlaybackLayer> layers,
                  SupplePlaybackDesc desc = {}) {
    desc.structSize = sizeof desc;
    desc.layers = layers.data();
    desc.layerCount = static_cast<uint32_t>(layers.size());
    return suppleSetPlayback(context.handle(), instance, &desc);
}

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

Status playTransition(Context& context, SuppleGroup group, SuppleInstance instance, const PlannedTransition& transition,
                      double time) {
    const SupplePlaybackLayer from = looping(transition.from, 0.0);
    SuppleResult result = play(context, instance, {&from, 1});
    if (result == SUPPLE_OK && time >= transition.at) {
        const bool crossfade = transition.method == TransitionMethod::crossfade;
        SupplePlaybackLayer layers[] = {from, looping(transition.to, transition.at)};
        SupplePlaybackDesc desc{};
        if (crossfade) {
            layers[1].weight = 0.0f;
            layers[1].fadeWeight = 1.0f;
            layers[1].fadeStart = transition.at;
            layers[1].fadeDuration = static_cast<float>(transition.seconds);
        } else {
            desc.transition = transition.seconds;
            desc.transitionKind = transition.method == TransitionMethod::quintic ? SUPPLE_TRANSITION_QUINTIC
                                                                                 : SUPPLE_TRANSITION_DEAD_BLENDING;
        }
        result = suppleSetTime(context.handle(), group, transition.at);
        if (result == SUPPLE_OK) {
            result = play(context, instance, std::span(layers).subspan(crossfade ? 0 : 1), desc);
        }
    }
    if (result == SUPPLE_OK) {
        result = suppleSetTime(context.handle(), group, time);
    }
    return context.check(result, "suppleSetPlayback");
}

} // namespace supple::host
