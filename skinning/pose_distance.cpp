#include "skinning/pose_distance.h"

#include "cage/solved_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace supple::skinning {

namespace {

constexpr double kShell = 0.015; // of the extent
constexpr size_t kMostWatched = 160;

} // namespace

PoseDistance::PoseDistance(const cage::Character& character)
    : character_(character), inverseBinds_(character.skin.inverseBinds.begin(), character.skin.inverseBinds.end()) {
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        all_.push_back(v);
    }
    Pose rest;
    restPose(character, rest);
    std::vector<glm::dmat4> globals(character.skeleton.nodes.size());
    globalsOf(rest, globals);
    measureExtent(globals);
    measureReach(globals);
    measureTargets(globals);
    drivenReach_.assign(character.skeleton.nodes.size(), 0.0);
    watch(globals);
}

void PoseDistance::globalsOf(const Pose& pose, std::vector<glm::dmat4>& globals) const {
    const cage::Skeleton& skeleton = character_.skeleton;
    for (const uint32_t node : skeleton.parentsFirst) {
        const glm::dmat4 local = localMatrix(skeleton.nodes[node], pose.locals[node]);
        const uint32_t parent = skeleton.nodes[node].parent;
        globals[node] = parent == cage::kNone ? local : globals[parent] * local;
    }
}

double PoseDistance::between(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b,
                             std::span<const uint32_t> vertices) const {
    double worst = 0.0;
    for (const uint32_t v : vertices) {
        worst = std::max(worst, glm::length(vertex(v, a) - vertex(v, b)));
    }
    for (const uint32_t node : character_.skin.joints) {
        for (int axis = 0; axis < 3; ++axis) {
            worst = std::max(worst, glm::length(shellPoint(a[node], axis) - shellPoint(b[node], axis)));
        }
    }
    return worst / extent_;
}

void PoseDistance::takeLargest(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b,
                               std::vector<double>& largest) const {
    const cage::SkinWeights& weights = character_.weights;
    for (const uint32_t v : all_) {
        const double own = glm::length(vertex(v, a) - vertex(v, b)) / extent_;
        for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
            double& of = largest[character_.skin.joints[weights.influences[i].joint]];
            of = std::max(of, own);
        }
    }
    for (const uint32_t node : character_.skin.joints) {
        for (int axis = 0; axis < 3; ++axis) {
            const double own = glm::length(shellPoint(a[node], axis) - shellPoint(b[node], axis)) / extent_;
            largest[node] = std::max(largest[node], own);
        }
    }
}

void PoseDistance::place(const std::vector<glm::dmat4>& globals, std::vector<glm::dvec3>& points) const {
    points.clear();
    for (const uint32_t v : watched_) {
        points.push_back(vertex(v, globals));
    }
    for (const uint32_t node : character_.skin.joints) {
        for (int axis = 0; axis < 3; ++axis) {
            points.push_back(shellPoint(globals[node], axis));
        }
    }
}

glm::dvec3 PoseDistance::vertex(uint32_t v, const std::vector<glm::dmat4>& globals) const {
    const cage::SkinWeights& weights = character_.weights;
    glm::dvec3 sum(0.0);
    for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
        const uint32_t joint = weights.influences[i].joint;
        const glm::dvec4 bound = inverseBinds_[joint] * glm::dvec4(glm::dvec3(character_.cage.positions[v]), 1.0);
        sum += static_cast<double>(weights.influences[i].weight) *
               glm::dvec3(globals[character_.skin.joints[joint]] * bound);
    }
    return sum;
}

glm::dvec3 PoseDistance::shellPoint(const glm::dmat4& m, int axis) const {
    const glm::dvec3 along(m[axis]);
    const double length = glm::length(along);
    return glm::dvec3(m[3]) + (length > 0.0 ? along * (kShell * extent_ / length) : glm::dvec3(0.0));
}

void PoseDistance::measureExtent(const std::vector<glm::dmat4>& globals) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const uint32_t v : all_) {
        const glm::dvec3 p = vertex(v, globals);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    extent_ = glm::length(high - low);
}

/// By the weight of all that hangs on a node, times its distance.
void PoseDistance::measureReach(const std::vector<glm::dmat4>& globals) {
    const cage::Skeleton& skeleton = character_.skeleton;
    const cage::SkinWeights& weights = character_.weights;
    reach_.assign(skeleton.nodes.size(), kShell * extent_);
    std::vector<double> share(skeleton.nodes.size(), 0.0);
    std::vector<uint32_t> touched;
    for (const uint32_t v : all_) {
        const glm::dvec3 p = vertex(v, globals);
        for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
            uint32_t node = character_.skin.joints[weights.influences[i].joint];
            for (; node != cage::kNone; node = skeleton.nodes[node].parent) {
                touched.push_back(node);
                share[node] += std::abs(static_cast<double>(weights.influences[i].weight));
            }
        }
        for (const uint32_t node : touched) {
            reach_[node] = std::max(reach_[node], share[node] * glm::length(p - glm::dvec3(globals[node][3])));
        }
        for (const uint32_t node : touched) {
            share[node] = 0.0;
        }
        touched.clear();
    }
    for (const cage::Node& node : skeleton.nodes) {
        double scale = 1.0;
        if (node.parent != cage::kNone) {
            const glm::dmat3 linear(globals[node.parent]);
            scale = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]), 1e-9});
        }
        parentScale_.push_back(scale);
    }
}

void PoseDistance::measureTargets(const std::vector<glm::dmat4>& globals) {
    const cage::SkinWeights& weights = character_.weights;
    for (const cage::MorphTarget& target : character_.morphs.targets) {
        double& reach = targetReach_.emplace_back(0.0);
        for (size_t k = 0; k < target.vertices.size(); ++k) {
            const uint32_t v = target.vertices[k];
            glm::dvec3 moved(0.0);
            for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
                const uint32_t joint = weights.influences[i].joint;
                const glm::dmat3 linear(globals[character_.skin.joints[joint]] * inverseBinds_[joint]);
                moved += static_cast<double>(weights.influences[i].weight) * (linear * glm::dvec3(target.deltas[k]));
            }
            reach = std::max(reach, glm::length(moved));
        }
    }
}

/// (1 + x)^-2 of x = g sin^2(a / 2) / sigma^2 changes by 0.52 sqrt(g / sigma^2) per radian at most.
void PoseDistance::takeDrivers() {
    constexpr double kSteepest = 0.52;
    for (const cage::PoseDriver& driver : character_.drivers) {
        const Result<cage::SolvedDriver> solved = cage::solveDriver(driver);
        if (!solved) {
            continue;
        }
        double moved = 0.0;
        for (size_t i = 0; i < solved->coefficients.size(); ++i) {
            moved += std::abs(static_cast<double>(solved->coefficients[i])) *
                     targetReach_[driver.targets[i % driver.targets.size()]];
        }
        for (const cage::DriverInput& input : driver.inputs) {
            drivenReach_[input.node] +=
                kSteepest * std::sqrt(static_cast<double>(input.weight * solved->inverseSigma2)) * moved;
        }
    }
}

void PoseDistance::watch(const std::vector<glm::dmat4>& globals) {
    const cage::SkinWeights& weights = character_.weights;
    std::vector<std::pair<double, uint32_t>> farthest(character_.skin.joints.size(), {-1.0, 0u}); // by joint
    for (const uint32_t v : all_) {
        const glm::dvec3 p = vertex(v, globals);
        for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
            const uint32_t joint = weights.influences[i].joint;
            const double far = static_cast<double>(weights.influences[i].weight) *
                               glm::length(p - glm::dvec3(globals[character_.skin.joints[joint]][3]));
            farthest[joint] = std::max(farthest[joint], {far, v});
        }
    }
    std::sort(farthest.rbegin(), farthest.rend());
    for (const auto& [far, v] : farthest) {
        if (far >= 0.0 && watched_.size() < kMostWatched) {
            watched_.push_back(v);
        }
    }
}

} // namespace supple::skinning
