// Which instances of a view's group surely are out of its sight, found on the CPU before they are posed.
#pragma once

#include "runtime/instance_slots.h"
#include "runtime/pose_source.h"
#include "shaders/shared/bounds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Boxes by their middle and half their size, a run for each coordinate: a test of many is done in vectors.
struct BoxRuns {
    std::array<std::vector<float>, 3> middle, half;

    explicit BoxRuns(size_t count = 0);
    void set(size_t index, const skinning::Box& box);
    /// Nobody knows it: it may be anywhere.
    void setUnknown(size_t index);
};

/// By box: 1 if all of it is where the view does not look, else 0. The device judges boxes that lie within these, in
/// floats (shaders/bounds/bounds.comp): what is surely unseen here is unseen there.
void findUnseen(const shared::CullView& view, const BoxRuns& boxes, std::span<uint8_t> unseen);

/// Finding allocates nothing.
class OutOfSight {
public:
    OutOfSight() = default;
    /// `margin`: how far surfaces may lie outside the boxes of their cages, as a part of the size of these. `reach`
    /// must outlive this.
    OutOfSight(const skinning::Reach& reach, float margin, uint32_t capacity);
    /// Whether somebody looks for them.
    [[nodiscard]] bool isAskedFor() const { return reach_ != nullptr; }

    /// True if others than before are unseen.
    bool find(const shared::CullView& view, const InstanceSlots& slots, PoseSource& poses);
    /// Nothing is unseen. True if something was.
    bool clear();
    [[nodiscard]] bool holds(uint32_t slot) const { return unseen_[slot] != 0; }
    /// How many visible instances are unseen.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    const skinning::Reach* reach_ = nullptr;
    double margin_ = 0.0;
    // By slot:
    std::vector<uint64_t> versions_; ///< of the boxes: PoseSource::boundsVersion
    BoxRuns boxes_;
    std::vector<uint8_t> judged_, unseen_;
    uint32_t count_ = 0;
};

} // namespace supple::runtime
