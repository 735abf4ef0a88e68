// A transition from command lines: from one clip to another at a time.
#pragma once

#include "base/result.h"
#include "host/context.h"

#include <functional>
#include <optional>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::host {

/// A crossfade plays both clips meanwhile, by two layers.
enum class TransitionMethod { deadBlending, quintic, crossfade };

struct TransitionSetting {
    std::string from, to; ///< names or numbers of clips; empty: no transition
    double at = 0.0;      ///< seconds, of the time that poses are asked for at
    double seconds = 0.3; ///< that it takes
    std::string method = "dead-blending";

    [[nodiscard]] bool isThere() const { return !to.empty(); }
};
/// The values of TransitionSetting::method.
[[nodiscard]] std::vector<std::string> transitionMethods();
/// "walk@0.4->run" into from, at and to. The error says what is wrong in a few words.
[[nodiscard]] Status parseTransition(const std::string& text, TransitionSetting& setting);

struct PlannedTransition {
    uint32_t from = 0, to = 0; ///< clips
    double at = 0.0, seconds = 0.3;
    TransitionMethod method = TransitionMethod::deadBlending;
};
/// Nothing if the setting is not there. `findClip`: the number of a clip by its name or number.
[[nodiscard]] Result<std::optional<PlannedTransition>>
planTransition(const TransitionSetting& setting, const std::function<Result<uint32_t>(const std::string&)>& findClip);

/// A clip that loops, and is at `offset` at a time of the group.
[[nodiscard]] SupplePlaybackLayer loopingLayer(uint32_t clip, double start, double offset = 0.0);

/// How an instance takes what it plays next, and when.
struct ClipChange {
    std::optional<TransitionMethod> method; ///< none: at once
    double seconds = 0.3;
    double time = 0.0; ///< the group's
};
/// Sets what an instance plays from now on; no layer: the rest pose. `from` is what it has played, for a crossfade. The
/// group plays, with SUPPLE_GROUP_TRANSITIONS.
[[nodiscard]] Status changeClip(Context& context, SuppleInstance instance,
                                const std::optional<SupplePlaybackLayer>& from,
                                const std::optional<SupplePlaybackLayer>& to, const ClipChange& change);

/// Both clips loop, and begin with the group and with the transition. Sets the group's time, and what the instance
/// plays then.
[[nodiscard]] Status playTransition(Context& context, SuppleGroup group, SuppleInstance instance,
                                    const PlannedTransition& transition, double time);

} // namespace supple::host
