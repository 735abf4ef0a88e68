#include "runtime/timings.h"

namespace supple::runtime {

namespace {
constexpr uint32_t kMarks = 512; // timestamps a frame
}

Status Timings::create(const gpu::Device& device, uint32_t framesInFlight) {
    supported_ = device.timestampValidBits > 0;
    latest_.reserve(kMarks);
    nanoseconds_.resize(kMarks);
    slots_.resize(framesInFlight);
    for (Slot& slot : slots_) {
        slot.entries.reserve(kMarks);
        slot.marks.reserve(kMarks);
        if (!supported_) {
            continue;
        }
        Result<gpu::Timers> timers = gpu::Timers::create(device, kMarks, "supple timings");
        if (!timers) {
            return timers.error();
        }
        slot.timers = std::move(*timers);
    }
    return success();
}

void Timings::beginFrame(uint64_t frame, uint64_t completedFrame) {
    for (Slot& slot : slots_) {
        if (slot.frame == 0 || slot.frame > completedFrame) {
            continue;
        }
        const bool newer = latest_.empty() || slot.frame > latest_.front().frame;
        if (newer && !slot.entries.empty() && slot.timers.read(nanoseconds_)) {
            latest_.assign(slot.entries.begin(), slot.entries.end());
            for (size_t i = 0; i < latest_.size(); ++i) {
                latest_[i].gpuBegin = nanoseconds_[slot.marks[i] - 1];
                latest_[i].gpuEnd = nanoseconds_[slot.marks[i]];
            }
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
    enabled_ = enabled && supported_;
    if (!enabled_) {
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
    if (!enabled_) {
        return;
    }
    uint32_t mark = 0;
    if (!current_->timers.mark(commandBuffer, mark)) {
        enabled_ = false;
        return;
    }
    const double cpu = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - passBegin_).count();
    current_->entries.push_back({pass, group, current_->frame, 0.0, 0.0, cpu, points, bytes});
    current_->marks.push_back(mark);
}

} // namespace supple::runtime
