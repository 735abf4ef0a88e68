// GPU timestamps of one frame. Reading never blocks.
#pragma once

#include "base/result.h"
#include "gpu/handle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::gpu {

/// One query pool of `capacity` timestamps. reset() and mark() are recorded; read() needs the frame to be complete.
class Timers {
public:
    [[nodiscard]] static Result<Timers> create(const Device& device, uint32_t capacity, const char* name);

    void reset(VkCommandBuffer commandBuffer);
    /// Records a timestamp after everything recorded before; returns its index, or false when the pool is full.
    [[nodiscard]] bool mark(VkCommandBuffer commandBuffer, uint32_t& index);
    [[nodiscard]] uint32_t count() const { return count_; }
    /// The device's ticks at each mark; empty when the device has not written them all yet. Valid until the next call.
    [[nodiscard]] std::span<const uint64_t> read();

private:
    const Device* device_ = nullptr;
    QueryPoolHandle pool_;
    uint32_t capacity_ = 0;
    uint32_t count_ = 0;
    std::vector<uint64_t> raw_;
};

} // namespace supple::gpu
