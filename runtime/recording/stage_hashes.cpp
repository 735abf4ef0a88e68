#include "runtime/recording/stage_hashes.h"

#include "gpu/barriers.h"
#include "gpu/device.h"
#include "shaders/recording_records_comp.h"
#include "shaders/recording_words_comp.h"
#include "shaders/shared/lod.h"
#include "shaders/shared/word_hash.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkPipelineStageFlags2 kComputeStage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                         kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

} // namespace

Result<HashKernels> HashKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {gpu::storage(kHashedWordBinding), gpu::storage(kHashListBinding),
                                     gpu::storage(kHashSumBinding)};
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(
        device, bindings, std::max(sizeof(SlotHashPush), sizeof(RecordHashPush)), "supple hashes");
    if (!layout) {
        return layout.error();
    }
    HashKernels made;
    made.pipelines_ = &pipelines;
    made.layout_ = std::move(*layout);
    return made;
}

Status HashKernels::prepare() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const gpu::Kernel slots = batch.get(layout_, recording_words_comp, {}, "supple hashes");
    const gpu::Kernel records = batch.get(layout_, recording_records_comp, {}, "supple hashes of a view");
    Status status = batch.make();
    if (status) {
        slots_ = slots;
        records_ = records;
    }
    return status;
}

Result<std::shared_ptr<StageHashes>> StageHashes::create(const gpu::Device& device, const HashKernels& kernels,
                                                         uint32_t framesInFlight) {
    auto made = std::make_shared<StageHashes>();
    made->device_ = &device;
    made->kernels_ = &kernels;
    const VkDeviceSize bytes = made->offsetOf(framesInFlight, 0);
    const gpu::BufferRequest local{"supple hashes", bytes,
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    const gpu::BufferRequest readback{"supple hashes, read back", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    Result<gpu::BufferSet> sums = gpu::BufferSet::create(device, {&local, 1}, gpu::MemoryKind::deviceLocal);
    Result<gpu::BufferSet> copies = sums ? gpu::BufferSet::create(device, {&readback, 1}, gpu::MemoryKind::readback)
                                         : Result<gpu::BufferSet>(sums.error());
    if (!copies) {
        return copies.error();
    }
    made->local_ = std::move(*sums);
    made->readback_ = std::move(*copies);
    made->frames_.resize(framesInFlight);
    for (Frame& frame : made->frames_) {
        frame.hashes.reserve(kMost);
    }
    return made;
}

void StageHashes::takeCompleted(uint64_t completedFrame, const std::function<void(const FrameHashes&)>& tell) {
    std::array<Frame*, SUPPLE_MAX_FRAMES_IN_FLIGHT> all{}; // in order, without an allocation
    const auto end = std::transform(frames_.begin(), frames_.end(), all.begin(), [](Frame& frame) { return &frame; });
    std::sort(all.begin(), end, [](const Frame* a, const Frame* b) { return a->number < b->number; });
    for (Frame* const frame : std::span(all.begin(), end)) {
        if (frame->number == 0 || frame->number > completedFrame) {
            continue;
        }
        const auto place = static_cast<size_t>(frame - frames_.data());
        for (uint32_t i = 0; i < frame->hashes.size(); ++i) {
            std::memcpy(frame->hashes[i].sums, readback_.mapped(0) + offsetOf(place, i), sizeof(StageHash::sums));
        }
        std::erase_if(frame->hashes, [](const StageHash& hash) { return hash.group.id == 0; });
        tell({frame->number, frame->hashes.data(), static_cast<uint32_t>(frame->hashes.size())});
        frame->number = 0;
    }
}

void StageHashes::cancelFrame(uint64_t number) {
    Frame& frame = frames_[number % frames_.size()];
    frame.number = frame.number == number ? 0 : frame.number;
}

void StageHashes::forget() {
    for (Frame& frame : frames_) {
        frame.number = 0;
    }
}

StageHashes::Recording::Recording(StageHashes& hashes, VkCommandBuffer commandBuffer, uint64_t frame, uint32_t count)
    : hashes_(&hashes), commandBuffer_(commandBuffer), place_(frame % hashes.frames_.size()) {
    {
        const std::scoped_lock lock(hashes.mutex_);
        Frame& own = hashes.frames_[place_];
        if (own.number != frame) {
            own.number = frame;
            own.hashes.clear();
        }
        first_ = static_cast<uint32_t>(own.hashes.size());
        count_ = std::min(count, kMost - first_);
        own.hashes.resize(first_ + count_);
    }
    if (count_ == 0) {
        return;
    }
    const gpu::Device& device = *hashes.device_;
    device.vk.CmdFillBuffer(commandBuffer, hashes.sums(), hashes.offsetOf(place_, first_), hashes.offsetOf(0, count_),
                            0);
    gpu::memoryBarrier(
        device, commandBuffer,
        {kComputeStage | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, kStorageWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT},
        {kComputeStage, kStorageRead | kStorageWrite});
}

bool StageHashes::Recording::next(const StageHash& which) {
    if (taken_ == count_) {
        return false;
    }
    const std::scoped_lock lock(hashes_->mutex_);
    hashes_->frames_[place_].hashes[first_ + taken_++] = which;
    return true;
}

void StageHashes::Recording::add(VkDescriptorSet set, SlotHashPush push) {
    const gpu::Device& device = *hashes_->device_;
    push.shares = (push.elementCount + kHashedElements - 1) / kHashedElements;
    push.target = target();
    gpu::bind(device, commandBuffer_, hashes_->kernels_->slots(), set, push);
    gpu::dispatchLinear(device, commandBuffer_, uint64_t{push.mostEntries} * push.shares);
}

void StageHashes::Recording::add(VkDescriptorSet set, RecordHashPush push) {
    const gpu::Device& device = *hashes_->device_;
    push.target = target();
    gpu::bind(device, commandBuffer_, hashes_->kernels_->records(), set, push);
    gpu::dispatchLinear(device, commandBuffer_, uint64_t{push.runCount} * kCapacityCount * kRecordHashShares);
}

void StageHashes::Recording::end() {
    if (count_ == 0) {
        return;
    }
    const gpu::Device& device = *hashes_->device_;
    gpu::memoryBarrier(device, commandBuffer_, {kComputeStage, kStorageWrite},
                       {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
    const VkDeviceSize offset = hashes_->offsetOf(place_, first_);
    const VkBufferCopy region{offset, offset, hashes_->offsetOf(0, count_)};
    device.vk.CmdCopyBuffer(commandBuffer_, hashes_->sums(), hashes_->readback_.buffer(0), 1, &region);
    gpu::memoryBarrier(device, commandBuffer_, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

Status HashedParts::create(std::span<const HashedPart> parts, VkBuffer list) {
    const auto count = static_cast<uint32_t>(std::max<size_t>(1, parts.size() * windows_->count()));
    Status status = sets_.create(*device_, hashes_->layout(), count, "supple hashes");
    for (size_t n = 0; n < parts.size() && status; ++n) {
        for (uint32_t w = 0; w < windows_->count() && parts[n].words != VK_NULL_HANDLE; ++w) {
            write(placeOf(n, w), parts[n], w, list);
        }
    }
    return status;
}

void HashedParts::write(size_t place, const HashedPart& part, uint32_t window, VkBuffer list) {
    const VkDeviceSize bytes = VkDeviceSize{part.slotStride} * sizeof(uint32_t);
    VkDescriptorBufferInfo words{part.words, windows_->firstSlot(window) * bytes, windows_->slots(window) * bytes};
    VkDescriptorBufferInfo listed{list, 0, VK_WHOLE_SIZE};
    switch (part.by) {
    case HashedBy::hostList:
        break;
    case HashedBy::rateList:
        listed.buffer = culling_->list().buffer;
        break;
    case HashedBy::records:
        words = {part.words, 0, VK_WHOLE_SIZE};
        listed.buffer = part.view->words();
        break;
    }
    const gpu::BoundResource resources[] = {
        {kHashedWordBinding, words, VK_NULL_HANDLE},
        {kHashListBinding, listed, VK_NULL_HANDLE},
        {kHashSumBinding, {hashes_->sums(), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
    };
    sets_.write(*device_, hashes_->layout(), place, resources);
}

void HashedParts::record(StageHashes::Recording& recording, size_t number, const HashedPart& part) const {
    if (part.by == HashedBy::records) {
        RecordHashPush push{};
        push.runs = part.view->maxRuns();
        push.firstRun = part.firstRun;
        push.runCount = part.runCount;
        push.patchCount = part.patchCount;
        push.vertexCount = part.elementCount;
        push.elementWords = part.elementWords;
        push.keptWords = part.keptWords;
        recording.add(sets_[placeOf(number, 0)].set, push);
        return;
    }
    SlotHashPush push{};
    push.slotStride = part.slotStride;
    push.firstWord = part.firstWord;
    push.elementCount = part.elementCount;
    push.elementWords = part.elementWords;
    push.keptWords = part.keptWords;
    uint32_t firstEntry = 0;
    for (uint32_t w = 0; w < windows_->count(); ++w) {
        const uint32_t listed = windows_->listed[w].count;
        push.firstSlot = windows_->firstSlot(w);
        push.mostEntries = listed;
        if (part.by == HashedBy::rateList) {
            const shared::WindowPush window = culling_->window(w, part.surface, part.rate).push;
            push.firstEntry = window.firstInstance;
            push.entryCount = window.instanceCount;
        } else {
            // Where draws have windows, each has a place of its own in the list.
            push.firstEntry = windows_->drawCount() > 1 ? windows_->firstDrawnSlot(w) : firstEntry;
            push.entryCount = listed;
            push.firstListed = push.firstSlot;
            firstEntry += listed;
        }
        if (listed > 0) {
            recording.add(sets_[placeOf(number, w)].set, push);
        }
    }
}

} // namespace supple::runtime
