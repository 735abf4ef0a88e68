#include "skinning/coarse_clip.h"

#include "skinning/packed_clip.h"

namespace supple::skinning {

std::optional<cage::Clip> coarseClip(const NodeOrder& order, const cage::Clip& clip) {
    if (clip.packed.coarseWords.empty()) {
        return std::nullopt;
    }
    const Result<PackedClip> packed =
        readPackedWords(clip.packed.coarseWords, clip.duration, {order.nodes.size(), order.targetCount});
    if (!packed) {
        return std::nullopt;
    }
    cage::Clip coarse;
    coarse.name = clip.name;
    coarse.duration = clip.duration;
    coarse.channels = channelsOf(*packed, clip.duration, order.nodes, order.targetCount);
    coarse.channels.insert(coarse.channels.end(), clip.channels.begin() + clip.packed.channelCount,
                           clip.channels.end());
    return coarse;
}

} // namespace supple::skinning
