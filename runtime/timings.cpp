#include "runtime/timings.h"

#include "runtime/sized.h"

#include <algorithm>
#include <cstdio>
#include <span>

namespace supple::runtime {

static_assert(kPassCount == SUPPLE_PASS_QUERIES + 1, "add the name of the pass");

const char* passName(SupplePass pass) {
    const uint32_t index = rawValue(pass);
    return index < kPassCount ? kPassNames[index] : "unknown SupplePass";
}

Status Timings::create(const gpu::Device& device, uint32_t framesInFlight) {
    timestamps_ = device.timestampValidBits > 0;
    tickMask_ = device.timestampValidBits >= 64 ? ~0ull : (1ull << device.timestampValidBits) - 1;
    tickPeriod_ = static_cast<double>(device.limits.timestampPeriod);
    latest_.reserve(SUPPLE_MAX_TIMINGS);
    for (uint32_t i = 0; i < framesInFlight; ++i) {
        auto slot = std::make_unique<Slot>();
        slot->entries.resize(SUPPLE_MAX_TIMINGS);
        slot->marks.resize(SUPPLE_MAX_TIMINGS);
        slot->solved.resize(SUPPLE_MAX_TIMINGS);
        if (timestamps_) {
            // A pass ends with a mark and begins with the one before; each suppleRecord adds one.
            Result<gpu::Timers> timers = gpu::Timers::create(device, 2 * SUPPLE_MAX_TIMINGS, "supple timings");
            if (!timers) {
                return timers.error();
            }
            slot->timers = std::move(*timers);
        }
        slots_.push_back(std::move(slot));
    }
    return success();
}

double Timings::nanoseconds(uint64_t ticks) const {
    return static_cast<double>((ticks - origin_.value_or(0)) & tickMask_) * tickPeriod_;
}

Result<bool> Timings::collect(Slot& slot, const std::function<Shortfall(const View*, uint64_t)>& shortfall) {
    const size_t count = std::min<size_t>(slot.count.load(), SUPPLE_MAX_TIMINGS);
    if (timestamps_) {
        const Result<std::span<const gpu::Timers::Tick>> ticks = slot.timers.read();
        if (!ticks) {
            return ticks.error();
        }
        const auto at = [&](uint32_t mark) { return (*ticks)[mark]; };
        for (size_t i = 0; i < count; ++i) {
            if (at(slot.marks[i] - 1).available == 0 || at(slot.marks[i]).available == 0) {
                return false; // the host says that the frame is complete; the device does not
            }
        }
        if (!origin_ && count > 0) {
            origin_ = at(slot.marks[0] - 1).value;
        }
        for (size_t i = 0; i < count; ++i) {
            slot.entries[i].gpuBegin = nanoseconds(at(slot.marks[i] - 1).value);
            slot.entries[i].gpuEnd = nanoseconds(at(slot.marks[i]).value);
        }
    }
    latest_.clear();
    for (size_t i = 0; i < count && latest_.size() < SUPPLE_MAX_TIMINGS; ++i) {
        latest_.push_back(slot.entries[i]);
        const Shortfall own = slot.solved[i] != nullptr ? shortfall(slot.solved[i], slot.frame) : Shortfall{};
        if (own.any && latest_.size() < SUPPLE_MAX_TIMINGS) {
            const SuppleTiming& solve = slot.entries[i];
            latest_.push_back({SUPPLE_PASS_SHORTFALL, SUPPLE_NO_SURFACE, solve.group, solve.frame, solve.gpuEnd,
                               solve.gpuEnd, 0.0, own.instances, own.bytes});
        }
    }
    return true;
}

Status Timings::beginFrame(uint64_t frame, uint64_t completedFrame,
                           const std::function<Shortfall(const View*, uint64_t)>& shortfall,
                           const std::function<void(const char*)>& warn) {
    Status status = success();
    // In the order of frames, so that each is counted when several have completed since the last call.
    const auto oldest = [&]() -> Slot* {
        Slot* found = nullptr;
        for (const std::unique_ptr<Slot>& slot : slots_) {
            if (slot->frame != 0 && slot->frame <= completedFrame && (found == nullptr || slot->frame < found->frame)) {
                found = slot.get();
            }
        }
        return found;
    };
    while (Slot* const slot = oldest()) {
        if (slot->count.load() > 0) {
            const Result<bool> collected = collect(*slot, shortfall);
            if (!collected) {
                status = collected.error();
            } else if (*collected) {
                judge(warn);
            }
        }
        slot->frame = 0;
    }
    if (!status) {
        return status; // the frame has not begun
    }
    current_ = slots_[frame % slots_.size()].get();
    current_->frame = frame;
    current_->count = 0;
    current_->timers.clear();
    return success();
}

void Timings::cancelFrame() {
    current_->count = 0;
    current_->timers.clear();
}

Timings::Recording Timings::open(VkCommandBuffer commandBuffer, uint64_t entries) {
    Recording recording;
    if (timestamps_) {
        const auto wanted = static_cast<uint32_t>(std::min<uint64_t>(entries, SUPPLE_MAX_TIMINGS) + 1);
        if (!current_->timers.take(commandBuffer, wanted, recording.mark_)) {
            return recording;
        }
        current_->timers.mark(commandBuffer, recording.mark_);
        recording.first_ = recording.mark_;
    }
    recording.timings_ = this;
    recording.commandBuffer_ = commandBuffer;
    return recording;
}

void Timings::Recording::beginPass() {
    if (timings_ != nullptr) {
        passBegin_ = std::chrono::steady_clock::now();
    }
}

void Timings::Recording::endPass(SupplePass pass, SuppleGroup group, uint32_t surface, const PassCost& cost) {
    if (timings_ == nullptr) {
        return;
    }
    Slot& slot = *timings_->current_;
    const uint32_t entry = slot.count.fetch_add(1);
    if (entry >= SUPPLE_MAX_TIMINGS) {
        end();
        return;
    }
    const double cpu = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - passBegin_).count();
    if (timings_->timestamps_) {
        slot.timers.mark(commandBuffer_, ++mark_);
    }
    slot.entries[entry] = {pass, surface, group, slot.frame, 0.0, 0.0, cpu, cost.points, cost.bytes};
    slot.marks[entry] = mark_;
    slot.solved[entry] = cost.solved;
}

void Timings::Recording::end() {
    if (timings_ != nullptr && timings_->timestamps_) {
        timings_->current_->timers.finish(commandBuffer_, first_, mark_ - first_ + 1);
    }
    timings_ = nullptr;
}

bool Timings::setBudget(SupplePass pass, double nanoseconds) {
    if (budget(pass) == nullptr) {
        return false;
    }
    budgets_[pass] = {};
    budgets_[pass].limit = nanoseconds;
    return true;
}

const SuppleBudget* Timings::budget(SupplePass pass) const {
    return rawValue(pass) >= kPassCount || pass == SUPPLE_PASS_SHORTFALL ? nullptr : &budgets_[pass];
}

void Timings::judge(const std::function<void(const char*)>& warn) {
    for (size_t i = 0; i < kPassCount; ++i) {
        SuppleBudget& budget = budgets_[i];
        if (budget.limit <= 0.0) {
            continue;
        }
        double spent = 0.0;
        for (const SuppleTiming& timing : latest_) {
            if (i == SUPPLE_PASS_ALL || timing.pass == i) {
                spent += timing.gpuEnd - timing.gpuBegin;
            }
        }
        const bool wasOver = budget.latest > budget.limit;
        budget.latest = spent;
        budget.worst = std::max(budget.worst, spent);
        ++budget.framesMeasured;
        if (spent > budget.limit) {
            ++budget.framesOver;
            if (!wasOver) {
                char text[128];
                std::snprintf(text, sizeof(text), "frame %llu: %s took %.3f ms of its %.3f",
                              static_cast<unsigned long long>(latest_.front().frame), kPassNames[i], spent * 1e-6,
                              budget.limit * 1e-6);
                warn(text);
            }
        }
    }
}

} // namespace supple::runtime
