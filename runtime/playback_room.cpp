#include "runtime/playback_room.h"

#include "gpu/memory.h"
#include "skinning/layers.h"
#include "skinning/playback.h"
#include "skinning/transition.h"

#include <algorithm>

namespace supple::runtime {

skinning::PoseNeeds poseNeeds(const StateRoom& room, const cage::Character& character, bool hasMorphs) {
    skinning::PoseNeeds needs;
    needs.mixes = room.updateRates;
    needs.steps = room.hasSteps();
    needs.springs = room.springs;
    needs.drivers = hasMorphs && !character.drivers.empty();
    needs.morphs = hasMorphs;
    needs.clips = skinning::clipKinds(character);
    return needs;
}

uint32_t transitionElements(const skinning::ClipTable& table, const skinning::PoseLayout& layout,
                            const StateRoom& room) {
    return room.transitions ? skinning::transitionElements(static_cast<uint32_t>(table.nodes.size()), layout.morphCount)
                            : 0;
}

namespace {

using namespace supple::shared;

/// Elements: descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits).
constexpr uint32_t kPadding = 16;

uint32_t padded(uint32_t elements) {
    return (elements + kPadding - 1) / kPadding * kPadding;
}

/// Where the transition begins in a state.
uint32_t transitionBegin(const skinning::PoseLayout& layout, const StateRoom& room) {
    return skinning::PlaybackState::elements(layout.morphCount, room.modifiers ? kMaxModifiers : 0);
}

/// From what an instance plays to what it has played before the last call, which is there with steps.
uint32_t playedStride(const skinning::ClipTable& table, const skinning::PoseLayout& layout, const StateRoom& room) {
    return padded(transitionBegin(layout, room) + transitionElements(table, layout, room));
}
uint32_t stateStride(const skinning::ClipTable& table, const skinning::PoseLayout& layout, const StateRoom& room) {
    return (room.hasSteps() ? 2 : 1) * playedStride(table, layout, room);
}

/// Behind the nodes and the place.
uint32_t springScratch(const skinning::ClipTable& table, const StateRoom& room) {
    return kAffineElements * (static_cast<uint32_t>(table.nodes.size()) + 1) + (room.modifiers ? table.footCount : 0);
}
uint32_t scratchStride(const skinning::ClipTable& table, const StateRoom& room) {
    const uint32_t colliders = room.springs ? kPosedColliderElements * table.springColliderCount : 0;
    return padded(springScratch(table, room) + (room.hasSteps() ? kAffineElements + colliders : 0));
}
uint32_t springStride(const skinning::ClipTable& table, const StateRoom& room) {
    return room.springs ? padded(kSpringJoints + kSpringJointElements * table.springJointCount) : 0;
}

} // namespace

uint32_t posesInFrame(const StateRoom& room) {
    return room.updateRates ? 2 : room.hasSteps() ? 1 + kStepsInRound : 1;
}

uint32_t unshownPoses(const StateRoom& room) {
    return room.updateRates ? kPoseEnds : room.soft ? kStepsInRound : 0;
}

uint32_t unshownStride(const skinning::PoseLayout& layout, uint32_t poses) {
    const uint32_t multiple = poses > 0 ? kPadding / poses : 1;
    return poses > 0 ? (layout.elements() + multiple - 1) / multiple * multiple : 0;
}

VkDeviceSize playbackWindowBytes(const Asset& asset, const skinning::PoseLayout& layout, const StateRoom& room) {
    const skinning::ClipTable& table = *asset.clipTable;
    return std::max({stateStride(table, layout, room), posesInFrame(room) * scratchStride(table, room),
                     unshownPoses(room) * unshownStride(layout, unshownPoses(room)), springStride(table, room)}) *
           gpu::kVec4Bytes;
}

PosePush posePushOf(const Asset& asset, const skinning::PoseLayout& layout, const StateRoom& room) {
    const skinning::ClipTable& table = *asset.clipTable;
    PosePush push{};
    push.nodeCount = static_cast<uint32_t>(table.nodes.size());
    push.jointCount = table.jointCount;
    push.morphCount = layout.morphCount;
    push.joints = table.joints;
    push.levels = table.levels;
    push.levelCount = table.levelCount;
    push.restWeights = table.restWeights;
    push.clips = table.clips;
    push.stateStride = stateStride(table, layout, room);
    push.transition = transitionBegin(layout, room);
    push.maskStride = skinning::maskElements(table);
    push.scratchStride = scratchStride(table, room);
    push.contacts = table.contacts;
    push.poseStride = layout.stride;
    push.endStride = unshownStride(layout, unshownPoses(room));
    push.morphWeights = layout.morphWeights;
    push.shown = UINT32_MAX;
    const bool poseAll = room.soft && skinning::isMush(layout.mode);
    push.stepNodes =
        room.modifiers || poseAll ? 0 : (room.springs ? kNodeOfSprings : 0) | (room.soft ? kNodeOfSoft : 0);
    push.stepNodes |= room.soft ? kStepsHavePoses : 0;
    push.stepNodes |= poseAll ? kStepsPoseAll : 0;
    push.stateBefore = playedStride(table, layout, room);
    push.springs = room.springs ? table.springs : 0;
    push.springScratch = springScratch(table, room);
    push.springStride = springStride(table, room);
    push.drivers = layout.morphCount > 0 ? table.drivers : 0;
    return push;
}

} // namespace supple::runtime
