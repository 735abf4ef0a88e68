#include "tools/gltf/part_weights.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <vector>

namespace supple::cage::gltf {
namespace {

/// One number of a linear channel.
float linearAt(const Channel& channel, float time, size_t number) {
    const size_t width = channel.width();
    const auto after =
        static_cast<size_t>(std::upper_bound(channel.times.begin(), channel.times.end(), time) - channel.times.begin());
    const size_t next = std::min(after, channel.times.size() - 1), key = after > 0 ? after - 1 : 0;
    const float begin = channel.times[key], end = channel.times[next];
    const float part = end > begin ? (time - begin) / (end - begin) : 0.0f;
    return std::lerp(channel.values[width * key + number], channel.values[width * next + number], part);
}

} // namespace

bool setsWeightsOf(const Channel& channel, const Part& part) {
    return channel.firstTarget < part.firstTarget + part.targetCount &&
           part.firstTarget < channel.firstTarget + channel.width();
}

std::optional<Channel> partWeights(const Clip& clip, const Part& part, std::span<const float> rest) {
    std::vector<const Channel*> own;
    std::set<float> times;
    const uint32_t end = part.firstTarget + part.targetCount;
    for (const Channel& channel : clip.channels) {
        if (channel.path != ChannelPath::weights || !setsWeightsOf(channel, part)) {
            continue;
        }
        if (channel.firstTarget == part.firstTarget && channel.width() == part.targetCount) {
            return channel;
        }
        own.push_back(&channel);
        times.insert(channel.times.begin(), channel.times.end());
    }
    if (own.empty()) {
        return std::nullopt;
    }
    Channel all;
    all.node = part.node;
    all.path = ChannelPath::weights;
    all.firstTarget = part.firstTarget;
    all.times.assign(times.begin(), times.end());
    for (const float time : all.times) {
        for (uint32_t target = part.firstTarget; target < end; ++target) {
            const auto from = std::find_if(own.rbegin(), own.rend(), [&](const Channel* channel) {
                return target >= channel->firstTarget && target - channel->firstTarget < channel->width();
            });
            all.values.push_back(from != own.rend() ? linearAt(**from, time, target - (*from)->firstTarget)
                                                    : rest[target]);
        }
    }
    return all;
}

} // namespace supple::cage::gltf
