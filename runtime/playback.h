// What a group's instances play on the device: their states, uploaded when they change, and the group's share of the
// pose pass.
#pragma once

#include "base/result.h"
#include "gpu/bound_sets.h"
#include "gpu/buffer_plan.h"
#include "runtime/asset.h"
#include "runtime/asset_match.h"
#include "runtime/instance_modifiers.h"
#include "runtime/instance_state.h"
#include "runtime/instance_windows.h"
#include "runtime/played_bounds.h"
#include "runtime/played_masks.h"
#include "runtime/played_states.h"
#include "runtime/pose_list.h"
#include "runtime/step_clock.h"
#include "runtime/step_detail.h"
#include "runtime/update_rates.h"
#include "skinning/deform_kernels.h"
#include "skinning/layers.h"
#include "skinning/playback.h"
#include "skinning/pose_kernels.h"
#include "skinning/pose_twin.h"
#include "skinning/transition.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

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
        skinning::PosePipelines pipelines;
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
    Playback(const Playback&) = delete; // its planned buffers point into it
    Playback& operator=(const Playback&) = delete;
    [[nodiscard]] Status create(const Desc& desc); ///< once

    void reset(uint32_t slot); ///< bind pose, no morph weights of the host's, identity transform
    /// An instance in the bind pose begins at once.
    /// `updateInterval`: steps of the grid of times from pose to pose; 0: by the size on the screen.
    void set(uint32_t slot, const skinning::PlaybackDesc& desc, const TransitionRequest& request = {},
             uint32_t updateInterval = 0);
    [[nodiscard]] bool takesUpdateRates() const { return rates_.areTaken(); }
    /// What was asked for, or what the size on the screen has chosen.
    [[nodiscard]] uint32_t updateIntervalOf(uint32_t slot) const { return rates_.interval(slot); }
    [[nodiscard]] bool takesTransitions() const { return states_.haveTransitions(); }
    /// Some joints swing. What is said of joints on the CPU, and of poses, is without that.
    [[nodiscard]] bool hasSprings() const { return push_.springs != 0; }
    /// Something runs steps on the grid of times.
    [[nodiscard]] bool hasSteps() const { return clock_.isTaken(); }
    /// Some vertices are soft: steps have poses.
    [[nodiscard]] bool hasSoft() const { return (push_.stepNodes & shared::kStepsHavePoses) != 0; }
    /// Some morph weights follow from joints, beside what clips and the host make of them.
    [[nodiscard]] bool hasDrivers() const { return push_.drivers != 0; }
    /// A frame poses what listPoses() has listed, not all that the group works on.
    [[nodiscard]] bool listsPoses() const { return list_.isTaken(); }
    /// Its springs see no movement from where it stood to where it stands in the next frame.
    void teleport(uint32_t slot) { clock_.jump(slot, time_); }
    /// Velocity in the world, from the group's time on.
    void setWind(const glm::dvec3& velocity) { clock_.setWind(velocity, time_); }
    /// All that runs steps begins anew.
    void settleSteps() { clock_.settleAll(); }
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
    [[nodiscard]] uint32_t modifierCount(uint32_t slot) { return states_.state(slot).modifierCount(); }
    [[nodiscard]] std::span<const uint32_t> modifierWords(uint32_t slot, uint32_t index) {
        return modifiers_.words(states_.state(slot), index);
    }

    /// Masks are numbered from 1; a layer's mask must have been set.
    void setMask(uint32_t mask, std::span<const float> joints, std::span<const float> morphs);
    [[nodiscard]] bool hasMask(uint32_t mask) const { return masks_.has(mask); }

    /// Where the joint is at the group's time, with the bits that the device has. The pose of the slot that was asked
    /// for last is kept until what plays, where it stands, the time or a mask changes.
    [[nodiscard]] glm::mat4 jointTransform(uint32_t slot, uint32_t joint);
    /// The pose as the next recording leaves it on the device: all elements but those of padding.
    void writePose(uint32_t slot, std::span<glm::vec4> pose);

    // What the device reads: of the slot, and the masks.
    [[nodiscard]] std::span<const uint32_t> stateOf(uint32_t slot) const { return states_.words(slot); }
    [[nodiscard]] std::span<const float> masks() const { return masks_.values(); }

    /// A box that holds the instance's cage at the group's time, where the next recording places it; nothing if nobody
    /// knows. It is found without a pose.
    [[nodiscard]] std::optional<skinning::Box> boundsOf(uint32_t slot, const skinning::Reach& reach);

    /// Another number whenever boundsOf() may give another box; never 0.
    [[nodiscard]] uint64_t boundsVersion(uint32_t slot) const {
        return uint64_t{states_.version(slot)} << 32 | bounds_.loopOf(slot, time_);
    }

    /// The same of all slots; 0: somebody may travel, or be in a transition, and boxes follow from the time too.
    [[nodiscard]] uint64_t boundsVersions() const {
        return roots_ || transitions_.holds(time_) ? 0 : states_.changes();
    }

    /// Takes over the time, the masks and the first `count` instances, of the same asset or of another version of it.
    /// Layers whose clip the other version lacks are left out. Joints and morph targets that it lacks have in a mask
    /// what they would have if the mask did not name them.
    void takeOver(Playback& other, uint32_t count, const AssetMatch& match);

    /// What has changed since it was recorded last; the bytes of it.
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    void beginFrame(uint64_t completedFrame) { springState_.beginFrame(completedFrame); }
    /// The command buffers of `frame` will never run: what was recorded in it is due again.
    void cancelFrame(uint64_t frame);

    // If listsPoses(), in each frame, before its parts of the pass. The interval of an instance whose size on the
    // screen decides is chosen with setSize(); until then it is posed in every frame.
    void takeStep(); ///< a recording begins
    /// Whether setSize() is waited for.
    [[nodiscard]] bool asksForSize(uint32_t slot) const { return rates_.asked(slot) == 0; }
    /// `pixelsPerUnit`: at most, where the instance is.
    void setSize(uint32_t slot, float pixelsPerUnit);
    void forgetSizes() {
        rates_.forgetChoices();
        detail_.forgetAll();
    }
    /// Steps are run where instances are large enough on the screen: in each frame, setStepSize() says so. Once.
    void takeStepSizes();
    [[nodiscard]] bool takesStepSizes() const { return detail_.isTaken(); }
    void setStepSize(uint32_t slot, float pixelsPerUnit);
    /// Lists what is posed in a frame, of the instances that `worksOn` holds for.
    template <class WorksOn>
    void listPoses(uint64_t frame, const InstanceWindows& windows, uint32_t end, WorksOn&& worksOn) {
        list_.clear();
        firstStep_ = kNever;
        for (uint32_t w = 0; w < windows.count(); ++w) {
            const uint32_t first = windows.firstSlot(w), last = std::min(first + windows.slots(w), end);
            for (uint32_t slot = first; slot < last; ++slot) {
                if (worksOn(slot)) {
                    hasSteps() ? listSteps(frame, slot, slot - first) : listPose(slot, slot - first);
                }
            }
            list_.endWindow(w);
        }
        clock_.endFrame(frame);
    }
    VkDeviceSize recordList(VkCommandBuffer commandBuffer, uint64_t frame) {
        return list_.recordUpload(*device_, commandBuffer, frame);
    }

    enum class Part { locals, roots, modifiers, drivers, springs, palette, mix };
    static constexpr uint32_t kParts = 7;
    static constexpr uint32_t kTasks = kParts + 1; ///< of a window at most: with transitions locals are two
    /// A part of the pass over the instances of a window. `round`: PoseList::Window::rounds.
    void record(gpu::Dispatches& dispatches, Part part, uint32_t window, const InstanceWindows& windows,
                uint32_t round = 0) const;
    /// Whether there is anything to record of a part.
    [[nodiscard]] bool has(Part part) const;
    /// Rounds of steps before that which is posed with what is shown.
    [[nodiscard]] uint32_t earlyRounds() const { return hasSteps() ? list_.earlyRounds() : 0; }
    [[nodiscard]] bool hasEarly(Part part) const;
    /// What the tasks of all parts follow from, beside windows and time; never 0.
    [[nodiscard]] uint64_t tasksMade() const;
    /// How their push constants (shared::PosePush) begin.
    [[nodiscard]] skinning::SplitTime splitTime() const { return skinning::splitTime(time_); }
    /// Poses that a frame makes of these instances.
    [[nodiscard]] uint32_t poseCount(const InstanceWindows& windows) const {
        return listsPoses() ? list_.poseCount() : windows.visible;
    }

    /// If hasSoft().
    [[nodiscard]] StepPoses stepPoses() const;
    /// What listPoses() has listed.
    [[nodiscard]] const PoseList::Window& listedPoses(uint32_t window) const { return list_.window(window); }

    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer) const;

    [[nodiscard]] gpu::MemoryUse memoryUse() const;

private:
    Status createBuffers(const Desc& desc);
    Status createSets(const Desc& desc);
    [[nodiscard]] uint32_t windowCount() const { return (capacity_ + windowSize_ - 1) / windowSize_; }
    [[nodiscard]] glm::mat4 placement(uint32_t slot) const;
    void place(uint32_t slot);
    void takeModifiers(uint32_t slot); ///< bounds_ is told what they turn
    void sample(uint32_t slot, double time, bool modified, skinning::SampledPose& pose);
    void sampleShown(uint32_t slot, const TransitionRequest& request);
    void startTransition(uint32_t slot, const TransitionRequest& request);
    [[nodiscard]] skinning::PosePipelines::Locals locals() const;
    void recordLocals(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;
    void takeOverState(Playback& other, uint32_t slot, const AssetMatch& match);
    void evaluate(uint32_t slot); ///< into twin_, and of what lies between two ends the later into laterTwin_
    /// Both ends of an instance, or the poses of its steps.
    [[nodiscard]] VkDeviceSize endBytes() const {
        return VkDeviceSize{unshownPoses_} * push_.endStride * gpu::kVec4Bytes;
    }
    /// All poses of an instance in a frame.
    [[nodiscard]] VkDeviceSize scratchBytes() const {
        return VkDeviceSize{posesInFrame_} * push_.scratchStride * gpu::kVec4Bytes;
    }
    [[nodiscard]] VkDeviceSize springBytes() const { return VkDeviceSize{push_.springStride} * 16; }
    /// What the slot plays changes: due steps are still posed by what it has played. Whether there are any.
    bool keepBefore(uint32_t slot);
    [[nodiscard]] bool travels(uint32_t slot);
    void listSteps(uint64_t frame, uint32_t slot, uint32_t slotInWindow);
    [[nodiscard]] shared::PosePush pushOf(Part part, uint32_t window, const InstanceWindows& windows,
                                          uint32_t round) const;
    [[nodiscard]] PoseSpan spanOf(uint32_t slot); ///< that the instance shows at the group's time
    void listPose(uint32_t slot, uint32_t slotInWindow);
    void forget(uint32_t slot); ///< what plays there, or where it stands, has changed
    void takeSegments();        ///< other segments of clips may play since then
    template <class Holds>
    void forgetEndsOf(Holds&& holds); ///< of instances that have a layer for which holds(PlaybackLayer)

    const gpu::Device* device_ = nullptr;
    skinning::PosePipelines pipelines_;
    Asset* asset_ = nullptr;
    uint32_t capacity_ = 0, windowSize_ = 0, posesInFrame_ = 1, unshownPoses_ = 0;
    double time_ = 0.0;
    /// What some instance has ever been set to do.
    bool adds_ = false, roots_ = false, modifies_ = false, plants_ = false;
    shared::PosePush push_{};            ///< but for the time, the instances and the feet
    PlayedBounds::Interval transitions_; ///< holds those of all instances

    std::vector<glm::mat4> transforms_; ///< but for the translation
    std::vector<glm::dvec3> positions_; ///< that is here
    glm::dvec3 origin_{0.0};
    PlayedStates states_;
    InstanceModifiers modifiers_; ///< of these states
    PlayedMasks masks_;

    static constexpr uint32_t kNoSlot = 0xFFFFFFFFu;
    uint32_t evaluated_ = kNoSlot; ///< the slot that twin_ has posed
    skinning::PoseTwin twin_, laterTwin_;
    PoseSpan evaluatedSpan_;
    uint64_t segmentVersion_ = 0; ///< ClipStream::version() of what is posed

    UpdateRates rates_;
    TimeSteps steps_;
    PoseList list_;

    StepClock clock_;
    StepDetail detail_;
    float extent_ = 0.0f;       ///< of the character as it rests, if takesStepSizes()
    InstanceState springState_; ///< created if hasSprings()
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    double firstStep_ = kNever; ///< the earliest time of a step in the list

    PlayedBounds bounds_;

    skinning::TransitionEnds startsFrom_; ///< memory of set
    std::vector<uint32_t> turnedNodes_;   ///< memory of takeModifiers

    gpu::BufferSet buffers_, staging_;
    gpu::PlannedBuffer scratch_, ends_; ///< node matrices; poses of update rates or of steps
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

} // namespace supple::runtime
