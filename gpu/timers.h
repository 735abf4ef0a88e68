// GPU timestamps of one frame. Reading never blocks: where the driver would wait (Mapping::lazyTimestamps), the command
// buffer copies them into a buffer that the host reads.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::gpu {

/// One query pool of `capacity` timestamps, handed out in runs, so that command buffers recorded at the same time each
/// have their own.
class Timers {
public:
    [[nodiscard]] static Result<Timers> create(const Device& device, uint32_t capacity, const char* name);
    Timers() = default;
    Timers(Timers&& other) noexcept;
    Timers& operator=(Timers&& other) noexcept;

    /// Takes all runs back; nothing recorded with them may be pending.
    void clear();
    /// Takes a run of timestamps and records their reset; false when there are not as many left. Any thread.
    [[nodiscard]] bool take(VkCommandBuffer commandBuffer, uint32_t count, uint32_t& first);
    /// Records timestamp `index` of a run, after everything recorded before.
    void mark(VkCommandBuffer commandBuffer, uint32_t index) const;
    /// Behind the last mark of a run: sees to it that read() finds `count` timestamps from `first` on.
    void finish(VkCommandBuffer commandBuffer, uint32_t first, uint32_t count) const;

    struct Tick {
        uint64_t value = 0;
        uint64_t available = 0; ///< 0: the device has not written it
    };
    /// All timestamps taken, by index. The frame must be complete. Valid until the next call.
    [[nodiscard]] Result<std::span<const Tick>> read();

private:
    const Device* device_ = nullptr;
    QueryPoolHandle pool_;
    uint32_t capacity_ = 0;
    std::atomic<uint32_t> taken_ = 0;
    [[nodiscard]] bool copies() const { return device_->mapping.lazyTimestamps; }
    [[nodiscard]] Tick* copied() const { return reinterpret_cast<Tick*>(readback_.mapped(0)); }

    BufferSet readback_;    ///< ticks, if the command buffer copies them
    std::vector<Tick> raw_; ///< otherwise
};

} // namespace supple::gpu
