// What every pass cost: GPU timestamps ringed over the frames in flight, CPU record time, elements and bytes written.
#pragma once

#include "gpu/timers.h"
#include "supple/supple.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace supple::runtime {

class Timings {
public:
    [[nodiscard]] Status create(const gpu::Device& device, uint32_t framesInFlight);

    /// Collects what completed frames measured; never waits.
    void beginFrame(uint64_t frame, uint64_t completedFrame);

    // Recording: open() once a suppleRecord, then beginPass/endPass round each pass of each group.
    void open(VkCommandBuffer commandBuffer, bool enabled);
    void beginPass();
    void endPass(VkCommandBuffer commandBuffer, const char* pass, uint32_t group, uint64_t points, uint64_t bytes);

    /// The newest completed frame; empty when there is none.
    [[nodiscard]] const std::vector<SuppleTiming>& latest() const { return latest_; }

private:
    struct Slot {
        gpu::Timers timers;
        uint64_t frame = 0;
        std::vector<SuppleTiming> entries;
        std::vector<uint32_t> marks; ///< per entry: the timestamp that ends it; the one before begins it
    };
    void collect(Slot& slot);
    [[nodiscard]] double nanoseconds(uint64_t ticks) const;

    std::vector<Slot> slots_;
    Slot* current_ = nullptr;
    bool timestamps_ = false; ///< the queue family has them
    bool enabled_ = false;
    uint64_t tickMask_ = 0;
    double tickPeriod_ = 1.0;
    bool originKnown_ = false;
    uint64_t origin_ = 0; ///< first tick seen: differences are taken as integers, which doubles could not hold
    std::chrono::steady_clock::time_point passBegin_;
    std::vector<SuppleTiming> latest_;
};

} // namespace supple::runtime
