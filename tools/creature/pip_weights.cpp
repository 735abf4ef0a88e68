#include "weights.h"

#include "pip_model.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::creature {

namespace {

double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::length(p - (a + ab * t));
}

// The joints a point may start from. Only these compete, so an arm hanging beside the belly never takes hold of it.
std::vector<std::string> candidates(Part part) {
    switch (part) {
    case Part::Torso:
    case Part::Belly:
        return {"hips", "spine", "chest", "neck"};
    case Part::Head:
    case Part::Mouth:
    case Part::Lid:
        return {"head"};
    case Part::Ear:
        return {"ear", "earTip"};
    case Part::Arm:
        return {"upperArm", "foreArm", "hand"};
    case Part::Thumb:
        return {"thumbA", "thumbB"};
    case Part::Finger1:
        return {"indexA", "indexB"};
    case Part::Finger2:
        return {"middleA", "middleB"};
    case Part::Finger3:
        return {"pinkyA", "pinkyB"};
    case Part::Leg:
        return {"thigh", "shin", "foot"};
    case Part::Foot:
        return {"foot", "toes"};
    case Part::Tail:
        return {"tail1", "tail2", "tail3", "tail4", "tail5", "tail6", "tail7"};
    case Part::TailFin:
        return {"tail7"};
    case Part::Wing:
        return {"wing", "wingMiddle", "wingTip"};
    default:
        return {"head"};
    }
}

// How far from its bone a point is taken to be at most: the head and feet are wide but must stay stiff.
double reach(Part part) {
    switch (part) {
    case Part::Head:
    case Part::Mouth:
    case Part::Lid:
        return 0.07;
    case Part::Torso:
    case Part::Belly:
        return 0.13;
    case Part::Leg:
        return 0.075;
    case Part::Foot:
        return 0.05;
    case Part::Ear:
    case Part::Wing:
        return 0.07;
    default:
        return 0.2;
    }
}

bool paired(Part part) {
    return part == Part::Ear || part == Part::Arm || part == Part::Thumb || part == Part::Finger1 ||
           part == Part::Finger2 || part == Part::Finger3 || part == Part::Leg || part == Part::Foot ||
           part == Part::Wing;
}

const char* rigidJoint(Part part) {
    switch (part) {
    case Part::Eye:
    case Part::EyeShine:
        return "eye";
    case Part::Tongue:
        return "tongue";
    default:
        return "head";
    }
}

} // namespace

std::vector<Influences> skinWeights(const Cage& cage, const Skeleton& skeleton) {
    const size_t pointCount = cage.points.size();
    const size_t jointCount = skeleton.joints.size();
    const std::vector<std::vector<int>> around = cage.neighbours();

    std::vector<int> source(pointCount, 0);
    std::vector<double> pull(pointCount, 0);
    for (size_t i = 0; i < pointCount; ++i) {
        const Point& point = cage.points[i];
        if (point.shell != 0) {
            continue;
        }
        const std::string suffix = paired(point.part) ? (point.position.x > 0 ? ".L" : ".R") : "";
        double nearest = 1e30;
        for (const std::string& name : candidates(point.part)) {
            const int joint = skeleton.index(name + suffix);
            const Joint& bone = skeleton.joints[static_cast<size_t>(joint)];
            const double distance = distanceToSegment(point.position, bone.rest, bone.end);
            if (distance < nearest - 1e-9) {
                nearest = distance;
                source[i] = joint;
            }
        }
        nearest = std::clamp(nearest, 0.02, reach(point.part));
        double h2 = 0;
        for (int n : around[i]) {
            const Vec3 d = cage.position(n) - point.position;
            h2 += glm::dot(d, d) / static_cast<double>(around[i].size());
        }
        // Ratio of the bone's heat to the flow from the neighbours in one relaxation.
        pull[i] = h2 / (4 * nearest * nearest);
    }

    std::vector<std::vector<double>> weights(pointCount, std::vector<double>(jointCount, 0.0));
    for (size_t i = 0; i < pointCount; ++i) {
        weights[i][static_cast<size_t>(source[i])] = 1;
    }
    for (int round = 0; round < 200; ++round) {
        const std::vector<std::vector<double>> before = weights;
        for (size_t i = 0; i < pointCount; ++i) {
            if (cage.points[i].shell != 0) {
                continue;
            }
            const double share = 1.0 / static_cast<double>(around[i].size());
            for (size_t joint = 0; joint < jointCount; ++joint) {
                double mean = 0;
                for (int n : around[i]) {
                    mean += before[static_cast<size_t>(n)][joint] * share;
                }
                const double own = static_cast<size_t>(source[i]) == joint ? 1.0 : 0.0;
                weights[i][joint] = (mean + pull[i] * own) / (1 + pull[i]);
            }
        }
    }

    // The face: part of the head's share goes to the jaw and the lids.
    const size_t head = static_cast<size_t>(skeleton.index("head"));
    const size_t jaw = static_cast<size_t>(skeleton.index("jaw"));
    for (size_t i = 0; i < pointCount; ++i) {
        const Point& point = cage.points[i];
        const std::string suffix = point.position.x > 0 ? ".L" : ".R";
        const auto give = [&](size_t to, double share) {
            const double moved = weights[i][head] * share;
            weights[i][head] -= moved;
            weights[i][to] += moved;
        };
        if (point.shell != 0) {
            continue;
        }
        give(jaw, point.jaw);
        give(static_cast<size_t>(skeleton.index("upperLid" + suffix)), point.upper);
        give(static_cast<size_t>(skeleton.index("lowerLid" + suffix)), point.lower);
    }

    std::vector<Influences> result(pointCount);
    for (size_t i = 0; i < pointCount; ++i) {
        if (cage.points[i].shell == 0) {
            result[i] = strongest(weights[i]);
        }
    }

    // A shell is rigid: it takes the mean weights of the body points nearest to its root.
    for (int shell = 1; shell <= cage.shells; ++shell) {
        std::vector<size_t> members;
        Vec3 root{0};
        for (size_t i = 0; i < pointCount; ++i) {
            if (cage.points[i].shell == shell) {
                members.push_back(i);
            }
        }
        if (members.empty()) {
            continue;
        }
        double rootCount = 0;
        for (size_t i : members) {
            rootCount += cage.points[i].along == 0;
        }
        for (size_t i : members) {
            if (cage.points[i].along == 0) {
                root += cage.points[i].position / rootCount;
            }
        }
        const Part part = cage.points[members[0]].part;
        const std::string suffix = cage.points[members[0]].position.x > 0 ? ".L" : ".R";
        Influences shared;
        shared.weights[0] = 1;
        if (part == Part::Claw || part == Part::Spike) {
            std::vector<std::pair<long, size_t>> near;
            for (size_t i = 0; i < pointCount; ++i) {
                if (cage.points[i].shell == 0) {
                    near.push_back({std::lround(glm::length(cage.points[i].position - root) * 1e6), i});
                }
            }
            std::sort(near.begin(), near.end());
            std::vector<double> mean(jointCount, 0);
            double total = 0;
            for (size_t k = 0; k < 6; ++k) {
                const double w = 1.0 / (1e-3 + static_cast<double>(near[k].first) * 1e-6);
                total += w;
                for (size_t joint = 0; joint < jointCount; ++joint) {
                    mean[joint] += w * weights[near[k].second][joint];
                }
            }
            for (double& w : mean) {
                w /= total;
            }
            shared = strongest(mean);
        } else {
            const std::string name = rigidJoint(part);
            shared.joints[0] = skeleton.index(part == Part::Eye || part == Part::EyeShine ? name + suffix : name);
        }
        for (size_t i : members) {
            result[i] = shared;
        }
    }
    return result;
}

} // namespace supple::creature
