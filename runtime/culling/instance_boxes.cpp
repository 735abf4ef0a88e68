#include "runtime/culling/instance_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supple::runtime {

BoxRuns::BoxRuns(size_t count) {
    for (size_t axis = 0; axis < 3; ++axis) {
        middle[axis].assign(count, 0.0f);
        half[axis].assign(count, 0.0f);
    }
}

void BoxRuns::set(size_t index, const skinning::Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
        middle[static_cast<size_t>(axis)][index] = static_cast<float>(0.5 * box.low[axis] + 0.5 * box.high[axis]);
        half[static_cast<size_t>(axis)][index] = static_cast<float>(0.5 * box.high[axis] - 0.5 * box.low[axis]);
    }
}

void BoxRuns::setUnknown(size_t index) {
    for (size_t axis = 0; axis < 3; ++axis) {
        middle[axis][index] = 0.0f;
        half[axis][index] = std::numeric_limits<float>::infinity();
    }
}

float pixelsPerUnit(const shared::LodCamera& camera, const BoxRuns& boxes, size_t index) {
    if (camera.orthographic != 0) {
        return camera.focal;
    }
    float squares = 0.0f;
    for (size_t axis = 0; axis < 3; ++axis) {
        const float from = std::abs(boxes.middle[axis][index] - camera.position[axis]);
        const float beyond = std::max(from - boxes.half[axis][index], 0.0f);
        squares += beyond * beyond;
    }
    const float away = std::max(std::sqrt(squares), camera.nearest);
    return squares > 0.0f ? camera.focal / away : std::numeric_limits<float>::infinity();
}

InstanceBoxes::InstanceBoxes(const skinning::Reach& reach, float margin, uint32_t capacity)
    : reach_(&reach), margin_(static_cast<double>(margin)), versions_(capacity, 0), boxes_(capacity) {}

void InstanceBoxes::find(const InstanceSlots& slots, PoseSource& poses) {
    for (uint32_t slot = 0; slot < slots.end(); ++slot) {
        if (!slots.shows(slot)) {
            continue;
        }
        const uint64_t version = poses.boundsVersion(slot);
        if (versions_[slot] == version) {
            continue;
        }
        versions_[slot] = version;
        if (const std::optional<skinning::Box> cage = poses.boundsOf(slot, *reach_)) {
            boxes_.set(slot, skinning::grownBy(*cage, margin_ * (cage->high - cage->low)));
        } else {
            boxes_.setUnknown(slot);
        }
    }
}

} // namespace supple::runtime
