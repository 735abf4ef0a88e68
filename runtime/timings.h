// What every pass cost: GPU timestamps ringed over the frames in flight, CPU record time, elements and bytes written;
// and the budgets of passes.
#pragma once

#include "gpu/timers.h"
#include "runtime/pass_cost.h"
#include "supple/supple.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace supple::runtime {

/// By SupplePass. That of all passes together stands in warnings.
inline constexpr const char* kPassNames[] = {"all passes", "upload",   "attributes", "pose",      "deform", "bounds",
                                             "list",       "vertex",   "assemble",   "patch",     "level",  "solve",
                                             "place",      "evaluate", "motion",     "shortfall", "points", "queries"};
inline constexpr size_t kPassCount = std::size(kPassNames);
[[nodiscard]] const char* passName(SupplePass pass);
/// The most entries that a group can have in a frame, for each of its surfaces, beside one for every cage stage. Pose
/// comes up to six times, bounds again for occlusion, level for patches, assemble and place for chains of leaves,
/// place for rates, and attributes if some surfaces have levels and others rates. Two of the names are no passes, and
/// queries are recorded by themselves.
inline constexpr size_t kMostEntries = kPassCount - 3 + 9;

class Timings {
public:
    [[nodiscard]] Status create(const gpu::Device& device, uint32_t framesInFlight);

    /// What a view's budget was not enough for in a frame.
    struct Shortfall {
        bool any = false;
        uint64_t instances = 0, bytes = 0; ///< as of SuppleTiming's `shortfall`
    };
    /// Collects what completed frames measured; never waits. `shortfall` is asked of the views that endPass was told
    /// of, `warn` is told of passes that have come to exceed their budget.
    [[nodiscard]] Status beginFrame(uint64_t frame, uint64_t completedFrame,
                                    const std::function<Shortfall(const View*, uint64_t frame)>& shortfall,
                                    const std::function<void(const char*)>& warn);
    /// Forgets what the frame has recorded.
    void cancelFrame();

    /// The measurements of one suppleRecord; several may be open at a time, each in its own command buffer.
    class Recording {
    public:
        [[nodiscard]] bool isOpen() const { return timings_ != nullptr; }
        void beginPass();
        /// `surface`: of the group, or SUPPLE_NO_SURFACE.
        void endPass(SupplePass pass, SuppleGroup group, uint32_t surface, const PassCost& cost);
        /// Behind the last pass.
        void end();

    private:
        friend class Timings;
        Timings* timings_ = nullptr; ///< null: nothing is measured
        VkCommandBuffer commandBuffer_ = VK_NULL_HANDLE;
        uint32_t first_ = 0, mark_ = 0; ///< timestamps: the first, and the last that is recorded
        std::chrono::steady_clock::time_point passBegin_;
    };
    /// Makes room for so many passes.
    [[nodiscard]] Recording open(VkCommandBuffer commandBuffer, uint64_t entries);
    /// How many passes groups can have that have so many surfaces together.
    [[nodiscard]] static uint64_t mostEntries(uint32_t surfaceCount, uint32_t stageCount) {
        return uint64_t{surfaceCount} * (kMostEntries + stageCount);
    }
    /// Whether anything of the frame has been measured so far.
    [[nodiscard]] bool measuresFrame() const { return current_->count.load() > 0; }

    /// The newest completed frame; empty when there is none.
    [[nodiscard]] const std::vector<SuppleTiming>& latest() const { return latest_; }
    /// In ticks: the first timestamp. Nothing before that.
    [[nodiscard]] std::optional<uint64_t> origin() const { return origin_; }

    /// False: no such pass. 0 takes the budget away.
    [[nodiscard]] bool setBudget(SupplePass pass, double nanoseconds);
    /// Null: no such pass. limit 0: it has no budget.
    [[nodiscard]] const SuppleBudget* budget(SupplePass pass) const;

private:
    struct Slot {
        gpu::Timers timers;
        uint64_t frame = 0;
        std::vector<SuppleTiming> entries; ///< SUPPLE_MAX_TIMINGS, of which `count` are in use
        std::vector<uint32_t> marks;       ///< per entry: the timestamp that ends it; the one before begins it
        std::vector<const View*> solved;   ///< per entry, or null; not to be read: it may be gone
        std::atomic<uint32_t> count = 0;
    };
    /// Makes it the latest; false where the device has not written all of its timestamps.
    [[nodiscard]] Result<bool> collect(Slot& slot, const std::function<Shortfall(const View*, uint64_t)>& shortfall);
    void judge(const std::function<void(const char*)>& warn);
    [[nodiscard]] double nanoseconds(uint64_t ticks) const;

    std::vector<std::unique_ptr<Slot>> slots_;
    Slot* current_ = nullptr;
    bool timestamps_ = false; ///< the queue family has them
    uint64_t tickMask_ = 0;
    double tickPeriod_ = 1.0;
    std::optional<uint64_t> origin_; ///< first tick seen: differences are integers, which doubles could not hold
    std::vector<SuppleTiming> latest_;
    std::array<SuppleBudget, kPassCount> budgets_{}; ///< by SupplePass
};

} // namespace supple::runtime
