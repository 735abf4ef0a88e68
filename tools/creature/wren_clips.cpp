#include "wren_clips.h"

#include "wren_stance.h"

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

// Breathing, standing with the weight on the right leg. All other clips begin and end in its first pose.
Pose standing(const Skeleton& skeleton, double phase, double look) {
    const double breath = std::sin(kTurn * (phase * 2 - 0.1));
    const double sway = std::sin(kTurn * phase);
    Pose pose(skeleton);
    pose.move("hips", {-0.024 + 0.004 * sway, -0.020 + 0.002 * breath, -0.006});
    pose.turn("hips", 1, 6, 3.0 + 0.5 * sway);
    pose.turn("spine", -1.5 - 0.5 * breath, -2, -3.4 - 0.4 * sway);
    pose.turn("chest", -1.5 - 1.1 * breath, -5 + 2 * look, -2.0 - 0.4 * sway);
    pose.turnPair("clavicle", 0, 0, 1.6 * breath);
    pose.turn("neck", 1 + 0.6 * breath, 1 + 5 * look, 1.4);
    pose.turn("head", 0.5 + 0.6 * breath, 3 + 12 * look, 2.4 + 0.8 * std::sin(kTurn * (phase + 0.2)) - 2 * look);
    for (const char* side : {".L", ".R"}) {
        pose.turn(std::string("eye") + side, 0, 9 * look, 0);
    }
    return pose;
}

struct Feet {
    Vec3 left{0.022, 0, 0.050}, right{-0.006, 0, -0.026};
    double leftHeel = 0, rightHeel = 0, leftYaw = 20, rightYaw = 10;
};

void plantFeet(Pose& pose, const Feet& feet) {
    stand(pose, ".L", feet.left, feet.leftHeel, feet.leftYaw);
    stand(pose, ".R", feet.right, feet.rightHeel, feet.rightYaw);
    drape(pose);
}

Clip idle(const Skeleton& skeleton) {
    Clip clip{"idle", 30, {}};
    constexpr int kFrames = 120;
    const Curve lids{{0.0, 0},  {0.95, 0}, {1.03, 1}, {1.07, 1}, {1.20, 0},
                     {2.93, 0}, {3.00, 1}, {3.04, 1}, {3.16, 0}, {4.0, 0}};
    const Curve look{{0.0, 0}, {0.9, 0}, {1.3, 1}, {2.4, 1}, {3.05, 0}, {4.0, 0}};
    const Curve brows{{0.0, 0}, {1.1, 0}, {1.5, 0.6}, {2.3, 0.5}, {2.9, 0}, {4.0, 0}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double t = 4.0 * (frame % kFrames) / kFrames;
        Pose pose = standing(skeleton, t / 4, look(t));
        Hand right = kOnShoulder;
        right.wrist.y += 0.003 * std::sin(kTurn * (t / 2 - 0.15));
        place(pose, ".R", right);
        place(pose, ".L", kOnScabbard);
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", 0.42 + 0.05 * std::sin(kTurn * t / 4), 0.2);
        plantFeet(pose, {});
        clip.frames.push_back(pose);
        clip.morphs["blink"].push_back(lids(t));
        clip.morphs["brows"].push_back(brows(t));
        clip.morphs["smile"].push_back(0.30 + 0.12 * brows(t));
    }
    hang(clip, skeleton, true, 0);
    return clip;
}

// A cut from the right shoulder down to the left, with a lunge.
Clip attack(const Skeleton& skeleton) {
    Clip clip{"attack", 30, {}};
    constexpr int kFrames = 48;
    const std::vector<HandKey> right{
        {0.00, kOnShoulder},
        {0.16, {{-0.235, 1.20, 0.110}, {-0.8, -0.8, -0.3}, {0.10, 0.85, 0.50}, {0.10, 0.45, -0.88}}},
        {0.40, {{-0.240, 1.365, -0.060}, {-1.0, -0.1, 0.25}, {0.05, 0.90, -0.42}, {0.30, 0.34, -0.88}}},
        {0.48, {{-0.235, 1.385, -0.040}, {-1.0, -0.1, 0.25}, {0.10, 0.92, -0.20}, {0.30, 0.28, -0.90}}},
        {0.56, {{-0.130, 1.330, 0.250}, {-0.9, -0.4, 0.0}, {0.25, 0.30, 0.90}, {0.10, 0.94, -0.20}}},
        {0.62, {{-0.010, 1.120, 0.390}, {-0.8, -0.6, -0.1}, {0.40, -0.82, 0.40}, {0.32, 0.42, 0.86}}},
        {0.69, {{0.100, 0.960, 0.310}, {-0.7, -0.2, 0.1}, {0.35, -0.92, -0.20}, {0.74, -0.12, 0.66}}},
        {0.82, {{0.150, 0.905, 0.215}, {-0.7, 0.1, 0.2}, {0.10, -0.85, -0.52}, {0.92, -0.30, 0.18}}},
        {1.00, {{0.120, 0.915, 0.235}, {-0.7, 0.0, 0.2}, {0.10, -0.88, -0.40}, {0.90, -0.28, 0.30}}},
        {1.25, {{-0.140, 1.000, 0.270}, {-0.8, -0.6, -0.1}, {0.20, 0.10, 0.95}, {0.20, 0.92, 0.10}}},
        {1.50, kOnShoulder},
        {1.60, kOnShoulder}};
    const std::vector<HandKey> left{
        {0.00, kOnScabbard},
        {0.12, kOnScabbard},
        {0.42, {{0.225, 1.130, 0.270}, {0.6, -0.8, -0.2}, {-0.20, 0.35, 0.90}, {-0.50, 0.80, -0.30}}},
        {0.64, {{0.330, 1.040, -0.090}, {0.5, 0.1, -1.0}, {0.45, -0.70, -0.45}, {-0.10, 0.10, 0.95}}},
        {0.90, {{0.325, 1.000, -0.060}, {0.5, 0.1, -1.0}, {0.40, -0.80, -0.30}, {-0.10, 0.10, 0.95}}},
        {1.35, kOnScabbard},
        {1.60, kOnScabbard}};
    const Curve twist{{0.0, 0}, {0.42, -30}, {0.48, -30}, {0.64, 34}, {0.90, 38}, {1.40, 0}, {1.6, 0}};
    const Curve lean{{0.0, 0}, {0.42, -9}, {0.50, -8}, {0.66, 20}, {0.95, 21}, {1.40, 0}, {1.6, 0}};
    const Curve forward{{0.0, 0}, {0.42, -0.055}, {0.48, -0.045}, {0.66, 0.125}, {0.98, 0.130}, {1.38, 0}, {1.6, 0}};
    const Curve sink{{0.0, 0}, {0.36, -0.010}, {0.48, 0.0}, {0.66, -0.095}, {0.98, -0.090}, {1.38, 0}, {1.6, 0}};
    const Curve stepping{{0.0, 0}, {0.42, 0}, {0.58, 0.190}, {1.07, 0.190}, {1.31, 0}, {1.6, 0}};
    const Curve lifting{{0.0, 0}, {0.38, 0}, {0.50, 0.060}, {0.60, 0}, {1.04, 0}, {1.19, 0.045}, {1.34, 0}, {1.6, 0}};
    const Curve tiptoe{{0.0, 0}, {0.48, 0}, {0.66, 42}, {1.0, 42}, {1.36, 0}, {1.6, 0}};
    const Curve effort{{0.0, 0}, {0.40, 0.8}, {0.95, 1}, {1.4, 0}, {1.6, 0}};
    const Curve shout{{0.0, 0}, {0.48, 0.05}, {0.60, 0.9}, {0.80, 0.55}, {1.05, 0}, {1.6, 0}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double t = frame / 30.0;
        Pose pose = standing(skeleton, 0, 0);
        pose.move("hips", {0.024 * std::abs(forward(t)) / 0.13, sink(t), forward(t)});
        pose.turn("hips", 0.35 * lean(t), 0.35 * twist(t), 0);
        pose.turn("spine", 0.35 * lean(t), 0.35 * twist(t), 0);
        pose.turn("chest", 0.30 * lean(t), 0.45 * twist(t), 0);
        pose.turn("neck", -0.40 * lean(t), -0.50 * twist(t), 0);
        pose.turn("head", -0.40 * lean(t), -0.45 * twist(t), 0);
        place(pose, ".R", between(right, t));
        place(pose, ".L", between(left, t));
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", 0.42 + 0.2 * effort(t), 0.3);
        Feet feet;
        feet.left += Vec3{0.010 * stepping(t) / 0.19, lifting(t), stepping(t)};
        feet.leftHeel = lifting(t) > 0 && t < 0.5 ? 250 * lifting(t) : 120 * lifting(t);
        feet.rightHeel = tiptoe(t);
        plantFeet(pose, feet);
        pose.turn("scabbard", -0.5 * lean(t), 0, 0.10 * twist(t));
        clip.frames.push_back(pose);
        clip.morphs["frown"].push_back(effort(t));
        clip.morphs["open"].push_back(shout(t));
        clip.morphs["smile"].push_back(0.30 * (1 - effort(t)));
    }
    hang(clip, skeleton, false, 0);
    return clip;
}

// A greeting with the left hand.
Clip waving(const Skeleton& skeleton) {
    Clip clip{"wave", 30, {}};
    constexpr int kFrames = 72;
    const Hand up{{0.330, 1.330, 0.110}, {0.8, -1, -0.35}, {0.16, 0.98, 0.05}, {-0.90, 0.15, 0.35}};
    const std::vector<HandKey> left{
        {0.0, kOnScabbard},
        {0.10, kOnScabbard},
        {0.35, {{0.300, 1.12, 0.190}, {0.9, -0.7, -0.3}, {0.10, 0.45, 0.88}, {-0.75, 0.55, -0.10}}},
        {0.62, up},
        {1.75, up},
        {2.02, {{0.295, 1.12, 0.150}, {0.9, -0.6, -0.4}, {0.10, 0.30, 0.90}, {-0.70, 0.65, 0.0}}},
        {2.30, kOnScabbard},
        {2.4, kOnScabbard}};
    const Curve raised{{0.0, 0}, {0.10, 0}, {0.62, 1}, {1.75, 1}, {2.3, 0}, {2.4, 0}};
    const Curve glad{{0.0, 0.30}, {0.5, 1}, {1.8, 1}, {2.3, 0.3}, {2.4, 0.3}};
    const Curve lids{{0.0, 0}, {0.14, 0}, {0.21, 1}, {0.25, 1}, {0.36, 0}, {1.82, 0}, {1.89, 1}, {1.93, 1}, {2.05, 0}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double t = frame / 30.0;
        const double r = raised(t);
        const double wag = r > 0.5 ? std::sin(kTurn * 1.75 * (t - 0.6)) * ramp(0.5, 0.95, r) : 0;
        Pose pose = standing(skeleton, 0, 0);
        pose.turn("spine", 0, 0, -2.0 * r);
        pose.turn("chest", -2 * r, -3 * r, -3.0 * r + 0.8 * wag);
        pose.turn("clavicle.L", 0, 0, 9 * r);
        pose.turn("head", -1.5 * r, -2 * r, 7 * r + 1.2 * wag);
        place(pose, ".R", kOnShoulder);
        Hand hand = between(left, t);
        hand.wrist += Vec3{0.030, -0.004 * std::abs(wag), 0} * wag;
        hand.fingers += Vec3{0.42, 0, 0} * wag;
        place(pose, ".L", hand);
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", mix(0.42, 0.06, r), 0.2 * (1 - r));
        plantFeet(pose, {});
        clip.frames.push_back(pose);
        clip.morphs["smile"].push_back(glad(t));
        clip.morphs["brows"].push_back(r * 0.8);
        clip.morphs["blink"].push_back(lids(t));
        clip.morphs["open"].push_back(0.22 * r);
    }
    hang(clip, skeleton, false, 0);
    return clip;
}

// A leap with the sword held high.
Clip jump(const Skeleton& skeleton) {
    Clip clip{"jump", 30, {}};
    constexpr int kFrames = 54;
    const Hand high{{-0.200, 1.520, 0.080}, {-1, 0.1, 0.1}, {0.10, 0.60, 0.75}, {-0.06, 0.88, -0.30}};
    const std::vector<HandKey> right{
        {0.0, kOnShoulder},
        {0.12, kOnShoulder},
        {0.42, {{-0.270, 0.960, 0.060}, {-0.6, -0.2, -0.8}, {-0.10, -0.85, 0.50}, {-0.20, 0.40, 0.86}}},
        {0.72, high},
        {1.02, high},
        {1.22, {{-0.250, 1.200, 0.200}, {-0.8, -0.8, -0.2}, {0.10, 0.55, 0.80}, {-0.10, 0.82, -0.40}}},
        {1.62, kOnShoulder},
        {1.8, kOnShoulder}};
    const std::vector<HandKey> left{
        {0.0, kOnScabbard},
        {0.10, kOnScabbard},
        {0.42, {{0.300, 0.930, -0.090}, {0.5, 0.1, -1}, {0.25, -0.85, -0.40}, {-0.10, 0.10, 0.95}}},
        {0.72, {{0.375, 1.230, 0.060}, {0.5, -0.6, -0.7}, {0.75, 0.45, 0.25}, {-0.30, 0.25, 0.90}}},
        {1.02, {{0.375, 1.190, 0.050}, {0.5, -0.6, -0.7}, {0.80, 0.25, 0.25}, {-0.20, 0.25, 0.90}}},
        {1.22, {{0.310, 1.020, 0.120}, {0.7, -0.2, -0.7}, {0.40, -0.50, 0.60}, {-0.45, 0.45, 0.60}}},
        {1.60, kOnScabbard},
        {1.8, kOnScabbard}};
    const Curve lift{{0.60, 0}, {0.85, 0.330}, {1.10, 0}};
    const Curve sink{{0.0, 0},    {0.42, -0.185}, {0.48, -0.185}, {0.62, 0.022}, {0.85, -0.01},
                     {1.08, 0.0}, {1.22, -0.165}, {1.62, 0},      {1.8, 0}};
    const Curve lean{{0.0, 0}, {0.42, 26}, {0.62, -4}, {0.85, -9}, {1.06, 4}, {1.22, 22}, {1.62, 0}, {1.8, 0}};
    const Curve tiptoe{{0.0, 0}, {0.46, 0}, {0.60, 44}, {0.80, 40}, {1.02, 30}, {1.12, 0}, {1.8, 0}};
    const Curve tuck{{0.62, 0}, {0.84, 1}, {1.06, 0}};
    const Curve even{{0.0, 0}, {0.40, 1}, {1.25, 1}, {1.65, 0}, {1.8, 0}};
    const Curve glad{{0.0, 0.3}, {0.45, 0.1}, {0.70, 1}, {1.3, 0.9}, {1.8, 0.3}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double t = frame / 30.0;
        Pose pose = standing(skeleton, 0, 0);
        const double e = even(t);
        pose.move("hips", {0.020 * e, lift(t) + sink(t), -0.10 * std::min(0.0, sink(t)) / -0.185 * 0.55});
        pose.turn("hips", 0.7 * lean(t), -6 * e, -3 * e);
        pose.turn("spine", 0.5 * lean(t), 2 * e, 3.4 * e);
        pose.turn("chest", 0.25 * lean(t), 5 * e, 2 * e);
        pose.turn("neck", -0.5 * lean(t), 0, 0);
        pose.turn("head", -0.5 * lean(t) - 5 * tuck(t), -2 * e, -2 * e);
        pose.turn("clavicle.R", 0, 0, -12 * tuck(t));
        place(pose, ".R", between(right, t));
        place(pose, ".L", between(left, t));
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", mix(0.42, 0.15, tuck(t)), 0.2);
        Feet feet;
        // In the air one knee is drawn up.
        feet.left += Vec3{0, lift(t) + 0.135 * tuck(t), 0.085 * tuck(t)};
        feet.right += Vec3{0, lift(t) + 0.030 * tuck(t), -0.130 * tuck(t)};
        feet.leftHeel = tiptoe(t) * (1 - 0.7 * tuck(t));
        feet.rightHeel = tiptoe(t) + 28 * tuck(t);
        plantFeet(pose, feet);
        clip.frames.push_back(pose);
        clip.morphs["smile"].push_back(glad(t));
        clip.morphs["open"].push_back(0.75 * tuck(t));
        clip.morphs["brows"].push_back(0.8 * tuck(t));
        clip.morphs["blink"].push_back(
            Curve({{0.30, 0}, {0.40, 0.6}, {0.52, 0}, {1.12, 0}, {1.20, 1}, {1.24, 1}, {1.36, 0}})(t));
    }
    hang(clip, skeleton, false, 0);
    return clip;
}

} // namespace

std::vector<Clip> makeClips(const Skeleton& skeleton) {
    std::vector<Clip> clips{idle(skeleton)};
    for (Clip& gait : makeGaits(skeleton)) {
        clips.push_back(std::move(gait));
    }
    clips.push_back(attack(skeleton));
    clips.push_back(waving(skeleton));
    clips.push_back(jump(skeleton));
    return clips;
}

} // namespace supple::creature::wren
