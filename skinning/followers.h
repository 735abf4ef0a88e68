// Which joint of a skeleton follows which of another one, and how: what retargeting (skinning/retarget.h) needs to know
// of the two before it looks at a clip.
#pragma once

#include "cage/character.h"
#include "skinning/roles.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <utility>
#include <vector>

namespace supple::skinning {

/// A skeleton as it rests, in model space. By node.
struct RestPlaces {
    std::vector<glm::dmat4> matrices;
    std::vector<glm::dquat> turns; ///< rotations alone, from the root down

    explicit RestPlaces(const cage::Skeleton& skeleton);
    [[nodiscard]] glm::dvec3 place(uint32_t node) const { return glm::dvec3(matrices[node][3]); }
};

/// A joint that turns as one of the other skeleton does, or between two of them.
struct TurnFollower {
    uint32_t node = cage::kNone;
    uint32_t leader = cage::kNone, next = cage::kNone; ///< nodes of the other skeleton
    double share = 0.0;                                ///< of the way from the leader's turn to the next one's
    glm::dquat rest{1.0, 0.0, 0.0, 0.0};               ///< in model space, where the leader rests
};

/// A joint without a role that is moved as the one of its name.
struct MoveFollower {
    uint32_t node = cage::kNone, leader = cage::kNone;
    glm::dmat3 map{1.0}; ///< from what moves the leader in its parent's frame to the same here
};

/// From a thigh down to the foot: every node between is there.
struct Leg {
    std::vector<uint32_t> path;
    size_t shin = 0; ///< place in the path
    size_t side = kLeft;
};

struct Followers {
    Roles from{}, to{};
    std::vector<TurnFollower> turned; ///< parents before children
    std::vector<MoveFollower> moved;
    std::array<Leg, 2> legs;
    glm::dquat yaw{1.0, 0.0, 0.0, 0.0}; ///< C0: about +Y, from the one skeleton's left to the other's
    double scale = 1.0;                 ///< of the heights of the hips over the ankles

    /// How many joints follow by their role: the rest does by its name, or as a part of a limb or a spine.
    size_t byRole = 0, byName = 0;
};

/// A skeleton and its roles: it has legs (hasLegs()), and hips that are higher than the ankles.
struct Biped {
    const cage::Skeleton& skeleton;
    const Roles& roles;
};
/// A node of one skeleton, and the one of the other that follows it.
using NodePair = std::pair<uint32_t, uint32_t>;

/// `given`: pairs that a user knows: they go first. `partners`: by node of `from`, the node of `to` of the same name,
/// or kNone. Nodes of `to` that have a matrix are never turned.
[[nodiscard]] Followers findFollowers(const Biped& from, const Biped& to, std::span<const NodePair> given,
                                      std::span<const uint32_t> partners);

/// How high the hips rest over the lower ankle.
[[nodiscard]] double hipsHeight(const RestPlaces& rest, const Roles& roles);

} // namespace supple::skinning
