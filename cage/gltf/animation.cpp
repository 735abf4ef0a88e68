#include "cage/gltf/animation.h"

#include "cage/clip_checks.h"
#include "cage/entry_faults.h"
#include "cage/gltf/accessors.h"
#include "cage/gltf/keys.h"
#include "cage/gltf/markers.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/nodes.h"
#include "cage/gltf/pointer.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// What a path's output looks like.
struct Output {
    ChannelPath path;
    int type;
    uint32_t components;
    size_t width; ///< elements a value
};

std::optional<Output> outputOf(const std::string& path, size_t targetCount) {
    constexpr uint32_t kAny = kFloat | kNormalizedU8 | kNormalizedU16 | kNormalizedS8 | kNormalizedS16;
    if (path == "translation") {
        return Output{ChannelPath::translation, file::kVec3, kFloat, 1};
    }
    if (path == "rotation") {
        return Output{ChannelPath::rotation, file::kVec4, kAny, 1};
    }
    if (path == "scale") {
        return Output{ChannelPath::scale, file::kVec3, kFloat, 1};
    }
    if (path == "weights" && targetCount > 0) {
        return Output{ChannelPath::weights, file::kScalar, kAny, targetCount};
    }
    return std::nullopt;
}

Channel readChannel(const Document& document, const file::Animation& animation, const file::AnimationChannel& from,
                    const Output& kind, const std::string& element) {
    Channel channel;
    channel.node = static_cast<uint32_t>(from.node);
    channel.path = kind.path;
    const auto& sampler = animation.samplers[static_cast<size_t>(from.sampler)];
    if (sampler.broken) {
        refuse(element, at("sampler", static_cast<size_t>(from.sampler)) + " cannot be read");
    }
    channel.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                            : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubicSpline
                                                                     : Interpolation::linear;

    const std::string input = element + " input";
    channel.times = readFloats(document, sampler.input, file::kScalar, kFloat, input);
    checkKeyCount(channel, input);
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;

    const std::string output = element + " output";
    channel.values = readFloats(document, sampler.output, kind.type, kind.components, output);
    const size_t elements = accessorCount(document, sampler.output);
    const size_t perKey = cubic ? 3 : 1;
    const bool fromKeys = kind.width == kFromKeys;
    const size_t width = fromKeys ? std::max<size_t>(elements / (perKey * channel.times.size()), 1) : kind.width;
    // The quotient is formed instead of the product, which might overflow.
    if (elements % (perKey * width) != 0 || elements / (perKey * width) != channel.times.size()) {
        refuse(output, counted(elements, "element", "elements") + " for " +
                           counted(channel.times.size(), "key", "keys") +
                           (channel.path == ChannelPath::weights && !fromKeys
                                ? " of " + counted(width, "morph target", "morph targets")
                                : "") +
                           (cubic ? " of CUBICSPLINE" : ""));
    }
    mendKeys(input, output, channel.values.size() / elements, *document.leniency, channel);
    checkTimes(channel, input);
    checkValues(channel, channel.values.size() / elements, output);
    return channel;
}

/// What a channel moves that is not read, as messages have it.
std::string whatIsIgnored(const file::AnimationChannel& channel) {
    if (channel.path == "weights") {
        return "weights of nodes without morph targets";
    }
    if (channel.path != "pointer") {
        return channel.path;
    }
    return channel.pointer.empty() ? "no node" : "KHR_animation_pointer to " + quoted(kindOfPointer(channel.pointer));
}

/// Reads clips one after the other, and bounds what they hold together.
class ClipReader {
public:
    ClipReader(const Document& document, Skeleton& skeleton, std::span<const size_t> targetCounts, Warnings& warnings)
        : document_(document), skeleton_(skeleton), targetCounts_(targetCounts), warnings_(warnings) {}

    Clip read(size_t index) {
        const auto& animation = document_.model.animations[index];
        const std::string element = at("animation", index);
        Clip clip;
        clip.name = animation.name.empty() ? "clip_" + std::to_string(index) : animation.name;
        ignored_.clear();
        targets_.clear();
        document_.memory->take(animation.channels.size(), 4 * sizeof(Channel), element);
        for (size_t k = 0; k < animation.channels.size(); ++k) {
            if (!animation.channels[k].broken) {
                document_.leniency->leaveOut([&] { addChannel(animation, k, element + " " + at("channel", k), clip); });
            }
        }
        addCurves(animation, element, clip);
        const float first = beginAtFirstKey(clip, element, warnings_);
        clip.duration = lastKey(clip);
        clip.markers = readMarkers(animation.extras, element, first, clip.duration, warnings_);
        for (const auto& [what, count] : ignored_) {
            warn(warnings_, element, counted(count, "channel", "channels") + " of " + what + " ignored");
        }
        return clip;
    }

private:
    void addChannel(const file::Animation& animation, size_t k, const std::string& element, Clip& clip) {
        file::AnimationChannel channel = animation.channels[k];
        resolvePointer(targetCounts_.size(), element, channel);
        const std::string& path = channel.path;
        const std::optional<Output> kind =
            outputOf(path, channel.node < 0 ? 0 : targetCounts_[static_cast<size_t>(channel.node)]);
        if (!kind) {
            ++ignored_[whatIsIgnored(channel)];
            return;
        }
        if (targets_.contains({channel.node, path})) {
            refuse(element, "a second channel for " + path + " of node " + std::to_string(channel.node));
        }
        // One that cannot be read is none: it takes no other's place, and no matrix apart.
        Channel read = readChannel(document_, animation, channel, *kind, element);
        if (kind->path != ChannelPath::weights) {
            takeMatrixApart(static_cast<uint32_t>(channel.node), element);
        }
        targets_.emplace(channel.node, path);
        clip.channels.push_back(std::move(read));
        count(clip.channels.back(), element);
    }

    /// extras.sharpness: what the clip gives to crease sets. Entries that make no sense are left out with a warning.
    void addCurves(const file::Animation& animation, const std::string& element, Clip& clip) {
        const Json* entries = animation.extras.isObject() ? member(animation.extras, "sharpness") : nullptr;
        if (entries == nullptr) {
            return;
        }
        const std::string list = element + " extras sharpness";
        if (!entries->isArray()) {
            warn(warnings_, list, "not an array; ignored");
            return;
        }
        EntryFaults faults(list);
        std::set<std::string> known;
        for (size_t i = 0; i < entries->size(); ++i) {
            const Json& entry = (*entries)[i];
            const Json* set = entry.isObject() ? member(entry, "set") : nullptr;
            const Json* sampler = entry.isObject() ? member(entry, "sampler") : nullptr;
            const double number = sampler != nullptr && sampler->isNumber() ? sampler->number() : -1.0;
            if (set == nullptr || !set->isString() || set->string().empty()) {
                faults.add(i, "set is not a name");
            } else if (!(number >= 0.0 && number < static_cast<double>(animation.samplers.size())) ||
                       std::floor(number) != number) {
                faults.add(i, "no such sampler");
            } else if (!known.insert(set->string()).second) {
                faults.add(i, "a second curve for " + quoted(set->string()));
            } else {
                document_.leniency->leaveOut(
                    [&] { addCurve(animation, static_cast<int>(number), set->string(), item(list, i), clip); });
            }
        }
        faults.report(warnings_);
    }

    void addCurve(const file::Animation& animation, int sampler, const std::string& set, const std::string& element,
                  Clip& clip) {
        file::AnimationChannel from;
        from.node = 0;
        from.sampler = sampler;
        const Output kind{ChannelPath::weights, file::kScalar, kFloat, 1};
        clip.sharpness.push_back({set, readChannel(document_, animation, from, kind, element)});
        count(clip.sharpness.back().keys, element);
    }

    void count(const Channel& channel, const std::string& element) {
        floats_ += channel.times.size() + channel.values.size();
        // Accessors may be shared, so a small file can ask for long clips.
        if (floats_ > kMaxClipFloats) {
            refuse(element, "the clips hold more than " + std::to_string(kMaxClipFloats) + " numbers",
                   ErrorCode::limit);
        }
    }

    /// A matrix cannot be animated in parts.
    void takeMatrixApart(uint32_t number, const std::string& element) {
        Node& node = skeleton_.nodes[number];
        if (!node.hasMatrix) {
            return;
        }
        const std::string reason = "animates node " + std::to_string(number) + ", which has a matrix";
        Node parts = node;
        if (!decompose(parts)) {
            refuse(element, reason);
        }
        document_.leniency->mend(element, reason, "the matrix is taken apart");
        node = parts;
    }

    const Document& document_;
    Skeleton& skeleton_;
    const std::span<const size_t> targetCounts_;
    Warnings& warnings_;
    uint64_t floats_ = 0;
    std::map<std::string, size_t> ignored_;         ///< of the clip: what -> channels
    std::set<std::pair<int, std::string>> targets_; ///< of the clip
};

} // namespace

std::vector<Clip> readClips(const Document& document, Skeleton& skeleton, std::span<const size_t> targetCounts,
                            Warnings& warnings) {
    ClipReader reader(document, skeleton, targetCounts, warnings);
    std::vector<Clip> clips;
    for (size_t i = 0; i < document.model.animations.size(); ++i) {
        clips.push_back(reader.read(i));
    }
    return clips;
}

ClipSet readMotion(const Document& document, const std::string& name) {
    const auto& meshes = document.model.meshes;
    ClipSet set;
    set.name = name;
    set.skeleton = readSkeleton(document);
    Warnings ofMeshes;                 // which are not read
    std::vector<size_t> targetsOfMesh; // a mesh may have no primitives that can be read
    for (size_t m = 0; m < meshes.size(); ++m) {
        size_t targets = 0;
        for (const file::Primitive& primitive : meshes[m].primitives) {
            targets = std::max(targets, primitive.targets.size());
        }
        targetsOfMesh.push_back(targets);
        set.targetNames.push_back(readTargetNames(document.meshes[m], at("mesh", m), *document.memory, ofMeshes).names);
    }
    std::vector<size_t> targetCounts;
    for (const auto& node : document.model.nodes) {
        set.meshes.push_back(node.mesh < 0 ? kNone : static_cast<uint32_t>(node.mesh));
        const size_t targets = node.mesh < 0 ? 0 : targetsOfMesh[static_cast<size_t>(node.mesh)];
        targetCounts.push_back(targets > 0 ? targets : kFromKeys);
    }
    set.clips = readClips(document, set.skeleton, targetCounts, set.warnings);
    document.leniency->raise();
    for (const Damage& damage : document.leniency->takeDamages()) {
        set.warnings.push_back(damage.found + "; " + damage.repair);
    }
    const auto& animations = document.model.animations;
    for (size_t i = 0; i < animations.size(); ++i) {
        if (animations[i].name.empty()) {
            set.clips[i].name = stemOf(name) + (animations.size() > 1 ? "_" + std::to_string(i) : "");
        }
    }
    return set;
}

} // namespace supple::cage::gltf
