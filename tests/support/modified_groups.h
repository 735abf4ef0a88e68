// Groups whose instances play and have modifiers.
#pragma once

#include "tests/support/played_group.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>

namespace supple::test {

inline SuppleModifier modifierOf(SuppleModifierKind kind, uint32_t joint, const glm::dvec3& target = {}) {
    SuppleModifier modifier{};
    modifier.kind = kind;
    modifier.joint = joint;
    modifier.weight = 1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        modifier.target[axis] = target[axis];
    }
    return modifier;
}
inline SuppleModifier turning(SuppleModifierKind kind, uint32_t joint, const glm::quat& q, uint32_t flags = 0) {
    SuppleModifier modifier = modifierOf(kind, joint);
    modifier.flags = flags;
    const float rotation[] = {q.x, q.y, q.z, q.w};
    std::memcpy(modifier.rotation, rotation, sizeof rotation);
    return modifier;
}

inline SuppleGroupDesc modifiedGroup(SuppleAsset asset, uint32_t capacity,
                                     SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR) {
    return playedGroup(asset, capacity, SUPPLE_GROUP_MODIFIERS, skinning);
}

inline glm::dquat rotationOf(const glm::dmat4& m) {
    return glm::normalize(glm::quat_cast(glm::dmat3(glm::normalize(glm::dvec3(m[0])), glm::normalize(glm::dvec3(m[1])),
                                                    glm::normalize(glm::dvec3(m[2])))));
}
inline double turnBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(a) * b;
    return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

/// The end of some limb of a character: a joint with two above it.
inline uint32_t someEnd(const PlayedGroup& stage) {
    const std::vector<uint32_t>& parents = stage.group().asset().rig.jointParents;
    uint32_t best = 0;
    size_t deepest = 0;
    for (uint32_t j = 0; j < parents.size(); ++j) {
        size_t depth = 0;
        for (uint32_t up = j; parents[up] != cage::kNone; up = parents[up]) {
            ++depth;
        }
        if (depth > deepest) {
            deepest = depth;
            best = j;
        }
    }
    return best;
}

} // namespace supple::test
