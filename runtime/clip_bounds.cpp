#include "runtime/clip_bounds.h"

#include "skinning/coarse_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supple::runtime {

namespace {

constexpr float kFloatMax = std::numeric_limits<float>::max();

/// The next float that is not above the value, or not below it: the box as floats holds the box.
float notAbove(double value) {
    const auto rounded = static_cast<float>(std::clamp(value, -double{kFloatMax}, double{kFloatMax}));
    return double{rounded} > value ? std::nextafter(rounded, -kFloatMax) : rounded;
}
float notBelow(double value) {
    return -notAbove(-value);
}

/// The coarse twin may play in its place.
skinning::Box boundsOf(const cage::Character& character, const cage::Clip& clip, const skinning::ClipBoundsDesc& desc) {
    skinning::Box box = skinning::clipBounds(character, &clip, desc);
    if (const auto twin = skinning::coarseClip(skinning::nodeOrder(character), clip)) {
        const skinning::Box other = skinning::clipBounds(character, &*twin, desc);
        box = {glm::min(box.low, other.low), glm::max(box.high, other.high)};
    }
    return box;
}

} // namespace

std::optional<SuppleBounds> ClipBounds::of(const cage::Character& character, uint32_t clip,
                                           const skinning::ClipBoundsDesc& desc) {
    if (clip >= character.clips.size() && clip != SUPPLE_BIND_POSE && clip != SUPPLE_REST_POSE) {
        return std::nullopt;
    }
    const auto [known, isNew] = found_.try_emplace(Key{clip, desc.skinning.mode, desc.margin});
    if (isNew) {
        const skinning::Box box = clip == SUPPLE_BIND_POSE   ? skinning::bindBounds(character, desc)
                                  : clip == SUPPLE_REST_POSE ? skinning::clipBounds(character, nullptr, desc)
                                                             : boundsOf(character, character.clips[clip], desc);
        for (int axis = 0; axis < 3; ++axis) {
            known->second.min[axis] = notAbove(box.low[axis]);
            known->second.max[axis] = notBelow(box.high[axis]);
        }
    }
    return known->second;
}

} // namespace supple::runtime
