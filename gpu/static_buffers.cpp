#include "gpu/static_buffers.h"

#include <cstring>

namespace supple::gpu {

Result<StaticBuffers> StaticBuffers::create(const Device& device, std::span<const StaticRequest> requests) {
    std::vector<BufferRequest> local, staging;
    for (const StaticRequest& request : requests) {
        local.push_back({request.name, request.bytes.size(), request.usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryPurpose::tables});
        staging.push_back({request.name, request.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    }
    StaticBuffers buffers;
    buffers.owner_ = &device;
    buffers.count_ = requests.size();
    Result<BufferSet> localSet = BufferSet::create(device, local, MemoryKind::deviceLocal);
    if (!localSet) {
        return localSet.error();
    }
    Result<BufferSet> stagingSet = BufferSet::create(device, staging, MemoryKind::upload);
    if (!stagingSet) {
        return stagingSet.error();
    }
    buffers.device_ = std::move(*localSet);
    buffers.staging_ = std::move(*stagingSet);
    for (size_t i = 0; i < requests.size(); ++i) {
        if (requests[i].bytes.empty()) {
            continue;
        }
        std::memcpy(buffers.staging_.mapped(i), requests[i].bytes.data(), requests[i].bytes.size());
    }
    return buffers;
}

MemoryUse StaticBuffers::use() const {
    MemoryUse use = device_.use();
    use += staging_.use();
    return use;
}

VkDeviceSize StaticBuffers::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    if (recorded_) {
        return 0;
    }
    VkDeviceSize bytes = 0;
    for (size_t i = 0; i < count_; ++i) {
        if (device_.size(i) == 0) {
            continue;
        }
        const VkBufferCopy copy{0, 0, device_.size(i)};
        owner_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(i), device_.buffer(i), 1, &copy);
        bytes += copy.size;
    }
    recorded_ = true;
    recordedFrame_ = frame;
    return bytes;
}

void StaticBuffers::cancelFrame(uint64_t frame) {
    if (recorded_ && !released_ && recordedFrame_ == frame) {
        recorded_ = false;
    }
}

void StaticBuffers::beginFrame(uint64_t completedFrame) {
    if (!recorded_ || released_ || recordedFrame_ > completedFrame) {
        return;
    }
    staging_ = BufferSet();
    released_ = true;
}

} // namespace supple::gpu
