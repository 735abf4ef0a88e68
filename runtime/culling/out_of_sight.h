// Which instances of a view's group surely are out of its sight, found on the CPU before they are posed.
#pragma once

#include "runtime/culling/instance_boxes.h"
#include "runtime/instance_slots.h"
#include "shaders/shared/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// By box: 1 if all of it is where the view does not look, else 0. The device judges boxes that lie within these, in
/// floats (shaders/bounds/bounds.comp): what is surely unseen here is unseen there.
void findUnseen(const shared::CullView& view, const BoxRuns& boxes, std::span<uint8_t> unseen);

/// Finding allocates nothing.
class OutOfSight {
public:
    OutOfSight() = default;
    explicit OutOfSight(uint32_t capacity) : judged_(capacity, 0), unseen_(capacity, 0) {}
    /// Whether somebody looks for them.
    [[nodiscard]] bool isAskedFor() const { return !unseen_.empty(); }

    /// True if others than before are unseen. `boxes`: by slot.
    bool find(const shared::CullView& view, const InstanceSlots& slots, const BoxRuns& boxes);
    /// Nothing is unseen. True if something was.
    bool clear();
    [[nodiscard]] bool holds(uint32_t slot) const { return unseen_[slot] != 0; }
    /// How many visible instances are unseen.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    std::vector<uint8_t> judged_, unseen_; ///< by slot
    uint32_t count_ = 0;
};

} // namespace supple::runtime
