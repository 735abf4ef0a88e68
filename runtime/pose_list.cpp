#include "runtime/pose_list.h"

#include <cstring>

namespace supple::runtime {

PoseList::PoseList(uint32_t capacity, uint32_t windowCount, const StateRoom& room)
    : windows_(windowCount), bytes_(VkDeviceSize{capacity} * wordsOfInstance(room) * sizeof(uint32_t)) {
    const size_t instances = isTaken() ? capacity : 0, swinging = room.hasSteps() ? instances : 0;
    const size_t mixed = instances - swinging, steps = swinging * shared::kMostDueSteps;
    words_.reserve(instances * wordsOfInstance(room));
    times_.reserve(2 * (2 * mixed + swinging + steps));
    mixes_.reserve(mixed);
    parts_.reserve(mixed);
    steps_.reserve(steps);
    stepTimes_.reserve(2 * steps);
    moves_.reserve(steps * shared::kMoveWords);
    swinging_.reserve(swinging);
}

void PoseList::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight) {
    framesInFlight_ = framesInFlight;
    buffer_ = device.add({"supple list of poses", bytes_,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          gpu::MemoryPurpose::poses});
    staging_ = staging.add({"supple list of poses staging", bytes_ * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
}

void PoseList::addSteps(uint32_t slot, const StepClock::Due& due, float fade) {
    using namespace shared;
    const uint32_t jump = due.jump != StepClock::kNone ? (due.jump + 1) << kStepJumpShift : 0;
    const uint32_t number = (static_cast<uint32_t>(due.first) & (kStepNumbers - 1)) << kStepNumberShift;
    const uint32_t begins = due.settles ? kStepSettles | due.skipped << kStepSkippedShift : 0;
    const bool moves = due.moves || due.blows || due.hasDown;
    swinging_.push_back({slot, static_cast<uint32_t>(steps_.size()), due.count | jump | number | begins,
                         std::bit_cast<uint32_t>(due.part), moves ? static_cast<uint32_t>(moves_.size()) + 1 : 0,
                         static_cast<uint32_t>(times_.size() / 2) - 1, std::bit_cast<uint32_t>(fade)});
    for (uint32_t k = 0; k < due.count; ++k) {
        const skinning::SplitTime split = skinning::splitTime(timeOfStep(due.first + k));
        steps_.push_back(slot);
        stepTimes_.push_back(std::bit_cast<uint32_t>(split.high));
        stepTimes_.push_back(std::bit_cast<uint32_t>(split.low));
        if (moves) {
            addMove(due, k);
        }
    }
}

void PoseList::addMove(const StepClock::Due& due, uint32_t step) {
    const auto add = [&](const auto& vector) {
        for (int i = 0; i < vector.length(); ++i) {
            moves_.push_back(std::bit_cast<uint32_t>(vector[i]));
        }
    };
    for (const glm::vec4& row : due.rows[step]) {
        add(row);
    }
    add(due.down[step]);
    add(due.wind[step]);
}

void PoseList::endWindow(uint32_t window) {
    Window& own = windows_[window];
    own.shown = static_cast<uint32_t>(times_.size() / 2);
    append(steps_);
    times_.insert(times_.end(), stepTimes_.begin(), stepTimes_.end());
    stepTimes_.clear();
    own.poses.count = static_cast<uint32_t>(times_.size() / 2);
    own.poses.values = append(times_);
    own.poses.first = own.poses.values - own.poses.count;
    own.mixes.first = append(mixes_);
    own.mixes.values = append(parts_);
    own.mixes.count = own.mixes.values - own.mixes.first;
    endSwinging(own);
    poses_ += own.shown;
    mixed_ += own.mixes.count;
}

void PoseList::endSwinging(Window& own) {
    own.swinging.first = static_cast<uint32_t>(words_.size());
    own.swinging.count = static_cast<uint32_t>(swinging_.size());
    const uint32_t moves = own.swinging.first + own.swinging.count * shared::kStepWords;
    for (std::array<uint32_t, shared::kStepWords>& record : swinging_) {
        constexpr size_t kMoves = 4;
        record[kMoves] += record[kMoves] != 0 ? moves - 1 : 0;
        words_.insert(words_.end(), record.begin(), record.end());
    }
    swung_ += own.swinging.count;
    swinging_.clear();
    append(moves_);
}

uint32_t PoseList::append(std::vector<uint32_t>& values) {
    const auto first = static_cast<uint32_t>(words_.size());
    words_.insert(words_.end(), values.begin(), values.end());
    values.clear();
    return first;
}

VkDeviceSize PoseList::recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame) {
    if (words_.empty()) {
        return 0;
    }
    const VkBufferCopy region{frame % framesInFlight_ * bytes_, 0, words_.size() * sizeof(uint32_t)};
    std::memcpy(staging_.mapped() + region.srcOffset, words_.data(), region.size);
    device.vk.CmdCopyBuffer(commandBuffer, staging_.buffer(), buffer(), 1, &region);
    frame_ = frame;
    return region.size;
}

} // namespace supple::runtime
