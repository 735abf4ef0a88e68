// Device-local buffers filled once: created from bytes on the CPU, uploaded by the first command buffers that need
// them. With a budget (gpu/uploads.h) these are those of several frames.
#pragma once

#include "gpu/frame_member.h"
#include "gpu/memory.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace supple::gpu {

struct StaticRequest {
    const char* name = "";
    VkBufferUsageFlags usage = 0; ///< TRANSFER_DST is added
    std::span<const std::byte> bytes;
    /// Keeps the bytes where they are until they are uploaded. Null: they are copied at once.
    std::shared_ptr<const void> keeper;
};

class StaticBuffers final : public FrameMember {
public:
    /// Without a budget the bytes go to staging memory of their own, now. With one they go through the budget's memory,
    /// a piece a frame.
    [[nodiscard]] static Result<StaticBuffers> create(const Device& device, std::span<const StaticRequest> requests);

    [[nodiscard]] VkBuffer buffer(size_t index) const { return device_.buffer(index); }
    [[nodiscard]] VkDeviceSize size(size_t index) const { return device_.size(index); }
    /// With the staging memory, as long as that is there.
    [[nodiscard]] MemoryUse use() const;
    [[nodiscard]] bool empty() const { return count_ == 0; }

    [[nodiscard]] bool staticsPending() const override { return sent_ < total_; }
    /// Records the copies that have not been recorded, as far as the frame's budget goes; returns the bytes copied.
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    void countStatics(StaticCount& count) const override;
    /// Takes staging memory for what the budget's memory was to take.
    [[nodiscard]] Status stageStatics() override;
    void cancelFrame(uint64_t frame) override;
    /// Frees staging memory and bytes once the frame that uploaded the last of them is complete.
    void beginFrame(uint64_t completedFrame) override;

private:
    struct Source {
        std::span<const std::byte> bytes;
        std::shared_ptr<const void> keeper;
    };
    [[nodiscard]] static Result<BufferSet> stage(const Device& device, std::span<const BufferRequest> requests,
                                                 std::span<const Source> sources);
    void recordCopy(VkCommandBuffer commandBuffer, size_t index, VkDeviceSize offset, VkDeviceSize bytes);

    const Device* owner_ = nullptr;
    BufferSet device_, staging_;
    std::vector<Source> sources_; ///< empty: staging_ has their bytes
    size_t count_ = 0;
    VkDeviceSize total_ = 0;      ///< bytes of all buffers
    VkDeviceSize sent_ = 0;       ///< recorded, one buffer after the other
    VkDeviceSize sentBefore_ = 0; ///< by frames before recordedFrame_
    uint64_t recordedFrame_ = 0;  ///< the last that has copies; 0: none
    bool released_ = false;
    mutable uint64_t counted_ = 0; ///< StaticCount::number of the last count
};

} // namespace supple::gpu
