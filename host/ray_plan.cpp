#include "host/ray_plan.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace supple::host {

namespace {

constexpr float kShrunk = 0.5f, kGrown = 2.0f; // of a box's area

/// Half of the box's surface; 0 without one.
float areaOf(const std::optional<SuppleBounds>& box) {
    if (!box)
        return 0.0f;
    const float x = box->max[0] - box->min[0], y = box->max[1] - box->min[1], z = box->max[2] - box->min[2];
    return x * y + y * z + z * x;
}

/// Vertices that are not finite would lose hits of other instances too.
bool canBeTraced(const TracedInstance& instance) {
    return !instance.box || std::isfinite(areaOf(instance.box));
}

} // namespace

void RayPlan::plan(std::span<const TracedInstance> instances) {
    ++frame_;
    tasks_.clear();
    due_.clear();
    traced_.clear();
    for (uint32_t i = 0; i < instances.size(); ++i) {
        if (canBeTraced(instances[i]))
            addDue(i, instances[i]);
    }
    const size_t count = std::min<size_t>(due_.size(), options_.mostPerFrame);
    std::partial_sort(due_.begin(), due_.begin() + static_cast<ptrdiff_t>(count), due_.end(),
                      [](const Due& a, const Due& b) {
                          return std::tie(a.reason, a.worked, a.index) < std::tie(b.reason, b.worked, b.index);
                      });
    const uint32_t share = std::max(options_.rebuildShare, 1u);
    uint32_t rebuilds = std::max(static_cast<uint32_t>(instances.size()) / share, 1u);
    for (size_t i = 0; i < count; ++i)
        give(instances[due_[i].index], due_[i], rebuilds);
    for (const TracedInstance& instance : instances) {
        if (slots_[instance.slot].isBuilt && canBeTraced(instance))
            traced_.push_back(instance.slot);
    }
}

void RayPlan::addDue(uint32_t index, const TracedInstance& instance) {
    Slot& slot = slots_[instance.slot];
    const bool isNew = instance.isNew || slot.listed + 1 != frame_;
    slot.listed = frame_;
    slot.isBuilt = slot.isBuilt && !isNew;
    if (!slot.isBuilt) {
        due_.push_back({index, Reason::isNew, slot.worked});
    } else if (!std::ranges::equal(slot.hiddenParts, instance.hiddenParts)) {
        due_.push_back({index, Reason::partsChanged, slot.worked});
    } else if (frame_ - slot.worked >= instance.interval) {
        due_.push_back({index, Reason::inTurn, slot.worked});
    }
}

bool RayPlan::isWorn(const TracedInstance& instance) const {
    const Slot& slot = slots_[instance.slot];
    const float area = areaOf(instance.box);
    const bool boxChanged =
        slot.builtArea > 0.0f && area > 0.0f && (area < kShrunk * slot.builtArea || area > kGrown * slot.builtArea);
    return boxChanged || frame_ - slot.built >= options_.rebuildAge;
}

void RayPlan::give(const TracedInstance& instance, const Due& due, uint32_t& rebuilds) {
    Slot& slot = slots_[instance.slot];
    const bool isRebuilt = due.reason == Reason::inTurn && rebuilds > 0 && isWorn(instance);
    rebuilds -= isRebuilt ? 1 : 0;
    slot.worked = frame_;
    if (due.reason == Reason::inTurn && !isRebuilt) {
        if (slot.builtArea == 0.0f) // boxes come frames later
            slot.builtArea = areaOf(instance.box);
        tasks_.push_back({instance.slot, Work::update});
        return;
    }
    // Those that are built in one frame grow old in different ones.
    const int64_t head = due.reason == Reason::isNew ? instance.slot % std::max(options_.rebuildAge, 1u) : 0;
    slot.isBuilt = true;
    slot.built = frame_ - head;
    slot.builtArea = due.reason == Reason::isNew ? 0.0f : areaOf(instance.box); // a new one's box comes later
    slot.hiddenParts.assign(instance.hiddenParts.begin(), instance.hiddenParts.end());
    tasks_.push_back({instance.slot, Work::build});
}

} // namespace supple::host
