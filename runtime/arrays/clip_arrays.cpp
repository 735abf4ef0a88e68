#include "runtime/arrays/clip_arrays.h"

#include "cage/clip_checks.h"
#include "cage/clip_set.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace supple::runtime {

namespace {

cage::Interpolation interpolationOf(SuppleKeyInterpolation from) {
    return from == SUPPLE_KEYS_STEP          ? cage::Interpolation::step
           : from == SUPPLE_KEYS_CUBICSPLINE ? cage::Interpolation::cubicSpline
                                             : cage::Interpolation::linear;
}

cage::ChannelPath pathOf(SuppleChannelPath from) {
    constexpr cage::ChannelPath kPaths[] = {cage::ChannelPath::translation, cage::ChannelPath::rotation,
                                            cage::ChannelPath::scale, cage::ChannelPath::weights};
    return kPaths[from];
}

const char* nameOfPath(SuppleChannelPath path) {
    constexpr const char* kNames[] = {"translation", "rotation", "scale", "weights"};
    return kNames[path];
}

/// Reads clips one after the other, and bounds what they hold together.
class ClipArrayReader {
public:
    ClipArrayReader(const cage::Skeleton& skeleton, std::span<const size_t> targetCounts, cage::Refusals& refusals,
                    cage::Warnings& warnings)
        : skeleton_(skeleton), targetCounts_(targetCounts), refusals_(refusals), warnings_(warnings) {}

    cage::Clip read(const SuppleClipDesc& desc, uint32_t index) {
        cage::Clip clip;
        clip.name = orEmpty(desc.name).empty() ? "clip_" + std::to_string(index) : desc.name;
        Faults faults(refusals_, cage::at("clip", index));
        moved_.clear();
        size_t ignored = 0;
        const std::vector<SuppleChannelDesc> channels = takeArray(desc.channels, desc.channelCount, "channels", faults);
        for (uint32_t c = 0; c < channels.size(); ++c) {
            Faults own(refusals_, faults.element() + " " + cage::at("channel", c));
            if (isIgnored(channels[c])) {
                ++ignored;
            } else {
                own.gather([&] { addChannel(channels[c], clip, own); });
            }
        }
        if (ignored > 0) {
            cage::warn(warnings_, faults.element(),
                       cage::counted(ignored, "channel", "channels") +
                           " of weights of nodes without morph targets ignored");
        }
        readCurves(desc, clip, faults);
        const float first = cage::beginAtFirstKey(clip, faults.element(), warnings_);
        readDuration(desc, first, clip, faults);
        readMarkers(desc, first, clip, faults);
        return clip;
    }

private:
    [[nodiscard]] bool isIgnored(const SuppleChannelDesc& desc) const {
        return desc.path == SUPPLE_PATH_WEIGHTS && desc.node < targetCounts_.size() && targetCounts_[desc.node] == 0;
    }

    void addChannel(const SuppleChannelDesc& desc, cage::Clip& clip, Faults& faults) {
        if (rawValue(desc.path) > SUPPLE_PATH_WEIGHTS || rawValue(desc.interpolation) > SUPPLE_KEYS_CUBICSPLINE) {
            faults.add("no such path or interpolation", ErrorCode::range);
            return;
        }
        if (desc.node >= skeleton_.nodes.size()) {
            faults.add("node " + std::to_string(desc.node) + " of " + std::to_string(skeleton_.nodes.size()));
            return;
        }
        if (!moved_.emplace(desc.node, desc.path).second) {
            faults.add(std::string("a second channel for ") + nameOfPath(desc.path) + " of " +
                       cage::at("node", desc.node));
        }
        if (desc.path != SUPPLE_PATH_WEIGHTS && skeleton_.nodes[desc.node].hasMatrix) {
            faults.add("animates " + cage::at("node", desc.node) + ", which has a matrix");
        }
        const uint64_t width = desc.path == SUPPLE_PATH_WEIGHTS    ? targetCounts_[desc.node]
                               : desc.path == SUPPLE_PATH_ROTATION ? 4
                                                                   : 3;
        const uint64_t perKey = width * (desc.interpolation == SUPPLE_KEYS_CUBICSPLINE ? 3 : 1);
        if (desc.keyCount == 0 || desc.valueCount != perKey * desc.keyCount) {
            faults.add(desc.keyCount == 0
                           ? "no keys"
                           : cage::counted(desc.valueCount, "number", "numbers") + " for " +
                                 cage::counted(desc.keyCount, "key", "keys") + " of " + std::to_string(perKey));
            return;
        }
        if (!faults.present(1, "times or values", desc.times, desc.values)) {
            return;
        }
        cage::Channel& channel = clip.channels.emplace_back();
        channel.node = desc.node;
        channel.path = pathOf(desc.path);
        channel.interpolation = interpolationOf(desc.interpolation);
        channel.times.assign(desc.times, desc.times + desc.keyCount);
        channel.values.assign(desc.values, desc.values + desc.valueCount);
        faults.gather([&] { cage::checkTimes(channel, "times"); });
        faults.gather([&] { cage::checkValues(channel, 1, "values"); });
        count(channel, faults);
    }

    void readCurves(const SuppleClipDesc& desc, cage::Clip& clip, Faults& faults) {
        if (!faults.present(desc.sharpnessCurveCount, "sharpnessCurves", desc.sharpnessCurves)) {
            return;
        }
        std::set<std::string> known;
        for (uint32_t c = 0; c < desc.sharpnessCurveCount; ++c) {
            const SuppleSharpnessCurveDesc& from = desc.sharpnessCurves[c];
            Faults own(refusals_, (faults.element() + " ").append(cage::at("sharpness curve", c)));
            if (rawValue(from.interpolation) > SUPPLE_KEYS_CUBICSPLINE) {
                own.add("no such interpolation");
                continue;
            }
            if (orEmpty(from.set).empty() || !known.insert(from.set).second) {
                own.add("set is no name, or has a curve already");
                continue;
            }
            const size_t perKey = from.interpolation == SUPPLE_KEYS_CUBICSPLINE ? 3 : 1;
            if (from.keyCount == 0) {
                own.add("no keys");
                continue;
            }
            if (!own.present(from.keyCount, "times or values", from.times, from.values)) {
                continue;
            }
            cage::SharpnessCurve& curve = clip.sharpness.emplace_back();
            curve.set = from.set;
            curve.keys.path = cage::ChannelPath::weights;
            curve.keys.interpolation = interpolationOf(from.interpolation);
            curve.keys.times.assign(from.times, from.times + from.keyCount);
            curve.keys.values.assign(from.values, from.values + perKey * from.keyCount);
            own.gather([&] { cage::checkTimes(curve.keys, "times"); });
            own.gather([&] { cage::checkValues(curve.keys, 1, "values"); });
            count(curve.keys, own);
        }
    }

    void count(const cage::Channel& channel, Faults& faults) {
        floats_ += channel.times.size() + channel.values.size();
        if (floats_ > cage::kMaxClipFloats) {
            faults.add("the clips hold more than " + std::to_string(cage::kMaxClipFloats) + " numbers",
                       ErrorCode::limit);
        }
    }

    static void readDuration(const SuppleClipDesc& desc, double first, cage::Clip& clip, Faults& faults) {
        clip.duration = cage::lastKey(clip);
        if (!std::isfinite(desc.duration) || desc.duration < 0.0 || desc.duration > SUPPLE_MAX_COORDINATE) {
            faults.add("duration is negative, not finite or beyond 1e+09");
            return;
        }
        clip.duration = std::max(clip.duration, desc.duration > 0.0 ? desc.duration - first : 0.0);
    }

    static void readMarkers(const SuppleClipDesc& desc, double first, cage::Clip& clip, Faults& faults) {
        if (!faults.present(desc.markerCount, "markers", desc.markers)) {
            return;
        }
        for (uint32_t m = 0; m < desc.markerCount; ++m) {
            cage::Marker marker;
            marker.name = orEmpty(desc.markers[m].name);
            const double time = desc.markers[m].time;
            const std::optional<std::string> fault = std::isfinite(time)
                                                         ? cage::placeMarker(time, first, clip.duration, marker)
                                                         : std::optional<std::string>("time is not finite");
            if (fault) {
                faults.add(cage::at("marker", m) + ": " + *fault);
            }
            clip.markers.push_back(std::move(marker));
        }
        cage::sortMarkers(clip.markers);
    }

    const cage::Skeleton& skeleton_;
    const std::span<const size_t> targetCounts_;
    cage::Refusals& refusals_;
    cage::Warnings& warnings_;
    uint64_t floats_ = 0;
    std::set<std::pair<uint32_t, SuppleChannelPath>> moved_; ///< of the clip
};

} // namespace

std::vector<cage::Clip> readClipArrays(const SuppleCharacterDesc& desc, const cage::Skeleton& skeleton,
                                       std::span<const size_t> targetCounts, cage::Refusals& refusals,
                                       cage::Warnings& warnings) {
    Faults all(refusals, "");
    const std::vector<SuppleClipDesc> from = takeArray(desc.clips, desc.clipCount, "clips", all);
    ClipArrayReader reader(skeleton, targetCounts, refusals, warnings);
    std::vector<cage::Clip> clips;
    for (uint32_t c = 0; c < from.size(); ++c) {
        clips.push_back(reader.read(from[c], c));
    }
    return clips;
}

} // namespace supple::runtime
