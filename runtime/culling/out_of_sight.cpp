#include "runtime/culling/out_of_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace supple::runtime {

namespace {

/// As a part of what is compared. Floats lose less, here and where the device compares.
constexpr float kSlack = 1e-4f;

/// Boxes that lie behind a plane, in vectors: no branches.
void findBehind(const float* plane, const BoxRuns& boxes, std::span<uint8_t> unseen) {
    const float x = plane[0], y = plane[1], z = plane[2], offset = plane[3];
    const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z), size = std::abs(offset);
    const float *mx = boxes.middle(0), *my = boxes.middle(1), *mz = boxes.middle(2);
    const float *hx = boxes.half(0), *hy = boxes.half(1), *hz = boxes.half(2);
    for (size_t i = 0; i < unseen.size(); ++i) {
        const float at = x * mx[i] + y * my[i] + z * mz[i] + offset;
        const float reach = ax * hx[i] + ay * hy[i] + az * hz[i];
        const float far = ax * std::abs(mx[i]) + ay * std::abs(my[i]) + az * std::abs(mz[i]) + size + reach;
        unseen[i] |= at + reach < -kSlack * far ? 1 : 0; // false for what is not a number
    }
}

/// Boxes that are too far away or too small.
void findFar(const shared::CullView& view, const BoxRuns& boxes, std::span<uint8_t> unseen) {
    const float farthest = view.farthest > 0.0f ? view.farthest : std::numeric_limits<float>::infinity();
    for (size_t i = 0; i < unseen.size(); ++i) {
        float distance = 0.0f, size = 0.0f;
        for (size_t axis = 0; axis < 3; ++axis) {
            const float middle = boxes.middle(axis)[i], half = boxes.half(axis)[i];
            const float from = std::abs(middle - view.camera.position[axis]);
            const float beyond = from - half - kSlack * (std::abs(middle) + half);
            distance += beyond > 0.0f ? beyond * beyond : 0.0f;
            size += half * half;
        }
        distance = std::sqrt(distance) * (1.0f - kSlack);
        // The box within may be at this box's nearest point, and as large as it.
        const float away = view.camera.orthographic != 0 ? 1.0f : distance;
        const bool small = std::sqrt(size) * view.camera.focal * (1.0f + kSlack) < view.smallest * away;
        unseen[i] |= distance > farthest || small ? 1 : 0;
    }
}

} // namespace

void findUnseen(const shared::CullView& view, const BoxRuns& boxes, std::span<uint8_t> unseen) {
    std::fill(unseen.begin(), unseen.end(), uint8_t{0});
    for (size_t k = 0; k < 6; ++k) {
        findBehind(view.planes + 4 * k, boxes, unseen);
    }
    if (view.farthest > 0.0f || view.smallest > 0.0f) {
        findFar(view, boxes, unseen);
    }
}

namespace {

/// Whether no box in the hull is too far away or too small. Distances are rounded up by more than floats lose.
bool isNearAndLarge(const shared::CullView& view, const Hull& hull) {
    float squares = 0.0f;
    for (size_t axis = 0; axis < 3; ++axis) {
        const float from = std::abs(hull.middle[axis] - view.camera.position[axis]) + hull.half[axis] +
                           kSlack * (std::abs(hull.middle[axis]) + hull.half[axis]);
        squares += from * from;
    }
    const float farthest = std::sqrt(squares) * (1.0f + kSlack);
    const float away = view.camera.orthographic != 0 ? 1.0f : farthest;
    const bool near = !(view.farthest > 0.0f) || farthest <= view.farthest;
    return near && hull.least * view.camera.focal >= view.smallest * away;
}

} // namespace

Sight sightOf(const shared::CullView& view, const Hull& hull) {
    bool seen = true;
    for (size_t k = 0; k < 6; ++k) {
        const float* const plane = view.planes + 4 * k;
        float at = plane[3], reach = 0.0f, far = std::abs(plane[3]);
        for (size_t axis = 0; axis < 3; ++axis) {
            at += plane[axis] * hull.middle[axis];
            reach += std::abs(plane[axis]) * hull.half[axis];
            far += std::abs(plane[axis]) * std::abs(hull.middle[axis]);
        }
        far += reach; // that of a box within is at most twice as large
        if (at + reach < -4.0f * kSlack * far) {
            return Sight::unseen;
        }
        seen = seen && at - reach >= kSlack * far;
    }
    return seen && isNearAndLarge(view, hull) ? Sight::seen : Sight::mixed;
}

bool OutOfSight::find(const shared::CullView& view, const InstanceSlots& slots, const InstanceBoxes& boxes) {
    const Sight sight = sightOf(view, boxes.hull()), before = std::exchange(sight_, sight);
    const bool sameSlots = std::exchange(slotsVersion_, slots.version()) == slots.version();
    if (sight != Sight::mixed && sight == before && sameSlots) {
        return false;
    }
    const uint32_t end = slots.end();
    findUnseen(view, boxes.boxes(), std::span(judged_).first(end));
    bool changed = false;
    count_ = 0;
    for (uint32_t slot = 0; slot < end; ++slot) {
        const uint8_t unseen = slots.shows(slot) ? judged_[slot] : 0;
        count_ += unseen;
        changed = changed || unseen_[slot] != unseen;
        unseen_[slot] = unseen;
    }
    return changed;
}

bool OutOfSight::clear() {
    const bool changed = count_ > 0;
    std::fill(unseen_.begin(), unseen_.end(), uint8_t{0});
    count_ = 0;
    sight_ = Sight::mixed;
    return changed;
}

} // namespace supple::runtime
