#include "runtime/played_bounds.h"

#include "skinning/played_pose.h"

#include <algorithm>
#include <cmath>

namespace supple::runtime {

namespace {

/// From so many loops on nobody knows where the instance is: no clip of any length has them.
constexpr double kMostLoops = 2147483648.0;
constexpr uint32_t kUnboundedLoop = 0x80000000u;

} // namespace

void PlayedBounds::set(uint32_t slot, const skinning::PlaybackDesc& desc) {
    Played& own = played_[slot];
    own = {};
    const bool adds = std::any_of(desc.layers.begin(), desc.layers.end(), [](const skinning::PlaybackLayer& layer) {
        return layer.mode == skinning::LayerMode::additive;
    });
    // Where the yaw is taken and the way is not, the root stands anywhere on a circle.
    const bool circles = (desc.root.axes & skinning::kRootYaw) != 0 && (desc.root.axes & skinning::kRootGround) == 0;
    own.kind = adds || circles ? Kind::unbounded : Kind::blended;
    own.root = desc.root;
    own.travels = desc.travels && desc.root.axes != 0 && !desc.layers.empty();
    if (own.travels) {
        own.first = desc.layers.front();
    }
}

uint32_t PlayedBounds::loopOf(uint32_t slot, double time) const {
    const Played& own = played_[slot];
    if (own.transition.holds(time)) {
        return kUnboundedLoop;
    }
    const double loops = own.travels ? skinning::loopsAt(*character_, own.first, time) : 0.0;
    return std::abs(loops) < kMostLoops ? static_cast<uint32_t>(static_cast<int32_t>(loops)) : kUnboundedLoop;
}

bool PlayedBounds::leavesReach(uint32_t slot, const skinning::Reach& reach) const {
    const auto any = [&](const std::vector<uint32_t>& nodes) {
        return std::any_of(nodes.begin(), nodes.end(), [&](uint32_t node) { return reach.anchored[node] == 0; });
    };
    return any(swinging_) || (!turned_.empty() && (turned_[slot].elsewhere || any(turned_[slot].nodes)));
}

std::optional<skinning::Box> PlayedBounds::of(uint32_t slot, double time, const skinning::Reach& reach,
                                              std::span<const float> hostWeights) const {
    const Played& own = played_[slot];
    if (own.kind == Kind::unbounded || own.transition.holds(time) ||
        (own.root.axes != 0 && own.root.node != reach.anchor)) {
        return std::nullopt;
    }
    if (own.kind == Kind::bindPose) {
        return skinning::bindBounds(reach, hostWeights);
    }
    if (leavesReach(slot, reach)) {
        return std::nullopt;
    }
    skinning::Box box = skinning::grownBy(reach.blended, skinning::reachedBy(hostWeights, reach.targets));
    // What follows a modifier that lowers a joint may turn the way.
    box = skinning::grownBy(box, turned_.empty() ? 0.0 : turned_[slot].lowered);
    box = skinned_.reached(reach, box);
    if (!own.travels) {
        return box; // the root stays where the clip begins: at one of the anchor's places
    }
    // Within a loop, the root of the first layer moves among the anchor's places; what other layers mix in may stand at
    // another one, and turns with it.
    const double across = std::hypot(reach.anchorPath.x, reach.anchorPath.z);
    const glm::dvec3 within(across, reach.anchorPath.y, across);
    const double loops = skinning::loopsAt(*character_, own.first, time);
    if (!(std::abs(loops) < kMostLoops)) {
        return std::nullopt;
    }
    return skinning::movedBy(skinning::toMatrix(skinning::traveledToLoop(*character_, own.first, own.root, loops)),
                             skinning::grownBy(box, within));
}

} // namespace supple::runtime
