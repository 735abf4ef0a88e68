#include "skinning/followers.h"

#include "cage/skeleton.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace supple::skinning {
namespace {

using cage::kNone;

/// The part that a bone of a limb leads to.
std::optional<BodyPart> childOf(BodyPart part) {
    switch (part) {
    case BodyPart::thigh:
        return BodyPart::shin;
    case BodyPart::shin:
        return BodyPart::foot;
    case BodyPart::upperArm:
        return BodyPart::lowerArm;
    case BodyPart::lowerArm:
        return BodyPart::hand;
    default:
        return std::nullopt;
    }
}

BodyPart partOf(Role role) {
    return static_cast<BodyPart>(role < kMiddleParts ? role : (role - kMiddleParts) % kSideParts + kMiddleParts);
}
size_t sideOf(Role role) {
    return role < kMiddleParts + kSideParts ? kLeft : kRight;
}

/// The shortest turn from one direction to another; none if one of them has no length.
glm::dquat shortestTurn(const glm::dvec3& from, const glm::dvec3& to) {
    const double lengths = glm::length(from) * glm::length(to);
    if (!(lengths > 0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    const glm::dvec3 axis = glm::cross(from, to) / lengths;
    const double w = 1.0 + glm::dot(from, to) / lengths;
    if (w < 1e-9) { // half a turn, about any axis across
        const glm::dvec3 other = std::abs(from.x) < std::abs(from.z) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 across = glm::normalize(glm::cross(from, other));
        return {0.0, across.x, across.y, across.z};
    }
    return unit(glm::dquat(w, axis.x, axis.y, axis.z));
}

/// The way to the left, along the ground.
glm::dvec3 leftOf(const RestPlaces& rest, const Roles& roles) {
    const glm::dvec3 way =
        rest.place(roles[roleOf(BodyPart::thigh, kLeft)]) - rest.place(roles[roleOf(BodyPart::thigh, kRight)]);
    return {way.x, 0.0, way.z};
}

/// A half turn is about +Y.
glm::dquat yawBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const double angle = std::atan2(glm::cross(from, to).y, glm::dot(from, to));
    return {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
}

/// Nodes from `end` up to but without `top`, from the top down; none if `end` is not below it.
std::vector<uint32_t> pathBelow(const cage::Skeleton& skeleton, uint32_t top, uint32_t end) {
    std::vector<uint32_t> path;
    for (; end != kNone && end != top; end = skeleton.nodes[end].parent) {
        path.push_back(end);
    }
    if (end != top) {
        path.clear();
    }
    std::reverse(path.begin(), path.end());
    return path;
}

/// By node: the nearest role at or above it, or kRoles.
std::vector<size_t> nearestRoles(const cage::Skeleton& skeleton, const Roles& roles) {
    std::vector<size_t> nearest(skeleton.nodes.size(), kRoles);
    for (size_t role = 0; role < kRoles; ++role) {
        if (roles[role] != kNone) {
            nearest[roles[role]] = role;
        }
    }
    for (const uint32_t node : skeleton.parentsFirst) {
        const uint32_t parent = skeleton.nodes[node].parent;
        if (nearest[node] == kRoles && parent != kNone) {
            nearest[node] = nearest[parent];
        }
    }
    return nearest;
}

class FollowerFinder {
public:
    FollowerFinder(const Biped& from, const Biped& to, std::span<const NodePair> given,
                   std::span<const uint32_t> partners)
        : from_(from.skeleton), to_(to.skeleton), given_(given), partners_(partners), fromRest_(from.skeleton),
          toRest_(to.skeleton), leaders_(to.skeleton.nodes.size()) {
        found_.from = from.roles;
        found_.to = to.roles;
        found_.yaw = yawBetween(leftOf(fromRest_, from.roles), leftOf(toRest_, to.roles));
        found_.scale = hipsHeight(toRest_, to.roles) / hipsHeight(fromRest_, from.roles);
        corrections_.fill(glm::dquat(1.0, 0.0, 0.0, 0.0));
    }

    [[nodiscard]] Followers find() {
        findCorrections();
        followGiven();
        for (Role role = 0; role < kRoles; ++role) {
            if (isCommon(role)) {
                follow(found_.to[role], found_.from[role], corrections_[role]);
                ++found_.byRole;
            }
        }
        for (Role role = 0; role < kRoles; ++role) {
            followWithinLimb(role);
        }
        followSpine();
        followPelvis();
        followNames();
        for (const uint32_t node : to_.parentsFirst) {
            if (leaders_[node].node != kNone) {
                found_.turned.push_back(leaders_[node]);
            }
        }
        for (const size_t side : {kLeft, kRight}) {
            findLeg(side);
        }
        return found_;
    }

private:
    [[nodiscard]] bool isCommon(size_t role) const { return found_.from[role] != kNone && found_.to[role] != kNone; }
    /// For what hangs on a role, or on none.
    [[nodiscard]] glm::dquat correctionOf(size_t role) const {
        return role < kRoles ? corrections_[role] : glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
    [[nodiscard]] bool isFree(uint32_t node) const {
        return leaders_[node].node == kNone && !to_.nodes[node].hasMatrix;
    }
    void follow(uint32_t node, uint32_t leader, const glm::dquat& correction) {
        follow(node, leader, leader, 0.0, correction);
    }
    void follow(uint32_t node, uint32_t leader, uint32_t next, double share, const glm::dquat& correction) {
        if (isFree(node)) {
            leaders_[node] = {node, leader, next, share, correction * toRest_.turns[node]};
        }
    }

    /// By role: from the direction of its bone in the rest pose to that of the other skeleton's. Hands go on as their
    /// arms do.
    void findCorrections() {
        for (Role role = 0; role < kRoles; ++role) {
            const std::optional<BodyPart> child = childOf(partOf(role));
            const Role next = child ? roleOf(*child, sideOf(role)) : role;
            if (next != role && isCommon(role) && isCommon(next)) {
                const auto bone = [&](const RestPlaces& rest, const Roles& roles) {
                    return rest.place(roles[next]) - rest.place(roles[role]);
                };
                corrections_[role] = shortestTurn(bone(toRest_, found_.to), found_.yaw * bone(fromRest_, found_.from));
            }
        }
        for (const size_t side : {kLeft, kRight}) {
            corrections_[roleOf(BodyPart::hand, side)] = corrections_[roleOf(BodyPart::lowerArm, side)];
        }
    }

    void followGiven() {
        const std::vector<size_t> nearest = nearestRoles(to_, found_.to);
        for (const auto& [leader, node] : given_) {
            if (isFree(node)) {
                follow(node, leader, correctionOf(nearest[node]));
                followMove(node, leader);
                ++found_.byName;
            }
        }
    }

    void followWithinLimb(Role role) {
        const std::optional<BodyPart> child = childOf(partOf(role));
        if (!child || !isCommon(role) || found_.to[roleOf(*child, sideOf(role))] == kNone) {
            return;
        }
        for (const uint32_t node : pathBelow(to_, found_.to[role], found_.to[roleOf(*child, sideOf(role))])) {
            follow(node, found_.from[role], corrections_[role]);
        }
    }

    /// Joints between the hips and the neck turn by their share of the way.
    void followSpine() {
        const Role top = isCommon(roleOf(BodyPart::neck)) ? roleOf(BodyPart::neck) : roleOf(BodyPart::head);
        const Role hips = roleOf(BodyPart::hips);
        if (!isCommon(top)) {
            return;
        }
        const auto spine = [&](const cage::Skeleton& skeleton, const Roles& roles) {
            std::vector<uint32_t> path = pathBelow(skeleton, roles[hips], roles[top]);
            path.insert(path.begin(), roles[hips]);
            return path;
        };
        const std::vector<uint32_t> leading = spine(from_, found_.from), own = spine(to_, found_.to);
        const std::vector<double> ways = shares(fromRest_, leading), ownWays = shares(toRest_, own);
        for (size_t i = 1; i + 1 < own.size(); ++i) {
            size_t k = 0;
            while (k + 2 < ways.size() && ways[k + 1] <= ownWays[i]) {
                ++k;
            }
            if (k + 1 < ways.size()) {
                const double step = ways[k + 1] - ways[k];
                const double share = step > 0.0 ? std::clamp((ownWays[i] - ways[k]) / step, 0.0, 1.0) : 0.0;
                follow(own[i], leading[k], leading[k + 1], share, {1.0, 0.0, 0.0, 0.0});
            }
        }
    }
    /// How far along a path its nodes lie, from 0 to 1.
    [[nodiscard]] static std::vector<double> shares(const RestPlaces& rest, const std::vector<uint32_t>& path) {
        std::vector<double> ways(path.size(), 0.0);
        for (size_t i = 1; i < path.size(); ++i) {
            ways[i] = ways[i - 1] + glm::length(rest.place(path[i]) - rest.place(path[i - 1]));
        }
        if (!ways.empty() && ways.back() > 0.0) {
            std::transform(ways.begin(), ways.end(), ways.begin(), [&](double way) { return way / ways.back(); });
        }
        return ways;
    }

    /// What lies between the hips and a thigh turns as what the other thigh hangs on.
    void followPelvis() {
        for (const size_t side : {kLeft, kRight}) {
            const Role thigh = roleOf(BodyPart::thigh, side);
            for (uint32_t n = to_.nodes[found_.to[thigh]].parent; n != kNone && n != found_.to[roleOf(BodyPart::hips)];
                 n = to_.nodes[n].parent) {
                follow(n, from_.nodes[found_.from[thigh]].parent, {1.0, 0.0, 0.0, 0.0});
            }
        }
    }

    /// Fingers, tails, hair, props: nodes of one name that hang on the same part of the body.
    void followNames() {
        const std::vector<size_t> fromNearest = nearestRoles(from_, found_.from);
        const std::vector<size_t> toNearest = nearestRoles(to_, found_.to);
        for (const uint32_t leader : from_.parentsFirst) {
            const uint32_t node = partners_[leader];
            if (node == kNone || !isFree(node) || fromNearest[leader] != toNearest[node]) {
                continue;
            }
            follow(node, leader, correctionOf(toNearest[node]));
            followMove(node, leader);
            ++found_.byName;
        }
    }

    void followMove(uint32_t node, uint32_t leader) {
        const auto frame = [](const cage::Skeleton& skeleton, const RestPlaces& rest, uint32_t n) {
            const uint32_t parent = skeleton.nodes[n].parent;
            return parent == kNone ? glm::dmat3(1.0) : glm::dmat3(rest.matrices[parent]);
        };
        const glm::dmat3 own = frame(to_, toRest_, node);
        if (std::abs(glm::determinant(own)) > 0.0) {
            const glm::dmat3 map =
                glm::inverse(own) * glm::mat3_cast(found_.yaw) * frame(from_, fromRest_, leader) * found_.scale;
            found_.moved.push_back({node, leader, map});
        }
    }

    void findLeg(size_t side) {
        Leg& leg = found_.legs[side];
        leg.side = side;
        const uint32_t thigh = found_.to[roleOf(BodyPart::thigh, side)], shin = found_.to[roleOf(BodyPart::shin, side)];
        leg.path = pathBelow(to_, thigh, found_.to[roleOf(BodyPart::foot, side)]);
        leg.path.insert(leg.path.begin(), thigh);
        leg.shin = static_cast<size_t>(std::find(leg.path.begin(), leg.path.end(), shin) - leg.path.begin());
    }

    const cage::Skeleton &from_, &to_;
    std::span<const NodePair> given_;
    std::span<const uint32_t> partners_;
    RestPlaces fromRest_, toRest_;
    Followers found_;
    std::array<glm::dquat, kRoles> corrections_;
    std::vector<TurnFollower> leaders_; ///< by node; those without a node follow nobody
};

} // namespace

RestPlaces::RestPlaces(const cage::Skeleton& skeleton) : matrices(cage::restPlaces(skeleton)) {
    turns.resize(skeleton.nodes.size());
    for (const uint32_t n : skeleton.parentsFirst) {
        const cage::Node& node = skeleton.nodes[n];
        const glm::dquat own =
            node.hasMatrix ? nearestRotation(glm::dmat3(glm::dmat4(node.matrix))) : unit(glm::dquat(node.rotation));
        turns[n] = node.parent == kNone ? own : turns[node.parent] * own;
    }
}

double hipsHeight(const RestPlaces& rest, const Roles& roles) {
    const double ankles = std::min(rest.place(roles[roleOf(BodyPart::foot, kLeft)]).y,
                                   rest.place(roles[roleOf(BodyPart::foot, kRight)]).y);
    return rest.place(roles[roleOf(BodyPart::hips)]).y - ankles;
}

Followers findFollowers(const Biped& from, const Biped& to, std::span<const NodePair> given,
                        std::span<const uint32_t> partners) {
    return FollowerFinder(from, to, given, partners).find();
}

} // namespace supple::skinning
