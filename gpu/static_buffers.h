// Device-local buffers filled once: created from bytes on the CPU, uploaded by the first command buffer that needs
// them.
#pragma once

#include "gpu/frame_member.h"
#include "gpu/memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::gpu {

struct StaticRequest {
    const char* name = "";
    VkBufferUsageFlags usage = 0;     ///< TRANSFER_DST is added
    std::span<const std::byte> bytes; ///< copied to staging memory at once
};

class StaticBuffers final : public FrameMember {
public:
    [[nodiscard]] static Result<StaticBuffers> create(const Device& device, std::span<const StaticRequest> requests);

    [[nodiscard]] VkBuffer buffer(size_t index) const { return device_.buffer(index); }
    [[nodiscard]] VkDeviceSize size(size_t index) const { return device_.size(index); }
    /// With the staging memory, as long as that is there.
    [[nodiscard]] MemoryUse use() const;
    [[nodiscard]] bool empty() const { return count_ == 0; }

    [[nodiscard]] bool staticsPending() const override { return count_ > 0 && !recorded_; }
    /// Records the copies if that has not been done; returns the bytes copied.
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    void cancelFrame(uint64_t frame) override;
    /// Frees the staging memory once the frame that uploaded is complete.
    void beginFrame(uint64_t completedFrame) override;

private:
    const Device* owner_ = nullptr;
    BufferSet device_, staging_;
    size_t count_ = 0;
    bool recorded_ = false;
    bool released_ = false;
    uint64_t recordedFrame_ = 0;
};

} // namespace supple::gpu
