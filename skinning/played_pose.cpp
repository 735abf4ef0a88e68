#include "skinning/played_pose.h"

#include <algorithm>

namespace supple::skinning {
namespace {

double clipTimeAt(const PlaybackLayer& layer, double time) {
    return layer.offset + static_cast<double>(layer.speed) * (time - layer.start);
}

double weightAt(const PlaybackLayer& layer, double time) {
    const double from = layer.weight, to = layer.fadeWeight;
    if (!(layer.fadeDuration > 0.0f)) {
        return from;
    }
    const double faded = (time - layer.fadeStart) / static_cast<double>(layer.fadeDuration);
    return faded <= 0.0 ? from : faded >= 1.0 ? to : from + (to - from) * faded;
}

} // namespace

Layer layerAt(const cage::Character& character, const PlaybackLayer& layer, double time,
              std::span<const float> jointMask) {
    Layer result;
    result.clip = &character.clips[layer.clip];
    result.time = clipTimeAt(layer, time);
    result.previousTime = layer.offset;
    result.referenceTime = layer.referenceTime;
    result.weight = weightAt(layer, time);
    result.mode = layer.mode;
    result.loop = layer.loop;
    result.jointMask = jointMask;
    return result;
}

void poseNodes(const cage::Character& character, const Rig& rig, const PlaybackDesc& desc, double time,
               std::span<const float> jointMasks, PoseMemory& memory) {
    const size_t joints = character.skin.joints.size();
    restPose(character, memory.pose);
    for (const PlaybackLayer& layer : desc.layers) {
        const std::span<const float> mask =
            layer.mask == 0 ? std::span<const float>() : jointMasks.subspan((layer.mask - 1) * joints, joints);
        applyLayer(character, rig, layerAt(character, layer, time, mask), desc.root, memory.scratch, memory.pose);
    }
    localMatrices(character.skeleton, memory.pose, memory.nodes);
    globalTransforms(character.skeleton, memory.nodes, memory.nodes);
}

RootMotion traveledBy(const cage::Character& character, const PlaybackDesc& desc, double time) {
    if (!desc.travels || desc.layers.empty()) {
        return {};
    }
    const Layer first = layerAt(character, desc.layers.front(), time, {});
    return rootMotionBetween(character, *first.clip, desc.root, first.previousTime, first.time, first.loop);
}

double loopsAt(const cage::Character& character, const PlaybackLayer& layer, double time) {
    const double duration = character.clips[layer.clip].duration;
    return layer.loop && duration > 0.0 ? loopTime(clipTimeAt(layer, time), duration).loops : 0.0;
}

bool clampsBetween(const cage::Character& character, const PlaybackLayer& layer, double first, double last) {
    const double duration = character.clips[layer.clip].duration;
    const auto sideOf = [&](double time) {
        const double at = clipTimeAt(layer, time);
        return at < 0.0 ? -1 : at > duration ? 1 : 0;
    };
    return !layer.loop && sideOf(first) != sideOf(last);
}

RootMotion traveledToLoop(const cage::Character& character, const PlaybackLayer& layer, const RootSelection& root,
                          double loops) {
    const cage::Clip& clip = character.clips[layer.clip];
    return rootMotionBetween(character, clip, root, layer.offset, loops * clip.duration, layer.loop);
}

} // namespace supple::skinning
