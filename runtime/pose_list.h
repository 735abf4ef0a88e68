// The list of what is posed, in groups with update rates (shaders/shared/pose.h).
#pragma once

#include "shaders/shared/pose.h"
#include "skinning/split_time.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Listing allocates nothing.
class PoseList {
public:
    /// Of an instance: two ends with their times, or what is shown with its time; and its part of the way.
    static constexpr uint32_t kWordsOfInstance = 2 * 3 + 2;

    PoseList() = default;
    PoseList(uint32_t capacity, uint32_t windowCount) : windows_(windowCount) {
        words_.reserve(size_t{capacity} * kWordsOfInstance);
        times_.reserve(size_t{capacity} * 4);
        mixes_.reserve(capacity);
        parts_.reserve(capacity);
    }

    void clear() {
        words_.clear();
        poses_ = mixed_ = 0;
    }
    // Of one window after the other; slots count within it. endWindow() is called for each.
    void addPose(uint32_t slot, uint32_t run, double time) {
        const skinning::SplitTime split = skinning::splitTime(time);
        words_.push_back(slot | run << shared::kPosedRunShift);
        times_.push_back(std::bit_cast<uint32_t>(split.high));
        times_.push_back(std::bit_cast<uint32_t>(split.low));
    }
    void addMix(uint32_t slot, uint32_t earlierRun, float part) {
        mixes_.push_back(slot | earlierRun << shared::kPosedRunShift);
        parts_.push_back(std::bit_cast<uint32_t>(part));
    }
    void endWindow(uint32_t window) {
        Window& own = windows_[window];
        own.poses.count = static_cast<uint32_t>(times_.size() / 2);
        own.poses.values = append(times_);
        own.poses.first = own.poses.values - own.poses.count;
        own.mixes.first = append(mixes_);
        own.mixes.values = append(parts_);
        own.mixes.count = own.mixes.values - own.mixes.first;
        poses_ += own.poses.count;
        mixed_ += own.mixes.count;
    }

    /// Words of the list: entries, and what stands for each.
    struct Run {
        uint32_t first = 0, count = 0, values = 0;
    };
    struct Window {
        Run poses, mixes;
    };
    [[nodiscard]] const Window& window(uint32_t window) const { return windows_[window]; }
    [[nodiscard]] std::span<const uint32_t> words() const { return words_; }
    // In all windows.
    [[nodiscard]] uint32_t poseCount() const { return poses_; }
    [[nodiscard]] uint32_t mixCount() const { return mixed_; }

private:
    /// The word where they begin. Leaves none.
    uint32_t append(std::vector<uint32_t>& values) {
        const auto first = static_cast<uint32_t>(words_.size());
        words_.insert(words_.end(), values.begin(), values.end());
        values.clear();
        return first;
    }

    std::vector<uint32_t> words_, times_, mixes_, parts_; ///< the latter three of the window that is being listed
    std::vector<Window> windows_;
    uint32_t poses_ = 0, mixed_ = 0;
};

} // namespace supple::runtime
