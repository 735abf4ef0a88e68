// What the instances of a group play, in the words that the device reads: uploaded when it changes.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/playback_room.h"
#include "skinning/playback.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Changing and recording allocate nothing; a frame without changes uploads nothing.
class PlayedStates {
public:
    struct Desc {
        shared::PosePush push; ///< strides
        StateRoom room;
        uint32_t transitionElements = 0; ///< 0: instances have no transitions
        uint32_t capacity = 0;
        uint32_t framesInFlight = 2;
    };
    PlayedStates() = default;
    explicit PlayedStates(const Desc& desc);
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging);

    // Who changes the words of an instance calls markChanged().
    [[nodiscard]] std::span<uint32_t> words(uint32_t slot) {
        const size_t count = bytes() / sizeof(uint32_t);
        return std::span(words_).subspan(slot * count, count);
    }
    [[nodiscard]] std::span<const uint32_t> words(uint32_t slot) const {
        const size_t count = bytes() / sizeof(uint32_t);
        return std::span(words_).subspan(slot * count, count);
    }
    [[nodiscard]] skinning::PlaybackState state(uint32_t slot) { return skinning::PlaybackState(words(slot)); }
    void markChanged(uint32_t slot);
    /// Another number after each change; never 0.
    [[nodiscard]] uint32_t version(uint32_t slot) const { return versions_[slot]; }
    /// The same of all slots.
    [[nodiscard]] uint64_t changes() const { return changes_; }

    [[nodiscard]] bool haveTransitions() const { return desc_.transitionElements > 0; }
    /// Its words are written only with markTransition().
    [[nodiscard]] std::span<uint32_t> transition(uint32_t slot) {
        return words(slot).subspan(4 * size_t{desc_.push.transition}, 4 * size_t{desc_.transitionElements});
    }
    /// Another transition has begun: its words are due on the device.
    void markTransition(uint32_t slot) { transitionDue_[slot] = true; }

    /// With steps: what the slot plays now is also what it has played before the next change, with the masks of the
    /// last frame.
    void keepBefore(uint32_t slot);
    /// What it has played then.
    [[nodiscard]] std::span<const uint32_t> before(uint32_t slot) const {
        return words(slot).subspan(4 * size_t{desc_.push.stateBefore});
    }

    /// The first `count` instances of a group of the same asset and room.
    void takeOver(const PlayedStates& other, uint32_t count);

    [[nodiscard]] VkBuffer buffer() const { return buffer_.buffer(); }
    [[nodiscard]] VkDeviceSize bytes() const { return VkDeviceSize{desc_.push.stateStride} * gpu::kVec4Bytes; }
    /// The bytes of it.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame);
    void cancelFrame(uint64_t frame);

private:
    [[nodiscard]] bool haveParts() const {
        return desc_.room.modifiers || desc_.room.transitions || desc_.room.hasSteps();
    }
    [[nodiscard]] VkDeviceSize usedBytes(uint32_t slot);                 ///< but for the transition
    void stage(VkDeviceSize& from, VkDeviceSize to, VkDeviceSize bytes); ///< a piece of words_, for regions_
    void stageSlot(VkDeviceSize& from, uint32_t slot);
    /// The transition, and what was played before: also where there was nothing, which uploads some bytes in vain.
    void dueAgain(uint32_t slot);

    Desc desc_;
    std::vector<uint32_t> words_;
    // By slot:
    std::vector<uint32_t> versions_;
    uint64_t changes_ = 1;
    std::vector<bool> transitionDue_; ///< the words are not on the device yet
    std::vector<bool> beforeDue_;     ///< likewise of what it has played before
    std::vector<bool> changed_;

    std::vector<uint32_t> changedSlots_;  ///< those, in any order
    std::vector<uint32_t> uploadedSlots_; ///< of frame_
    std::vector<VkBufferCopy> regions_;   ///< memory of recordUpload
    uint64_t frame_ = 0;                  ///< the last that recorded an upload
    gpu::PlannedBuffer buffer_, staging_;
};

} // namespace supple::runtime
