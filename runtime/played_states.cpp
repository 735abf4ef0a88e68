#include "runtime/played_states.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

PlayedStates::PlayedStates(const Desc& desc)
    : desc_(desc), words_(size_t{desc.capacity} * desc.push.stateStride * 4), versions_(desc.capacity, 1),
      transitionDue_(desc.room.transitions ? desc.capacity : 0, false),
      beforeDue_(desc.room.hasSteps() ? desc.capacity : 0, false), changed_(desc.capacity, false) {
    changedSlots_.reserve(desc.capacity);
    uploadedSlots_.reserve(desc.capacity);
    // Runs of slots with others between; of states of which only parts are used, each part by itself.
    const size_t parts = desc.room.hasSteps() ? 3 : haveParts() ? 2 : 0;
    regions_.reserve(parts > 0 ? parts * desc.capacity : size_t{desc.capacity} / 2 + 1);
}

void PlayedStates::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    const VkDeviceSize all = desc_.capacity * bytes();
    buffer_ = device.add({"supple playback", all,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          gpu::MemoryPurpose::poses});
    staging_ = staging.add({"supple playback staging", all * desc_.framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
}

void PlayedStates::markChanged(uint32_t slot) {
    versions_[slot] += versions_[slot] == UINT32_MAX ? 2 : 1;
    ++changes_;
    if (!changed_[slot]) {
        changed_[slot] = true;
        changedSlots_.push_back(slot);
    }
}

void PlayedStates::keepBefore(uint32_t slot) {
    const std::span<uint32_t> own = words(slot);
    const size_t played = 4 * size_t{desc_.push.stateBefore};
    std::copy_n(own.begin(), played, own.begin() + static_cast<ptrdiff_t>(played));
    skinning::PlaybackState(own.subspan(played)).nameMasksBefore();
    beforeDue_[slot] = true;
}

void PlayedStates::dueAgain(uint32_t slot) {
    if (haveTransitions()) {
        transitionDue_[slot] = true;
    }
    if (desc_.room.hasSteps()) {
        beforeDue_[slot] = true;
    }
}

void PlayedStates::takeOver(const PlayedStates& other, uint32_t count) {
    std::copy_n(other.words_.begin(), count * bytes() / sizeof(uint32_t), words_.begin());
    for (uint32_t slot = 0; slot < count; ++slot) {
        dueAgain(slot);
    }
}

void PlayedStates::stage(VkDeviceSize& from, VkDeviceSize to, VkDeviceSize bytes) {
    std::memcpy(staging_.mapped() + from, words_.data() + to / sizeof(uint32_t), bytes);
    if (!regions_.empty() && regions_.back().dstOffset + regions_.back().size == to) {
        regions_.back().size += bytes;
    } else {
        regions_.push_back({from, to, bytes});
    }
    from += bytes;
}

void PlayedStates::stageSlot(VkDeviceSize& from, uint32_t slot) {
    const VkDeviceSize to = slot * bytes();
    stage(from, to, usedBytes(slot));
    if (haveTransitions() && transitionDue_[slot] && state(slot).isInTransition()) {
        stage(from, to + desc_.push.transition * gpu::kVec4Bytes, desc_.transitionElements * gpu::kVec4Bytes);
        transitionDue_[slot] = false;
    }
    if (desc_.room.hasSteps() && beforeDue_[slot]) {
        const VkDeviceSize played = desc_.push.stateBefore * gpu::kVec4Bytes;
        stage(from, to + played, played);
        beforeDue_[slot] = false;
    }
}

VkDeviceSize PlayedStates::recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame) {
    if (changedSlots_.empty()) {
        return 0;
    }
    // Packed in the order of slots: a region of the copy for every run of neighbors.
    std::sort(changedSlots_.begin(), changedSlots_.end());
    regions_.clear();
    const VkDeviceSize first = frame % desc_.framesInFlight * desc_.capacity * bytes();
    VkDeviceSize from = first;
    for (const uint32_t slot : changedSlots_) {
        stageSlot(from, slot);
        changed_[slot] = false;
    }
    device.vk.CmdCopyBuffer(commandBuffer, staging_.buffer(), buffer(), static_cast<uint32_t>(regions_.size()),
                            regions_.data());
    std::swap(uploadedSlots_, changedSlots_);
    changedSlots_.clear();
    frame_ = frame;
    return from - first;
}

VkDeviceSize PlayedStates::usedBytes(uint32_t slot) {
    const uint32_t elements = skinning::PlaybackState::elements(desc_.push.morphCount, state(slot).modifierCount());
    return haveParts() ? elements * gpu::kVec4Bytes : bytes();
}

void PlayedStates::cancelFrame(uint64_t frame) {
    if (frame_ == frame) {
        for (const uint32_t slot : uploadedSlots_) {
            markChanged(slot);
            dueAgain(slot);
        }
    }
}

} // namespace supple::runtime
