// Work that is recorded once, and once more if the frame that had it is cancelled.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"

#include <cstdint>
#include <vector>

namespace supple::runtime {

class RecordedOnce final : public gpu::FrameMember {
public:
    [[nodiscard]] bool due() const { return due_; }
    void record(uint64_t frame) {
        due_ = false;
        frame_ = frame;
    }
    [[nodiscard]] bool recordedIn(uint64_t frame) const { return !due_ && frame_ == frame; }
    [[nodiscard]] bool recordedBy(uint64_t frame) const { return !due_ && frame_ <= frame; }
    /// The work is due again; `wanted` false: there is none.
    void renew(bool wanted = true) { due_ = wanted; }
    void cancelFrame(uint64_t frame) override { due_ = due_ || (frame_ == frame && frame != 0); }

private:
    bool due_ = true;
    uint64_t frame_ = 0; ///< that recorded it; 0: none has
};

/// Buffers that are zero before the first frame that uses them.
class ZeroedOnce final : public gpu::FrameMember {
public:
    /// The plan of the buffer has been carried out. A buffer that is not there is passed over.
    void add(const gpu::Device& device, const gpu::PlannedBuffer& buffer, VkDeviceSize offset = 0,
             VkDeviceSize size = VK_WHOLE_SIZE) {
        if (buffer.buffer() != VK_NULL_HANDLE) {
            device_ = &device;
            ranges_.push_back({buffer.buffer(), offset, size});
        }
    }
    /// The buffers are gone. Those that are added from then on are zeroed.
    void forget() {
        ranges_.clear();
        once_.renew();
    }
    [[nodiscard]] bool staticsPending() const override { return !ranges_.empty() && once_.due(); }
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override {
        if (staticsPending()) {
            once_.record(frame);
            for (const BufferRange& range : ranges_) {
                device_->vk.CmdFillBuffer(commandBuffer, range.buffer, range.offset, range.size, 0);
            }
        }
        return 0;
    }
    void cancelFrame(uint64_t frame) override { once_.cancelFrame(frame); }
    [[nodiscard]] bool recordedIn(uint64_t frame) const { return once_.recordedIn(frame); }

private:
    struct BufferRange {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize offset = 0, size = 0;
    };
    const gpu::Device* device_ = nullptr;
    std::vector<BufferRange> ranges_;
    RecordedOnce once_;
};

} // namespace supple::runtime
