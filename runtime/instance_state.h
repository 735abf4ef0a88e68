// What a pass keeps of every instance from frame to frame, on the device.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "runtime/recorded_once.h"

#include <cstdint>
#include <memory>
#include <span>

namespace supple::runtime {

/// A buffer with the same number of bytes for every slot. Those of new instances are zero, so that kernels see who is
/// new: let them write a word that is not. It moves with the instances to another group's stage.
class InstanceState final : public gpu::FrameMember {
public:
    /// `bytes`: of an instance, a multiple of 16. `name` must be static.
    [[nodiscard]] Status create(const gpu::Device& device, uint32_t capacity, VkDeviceSize bytes, const char* name);
    /// Takes the first `count` slots of another state, if that has as many bytes for each. Before the first recording.
    void takeOver(InstanceState& other, uint32_t count);

    /// Null, of no bytes, and with nothing to record, if it was not created.
    [[nodiscard]] VkBuffer buffer() const { return set_ != nullptr ? set_->buffer(0) : VK_NULL_HANDLE; }
    [[nodiscard]] VkDeviceSize bytes() const { return bytes_; } ///< of an instance
    [[nodiscard]] gpu::MemoryUse memoryUse() const { return set_ != nullptr ? set_->use() : gpu::MemoryUse{}; }

    /// With the uploads of a frame; the bytes. `newSlots`: rising.
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, std::span<const uint32_t> newSlots);
    void beginFrame(uint64_t completedFrame) override;
    void cancelFrame(uint64_t frame) override;

private:
    void recordMove(VkCommandBuffer commandBuffer) const;

    const gpu::Device* device_ = nullptr;
    VkDeviceSize bytes_ = 0;
    uint32_t capacity_ = 0;
    std::shared_ptr<gpu::BufferSet> set_;   ///< shared with the state that takes over
    std::shared_ptr<gpu::BufferSet> moved_; ///< whose slots this one takes over, until that has happened
    uint32_t movedCount_ = 0;
    RecordedOnce start_; ///< the first recording: moves, and makes zero
    // That of the state whose buffer is `moved_`, and where its slots were before: if the frame is cancelled, they are
    // there.
    RecordedOnce source_;
    std::shared_ptr<gpu::BufferSet> sourceMoved_;
    uint32_t sourceCount_ = 0;
};

} // namespace supple::runtime
