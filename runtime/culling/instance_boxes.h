// Boxes that hold the instances of a view's group, found on the CPU without poses.
#pragma once

#include "runtime/instance_slots.h"
#include "runtime/pose_source.h"
#include "shaders/shared/camera.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// Boxes by their middle and half their size, a run for each coordinate: a test of many is done in vectors.
class BoxRuns {
public:
    explicit BoxRuns(size_t count = 0) : count_(count), values_(6 * count, 0.0f) {}
    void set(size_t index, const skinning::Box& box);
    /// Nobody knows it: it may be anywhere.
    void setUnknown(size_t index);
    [[nodiscard]] const float* middle(size_t axis) const { return values_.data() + axis * count_; } ///< by index
    [[nodiscard]] const float* half(size_t axis) const { return values_.data() + (3 + axis) * count_; }

private:
    size_t count_ = 0;
    std::vector<float> values_; ///< side by side: a frame reads all of them
};

/// A box that holds others. Without any, and if one is unknown or not finite, its numbers are NaN.
struct Hull {
    std::array<float, 3> middle{}, half{};
    float least = 0.0f; ///< half the diagonal of the smallest of them
};
/// The hull of the visible slots' boxes.
[[nodiscard]] Hull hullOf(const BoxRuns& boxes, const InstanceSlots& slots);

/// How many pixels a unit has at most within a box; infinity if the camera may stand in it, or
/// if nobody knows it.
[[nodiscard]] float pixelsPerUnit(const shared::LodCamera& camera, const BoxRuns& boxes, size_t index);

/// Finding allocates nothing.
class InstanceBoxes {
public:
    InstanceBoxes() = default;
    /// `margin`: how far surfaces may lie outside the boxes of their cages, as a part of the size of these. `reach`
    /// must outlive this.
    InstanceBoxes(const skinning::Reach& reach, float margin, uint32_t capacity);
    /// Whether somebody looks for them.
    [[nodiscard]] bool areAskedFor() const { return reach_ != nullptr; }

    /// Those of visible instances, where the next recording poses and places them.
    void find(const InstanceSlots& slots, PoseSource& poses);
    [[nodiscard]] const BoxRuns& boxes() const { return boxes_; } ///< by slot
    [[nodiscard]] const Hull& hull() const { return hull_; }      ///< of those that find() has found

private:
    const skinning::Reach* reach_ = nullptr;
    double margin_ = 0.0;
    Hull hull_;
    // What find() saw last: PoseSource::boundsVersions, InstanceSlots::version.
    uint64_t posesVersion_ = 0, slotsVersion_ = 0;
    std::vector<uint64_t> versions_; ///< by slot: PoseSource::boundsVersion
    BoxRuns boxes_;
};

} // namespace supple::runtime
