// Command buffers of frames in flight. A timeline semaphore counts the finished frames, which is what suppleBeginFrame
// asks. What fails here ends the process (host/must.h).
#pragma once

#include "host/device.h"

namespace supple::host {

inline constexpr uint32_t kFramesInFlight = 2;

class Frames {
public:
    explicit Frames(const Device& device);
    ~Frames();
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    /// Waits until there is room for another frame.
    void waitForRoom() const;
    /// Begins the next frame's command buffer, when there is room.
    VkCommandBuffer begin();
    /// acquired, drawn: of the swapchain, or null. The commands wait for `acquired` from `acquiredStages` on.
    void submit(VkSemaphore acquired = VK_NULL_HANDLE, VkPipelineStageFlags2 acquiredStages = 0,
                VkSemaphore drawn = VK_NULL_HANDLE);
    /// The number of the frame that was begun last, from 1.
    [[nodiscard]] uint64_t frame() const { return frame_; }
    /// The last frame that is complete.
    [[nodiscard]] uint64_t completed() const;
    /// Which of the resources that exist once per frame in flight.
    [[nodiscard]] uint32_t slot() const { return static_cast<uint32_t>(frame_ % kFramesInFlight); }
    [[nodiscard]] uint32_t nextSlot() const { return static_cast<uint32_t>((frame_ + 1) % kFramesInFlight); }

private:
    const Device& device_;
    VkSemaphore timeline_ = VK_NULL_HANDLE;
    VkCommandPool pools_[kFramesInFlight]{};
    VkCommandBuffer commands_[kFramesInFlight]{};
    uint64_t frame_ = 0;
};

} // namespace supple::host
