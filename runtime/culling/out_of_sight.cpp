#include "runtime/culling/out_of_sight.h"

#include <cmath>

namespace supple::runtime {

namespace {

/// Of what is compared: more than floats lose where the device compares.
constexpr double kSlack = 1e-4;

} // namespace

bool surelyUnseen(const shared::CullView& view, const skinning::Box& box) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    for (int k = 0; k < 6; ++k) {
        const glm::dvec3 normal(view.planes[4 * k], view.planes[4 * k + 1], view.planes[4 * k + 2]);
        const double offset = view.planes[4 * k + 3], reach = glm::dot(glm::abs(normal), half);
        const double slack = kSlack * (glm::dot(glm::abs(normal), glm::abs(middle)) + std::abs(offset) + reach);
        if (glm::dot(normal, middle) + offset + reach < -slack) {
            return true;
        }
    }
    const glm::dvec3 camera(view.camera.position[0], view.camera.position[1], view.camera.position[2]);
    const glm::dvec3 beyond = glm::max(glm::max(box.low - camera, camera - box.high), glm::dvec3(0.0));
    const double distance = glm::length(beyond) * (1.0 - kSlack);
    if (view.farthest > 0.0f && distance > static_cast<double>(view.farthest)) {
        return true;
    }
    // The box within may be at this box's nearest point, and as large as it.
    const double away = view.camera.orthographic != 0 ? 1.0 : distance;
    return glm::length(half) * static_cast<double>(view.camera.focal) * (1.0 + kSlack) <
           static_cast<double>(view.smallest) * away;
}

bool OutOfSight::find(const shared::CullView& view, float margin, const InstanceSlots& slots, PoseSource& poses) {
    bool changed = false;
    count_ = 0;
    for (uint32_t slot = 0; slot < slots.end(); ++slot) {
        bool unseen = false;
        if (slots.shows(slot)) {
            if (const std::optional<skinning::Box> cage = poses.boundsOf(slot, *reach_)) {
                const glm::dvec3 around = static_cast<double>(margin) * (cage->high - cage->low);
                unseen = surelyUnseen(view, {cage->low - around, cage->high + around});
            }
        }
        count_ += unseen ? 1 : 0;
        changed = changed || unseen_[slot] != unseen;
        unseen_[slot] = unseen;
    }
    return changed;
}

bool OutOfSight::clear() {
    const bool changed = count_ > 0;
    unseen_.assign(unseen_.size(), false);
    count_ = 0;
    return changed;
}

} // namespace supple::runtime
