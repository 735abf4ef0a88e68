#include "gpu/static_buffers.h"

#include "gpu/uploads.h"

#include <algorithm>
#include <cstring>

namespace supple::gpu {

namespace {

bool isBounded(const Device& device) {
    return device.uploads != nullptr && device.uploads->bounded();
}

} // namespace

Result<StaticBuffers> StaticBuffers::create(const Device& device, std::span<const StaticRequest> requests) {
    std::vector<BufferRequest> local, staging;
    StaticBuffers buffers;
    buffers.owner_ = &device;
    buffers.count_ = requests.size();
    for (const StaticRequest& request : requests) {
        local.push_back({request.name, request.bytes.size(), request.usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryPurpose::tables});
        staging.push_back({request.name, request.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
        buffers.sources_.push_back({request.bytes, request.keeper});
        buffers.total_ += request.bytes.size();
    }
    Result<BufferSet> localSet = BufferSet::create(device, local, MemoryKind::deviceLocal);
    if (!localSet) {
        return localSet.error();
    }
    buffers.device_ = std::move(*localSet);
    if (isBounded(device)) {
        for (Source& source : buffers.sources_) {
            if (source.keeper == nullptr && !source.bytes.empty()) {
                const auto copy = std::make_shared<std::vector<std::byte>>(source.bytes.begin(), source.bytes.end());
                source = {*copy, copy};
            }
        }
        return buffers;
    }
    Result<BufferSet> staged = stage(device, staging, buffers.sources_);
    if (!staged) {
        return staged.error();
    }
    buffers.staging_ = std::move(*staged);
    buffers.sources_.clear();
    return buffers;
}

Result<BufferSet> StaticBuffers::stage(const Device& device, std::span<const BufferRequest> requests,
                                       std::span<const Source> sources) {
    Result<BufferSet> staging = BufferSet::create(device, requests, MemoryKind::upload);
    for (size_t i = 0; staging && i < sources.size(); ++i) {
        if (!sources[i].bytes.empty()) {
            std::memcpy(staging->mapped(i), sources[i].bytes.data(), sources[i].bytes.size());
        }
    }
    return staging;
}

Status StaticBuffers::stageStatics() {
    if (sources_.empty() || !staticsPending()) {
        return success();
    }
    std::vector<BufferRequest> requests;
    for (const Source& source : sources_) {
        requests.push_back({"supple static data", source.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    }
    Result<BufferSet> staged = stage(*owner_, requests, sources_);
    if (!staged) {
        return staged.error();
    }
    staging_ = std::move(*staged);
    sources_.clear();
    return success();
}

MemoryUse StaticBuffers::use() const {
    MemoryUse use = device_.use();
    use += staging_.use();
    return use;
}

void StaticBuffers::countStatics(StaticCount& count) const {
    if (counted_ == count.number) {
        return; // in several lists
    }
    counted_ = count.number;
    count.bytes += total_;
    count.left += total_ - sent_;
    count.frameBytes += recordedFrame_ == count.frame ? sent_ - sentBefore_ : 0;
}

VkDeviceSize StaticBuffers::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    if (!staticsPending()) {
        return 0;
    }
    Uploads* const uploads = owner_->uploads;
    const VkDeviceSize left = uploads != nullptr ? uploads->left() : total_;
    const VkDeviceSize bytes = std::min(left, total_ - sent_);
    if (bytes == 0) {
        return 0;
    }
    if (recordedFrame_ != frame) {
        sentBefore_ = sent_;
        recordedFrame_ = frame;
    }
    const VkDeviceSize end = sent_ + bytes;
    VkDeviceSize first = 0; // of buffer i
    for (size_t i = 0; i < count_ && first < end; first += device_.size(i++)) {
        const VkDeviceSize from = std::max(first, sent_), to = std::min(first + device_.size(i), end);
        if (from < to) {
            recordCopy(commandBuffer, i, from - first, to - from);
        }
    }
    sent_ = end;
    if (uploads != nullptr) {
        uploads->count(bytes);
    }
    return bytes;
}

void StaticBuffers::recordCopy(VkCommandBuffer commandBuffer, size_t index, VkDeviceSize offset, VkDeviceSize bytes) {
    VkBufferCopy copy{offset, offset, bytes};
    VkBuffer source = VK_NULL_HANDLE;
    if (sources_.empty()) {
        source = staging_.buffer(index);
    } else {
        const Uploads::Piece piece = owner_->uploads->take(bytes);
        std::memcpy(piece.mapped, sources_[index].bytes.data() + offset, bytes);
        copy.srcOffset = piece.offset;
        source = piece.buffer;
    }
    owner_->vk.CmdCopyBuffer(commandBuffer, source, device_.buffer(index), 1, &copy);
}

void StaticBuffers::cancelFrame(uint64_t frame) {
    if (!released_ && frame != 0 && recordedFrame_ == frame) {
        sent_ = sentBefore_;
    }
}

void StaticBuffers::beginFrame(uint64_t completedFrame) {
    if (staticsPending() || released_ || recordedFrame_ > completedFrame) {
        return;
    }
    staging_ = BufferSet();
    sources_ = {};
    released_ = true;
}

} // namespace supple::gpu
