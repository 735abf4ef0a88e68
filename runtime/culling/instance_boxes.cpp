#include "runtime/culling/instance_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace supple::runtime {

void BoxRuns::set(size_t index, const skinning::Box& box) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<int>(axis);
        values_[axis * count_ + index] = static_cast<float>(0.5 * box.low[a] + 0.5 * box.high[a]);
        values_[(3 + axis) * count_ + index] = static_cast<float>(0.5 * box.high[a] - 0.5 * box.low[a]);
    }
}

void BoxRuns::setUnknown(size_t index) {
    for (size_t axis = 0; axis < 3; ++axis) {
        values_[axis * count_ + index] = 0.0f;
        values_[(3 + axis) * count_ + index] = std::numeric_limits<float>::infinity();
    }
}

Hull hullOf(const BoxRuns& boxes, const InstanceSlots& slots) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr Hull kNoHull{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}, kNaN};
    float least = kInfinity;
    std::array<float, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
    for (uint32_t slot = 0; slot < slots.end(); ++slot) {
        if (!slots.shows(slot)) {
            continue;
        }
        float squares = 0.0f;
        for (size_t axis = 0; axis < 3; ++axis) {
            const float middle = boxes.middle(axis)[slot], half = boxes.half(axis)[slot];
            if (!std::isfinite(middle) || !std::isfinite(half)) {
                return kNoHull;
            }
            low[axis] = std::min(low[axis], middle - half);
            high[axis] = std::max(high[axis], middle + half);
            squares += half * half;
        }
        least = std::min(least, squares);
    }
    if (least == kInfinity) {
        return kNoHull;
    }
    Hull hull;
    hull.least = std::sqrt(least);
    for (size_t axis = 0; axis < 3; ++axis) {
        hull.middle[axis] = 0.5f * low[axis] + 0.5f * high[axis];
        hull.half[axis] = 0.5f * high[axis] - 0.5f * low[axis];
    }
    return hull;
}

float pixelsPerUnit(const shared::LodCamera& camera, const BoxRuns& boxes, size_t index) {
    if (std::isinf(boxes.half(0)[index])) { // unknown: what is shown may have any size
        return std::numeric_limits<float>::infinity();
    }
    if (camera.orthographic != 0) {
        return camera.focal;
    }
    float squares = 0.0f;
    for (size_t axis = 0; axis < 3; ++axis) {
        const float from = std::abs(boxes.middle(axis)[index] - camera.position[axis]);
        const float beyond = std::max(from - boxes.half(axis)[index], 0.0f);
        squares += beyond * beyond;
    }
    const float away = std::max(std::sqrt(squares), camera.nearest);
    return squares > 0.0f ? camera.focal / away : std::numeric_limits<float>::infinity();
}

InstanceBoxes::InstanceBoxes(const skinning::Reach& reach, float margin, uint32_t capacity)
    : reach_(&reach), margin_(static_cast<double>(margin)), versions_(capacity, 0), boxes_(capacity) {}

void InstanceBoxes::find(const InstanceSlots& slots, PoseSource& poses) {
    const uint64_t before = std::exchange(posesVersion_, poses.boundsVersions());
    const uint64_t slotsBefore = std::exchange(slotsVersion_, slots.version());
    if (posesVersion_ == before && before != 0 && slotsVersion_ == slotsBefore) {
        return;
    }
    bool changed = slotsVersion_ != slotsBefore;
    for (uint32_t slot = 0; slot < slots.end(); ++slot) {
        if (!slots.shows(slot)) {
            continue;
        }
        const uint64_t version = poses.boundsVersion(slot);
        if (versions_[slot] == version) {
            continue;
        }
        versions_[slot] = version;
        changed = true;
        if (const std::optional<skinning::Box> cage = poses.boundsOf(slot, *reach_)) {
            boxes_.set(slot, skinning::grownBy(*cage, margin_ * (cage->high - cage->low)));
        } else {
            boxes_.setUnknown(slot);
        }
    }
    if (changed) {
        hull_ = hullOf(boxes_, slots);
    }
}

} // namespace supple::runtime
