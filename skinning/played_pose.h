// What an instance plays, put together on the CPU: the twin of the pose pass (shaders/pose).
#pragma once

#include "cage/character.h"
#include "skinning/layers.h"
#include "skinning/playback.h"
#include "skinning/root_motion.h"

#include <glm/glm.hpp>
#include <span>

namespace supple::skinning {

/// What `layer` is at the group's time: a layer of that clip time and weight. Morph weights are not asked for: the
/// mask is one value per joint, or empty.
[[nodiscard]] Layer layerAt(const cage::Character& character, const PlaybackLayer& layer, double time,
                            std::span<const float> jointMask);

/// Leaves the nodes' global transforms in model space at the group's time in memory.nodes. `jointMasks`: mask m of the
/// layers is the m-th run of as many values as the skin has joints. Allocates nothing.
void poseNodes(const cage::Character& character, const Rig& rig, const PlaybackDesc& desc, double time,
               std::span<const float> jointMasks, PoseMemory& memory);

/// What stands between the instance's transform and model space: how far its first layer has carried it, or nothing.
[[nodiscard]] RootMotion traveledBy(const cage::Character& character, const PlaybackDesc& desc, double time);
/// How many whole loops of a layer's clip lie before a time; 0 if it does not loop.
[[nodiscard]] double loopsAt(const cage::Character& character, const PlaybackLayer& layer, double time);
/// Whether a layer that does not loop comes to the beginning or the end of its clip between two times.
[[nodiscard]] bool clampsBetween(const cage::Character& character, const PlaybackLayer& layer, double first,
                                 double last);
/// The part of traveledBy() up to the beginning of that loop.
[[nodiscard]] RootMotion traveledToLoop(const cage::Character& character, const PlaybackLayer& layer,
                                        const RootSelection& root, double loops);

} // namespace supple::skinning
