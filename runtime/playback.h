// What a group's instances play on the device: their states, uploaded when they change, and the group's share of the
// pose pass.
#pragma once

#include "base/result.h"
#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "runtime/asset.h"
#include "runtime/asset_match.h"
#include "runtime/instance_modifiers.h"
#include "runtime/instance_state.h"
#include "runtime/instance_windows.h"
#include "runtime/played_bounds.h"
#include "runtime/pose_list.h"
#include "runtime/spring_clock.h"
#include "runtime/update_rates.h"
#include "skinning/deform_kernels.h"
#include "skinning/layers.h"
#include "skinning/playback.h"
#include "skinning/pose_kernels.h"
#include "skinning/pose_twin.h"
#include "skinning/transition.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// What instances may have beside layers: there is room for it.
struct StateRoom {
    bool modifiers = false;
    // For instances that play on the device:
    bool transitions = false;
    bool updateRates = false;
    bool springs = false; ///< some joints of the asset swing
};

/// What suppleSetPlayback says beside the layers.
struct TransitionRequest {
    skinning::TransitionKind kind = skinning::TransitionKind::deadBlending;
    float seconds = 0.0f;      ///< 0: none
    bool fromModified = false; ///< from what modifiers have left
    bool keeps = false;        ///< the transition that the instance is in
};

/// Setting and recording allocate nothing. Without update rates and springs, a frame without anything set uploads
/// nothing and costs the same for any number of instances.
class Playback {
public:
    struct Desc {
        const gpu::Device* device = nullptr;
        const skinning::PoseKernels* kernels = nullptr;
        Asset* asset = nullptr; ///< with its clip table; must outlive this
        skinning::PoseLayout layout;
        uint32_t capacity = 0;
        uint32_t windowSize = 0; ///< instances that one descriptor set reaches
        uint32_t framesInFlight = 2;
        VkBuffer poses = VK_NULL_HANDLE;     ///< written
        VkBuffer instances = VK_NULL_HANDLE; ///< the lists of instances
        VkDeviceSize instanceBytes = 0;
        StateRoom room;
    };
    Playback() = default;
    [[nodiscard]] static Result<Playback> create(const Desc& desc);
    /// The most that an instance takes of a buffer that is bound by windows; a multiple of every descriptor alignment.
    [[nodiscard]] static VkDeviceSize windowBytes(const Asset& asset, const skinning::PoseLayout& layout,
                                                  const StateRoom& room);

    void reset(uint32_t slot); ///< bind pose, no morph weights of the host's, identity transform
    /// An instance in the bind pose begins at once.
    /// `updateInterval`: steps of the grid of times from pose to pose; 0: by the size on the screen.
    void set(uint32_t slot, const skinning::PlaybackDesc& desc, const TransitionRequest& request = {},
             uint32_t updateInterval = 0);
    [[nodiscard]] bool takesUpdateRates() const { return rates_.areTaken(); }
    /// What was asked for, or what the size on the screen has chosen.
    [[nodiscard]] uint32_t updateIntervalOf(uint32_t slot) const { return rates_.interval(slot); }
    [[nodiscard]] bool takesTransitions() const { return transitionElements_ > 0; }
    /// Some joints swing. What is said of joints on the CPU, and of poses, is without that.
    [[nodiscard]] bool hasSprings() const { return springs_.isTaken(); }
    /// A frame poses what listPoses() has listed, not all that the group works on.
    [[nodiscard]] bool listsPoses() const { return takesUpdateRates() || hasSprings(); }
    /// Its springs see no movement from where it stood to where it stands in the next frame.
    void teleport(uint32_t slot);
    /// All begin anew: tails at rest in the pose.
    void settleSprings() { springs_.settleAll(); }
    void setTransform(uint32_t slot, const glm::mat4& transform);
    void setPosition(uint32_t slot, const glm::dvec3& position);
    /// Where the coordinates of the device begin. A change places the instances of the slots below `end` anew; others
    /// must begin with reset().
    void setOrigin(const glm::dvec3& origin, uint32_t end);
    void setMorphWeights(uint32_t slot, const float* weights); ///< null: the clips' own again
    void setTime(double seconds);

    /// Replaces the instance's list. The group must have room for modifiers.
    void setModifiers(uint32_t slot, std::span<const PlacedModifier> modifiers);
    /// The instance must have this modifier.
    void setModifierGoal(uint32_t slot, uint32_t index, const ModifierGoal& goal);
    [[nodiscard]] bool takesModifiers() const { return modifiers_.areTaken(); }
    [[nodiscard]] uint32_t modifierCount(uint32_t slot) { return state(slot).modifierCount(); }
    [[nodiscard]] std::span<const uint32_t> modifierWords(uint32_t slot, uint32_t index) {
        return modifiers_.words(state(slot), index);
    }

    /// Masks are numbered from 1; a layer's mask must have been set.
    void setMask(uint32_t mask, std::span<const float> joints, std::span<const float> morphs);
    [[nodiscard]] bool hasMask(uint32_t mask) const { return masksSet_[mask - 1] != MaskKind::none; }

    /// Where the joint is at the group's time, with the bits that the device has. The pose of the slot that was asked
    /// for last is kept until what plays, where it stands, the time or a mask changes.
    [[nodiscard]] glm::mat4 jointTransform(uint32_t slot, uint32_t joint);
    /// The pose as the next recording leaves it on the device: all elements but those of padding.
    void writePose(uint32_t slot, std::span<glm::vec4> pose);

    // What the device reads: of the slot, and the masks.
    [[nodiscard]] std::span<const uint32_t> stateOf(uint32_t slot) const {
        const size_t words = size_t{push_.stateStride} * 4;
        return std::span(states_).subspan(slot * words, words);
    }
    [[nodiscard]] std::span<const float> masks() const { return masks_; }

    /// A box that holds the instance's cage at the group's time, where the next recording places it; nothing if nobody
    /// knows. It is found without a pose.
    [[nodiscard]] std::optional<skinning::Box> boundsOf(uint32_t slot, const skinning::Reach& reach);

    /// Another number whenever boundsOf() may give another box; never 0.
    [[nodiscard]] uint64_t boundsVersion(uint32_t slot) const {
        return uint64_t{versions_[slot]} << 32 | bounds_.loopOf(slot, time_);
    }

    /// Takes over the time, the masks and the first `count` instances, of the same asset or of another version of it.
    /// Layers whose clip the other version lacks are left out. Joints and morph targets that it lacks have in a mask
    /// what they would have if the mask did not name them.
    void takeOver(Playback& other, uint32_t count, const AssetMatch& match);

    /// What has changed since it was recorded last; the bytes of it.
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    void beginFrame(uint64_t completedFrame);
    /// The command buffers of `frame` will never run: what was recorded in it is due again.
    void cancelFrame(uint64_t frame);

    // If listsPoses(), in each frame, before its parts of the pass. The interval of an instance whose size on the
    // screen decides is chosen with setSize(); until then it is posed in every frame.
    void takeStep() { steps_.take(time_); } ///< a recording begins
    /// Whether setSize() is waited for.
    [[nodiscard]] bool asksForSize(uint32_t slot) const { return rates_.course(slot).asked == 0; }
    /// `pixelsPerUnit`: at most, where the instance is.
    void setSize(uint32_t slot, float pixelsPerUnit);
    void forgetSizes() { rates_.forgetChoices(); }
    /// Lists what is posed in a frame, of the instances that `worksOn` holds for.
    template <class WorksOn>
    void listPoses(uint64_t frame, const InstanceWindows& windows, uint32_t end, WorksOn&& worksOn) {
        list_.clear();
        firstStep_ = time_;
        for (uint32_t w = 0; w < windows.count(); ++w) {
            const uint32_t first = windows.firstSlot(w), last = std::min(first + windows.slots(w), end);
            for (uint32_t slot = first; slot < last; ++slot) {
                if (worksOn(slot)) {
                    hasSprings() ? listSteps(frame, slot, slot - first) : listPose(slot, slot - first);
                }
            }
            list_.endWindow(w);
        }
    }
    VkDeviceSize recordList(VkCommandBuffer commandBuffer, uint64_t frame);

    enum class Part { locals, roots, modifiers, springs, palette, mix };
    static constexpr uint32_t kParts = 6;
    /// A part of the pass over the instances of a window.
    void record(gpu::Dispatches& dispatches, Part part, uint32_t window, const InstanceWindows& windows) const;
    /// Whether there is anything to record of a part.
    [[nodiscard]] bool has(Part part) const;
    /// What the tasks of all parts follow from, beside windows and time; never 0.
    [[nodiscard]] uint64_t tasksMade() const;
    /// How their push constants (shared::PosePush) begin.
    [[nodiscard]] skinning::SplitTime splitTime() const { return skinning::splitTime(time_); }
    /// Poses that a frame makes of these instances.
    [[nodiscard]] uint32_t poseCount(const InstanceWindows& windows) const {
        return listsPoses() ? list_.poseCount() : windows.visible;
    }

    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer) const;

    [[nodiscard]] gpu::MemoryUse memoryUse() const;

private:
    enum BufferIndex : size_t { kStates, kMasks, kScratch, kEnds, kList, kBufferCount };
    enum StagingIndex : size_t { kStateStaging, kMaskStaging, kListStaging, kStagingCount };

    void makeLists(const Desc& desc); ///< of instances with update rates, or springs
    Status createBuffers(const Desc& desc);
    Status createSets(const Desc& desc);
    [[nodiscard]] VkDeviceSize stateBytes() const { return VkDeviceSize{push_.stateStride} * 16; }
    [[nodiscard]] skinning::PlaybackState state(uint32_t slot);
    [[nodiscard]] glm::mat4 placement(uint32_t slot) const;
    void place(uint32_t slot);
    void takeModifiers(uint32_t slot);                   ///< bounds_ is told what they turn
    [[nodiscard]] VkDeviceSize usedBytes(uint32_t slot); ///< of its state, but for the transition
    [[nodiscard]] std::span<uint32_t> stateWords(uint32_t slot) {
        const size_t words = size_t{push_.stateStride} * 4;
        return std::span(states_).subspan(slot * words, words);
    }
    void sample(uint32_t slot, double time, bool modified, skinning::SampledPose& pose);
    [[nodiscard]] std::span<uint32_t> transitionWords(uint32_t slot);
    void sampleShown(uint32_t slot, const TransitionRequest& request);
    void startTransition(uint32_t slot, const TransitionRequest& request);
    void stage(VkDeviceSize& from, VkDeviceSize to, VkDeviceSize bytes); ///< a piece of states_, for regions_
    [[nodiscard]] skinning::PoseKernels::Locals locals() const;
    void takeOverState(Playback& other, uint32_t slot, const AssetMatch& match);
    void takeOverMasks(const Playback& other, const AssetMatch& match);
    [[nodiscard]] size_t maskFloats() const { return size_t{push_.maskStride} * 4; } ///< of a mask, in masks_
    void markChanged(uint32_t slot);
    void evaluate(uint32_t slot); ///< into twin_, and of what lies between two ends the later into laterTwin_
    /// Both ends of an instance.
    [[nodiscard]] VkDeviceSize endBytes() const {
        return VkDeviceSize{shared::kPoseEnds} * push_.endStride * gpu::kVec4Bytes;
    }
    [[nodiscard]] VkDeviceSize listBytes() const {
        return capacity_ * PoseList::wordsOfInstance(takesUpdateRates(), hasSprings()) * sizeof(uint32_t);
    }
    [[nodiscard]] VkDeviceSize springBytes() const { return VkDeviceSize{push_.springStride} * 16; }
    /// What the slot plays changes: due steps are still posed by what it has played.
    void keepBefore(uint32_t slot);
    [[nodiscard]] bool travels(uint32_t slot);
    void listSteps(uint64_t frame, uint32_t slot, uint32_t slotInWindow);
    [[nodiscard]] shared::PosePush pushOf(Part part, uint32_t window, const InstanceWindows& windows) const;
    [[nodiscard]] UpdateCourse courseOf(const skinning::PlaybackDesc& desc, uint32_t updateInterval) const;
    [[nodiscard]] PoseSpan spanOf(uint32_t slot); ///< that the instance shows at the group's time
    /// What plays jumps or turns at once within a span: at seams, where clips begin and end, while weights fade.
    [[nodiscard]] bool hasCorner(uint32_t slot, const PoseSpan& span);
    void listPose(uint32_t slot, uint32_t slotInWindow);
    void forget(uint32_t slot);     ///< what plays there, or where it stands, has changed
    void forgetEnds(uint32_t slot); ///< what plays there has changed
    void forgetEndsWith(uint32_t mask);

    const gpu::Device* device_ = nullptr;
    const skinning::PoseKernels* kernels_ = nullptr;
    Asset* asset_ = nullptr;
    uint32_t capacity_ = 0, windowSize_ = 0, framesInFlight_ = 2;
    double time_ = 0.0;
    skinning::SkinningMode mode_ = skinning::SkinningMode::linear;
    /// What some instance has ever been set to do.
    bool adds_ = false, roots_ = false, modifies_ = false, plants_ = false;
    shared::PosePush push_{};            ///< but for the time, the instances and the feet
    uint32_t transitionElements_ = 0;    ///< of a state; 0: instances have no transitions
    PlayedBounds::Interval transitions_; ///< holds those of all instances

    std::vector<glm::mat4> transforms_; ///< but for the translation
    std::vector<glm::dvec3> positions_; ///< that is here
    glm::dvec3 origin_{0.0};
    // As it shall be on the device.
    std::vector<uint32_t> states_;
    InstanceModifiers modifiers_; ///< of these states
    std::vector<float> masks_;
    enum class MaskKind : uint8_t { none, joints, morphs }; ///< joints: with or without morph targets
    std::array<MaskKind, shared::kMaxMasks> masksSet_{};

    std::vector<float> jointMasks_; ///< one run a mask, one value a joint: for another version of the asset

    static constexpr uint32_t kNoSlot = 0xFFFFFFFFu;
    uint32_t evaluated_ = kNoSlot; ///< the slot that twin_ has posed
    skinning::PoseTwin twin_, laterTwin_;
    PoseSpan evaluatedSpan_;

    UpdateRates rates_;
    TimeSteps steps_;
    PoseList list_;
    uint64_t listFrame_ = 0; ///< the last that poses of the list are recorded in

    SpringClock springs_;
    InstanceState springState_;   ///< if hasSprings()
    std::vector<bool> beforeDue_; ///< by slot: what it has played before the last call is not on the device yet
    double firstStep_ = 0.0;      ///< the earliest time of the list

    PlayedBounds bounds_;
    std::vector<uint32_t> versions_; ///< by slot: rises when anything is set

    skinning::TransitionEnds startsFrom_; ///< memory of set
    std::vector<bool> transitionDue_;     ///< by slot: its words are not on the device yet
    std::vector<bool> changed_;           ///< by slot
    std::vector<uint32_t> changedSlots_;  ///< those, in any order
    std::vector<uint32_t> uploadedSlots_; ///< of uploadFrame_
    std::vector<VkBufferCopy> regions_;   ///< memory of recordUpload
    std::vector<uint32_t> turnedNodes_;   ///< memory of takeModifiers
    bool masksChanged_ = true;
    uint64_t uploadFrame_ = 0, masksFrame_ = 0; ///< that last recorded an upload

    gpu::BufferSet buffers_, staging_;
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

} // namespace supple::runtime
