// How much room the instances of a group that plays take on the device.
#pragma once

#include "runtime/asset.h"
#include "shaders/shared/pose.h"
#include "skinning/deform_kernels.h"
#include "skinning/pose_kernels.h"

#include <cstdint>
#include <supple/supple.h>
#include <vulkan/vulkan_core.h>

namespace supple::runtime {

/// What instances may have beside layers: there is room for it.
struct StateRoom {
    bool modifiers = false;
    // For instances that play on the device:
    bool transitions = false;
    bool updateRates = false;
    // For these, and for those whose poses the host sets:
    bool springs = false; ///< some joints of the asset swing
    bool soft = false;    ///< some vertices of the asset jiggle or are cloth
    bool cloths = false;  ///< are cloth

    /// Instances run steps on a grid of times, each posed by itself.
    [[nodiscard]] constexpr bool hasSteps() const { return springs || soft; }
};

/// Poses are made of what nodes do: the asset needs its clip table.
[[nodiscard]] constexpr bool posesNodes(SupplePoseSource source, bool modifiers, bool springs) {
    return source == SUPPLE_POSES_PLAYBACK || modifiers || springs;
}

/// What a group that plays, with such room, needs of the pose pass.
[[nodiscard]] skinning::PoseNeeds poseNeeds(const StateRoom& room, const cage::Character& character, bool hasMorphs);

/// The most that an instance takes of a buffer that is bound by windows; a multiple of every descriptor alignment.
[[nodiscard]] VkDeviceSize playbackWindowBytes(const Asset& asset, const skinning::PoseLayout& layout,
                                               const StateRoom& room);

/// Steps of an instance that are posed side by side. A frame with more due runs them in rounds, one behind the other,
/// which share their working memory (runtime/early_steps.h).
inline constexpr uint32_t kStepsInRound = 1;

/// Poses of an instance for which there is working memory.
[[nodiscard]] uint32_t posesInFrame(const StateRoom& room);

/// Poses of an instance that are kept beside what is shown: ends of update rates, or those of the steps of a round
/// for what is soft.
[[nodiscard]] uint32_t unshownPoses(const StateRoom& room);

/// From one pose that is not shown to the next. An instance has `poses` of them, a power of two or none; together they
/// are a multiple of every descriptor alignment.
[[nodiscard]] uint32_t unshownStride(const skinning::PoseLayout& layout, uint32_t poses);

/// Of a transition in a state; 0: instances have none.
[[nodiscard]] uint32_t transitionElements(const skinning::ClipTable& table, const skinning::PoseLayout& layout,
                                          const StateRoom& room);

/// What the dispatches of the pose pass have in common, whatever their window and time.
[[nodiscard]] shared::PosePush posePushOf(const Asset& asset, const skinning::PoseLayout& layout,
                                          const StateRoom& room);

} // namespace supple::runtime
