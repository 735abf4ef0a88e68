// Which acceleration structures of a group's instances a frame builds, and which it updates. It decides, and knows no
// device.
//
// A structure is built when its instance is new or other parts of it are hidden, as an update may change neither. Else
// it is updated in place, and built anew from time to time, because a tree that is updated gets worse: at an age, and
// when the box has grown or shrunk a lot.
#pragma once

#include <supple/supple.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace supple::host {

/// An instance that a frame traces: one that the host shows.
struct TracedInstance {
    uint32_t slot = 0;
    /// It has come into being or has teleported since the last frame, or its asset was reloaded. Who was not traced in
    /// the last frame is new without it.
    bool isNew = false;
    std::span<const uint32_t> hiddenParts; ///< rising; needed during the call
    uint32_t interval = 1;                 ///< frames from update to update: 2 or 4 for who is far or small
    /// Where known (suppleReadInstanceBounds): of a frame or two ago will do. If it is not finite, the instance is not
    /// traced.
    std::optional<SuppleBounds> box;
};

struct RayPlanOptions {
    uint32_t mostPerFrame = 16; ///< structures that a frame builds or updates
    uint32_t rebuildAge = 64;   ///< frames after which one is built anew
    /// In a frame, one in so many of the traced instances may be built anew for its age or its box; one always may.
    uint32_t rebuildShare = 16;
};

class RayPlan {
public:
    enum class Work { build, update };
    struct Task {
        uint32_t slot = 0;
        Work work = Work::build;
    };

    RayPlan(uint32_t capacity, const RayPlanOptions& options) : options_(options), slots_(capacity) {
        tasks_.reserve(options.mostPerFrame);
        due_.reserve(capacity);
        traced_.reserve(capacity);
    }

    /// Plans a frame. Those that must be built come first, then those that have waited longest.
    void plan(std::span<const TracedInstance> instances);
    [[nodiscard]] std::span<const Task> tasks() const { return tasks_; }
    /// Slots whose structure can be traced once the tasks are done. Who is new and had no turn is not among them. Who
    /// had no turn otherwise is traced as it was.
    [[nodiscard]] std::span<const uint32_t> traced() const { return traced_; }
    /// Parts that the structure of a slot leaves out.
    [[nodiscard]] std::span<const uint32_t> hiddenParts(uint32_t slot) const { return slots_[slot].hiddenParts; }

private:
    struct Slot {
        bool isBuilt = false;
        int64_t listed = 0, worked = 0, built = 0; ///< frames of the plan: the last of each kind
        float builtArea = 0.0f;                    ///< of the box when it was built; 0: not known
        std::vector<uint32_t> hiddenParts;         ///< when it was built
    };
    /// Why a structure is worked on; what comes first goes first.
    enum class Reason { isNew, partsChanged, inTurn };
    struct Due {
        uint32_t index = 0; ///< of the instance
        Reason reason = Reason::isNew;
        int64_t worked = 0;
    };
    void addDue(uint32_t index, const TracedInstance& instance);
    void give(const TracedInstance& instance, const Due& due, uint32_t& rebuilds);
    [[nodiscard]] bool isWorn(const TracedInstance& instance) const;

    RayPlanOptions options_;
    std::vector<Slot> slots_;
    std::vector<Task> tasks_;
    std::vector<Due> due_;
    std::vector<uint32_t> traced_;
    int64_t frame_ = 0;
};

} // namespace supple::host
