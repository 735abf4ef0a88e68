// How many bytes of static data a frame may upload, and the memory that they go through.
#pragma once

#include "gpu/memory.h"

#include <cstdint>
#include <vector>

namespace supple::gpu {

/// One thread at a time, as for what is uploaded.
class Uploads {
public:
    /// Until the next call a frame uploads so many bytes at most; 0: no bound. The memory for all frames in flight is
    /// taken here, so that recording takes none. If that fails, nothing has changed.
    [[nodiscard]] Status setBudget(const Device& device, VkDeviceSize bytes, uint32_t framesInFlight);
    [[nodiscard]] VkDeviceSize budget() const { return budget_; }
    [[nodiscard]] bool bounded() const { return budget_ > 0; }

    void beginFrame(uint64_t frame, uint64_t completedFrame);
    /// The open frame's command buffers will never run.
    void cancelFrame();

    /// Bytes that the open frame may still upload.
    [[nodiscard]] VkDeviceSize left() const;
    /// A part of the frame's staging memory.
    struct Piece {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
        std::byte* mapped = nullptr;
    };
    /// With a bound: memory for no more than left().
    [[nodiscard]] Piece take(VkDeviceSize bytes);
    /// Every byte that is uploaded counts, whatever memory it goes through.
    void count(VkDeviceSize bytes);
    /// The open frame is to upload so many bytes: they are not left for others.
    void reserve(VkDeviceSize bytes) { reserved_ += bytes; }
    /// Some of them are uploaded.
    void countReserved(VkDeviceSize bytes);

    [[nodiscard]] VkDeviceSize frameBytes() const { return frameBytes_; }
    [[nodiscard]] VkDeviceSize totalBytes() const { return totalBytes_; }

private:
    VkDeviceSize budget_ = 0;
    uint32_t framesInFlight_ = 1;
    uint64_t frame_ = 0;
    BufferSet memory_;       ///< with a bound: budget_ bytes a frame in flight
    VkDeviceSize taken_ = 0; ///< of the frame's part of it
    VkDeviceSize frameBytes_ = 0, totalBytes_ = 0;
    VkDeviceSize reserved_ = 0; ///< and not uploaded yet
    /// Memory of earlier budgets, which frames in flight may still read.
    struct Before {
        BufferSet memory;
        uint64_t lastFrame = 0;
    };
    std::vector<Before> before_;
};

} // namespace supple::gpu
