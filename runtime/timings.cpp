#include "runtime/timings.h"

#include <span>

namespace supple::runtime {

Status Timings::create(const gpu::Device& device, uint32_t framesInFlight) {
    timestamps_ = device.timestampValidBits > 0;
    tickMask_ = device.timestampValidBits >= 64 ? ~0ull : (1ull << device.timestampValidBits) - 1;
    tickPeriod_ = static_cast<double>(device.limits.timestampPeriod);
    latest_.reserve(SUPPLE_MAX_TIMINGS);
    slots_.resize(framesInFlight);
    for (Slot& slot : slots_) {
        slot.entries.reserve(SUPPLE_MAX_TIMINGS);
        slot.marks.reserve(SUPPLE_MAX_TIMINGS);
        if (!timestamps_) {
            continue;
        }
        // A pass ends with a mark and begins with the one before; each suppleRecord adds one.
        Result<gpu::Timers> timers = gpu::Timers::create(device, 2 * SUPPLE_MAX_TIMINGS, "supple timings");
        if (!timers) {
            return timers.error();
        }
        slot.timers = std::move(*timers);
    }
    return success();
}

double Timings::nanoseconds(uint64_t ticks) const {
    return static_cast<double>((ticks - origin_) & tickMask_) * tickPeriod_;
}

void Timings::collect(Slot& slot) {
    if (timestamps_) {
        const std::span<const uint64_t> ticks = slot.timers.read();
        if (ticks.empty()) {
            return;
        }
        if (!originKnown_) {
            origin_ = ticks.front();
            originKnown_ = true;
        }
        for (size_t i = 0; i < slot.entries.size(); ++i) {
            slot.entries[i].gpuBegin = nanoseconds(ticks[slot.marks[i] - 1]);
            slot.entries[i].gpuEnd = nanoseconds(ticks[slot.marks[i]]);
        }
    }
    latest_.assign(slot.entries.begin(), slot.entries.end());
}

void Timings::beginFrame(uint64_t frame, uint64_t completedFrame) {
    for (Slot& slot : slots_) {
        if (slot.frame == 0 || slot.frame > completedFrame) {
            continue;
        }
        const bool newer = latest_.empty() || slot.frame > latest_.front().frame;
        if (newer && !slot.entries.empty()) {
            collect(slot);
        }
        slot.frame = 0;
    }
    current_ = &slots_[frame % slots_.size()];
    current_->frame = frame;
    current_->entries.clear();
    current_->marks.clear();
    enabled_ = false;
}

void Timings::open(VkCommandBuffer commandBuffer, bool enabled) {
    enabled_ = enabled;
    if (!enabled_ || !timestamps_) {
        return;
    }
    if (current_->entries.empty()) {
        current_->timers.reset(commandBuffer);
    }
    uint32_t mark = 0;
    enabled_ = current_->timers.mark(commandBuffer, mark);
}

void Timings::beginPass() {
    if (enabled_) {
        passBegin_ = std::chrono::steady_clock::now();
    }
}

void Timings::endPass(VkCommandBuffer commandBuffer, const char* pass, uint32_t group, uint64_t points,
                      uint64_t bytes) {
    if (!enabled_ || current_->entries.size() == SUPPLE_MAX_TIMINGS) {
        return;
    }
    const double cpu = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - passBegin_).count();
    uint32_t mark = 0;
    if (timestamps_ && !current_->timers.mark(commandBuffer, mark)) {
        enabled_ = false;
        return;
    }
    current_->entries.push_back({pass, group, current_->frame, 0.0, 0.0, cpu, points, bytes});
    current_->marks.push_back(mark);
}

} // namespace supple::runtime
