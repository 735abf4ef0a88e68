// The list of what is posed, in groups with update rates, springs or what is soft (shaders/shared/pose.h).
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/playback_room.h"
#include "runtime/step_clock.h"
#include "runtime/step_detail.h"
#include "shaders/shared/pose.h"
#include "skinning/split_time.h"

#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::runtime {

/// Where a frame's steps are, for stages that read them. Buffers have so many bytes an instance; strides and places are
/// elements.
struct StepPoses {
    VkBuffer poses = VK_NULL_HANDLE, scratch = VK_NULL_HANDLE, list = VK_NULL_HANDLE;
    VkDeviceSize poseBytes = 0, scratchBytes = 0, listBytes = 0; ///< of the list: all
    uint32_t poseStride = 0, scratchStride = 0;
    uint32_t place = 0, way = 0; ///< in an entry's run of the scratch memory: where it stands, what it has travelled
};

/// Listing allocates nothing.
class PoseList {
public:
    /// An instance has two ends with their times, or what is shown with its time; and its part of the way.
    static constexpr uint32_t kWordsOfInstance = 2 * 3 + 2;
    /// With steps: what is shown, and each step with its time, its record and its move.
    static constexpr uint32_t kWordsOfStepping =
        3 + shared::kMostDueSteps * (3 + shared::kStepWords + shared::kMoveWords);

    /// Of an instance of a group with update rates or steps; of others there is no list.
    [[nodiscard]] static constexpr uint32_t wordsOfInstance(const StateRoom& room) {
        return room.hasSteps() ? kWordsOfStepping : room.updateRates ? kWordsOfInstance : 0;
    }

    PoseList() = default;
    /// `stepsInRound`: of an instance; the working memory of the group has room for so many.
    PoseList(uint32_t capacity, uint32_t windowCount, const StateRoom& room, uint32_t stepsInRound);
    /// False: a frame poses all that the group works on.
    [[nodiscard]] bool isTaken() const { return bytes_ > 0; }
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight);

    void clear() {
        words_.clear();
        poses_ = mixed_ = stepping_ = 0;
        usedRounds_ = 1;
    }
    // Windows are listed one after the other; slots count within one. endWindow() is called for each.
    /// `end`: its number; 0: what is shown.
    void addPose(uint32_t slot, uint32_t end, double time) {
        const skinning::SplitTime split = skinning::splitTime(time);
        words_.push_back(slot | end << shared::kPosedEndShift);
        times_.push_back(std::bit_cast<uint32_t>(split.high));
        times_.push_back(std::bit_cast<uint32_t>(split.low));
    }
    void addMix(uint32_t slot, uint32_t earlierEnd, float part) {
        mixes_.push_back(slot | earlierEnd << shared::kPosedEndShift);
        parts_.push_back(std::bit_cast<uint32_t>(part));
    }
    /// What is listed of an instance's steps beside the steps themselves.
    struct StepRecord {
        StepDetail::Shown shown;                             ///< of what they do
        std::array<uint32_t, shared::kMostDueSteps> posed{}; ///< flags of each: kPosedBefore, kPosedTravels
    };
    /// Behind addPose() of the instance, with what is shown: its steps.
    void addSteps(uint32_t slot, const StepClock::Due& due, const StepRecord& record);
    void endWindow(uint32_t window);

    /// Words of the list: entries, and what stands for each.
    struct Run {
        uint32_t first = 0, count = 0, values = 0;
    };
    struct Round {
        Run poses;
        uint32_t shown = 0; ///< of the poses, before steps
        Run stepping;       ///< kStepWords for each instance that has steps
    };
    struct Window {
        Run mixes;
        /// Rounds of steps by rising distance from the last one, with which all else is posed.
        std::array<Round, shared::kMostDueSteps> rounds;
    };
    [[nodiscard]] const Window& window(uint32_t window) const { return windows_[window]; }
    /// Rounds that come before the last one, in all windows.
    [[nodiscard]] uint32_t earlyRounds() const { return usedRounds_ - 1; }
    // In all windows.
    [[nodiscard]] uint32_t poseCount() const { return poses_; }
    [[nodiscard]] uint32_t mixCount() const { return mixed_; }
    [[nodiscard]] uint32_t steppingCount() const { return stepping_; }

    [[nodiscard]] VkBuffer buffer() const { return buffer_.buffer(); }
    [[nodiscard]] VkDeviceSize bytes() const { return bytes_; }
    /// The bytes of it.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame);
    [[nodiscard]] bool recordedIn(uint64_t frame) const { return isTaken() && frame_ == frame; }

private:
    /// Steps of one round in the window that is being listed.
    struct Steps {
        std::vector<uint32_t> entries, times, moves;
        std::vector<std::array<uint32_t, shared::kStepWords>> records;
    };
    /// Those of an instance from `first` to `end`.
    void addRun(Steps& to, uint32_t slot, const StepClock::Due& due, uint32_t first, uint32_t end,
                const StepRecord& record) const;
    void endStepping(Steps& steps, Round& round);
    /// The word where they begin. Leaves none.
    uint32_t append(std::vector<uint32_t>& values);

    uint32_t stepsInRound_ = 1;
    std::vector<uint32_t> words_;
    // What the window has that is being listed:
    std::vector<uint32_t> times_, mixes_, parts_;
    std::array<Steps, shared::kMostDueSteps> steps_; ///< by round
    std::vector<Window> windows_;
    uint32_t poses_ = 0, mixed_ = 0, stepping_ = 0, usedRounds_ = 1;

    VkDeviceSize bytes_ = 0; ///< at most
    uint32_t framesInFlight_ = 2;
    uint64_t frame_ = 0; ///< the last that poses of the list are recorded in
    gpu::PlannedBuffer buffer_, staging_;
};

} // namespace supple::runtime
