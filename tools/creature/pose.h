// Poses of the skeleton, curves to drive them, and leg placement.
#pragma once

#include "skeleton.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace supple::creature {

struct Pose {
    explicit Pose(const Skeleton& skeleton);

    // Turns a joint, in degrees about model axes, after what turned it before.
    void turn(const std::string& joint, double x, double y, double z);
    // The same for both sides: y and z are reflected on the right.
    void turnPair(const std::string& joint, double x, double y, double z);
    void move(const std::string& joint, const Vec3& by);

    // Where a joint is and how it is turned in the model.
    struct Placed {
        Vec3 position;
        Quat rotation;
    };
    Placed placed(int joint) const;

    // Bends hip and knee so that the ball of the foot is at `ball` and the foot turned by `foot`, both as the root sees
    // them, and bends the toes by `toes` degrees. `side` is ".L" or ".R".
    void plant(const std::string& side, const Vec3& ball, const Quat& foot, double toes);

    // Bends shoulder and elbow so that the wrist is at `wrist` and the hand turned by `hand`, both in the model. The
    // elbow points to `pole`. The joint foreTwist takes half of the hand's roll.
    void reach(const std::string& side, const Vec3& wrist, const Vec3& pole, const Quat& hand);

    const Skeleton& skeleton;
    std::vector<Quat> rotations;
    std::vector<Vec3> moves; // added to the joint's rest offset
};

// Part of the way from one pose to another.
Pose between(const Pose& from, const Pose& to, double share);

// The rotation that takes the axes (a, n, a x n) to (b, m, b x m).
Quat turnBetween(const Vec3& a, const Vec3& n, const Vec3& b, const Vec3& m);

Quat eulerDegrees(double x, double y, double z);

// A smooth curve through keys that never overshoots them.
class Curve {
public:
    Curve(std::initializer_list<std::pair<double, double>> keys) : Curve(std::vector(keys)) {}
    explicit Curve(std::vector<std::pair<double, double>> keys);
    double operator()(double time) const;

private:
    std::vector<std::pair<double, double>> keys;
    std::vector<double> slopes;
};

} // namespace supple::creature
