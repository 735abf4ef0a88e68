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
struct BoxRuns {
    std::array<std::vector<float>, 3> middle, half;

    explicit BoxRuns(size_t count = 0);
    void set(size_t index, const skinning::Box& box);
    /// Nobody knows it: it may be anywhere.
    void setUnknown(size_t index);
};

/// How many pixels a unit has at most within a box; infinity if the camera may stand in it.
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

private:
    const skinning::Reach* reach_ = nullptr;
    double margin_ = 0.0;
    std::vector<uint64_t> versions_; ///< by slot: PoseSource::boundsVersion
    BoxRuns boxes_;
};

} // namespace supple::runtime
