#include "cage/clip_set.h"

#include "cage/message.h"
#include "cage/node_match.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace supple::cage {
namespace {

/// Names for clips that no clip has yet.
class FreeNames {
public:
    FreeNames(const std::vector<Clip>& clips, const std::string& file) : stem_(stemOf(file)) {
        for (const Clip& clip : clips) {
            taken_.insert(clip.name);
        }
    }
    [[nodiscard]] std::string take(const std::string& name) {
        if (taken_.insert(name).second) {
            return name;
        }
        const std::string ofFile = name + "@" + stem_;
        for (uint32_t& number = numbers_[ofFile];;) {
            std::string free = ++number == 1 ? ofFile : ofFile + "_" + std::to_string(number);
            if (taken_.insert(free).second) {
                return free;
            }
        }
    }

private:
    std::string stem_;
    std::set<std::string> taken_;
    std::map<std::string, uint32_t> numbers_; ///< how many were tried
};

/// Per target of a part: the number of the clip's target that moves it, or kNone.
using TargetMatch = std::vector<uint32_t>;

/// The targets by their names; equal ones in their order.
std::map<std::pair<std::string, size_t>, uint32_t> byName(const std::vector<std::string>& names) {
    std::map<std::pair<std::string, size_t>, uint32_t> places;
    std::map<std::string, size_t> seen;
    for (uint32_t t = 0; t < names.size(); ++t) {
        places.emplace(std::pair(names[t], seen[names[t]]++), t);
    }
    return places;
}

/// `clip`: the names of the first of its `width` targets. `unmatched`: gets those that no target of the part has.
/// Nothing: no target matches.
std::optional<TargetMatch> matchTargets(const std::vector<std::string>& clip, size_t width,
                                        const std::vector<std::string>& part, std::vector<std::string>& unmatched) {
    const auto isNamed = [](const std::string& name) { return !name.empty(); };
    TargetMatch match(part.size(), kNone);
    if (std::none_of(clip.begin(), clip.end(), isNamed) || std::none_of(part.begin(), part.end(), isNamed)) {
        std::iota(match.begin(), match.end(), 0u);
        return width == part.size() ? std::optional(match) : std::nullopt;
    }
    const auto places = byName(part);
    bool any = false;
    for (const auto& [name, target] : byName(clip)) {
        const auto found = places.find(name);
        if (found != places.end()) {
            match[found->second] = target;
            any = true;
        } else {
            unmatched.push_back(name.first.empty() ? at("target", target) : name.first);
        }
    }
    return any ? std::optional(match) : std::nullopt;
}

/// The values for the targets of a part. `rest`: its weights, for those that the clip does not move.
std::vector<float> valuesFor(const Channel& channel, const TargetMatch& match, const std::vector<float>& rest) {
    const size_t width = channel.width();
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    std::vector<float> values;
    values.reserve(channel.values.size() / width * match.size());
    for (size_t row = 0; row * width < channel.values.size(); ++row) {
        const bool isTangent = cubic && row % 3 != 1;
        for (size_t t = 0; t < match.size(); ++t) {
            values.push_back(match[t] != kNone ? channel.values[row * width + match[t]] : isTangent ? 0.0f : rest[t]);
        }
    }
    return values;
}

class ClipTaker {
public:
    ClipTaker(const ClipSet& set, std::span<const PartCage> parts, Character& character)
        : set_(set), character_(character), match_(match(set, character.skeleton)),
          bone_(compareBones(set.skeleton, set.clips, character.skeleton, match_)), clipCount_(set.clips.size()) {
        for (const PartCage& part : parts) {
            parts_.emplace(part.part.node, &part);
        }
    }

    /// Whether the channel stays; it is then the character's.
    [[nodiscard]] bool take(Channel& channel) {
        const uint32_t from = channel.node;
        const uint32_t to = match_.partners[from];
        animated_.insert(from);
        if (to == kNone) {
            return false;
        }
        channel.node = to;
        if (channel.path == ChannelPath::weights) {
            return takeWeights(channel, from);
        }
        Node& node = character_.skeleton.nodes[to];
        if (node.hasMatrix && !decompose(node)) {
            sheared_.insert(to);
            return false;
        }
        count(channel.times.size() + channel.values.size());
        return true;
    }

    [[nodiscard]] std::string report() const {
        std::vector<std::string> alone, sheared;
        for (const uint32_t node : animated_) {
            if (match_.partners[node] == kNone) {
                alone.push_back(nameOf(set_.skeleton, node));
            }
        }
        for (const uint32_t node : sheared_) {
            sheared.push_back(nameOf(character_.skeleton, node));
        }
        std::string text;
        const auto say = [&](const char* what, const std::vector<std::string>& names) {
            text += names.empty() ? "" : what + listed(names);
        };
        say("; not matched: ", alone);
        say("; names that several nodes have: ", repeatedOfAnimated());
        say("; matrices that are no translation, rotation and scale: ", sheared);
        say("; morph weights not matched: ", weights_);
        if (bone_.node != kNone) {
            text += "; bones differ in length, most of all " + nameOf(set_.skeleton, bone_.node) + ": " +
                    shortNumber(bone_.from) + " instead of " + shortNumber(bone_.to);
        }
        if (text.empty() || set_.isFitted) {
            return text.empty() ? text : text.substr(2); // who fitted the set has told the rest
        }
        if (!set_.whyNotFitted.empty()) {
            text += "; not retargeted: " + set_.whyNotFitted;
        }
        return counted(clipCount_, "clip", "clips") + "; " + std::to_string(animated_.size() - alone.size()) + " of " +
               counted(animated_.size(), "node", "nodes") + " matched by name" + text;
    }

private:
    [[nodiscard]] static NodeMatch match(const ClipSet& set, const Skeleton& skeleton) {
        if (!set.isFitted) {
            return matchNodes(set.skeleton, skeleton);
        }
        NodeMatch same;
        same.partners.resize(skeleton.nodes.size());
        std::iota(same.partners.begin(), same.partners.end(), 0u);
        return same;
    }

    void count(uint64_t floats) {
        floats_ += floats;
        if (floats_ > kMaxClipFloats) {
            refuse(set_.name,
                   "for this character, its clips hold more than " + std::to_string(kMaxClipFloats) + " numbers",
                   ErrorCode::limit);
        }
    }

    /// What the targets of a node's part are matched to; it is found once.
    struct WeightMatch {
        size_t width = 0;
        std::optional<TargetMatch> targets;
    };

    [[nodiscard]] bool takeWeights(Channel& channel, uint32_t from) {
        const auto part = parts_.find(channel.node);
        const size_t targets = part == parts_.end() ? 0 : part->second->morphs.targets.size();
        const size_t width = channel.width();
        WeightMatch& known = known_[from];
        if (known.width != width) {
            known = {width, targets == 0 ? withoutTargets(from) : matchPart(*part->second, from, width)};
        }
        if (!known.targets) {
            return false;
        }
        count(channel.times.size() + channel.values.size() / width * targets);
        channel.values = valuesFor(channel, *known.targets, part->second->morphs.weights);
        return true;
    }

    std::optional<TargetMatch> withoutTargets(uint32_t from) {
        weights_.push_back(nameOf(set_.skeleton, from) + " (no targets)");
        return std::nullopt;
    }

    std::optional<TargetMatch> matchPart(const PartCage& part, uint32_t from, size_t width) {
        std::vector<std::string> ofClip, ofPart, unmatched;
        if (set_.meshes[from] != kNone) {
            ofClip = set_.targetNames[set_.meshes[from]];
            ofClip.resize(std::min(ofClip.size(), width));
        }
        for (const MorphTarget& target : part.morphs.targets) {
            ofPart.push_back(target.name);
        }
        std::optional<TargetMatch> match = matchTargets(ofClip, width, ofPart, unmatched);
        const std::string name = nameOf(set_.skeleton, from);
        if (!match && unmatched.empty()) {
            weights_.push_back(name + " (" + std::to_string(width) + " for " +
                               counted(ofPart.size(), "target", "targets") + ")");
        } else if (!unmatched.empty()) {
            weights_.push_back(name + " (" + listed(unmatched) + ")");
        }
        return match;
    }

    [[nodiscard]] std::vector<std::string> repeatedOfAnimated() const {
        std::set<std::string> names;
        for (const uint32_t node : animated_) {
            names.insert(set_.skeleton.nodes[node].name);
        }
        std::vector<std::string> repeated;
        std::copy_if(match_.repeated.begin(), match_.repeated.end(), std::back_inserter(repeated),
                     [&](const std::string& name) { return names.count(name) != 0; });
        return repeated;
    }

    const ClipSet& set_;
    Character& character_;
    NodeMatch match_;
    BoneDifference bone_;
    size_t clipCount_;
    std::map<uint32_t, const PartCage*> parts_; ///< by node
    std::map<uint32_t, WeightMatch> known_;     ///< by node of the set
    std::set<uint32_t> animated_;               ///< nodes of the set
    std::set<uint32_t> sheared_;                ///< nodes of the character
    std::vector<std::string> weights_;          ///< what was not matched
    uint64_t floats_ = 0;
};

} // namespace

std::string stemOf(const std::string& file) {
    const size_t folder = file.find_last_of("/\\");
    const std::string base = folder == std::string::npos ? file : file.substr(folder + 1);
    const size_t dot = base.rfind('.');
    return dot == std::string::npos || dot == 0 ? base : base.substr(0, dot);
}

void takeClips(ClipSet set, std::span<const PartCage> parts, Character& character) {
    for (const std::string& warning : set.warnings) {
        warn(character.warnings, set.name, warning);
    }
    if (set.clips.empty()) {
        warn(character.warnings, set.name, "no clips");
        return;
    }
    ClipTaker taker(set, parts, character);
    FreeNames names(character.clips, set.name);
    std::vector<Clip> taken = std::move(set.clips);
    for (Clip& clip : taken) {
        std::erase_if(clip.channels, [&](Channel& channel) { return !taker.take(channel); });
        clip.name = names.take(clip.name);
    }
    const std::string report = taker.report();
    if (!report.empty()) {
        warn(character.warnings, set.name, report);
    }
    std::move(taken.begin(), taken.end(), std::back_inserter(character.clips));
}

} // namespace supple::cage
