// Which instances of a view's group surely are out of its sight, found on the CPU before they are posed.
#pragma once

#include "runtime/instance_slots.h"
#include "runtime/pose_source.h"
#include "shaders/shared/bounds.h"

#include <cstdint>
#include <vector>

namespace supple::runtime {

/// Whether all of the box is where the view does not look. The device judges boxes that lie within this one, in floats
/// (shaders/bounds/bounds.comp): what is surely unseen here is unseen there.
[[nodiscard]] bool surelyUnseen(const shared::CullView& view, const skinning::Box& box);

/// Finding allocates nothing.
class OutOfSight {
public:
    OutOfSight() = default;
    /// `reach` must outlive this.
    OutOfSight(const skinning::Reach& reach, uint32_t capacity) : reach_(&reach), unseen_(capacity, false) {}
    /// Whether somebody looks for them.
    [[nodiscard]] bool isAskedFor() const { return reach_ != nullptr; }

    /// `margin`: how far surfaces may lie outside the boxes of their cages, as a part of the size of these. True if
    /// others than before are unseen.
    bool find(const shared::CullView& view, float margin, const InstanceSlots& slots, PoseSource& poses);
    /// Nothing is unseen. True if something was.
    bool clear();
    [[nodiscard]] bool holds(uint32_t slot) const { return unseen_[slot]; }
    /// How many visible instances are unseen.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    const skinning::Reach* reach_ = nullptr;
    std::vector<bool> unseen_; ///< by slot
    uint32_t count_ = 0;
};

} // namespace supple::runtime
