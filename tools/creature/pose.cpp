#include "pose.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

Quat turnBetween(const Vec3& a, const Vec3& n, const Vec3& b, const Vec3& m) {
    const glm::dmat3 from(a, n, glm::cross(a, n));
    const glm::dmat3 to(b, m, glm::cross(b, m));
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

Quat eulerDegrees(double x, double y, double z) {
    const double r = kPi / 180;
    return glm::angleAxis(z * r, Vec3{0, 0, 1}) * glm::angleAxis(y * r, Vec3{0, 1, 0}) *
           glm::angleAxis(x * r, Vec3{1, 0, 0});
}

Pose::Pose(const Skeleton& skeleton)
    : skeleton(skeleton), rotations(skeleton.joints.size(), Quat(1, 0, 0, 0)), moves(skeleton.joints.size(), Vec3(0)) {}

Pose between(const Pose& from, const Pose& to, double share) {
    Pose pose(from.skeleton);
    for (size_t i = 0; i < pose.rotations.size(); ++i) {
        pose.rotations[i] = glm::slerp(from.rotations[i], to.rotations[i], share);
        pose.moves[i] = from.moves[i] + (to.moves[i] - from.moves[i]) * share;
    }
    return pose;
}

void Pose::turn(const std::string& joint, double x, double y, double z) {
    Quat& rotation = rotations[static_cast<size_t>(skeleton.index(joint))];
    rotation = eulerDegrees(x, y, z) * rotation;
}

void Pose::turnPair(const std::string& joint, double x, double y, double z) {
    turn(joint + ".L", x, y, z);
    turn(joint + ".R", x, -y, -z);
}

void Pose::move(const std::string& joint, const Vec3& by) {
    moves[static_cast<size_t>(skeleton.index(joint))] += by;
}

Pose::Placed Pose::placed(int joint) const {
    const Joint& it = skeleton.joints[static_cast<size_t>(joint)];
    const Vec3 local = skeleton.offset(joint) + moves[static_cast<size_t>(joint)];
    if (it.parent < 0) {
        return {local, rotations[static_cast<size_t>(joint)]};
    }
    const Placed parent = placed(it.parent);
    return {parent.position + parent.rotation * local, parent.rotation * rotations[static_cast<size_t>(joint)]};
}

void Pose::plant(const std::string& side, const Vec3& ballInRoot, const Quat& footInRoot, double toes) {
    const Placed root = placed(0);
    const Vec3 ball = root.position + root.rotation * ballInRoot;
    const Quat foot = root.rotation * footInRoot;
    const int thigh = skeleton.index("thigh" + side);
    const int shin = skeleton.index("shin" + side);
    const int ankle = skeleton.index("foot" + side);
    const int toe = skeleton.index("toes" + side);
    const Vec3 upperRest = skeleton.offset(shin);
    const Vec3 lowerRest = skeleton.offset(ankle);
    const double upper = glm::length(upperRest);
    const double lower = glm::length(lowerRest);
    const Vec3 restNormal = glm::normalize(glm::cross(upperRest, lowerRest));

    const Placed hips = placed(skeleton.joints[static_cast<size_t>(thigh)].parent);
    const Vec3 hip = hips.position + hips.rotation * skeleton.offset(thigh);
    const Vec3 target = ball - foot * skeleton.offset(toe);
    Vec3 line = target - hip;
    const double reach = std::min(glm::length(line), (upper + lower) * 0.9995);
    line = glm::normalize(line);

    // The knee points between where the hips and the foot face.
    const Vec3 facing = hips.rotation * Vec3{0, 0, 1} + foot * Vec3{0, 0, 1} * 0.7;
    const Vec3 outward = glm::normalize(facing - line * glm::dot(facing, line));
    const double along = (upper * upper - lower * lower + reach * reach) / (2 * reach);
    const double off = std::sqrt(std::max(0.0, upper * upper - along * along));
    const Vec3 knee = hip + line * along + outward * off;
    const Vec3 end = hip + line * reach;
    // The hinge is square to the plane of the leg, on the side it has at rest.
    const Vec3 normal = glm::normalize(glm::cross(line, outward)) * -1.0;
    const Vec3 hinge = glm::dot(normal, hips.rotation * restNormal) < 0 ? -normal : normal;

    const Quat thighTurn = turnBetween(glm::normalize(upperRest), restNormal, glm::normalize(knee - hip), hinge);
    const Quat shinTurn = turnBetween(glm::normalize(lowerRest), restNormal, glm::normalize(end - knee), hinge);
    rotations[static_cast<size_t>(thigh)] = glm::inverse(hips.rotation) * thighTurn;
    rotations[static_cast<size_t>(shin)] = glm::inverse(thighTurn) * shinTurn;
    rotations[static_cast<size_t>(ankle)] = glm::inverse(shinTurn) * foot;
    rotations[static_cast<size_t>(toe)] = eulerDegrees(toes, 0, 0);
}

void Pose::reach(const std::string& side, const Vec3& wrist, const Vec3& pole, const Quat& hand) {
    const int arm = skeleton.index("upperArm" + side);
    const int fore = skeleton.index("foreArm" + side);
    const int end = skeleton.index("hand" + side);
    const Vec3 upperRest = skeleton.offset(fore);
    const Vec3 lowerRest = skeleton.offset(end);
    const double upper = glm::length(upperRest);
    const double lower = glm::length(lowerRest);
    const Vec3 restNormal = glm::normalize(glm::cross(upperRest, lowerRest));

    const Placed clavicle = placed(skeleton.joints[static_cast<size_t>(arm)].parent);
    const Vec3 shoulder = clavicle.position + clavicle.rotation * skeleton.offset(arm);
    Vec3 line = wrist - shoulder;
    const double length = std::clamp(glm::length(line), std::abs(upper - lower) * 1.01, (upper + lower) * 0.9990);
    line = glm::normalize(line);
    const Vec3 outward = glm::normalize(pole - line * glm::dot(pole, line));
    const double along = (upper * upper - lower * lower + length * length) / (2 * length);
    const double off = std::sqrt(std::max(0.0, upper * upper - along * along));
    const Vec3 elbow = shoulder + line * along + outward * off;
    // The forearm folds about the hinge as it does at rest.
    const Vec3 hinge = glm::normalize(glm::cross(outward, line));
    const Vec3 first = glm::normalize(elbow - shoulder);
    const Vec3 second = glm::normalize(shoulder + line * length - elbow);
    const Quat armTurn = turnBetween(glm::normalize(upperRest), restNormal, first, hinge);
    const Quat foreTurn = turnBetween(glm::normalize(lowerRest), restNormal, second, hinge);
    rotations[static_cast<size_t>(arm)] = glm::inverse(clavicle.rotation) * armTurn;
    rotations[static_cast<size_t>(fore)] = glm::inverse(armTurn) * foreTurn;
    const Quat local = glm::inverse(foreTurn) * hand;
    rotations[static_cast<size_t>(end)] = local;
    const Vec3 axis = glm::normalize(lowerRest);
    const double roll = glm::dot(Vec3{local.x, local.y, local.z}, axis);
    const double angle = 2 * std::atan2(roll, local.w);
    const double near = angle > kPi ? angle - 2 * kPi : (angle < -kPi ? angle + 2 * kPi : angle);
    rotations[static_cast<size_t>(skeleton.index("foreTwist" + side))] = glm::angleAxis(near * 0.5, axis);
}

Curve::Curve(std::vector<std::pair<double, double>> list) : keys(std::move(list)), slopes(keys.size(), 0.0) {
    // Fritsch-Carlson: level at peaks, harmonic mean of the neighboring slopes elsewhere.
    for (size_t i = 1; i + 1 < keys.size(); ++i) {
        const double before = (keys[i].second - keys[i - 1].second) / (keys[i].first - keys[i - 1].first);
        const double after = (keys[i + 1].second - keys[i].second) / (keys[i + 1].first - keys[i].first);
        slopes[i] = before * after > 0 ? 2 * before * after / (before + after) : 0.0;
    }
}

double Curve::operator()(double time) const {
    if (time <= keys.front().first) {
        return keys.front().second;
    }
    for (size_t i = 1; i < keys.size(); ++i) {
        if (time <= keys[i].first) {
            const double h = keys[i].first - keys[i - 1].first;
            const double t = (time - keys[i - 1].first) / h;
            const double t2 = t * t;
            const double t3 = t2 * t;
            return (2 * t3 - 3 * t2 + 1) * keys[i - 1].second + (t3 - 2 * t2 + t) * h * slopes[i - 1] +
                   (3 * t2 - 2 * t3) * keys[i].second + (t3 - t2) * h * slopes[i];
        }
    }
    return keys.back().second;
}

} // namespace supple::creature
