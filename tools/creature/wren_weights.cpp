#include "wren.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace supple::creature::wren {

namespace {

// One weight a joint, filled by name.
class Shares {
public:
    explicit Shares(const Skeleton& skeleton) : skeleton(skeleton), weights(skeleton.joints.size(), 0.0) {}
    void add(const std::string& joint, double weight) { weights[static_cast<size_t>(skeleton.index(joint))] += weight; }

    const Skeleton& skeleton;
    std::vector<double> weights;
};

// How far along a chain of places a point is: 0 at the first, 1 at the second; beyond the ends it goes on.
double along(std::span<const Vec3> chain, const Vec3& p) {
    double nearest = 1e30;
    double result = 0;
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
        const Vec3 line = chain[i + 1] - chain[i];
        double t = glm::dot(p - chain[i], line) / glm::dot(line, line);
        const double inside = std::clamp(t, 0.0, 1.0);
        const double distance = glm::length(p - (chain[i] + line * inside));
        if (distance < nearest - 1e-9) {
            nearest = distance;
            t = (i == 0 || t > 0) && (i + 2 == chain.size() || t < 1) ? t : inside;
            result = static_cast<double>(i) + t;
        }
    }
    return result;
}

// Shares `total` among a chain's joints; the first of them takes over from `parent` round 0.
void shareChain(Shares& shares, const std::string& parent, const std::vector<std::string>& joints, double at,
                double soft, double total) {
    double left = total;
    for (size_t i = joints.size(); i-- > 0;) {
        const double taken = left * ramp(static_cast<double>(i) - soft, static_cast<double>(i) + soft, at);
        shares.add(joints[i], taken);
        left -= taken;
    }
    shares.add(parent, left);
}

std::string sideOf(const Vec3& p) {
    return p.x > 0 ? ".L" : ".R";
}

Vec3 onLeft(const Vec3& p) {
    return {std::abs(p.x), p.y, p.z};
}

void torso(Shares& shares, const Vec3& p, double total) {
    const double neck = ramp(1.235, 1.320, p.y) * total;
    const double chest = ramp(1.015, 1.135, p.y) * total;
    const double spine = ramp(0.915, 1.005, p.y) * total;
    shares.add("neck", neck);
    shares.add("chest", std::max(0.0, chest - neck));
    shares.add("spine", std::max(0.0, spine - std::max(chest, neck)));
    shares.add("hips", total - std::max({spine, chest, neck}));
}

void foreArm(Shares& shares, const Vec3& p, double total) {
    const std::string side = sideOf(p);
    const Vec3 chain[] = {kElbow, kWrist};
    const double t = along(chain, onLeft(p));
    const double hand = ramp(0.90, 1.12, t) * total;
    const double twist = ramp(0.20, 0.85, t) * (total - hand);
    shares.add("hand" + side, hand);
    shares.add("foreTwist" + side, twist);
    shares.add("foreArm" + side, total - hand - twist);
}

// Where the elbow bends.
double elbowShare(const Vec3& p) {
    const Vec3 axis = glm::normalize(glm::normalize(kElbow - kShoulder) + glm::normalize(kWrist - kElbow));
    return ramp(-0.046, 0.046, glm::dot(onLeft(p) - kElbow, axis));
}

void torsoAndArm(Shares& shares, const Vec3& p) {
    const Vec3 q = onLeft(p);
    const Vec3 axis = glm::normalize(kElbow - kShoulder);
    const double u = glm::dot(q - kShoulder, axis);
    const double off = glm::length(q - kShoulder - axis * u);
    const double near = ramp(0.118, 0.078, off);
    const double arm = ramp(-0.052, 0.088, u) * near;
    const double clavicle =
        ramp(0.035, 0.125, q.x) * ramp(1.120, 1.205, q.y) * ramp(1.30, 1.25, q.y) * (1 - arm) * 0.85;
    const std::string side = sideOf(p);
    shares.add("clavicle" + side, clavicle);
    const double bend = elbowShare(p);
    shares.add("upperArm" + side, arm * (1 - bend));
    foreArm(shares, p, arm * bend);
    torso(shares, p, 1 - arm - clavicle);
}

void skirt(Shares& shares, const Vec3& p) {
    const double hangs = ramp(0.945, 0.765, p.y);
    const double left = ramp(-0.07, 0.07, p.x);
    const double front = ramp(-0.085, 0.085, p.z);
    shares.add("skirtFront.L", hangs * front * left);
    shares.add("skirtFront.R", hangs * front * (1 - left));
    shares.add("skirtBack.L", hangs * (1 - front) * left);
    shares.add("skirtBack.R", hangs * (1 - front) * (1 - left));
    torso(shares, p, 1 - hangs);
}

void leg(Shares& shares, const Vec3& p) {
    const Vec3 q = onLeft(p);
    const std::string side = sideOf(p);
    const double thigh = ramp(0.895, 0.745, q.y + 0.25 * (0.085 - q.x)) * ramp(-0.012, 0.030, q.x);
    const double shin = ramp(kKnee.y + 0.060, kKnee.y - 0.060, q.y) * thigh;
    const double foot = ramp(0.150, 0.070, q.y - 0.35 * std::max(0.0, q.z)) * shin;
    const double toes = ramp(kBall.z - 0.030, kBall.z + 0.035, q.z) * foot;
    shares.add("toes" + side, toes);
    shares.add("foot" + side, foot - toes);
    shares.add("shin" + side, shin - foot);
    shares.add("thigh" + side, thigh - shin);
    shares.add("hips", 1 - thigh);
}

void finger(Shares& shares, const Vec3& p, size_t which) {
    const std::array<Finger, 5> all = fingers();
    const Finger& it = all[which];
    const Vec3 chain[] = {handGrown(it.from), handGrown(mix(it.from, it.to, 0.42)),
                          handGrown(mix(it.from, it.to, 0.72)), handGrown(it.to)};
    const std::string side = sideOf(p);
    const std::string name = it.name;
    shareChain(shares, "hand" + side, {name + "A" + side, name + "B" + side, name + "C" + side},
               along(chain, onLeft(p)), which == 4 ? 0.34 : 0.30, 1);
}

void head(Shares& shares, const Vec3& p) {
    const double head = ramp(1.298, 1.352, p.y + 0.55 * p.z);
    const double chest = ramp(1.290, 1.245, p.y) * (1 - head);
    shares.add("head", head);
    shares.add("chest", chest);
    shares.add("neck", 1 - head - chest);
}

// The pouch that a shell is a piece of, if pouches move.
const Pouch* pouchAt(const Skeleton& skeleton, Part part, const Vec3& middle) {
    for (const Pouch& pouch : kPouches) {
        if (skeleton.springs && part != Part::Strap && middle.y < 0.95 &&
            glm::length(middle - mix(pouch.top, pouch.bottom, 0.5)) < 0.055) {
            return &pouch;
        }
    }
    return nullptr;
}

void weigh(Shares& shares, const Point& point, const Vec3& middle) {
    const Vec3& p = point.position;
    switch (point.part) {
    case Part::Eye:
        return shares.add("eye" + sideOf(middle), 1);
    case Part::Hair:
    case Part::Ribbon:
        if (point.rib > 0) {
            const Links links = shares.skeleton.links("ponytail");
            return shareChain(shares, "head", links.joints, along(links.places, p), 0.42, 1);
        }
        return shares.add("head", 1);
    case Part::Jacket:
    case Part::JacketTrim:
        return p.y < 0.945 && std::abs(p.x) < 0.26 ? skirt(shares, p) : torsoAndArm(shares, p);
    case Part::Collar:
        return torso(shares, {0, std::max(p.y, 1.20), 0}, 1);
    case Part::Strap:
    case Part::Buckle:
    case Part::Pouch: {
        if (const Pouch* pouch = pouchAt(shares.skeleton, point.part, middle)) {
            return shares.add(std::string(pouch->name) + "1", 1);
        }
        const Vec3 at = point.part == Part::Strap ? p : middle;
        return at.y < 0.75 ? leg(shares, at) : torsoAndArm(shares, at);
    }
    case Part::Pauldron:
        shares.add("clavicle" + sideOf(middle), 0.35 + 0.25 * ramp(1.14, 1.24, middle.y));
        return shares.add("upperArm" + sideOf(middle), 0.65 - 0.25 * ramp(1.14, 1.24, middle.y));
    case Part::Bracer:
        return foreArm(shares, p, 1);
    case Part::Trousers:
    case Part::KneePatch:
    case Part::Boot:
    case Part::BootCuff:
    case Part::Sole:
        return leg(shares, p);
    case Part::Hand:
        return foreArm(shares, p, 1);
    case Part::Finger1:
    case Part::Finger2:
    case Part::Finger3:
    case Part::Finger4:
        return finger(shares, p, static_cast<size_t>(point.part) - static_cast<size_t>(Part::Finger1));
    case Part::Thumb:
        return finger(shares, p, 4);
    case Part::Scarf:
    case Part::ScarfFringe:
        if (point.rib > 0) {
            const Links links = shares.skeleton.links("scarf");
            return shareChain(shares, "chest", links.joints, along(links.places, p), 0.42, 1);
        }
        shares.add("neck", ramp(1.225, 1.345, p.y));
        return shares.add("chest", 1 - ramp(1.225, 1.345, p.y));
    case Part::Blade:
    case Part::Guard:
    case Part::Grip:
        return shares.add("sword", 1);
    case Part::Scabbard:
        return shares.add("scabbard", 1);
    default:
        return head(shares, p);
    }
}

} // namespace

std::vector<Influences> weightsOf(const Cage& cage, const Skeleton& skeleton) {
    // The middle of each shell, for what is stiff.
    std::vector<Vec3> middles(static_cast<size_t>(cage.shells) + 1, Vec3(0));
    std::vector<double> counts(middles.size(), 0);
    for (const Point& point : cage.points) {
        middles[static_cast<size_t>(point.shell)] += point.position;
        counts[static_cast<size_t>(point.shell)] += 1;
    }
    std::vector<Influences> result;
    for (const Point& point : cage.points) {
        const size_t shell = static_cast<size_t>(point.shell);
        Shares shares(skeleton);
        weigh(shares, point, middles[shell] / counts[shell]);
        result.push_back(strongest(shares.weights));
    }
    return result;
}

} // namespace supple::creature::wren
