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

/// How a view sees all of some boxes.
enum class Sight : uint8_t { mixed, seen, unseen };
/// What findUnseen() would say of all boxes that the hull holds. `mixed`: not the same of all, or it takes too long to
/// say.
[[nodiscard]] Sight sightOf(const shared::CullView& view, const Hull& hull);

/// Finding allocates nothing.
class OutOfSight {
public:
    OutOfSight() = default;
    explicit OutOfSight(uint32_t capacity) : judged_(capacity, 0), unseen_(capacity, 0) {}
    /// Whether somebody looks for them.
    [[nodiscard]] bool isAskedFor() const { return !unseen_.empty(); }

    /// True if others than before are unseen. `boxes`: as they were found of these slots.
    bool find(const shared::CullView& view, const InstanceSlots& slots, const InstanceBoxes& boxes);
    /// Nothing is unseen. True if something was.
    bool clear();
    [[nodiscard]] bool holds(uint32_t slot) const { return unseen_[slot] != 0; }
    /// How many visible instances are unseen.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    std::vector<uint8_t> judged_, unseen_; ///< by slot
    uint32_t count_ = 0;
    // As it was when slots were looked through last: all of them, or mixed.
    Sight sight_ = Sight::mixed;
    uint64_t slotsVersion_ = 0; ///< InstanceSlots::version
};

} // namespace supple::runtime
