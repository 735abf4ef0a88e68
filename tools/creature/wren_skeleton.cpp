#include "wren.h"

#include <glm/geometric.hpp>

namespace supple::creature::wren {

namespace {

Vec3 onRight(const Vec3& p) {
    return {-p.x, p.y, p.z};
}

} // namespace

std::array<Finger, 5> fingers() {
    const Vec3 palm = glm::normalize(kKnuckles - kWrist);
    const Vec3 back = glm::normalize(Vec3{0.714, 0.70, 0});
    const Vec3 across{0, 0, 1};
    const auto line = [&](const char* name, const Vec3& from, const Vec3& direction, double length, double radius) {
        return Finger{name, from, from + glm::normalize(direction) * length, radius};
    };
    return {
        line("index", kKnuckles + across * 0.0285 - palm * 0.001, palm + across * 0.13 - back * 0.10, 0.073, 0.0102),
        line("middle", kKnuckles + across * 0.0095 + palm * 0.003, palm + across * 0.03 - back * 0.10, 0.080, 0.0104),
        line("ring", kKnuckles - across * 0.0095 + palm * 0.001, palm - across * 0.06 - back * 0.12, 0.074, 0.0100),
        line("pinky", kKnuckles - across * 0.0280 - palm * 0.005, palm - across * 0.17 - back * 0.14, 0.060, 0.0090),
        line("thumb", kWrist + palm * 0.036 + across * 0.030 - back * 0.006, palm * 0.80 + across * 0.78 - back * 0.28,
             0.072, 0.0118)};
}

Vec3 handGrown(const Vec3& p) {
    const Vec3 axis = glm::normalize(kKnuckles - kWrist);
    return kWrist + (p - kWrist) * mix(1.0, 1.17, ramp(-0.02, 0.03, glm::dot(p - kWrist, axis)));
}

Vec3 grip() {
    return handGrown({0.4835, 0.8175, -0.003});
}

Skeleton makeSkeleton(bool springs) {
    Skeleton skeleton;
    skeleton.springs = springs;
    const auto add = [&](const std::string& name, const std::string& parent, const Vec3& rest) {
        skeleton.joints.push_back({name, parent.empty() ? -1 : skeleton.index(parent), rest, rest});
    };
    const auto addChain = [&](const std::string& name, const std::string& parent, const std::vector<Vec3>& places) {
        for (size_t i = 0; i + 1 < places.size(); ++i) {
            add(name + std::to_string(i + 1), i == 0 ? parent : name + std::to_string(i), places[i]);
            skeleton.joints.back().end = places[i + 1];
        }
    };
    add("root", "", {0, 0, 0});
    add("hips", "root", kHips);
    add("spine", "hips", kSpine);
    add("chest", "spine", kChest);
    add("neck", "chest", kNeck);
    add("head", "neck", kHead);
    addChain("ponytail", "head", {grown(kTail[0]), grown(kTail[1]), grown(kTail[2]), grown(kTail[3])});
    const std::vector<Vec3> scarf{std::begin(kScarfTail), std::end(kScarfTail)};
    addChain("scarf", "chest", springs ? spline(scarf, 2 * kScarfJoints + 1) : scarf);
    for (const std::string side : {".L", ".R"}) {
        const auto addPaired = [&](const std::string& name, const std::string& parent, const Vec3& rest) {
            add(name + side, parent, side == ".L" ? rest : onRight(rest));
        };
        addPaired("eye", "head", grown(kEye));
        addPaired("clavicle", "chest", kShoulder * Vec3{0.25, 1, 1});
        addPaired("upperArm", "clavicle" + side, kShoulder);
        addPaired("foreArm", "upperArm" + side, kElbow);
        addPaired("foreTwist", "foreArm" + side, mix(kElbow, kWrist, 0.5));
        addPaired("hand", "foreArm" + side, kWrist);
        for (const Finger& finger : fingers()) {
            const std::string name = finger.name;
            addPaired(name + "A", "hand" + side, handGrown(finger.from));
            addPaired(name + "B", name + "A" + side, handGrown(mix(finger.from, finger.to, 0.42)));
            addPaired(name + "C", name + "B" + side, handGrown(mix(finger.from, finger.to, 0.72)));
        }
        addPaired("thigh", "hips", kThigh);
        addPaired("shin", "thigh" + side, kKnee);
        addPaired("foot", "shin" + side, kAnkle);
        addPaired("toes", "foot" + side, kBall);
        addPaired("skirtFront", "hips", {0.075, 0.915, 0.065});
        addPaired("skirtBack", "hips", {0.075, 0.915, -0.075});
    }
    add("sword", "hand.R", onRight(grip()));
    add("scabbard", "hips", kScabbard);
    for (size_t i = 0; springs && i < std::size(kPouches); ++i) {
        addChain(kPouches[i].name, "hips", {kPouches[i].top, kPouches[i].bottom});
    }
    // Springs end at joints.
    for (const std::string name : {"ponytail", "scarf", kPouches[0].name, kPouches[1].name}) {
        const Links links = skeleton.links(name);
        if (springs) {
            add(name + "End", links.joints.back(), links.places.back());
        }
    }
    return skeleton;
}

} // namespace supple::creature::wren
