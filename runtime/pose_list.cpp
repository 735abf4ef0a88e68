#include "runtime/pose_list.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

namespace {

/// In a record of steps.
constexpr size_t kMovesWord = 4;

void addMove(const StepClock::Due& due, uint32_t step, std::vector<uint32_t>& to) {
    const auto add = [&](const auto& vector) {
        for (int i = 0; i < vector.length(); ++i) {
            to.push_back(std::bit_cast<uint32_t>(vector[i]));
        }
    };
    for (const glm::vec4& row : due.rows[step]) {
        add(row);
    }
    add(due.down[step]);
    add(due.wind[step]);
}

} // namespace

PoseList::PoseList(uint32_t capacity, uint32_t windowCount, const StateRoom& room, uint32_t stepsInRound)
    : stepsInRound_(stepsInRound), windows_(windowCount),
      bytes_(VkDeviceSize{capacity} * wordsOfInstance(room) * sizeof(uint32_t)) {
    const size_t instances = isTaken() ? capacity : 0, stepping = room.hasSteps() ? instances : 0;
    const size_t mixed = instances - stepping;
    words_.reserve(instances * wordsOfInstance(room));
    times_.reserve(2 * (2 * mixed + stepping + stepping * stepsInRound));
    mixes_.reserve(mixed);
    parts_.reserve(mixed);
    const uint32_t rounds = (shared::kMostDueSteps + stepsInRound - 1) / stepsInRound;
    for (uint32_t round = 0; round < rounds; ++round) {
        Steps& own = steps_[round];
        own.entries.reserve(stepping * stepsInRound);
        own.times.reserve(2 * stepping * stepsInRound);
        own.moves.reserve(stepping * stepsInRound * shared::kMoveWords);
        own.records.reserve(stepping);
    }
}

void PoseList::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight) {
    framesInFlight_ = framesInFlight;
    buffer_ = device.add({"supple list of poses", bytes_,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          gpu::MemoryPurpose::poses});
    staging_ = staging.add({"supple list of poses staging", bytes_ * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
}

void PoseList::addSteps(uint32_t slot, const StepClock::Due& due, const StepRecord& record) {
    uint32_t end = due.count, round = 0;
    do {
        const uint32_t first = end - std::min(end, stepsInRound_);
        addRun(steps_[round++], slot, due, first, end, record);
        end = first;
    } while (end > 0);
    usedRounds_ = std::max(usedRounds_, round);
}

void PoseList::addRun(Steps& to, uint32_t slot, const StepClock::Due& due, uint32_t first, uint32_t end,
                      const StepRecord& record) const {
    using namespace shared;
    const bool isLast = end == due.count, moves = due.moves || due.blows || due.hasDown;
    const bool jumps = due.jump >= first && due.jump < end;
    const uint32_t jump = jumps ? (due.jump - first + 1) << kStepJumpShift : 0;
    const uint32_t number = ((static_cast<uint32_t>(due.first) + first) & (kStepNumbers - 1)) << kStepNumberShift;
    const auto begins = [](bool settles, uint32_t skipped) {
        return settles ? kStepSettles | skipped << kStepSkippedShift : 0;
    };
    const uint32_t common = (end - first) | jump | number | (record.shown.lightCloths ? kStepLightCloths : 0);
    const uint32_t softSkips = due.softWakes ? due.softSkipped : due.skipped;
    const bool softRuns = !due.softSleeps && (!due.softWakes || isLast);
    to.records.push_back({slot, static_cast<uint32_t>(to.entries.size()), common | begins(due.settles, due.skipped),
                          std::bit_cast<uint32_t>(due.part), moves ? static_cast<uint32_t>(to.moves.size()) + 1 : 0,
                          isLast ? static_cast<uint32_t>(times_.size() / 2) - 1 : kNotShown,
                          std::bit_cast<uint32_t>(record.shown.springs),
                          softRuns ? common | begins(due.settles || due.softWakes, softSkips) : 0,
                          std::bit_cast<uint32_t>(due.softSleeps ? 0.0f : record.shown.soft)});
    for (uint32_t k = first; k < end; ++k) {
        const skinning::SplitTime split = skinning::splitTime(timeOfStep(due.first + k));
        to.entries.push_back(slot | record.posed[k]);
        to.times.push_back(std::bit_cast<uint32_t>(split.high));
        to.times.push_back(std::bit_cast<uint32_t>(split.low));
        if (moves) {
            addMove(due, k, to.moves);
        }
    }
}

void PoseList::endWindow(uint32_t window) {
    Window& own = windows_[window];
    own = {};
    for (uint32_t r = 0; r < usedRounds_; ++r) {
        Round& round = own.rounds[r];
        round.shown = static_cast<uint32_t>(times_.size() / 2); // which stand before steps in the first one alone
        append(steps_[r].entries);
        times_.insert(times_.end(), steps_[r].times.begin(), steps_[r].times.end());
        steps_[r].times.clear();
        round.poses.count = static_cast<uint32_t>(times_.size() / 2);
        round.poses.values = append(times_);
        round.poses.first = round.poses.values - round.poses.count;
        endStepping(steps_[r], round);
    }
    own.mixes.first = append(mixes_);
    own.mixes.values = append(parts_);
    own.mixes.count = own.mixes.values - own.mixes.first;
    poses_ += own.rounds[0].shown;
    mixed_ += own.mixes.count;
    stepping_ += own.rounds[0].stepping.count;
}

void PoseList::endStepping(Steps& steps, Round& round) {
    round.stepping.first = static_cast<uint32_t>(words_.size());
    round.stepping.count = static_cast<uint32_t>(steps.records.size());
    const uint32_t moves = round.stepping.first + round.stepping.count * shared::kStepWords;
    for (std::array<uint32_t, shared::kStepWords>& record : steps.records) {
        record[kMovesWord] += record[kMovesWord] != 0 ? moves - 1 : 0;
        words_.insert(words_.end(), record.begin(), record.end());
    }
    steps.records.clear();
    append(steps.moves);
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
