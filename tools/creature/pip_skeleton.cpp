#include "skeleton.h"

#include "pip_model.h"

namespace supple::creature {

namespace {

using namespace landmark;

Vec3 flipped(const Vec3& p) {
    return {-p.x, p.y, p.z};
}

} // namespace

Skeleton makeSkeleton(bool ends) {
    Skeleton skeleton;
    const auto add = [&](const std::string& name, const char* parent, const Vec3& rest, const Vec3& end) {
        skeleton.joints.push_back({name, *parent ? skeleton.index(parent) : -1, rest, end});
    };
    add("root", "", {0, 0, 0}, {0, 0.1, 0});
    add("hips", "root", kHips, kSpine);
    add("spine", "hips", kSpine, kChest);
    add("chest", "spine", kChest, kNeck);
    add("neck", "chest", kNeck, kHead);
    add("head", "neck", kHead, {0, 1.40, 0.0});
    add("jaw", "head", kJaw, {0, 1.03, 0.40});
    add("tongue", "jaw", {0, 1.03, 0.14}, {0, 1.03, 0.34});
    for (const double side : {1.0, -1.0}) {
        const std::string suffix = side > 0 ? ".L" : ".R";
        const auto addPaired = [&](const std::string& name, const std::string& parent, const Vec3& rest,
                                   const Vec3& end) {
            const bool paired = parent != "head" && parent != "chest" && parent != "hips";
            skeleton.joints.push_back({name + suffix, skeleton.index(paired ? parent + suffix : parent),
                                       side > 0 ? rest : flipped(rest), side > 0 ? end : flipped(end)});
        };
        addPaired("eye", "head", kEye, kEye + Vec3{0, 0, kEyeRadius});
        addPaired("upperLid", "head", kEye, kEye + Vec3{0, 0.05, kEyeRadius});
        addPaired("lowerLid", "head", kEye, kEye + Vec3{0, -0.05, kEyeRadius});
        addPaired("ear", "head", kEar, kEarMiddle);
        addPaired("earTip", "ear", kEarMiddle, kEarTip);
        addPaired("clavicle", "chest", kShoulder * Vec3{0.35, 1, 1}, kShoulder);
        addPaired("upperArm", "clavicle", kShoulder, kElbow);
        addPaired("foreArm", "upperArm", kElbow, kWrist);
        addPaired("hand", "foreArm", kWrist, kKnuckles);
        for (const FingerLine& finger : fingerLines()) {
            const Vec3 middle = finger.from + (finger.to - finger.from) * 0.52;
            addPaired(std::string(finger.name) + "A", "hand", finger.from, middle);
            addPaired(std::string(finger.name) + "B", std::string(finger.name) + "A", middle, finger.to);
        }
        addPaired("wing", "chest", kWing, kWingMiddle);
        addPaired("wingMiddle", "wing", kWingMiddle, kWingTip);
        addPaired("wingTip", "wingMiddle", kWingTip, kWingTip + (kWingTip - kWingMiddle));
        addPaired("thigh", "hips", kThigh, kKnee);
        addPaired("shin", "thigh", kKnee, kAnkle);
        addPaired("foot", "shin", kAnkle, kBall);
        addPaired("toes", "foot", kBall, kBall + Vec3{0, -0.01, 0.12});
    }
    for (int i = 0; i < kTailJoints; ++i) {
        const std::string parent = i == 0 ? "hips" : "tail" + std::to_string(i);
        add("tail" + std::to_string(i + 1), parent.c_str(), kTail[i], kTail[i + 1]);
    }
    if (ends) {
        add("earEnd.L", "earTip.L", kEarTip, kEarTip);
        add("earEnd.R", "earTip.R", flipped(kEarTip), flipped(kEarTip));
        add("tailEnd", "tail7", kTail[kTailJoints], kTail[kTailJoints]);
    }
    return skeleton;
}

} // namespace supple::creature
