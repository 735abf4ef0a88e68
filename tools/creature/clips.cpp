#include "clips.h"

#include "pip_model.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

namespace {

using namespace landmark;

constexpr double kTurn = 2 * kPi;

double wave(double phase) {
    return std::sin(kTurn * phase);
}

// Where the ball of the left foot rests when standing.
const Vec3 kStand{kBall.x, kBall.y, kBall.z};

Vec3 onSide(const Vec3& p, const std::string& side) {
    return side == ".L" ? p : Vec3{-p.x, p.y, p.z};
}

// Foot on the ground under the body, rolled by `pitch` about its ball (positive: heel up).
void stand(Pose& pose, const std::string& side, const Vec3& shift, double pitch, double yaw) {
    const double mirrored = side == ".L" ? yaw : -yaw;
    pose.plant(side, onSide(kStand, side) + shift, eulerDegrees(0, mirrored, 0) * eulerDegrees(pitch, 0, 0), -pitch);
}

// How Pip carries itself between actions: arms in from the modelling pose, fingers curled, wings half folded.
void carry(Pose& pose, double wingFold, double armsIn) {
    pose.turnPair("upperArm", 0, 0, -26 * armsIn);
    pose.turnPair("upperArm", -8 * armsIn, 0, 0);
    pose.turnPair("foreArm", -46 * armsIn, -12 * armsIn, 0);
    for (const char* finger : {"index", "middle", "pinky"}) {
        pose.turnPair(std::string(finger) + "A", 0, 0, -14 * armsIn);
        pose.turnPair(std::string(finger) + "B", 0, 0, -22 * armsIn);
    }
    pose.turnPair("thumbB", 0, -18 * armsIn, 0);
    pose.turnPair("wing", 0, 38 * wingFold, 14 * wingFold);
    pose.turnPair("wingMiddle", 0, 22 * wingFold, 0);
    pose.turnPair("wingTip", 0, 16 * wingFold, 0);
    pose.turn("jaw", -4, 0, 0);
}

void curlTail(Pose& pose, double pitch, double yaw, double phase, double lag, double swing) {
    for (int i = 1; i <= kTailJoints; ++i) {
        const double whip = 0.55 + 0.18 * i;
        pose.turn("tail" + std::to_string(i), pitch * whip, yaw + swing * whip * wave(phase - lag * i), 0);
    }
}

void blink(Pose& pose, double closed) {
    pose.turnPair("upperLid", 84 * closed, 0, 0);
    pose.turnPair("lowerLid", -30 * closed, 0, 0);
    for (const char* side : {".L", ".R"}) {
        // The eyeball makes room for the lids.
        const Vec3 out = glm::normalize(onSide(kEyeOut, side));
        pose.move(std::string("eye") + side, out * (-0.25 * kEyeRadius * closed));
        pose.move(std::string("upperLid") + side, out * (0.10 * kEyeRadius * closed));
    }
}

// Eyes narrowed from below, as a broad smile does.
void beam(Pose& pose, double amount) {
    pose.turnPair("lowerLid", -26 * amount, 0, 0);
    for (const char* side : {".L", ".R"}) {
        pose.move(std::string("eye") + side, glm::normalize(onSide(kEyeOut, side)) * (-0.06 * kEyeRadius * amount));
    }
}

Clip idle(const Skeleton& skeleton) {
    Clip clip{"idle", 30, {}};
    const int frames = 90;
    const Curve lids{{0.0, 0.16}, {1.00, 0.16}, {1.07, 1}, {1.12, 1}, {1.24, 0.16}, {3.0, 0.16}};
    const Curve look{{0.0, 0}, {0.5, 0}, {0.95, 1}, {1.75, 1}, {2.25, 0}, {3.0, 0}};
    const Curve twitch{{0.0, 0}, {1.75, 0}, {1.83, 1}, {1.93, -0.35}, {2.03, 0.5}, {2.18, 0}, {3.0, 0}};
    for (int frame = 0; frame <= frames; ++frame) {
        const double t = 3.0 * (frame % frames) / frames;
        const double phase = t / 3.0;
        const double breath = wave(phase * 2 - 0.1);
        Pose pose(skeleton);
        carry(pose, 0.15, 1.0);
        pose.move("hips", {0.014 * wave(phase), -0.030 + 0.005 * breath, -0.01});
        pose.turn("hips", 4, 0, 1.6 * wave(phase));
        pose.turn("spine", -3 - 1.2 * breath, 0, -1.6 * wave(phase));
        pose.turn("chest", -1.5 * breath, -2 * look(t), -0.8 * wave(phase));
        pose.move("chest", {0, 0.004 * breath, 0.004 * breath});
        pose.turnPair("clavicle", 0, 0, 2.5 * breath);
        pose.turnPair("upperArm", 1.5 * breath, 0, 1.5 * breath);
        pose.turn("neck", 1.2 * breath, 5 * look(t), 0);
        pose.turn("head", 1.0 * breath - 2, 9 * look(t) + 2 * wave(phase), 5 * look(t) + 1.2 * wave(phase + 0.2));
        pose.turnPair("eye", 0, 0, 0);
        pose.turn("eye.L", -2, 10 * look(t), 0);
        pose.turn("eye.R", -2, 10 * look(t), 0);
        blink(pose, lids(t));
        pose.turnPair("ear", 0, 3 * wave(phase * 2 - 0.2), 3 * wave(phase * 2 - 0.3));
        pose.turn("ear.L", 0, 0, 20 * twitch(t));
        pose.turn("earTip.L", 0, 0, 16 * twitch(t - 0.04));
        pose.turnPair("wing", 0, 2.5 * wave(phase * 2 - 0.15), 2 * breath);
        pose.turnPair("wingTip", 0, 3 * wave(phase * 2 - 0.3), 0);
        curlTail(pose, 0, 0, phase, 0.09, 7);
        stand(pose, ".L", {0.015, 0, -0.01}, 0, 14);
        stand(pose, ".R", {-0.015, 0, 0.01}, 0, 14);
        clip.frames.push_back(pose);
    }
    return clip;
}

// One foot of the walk: on the ground for `kStance` of the cycle, moving back at a steady speed, then swung forward.
void step(Pose& pose, const std::string& side, double phase, double stride) {
    constexpr double kStance = 0.56;
    phase -= std::floor(phase);
    const Curve roll{{0.0, -16}, {0.08, 0}, {0.36, 0}, {0.56, 38}, {0.66, 46}, {0.80, 12}, {0.92, -14}, {1.0, -16}};
    const double pitch = roll(phase);
    Vec3 shift{-0.035, 0, 0};
    if (side == ".R") {
        shift.x = -shift.x;
    }
    if (phase < kStance) {
        shift.z = stride * (1 - 2 * phase / kStance);
    } else {
        const double s = (phase - kStance) / (1 - kStance);
        // Leaves and meets the ground at the ground's speed, so that the foot does not kick.
        const double ground = -2 * (1 - kStance) / kStance;
        const double s2 = s * s;
        const double s3 = s2 * s;
        shift.z =
            stride * ((2 * s3 - 3 * s2 + 1) * -1 + (s3 - 2 * s2 + s) * ground + (3 * s2 - 2 * s3) + (s3 - s2) * ground);
        const double arch = std::sin(kPi * s);
        shift.y = 0.068 * arch * arch;
    }
    if (pitch < 0) {
        // On the heel: the ball is off the ground by as much as the foot is long.
        shift.y += std::sin(-pitch * kPi / 180) * 0.175;
        pose.plant(side, onSide(kStand, side) + shift, eulerDegrees(pitch, 0, 0), 0);
    } else {
        // The toes stay flat till they leave the ground, then trail; the foot is raised by what they reach down.
        const double toes = 1 - 0.55 * std::clamp((phase - kStance) / 0.12, 0.0, 1.0);
        shift.y += 0.15 * std::sin(pitch * (1 - toes) * kPi / 180);
        pose.plant(side, onSide(kStand, side) + shift, eulerDegrees(pitch, 0, 0), -pitch * toes);
    }
}

Clip walk(const Skeleton& skeleton) {
    Clip clip{"walk", 30, {}};
    const int perCycle = 33;
    const int cycles = 2;
    for (int frame = 0; frame <= perCycle * cycles; ++frame) {
        const int at = frame % (perCycle * cycles);
        const double phase = static_cast<double>(at % perCycle) / perCycle;
        const double both = static_cast<double>(at) / (perCycle * cycles);
        const double bob = std::cos(2 * kTurn * (phase - 0.37));
        Pose pose(skeleton);
        carry(pose, 0.6, 0.9);
        pose.move("hips", {0.031 * wave(phase - 0.02), -0.042 + 0.017 * bob, 0});
        pose.turn("hips", 4, -9 * std::cos(kTurn * phase), 4.0 * wave(phase - 0.04));
        pose.turn("spine", 2, 5 * std::cos(kTurn * phase), -3.0 * wave(phase - 0.06));
        pose.turn("chest", 1.0 + 1.5 * bob, 11 * std::cos(kTurn * (phase - 0.03)), -3.5 * wave(phase - 0.08));
        pose.turn("neck", -3 - 1.2 * bob, -4 * std::cos(kTurn * (phase - 0.04)), 1.5 * wave(phase - 0.1));
        pose.turn("head", -4 - 2.2 * std::cos(2 * kTurn * (phase - 0.47)), -3.5 * std::cos(kTurn * (phase - 0.05)),
                  2.5 * wave(phase + 0.05) + 2.5 * wave(both));
        for (const double side : {1.0, -1.0}) {
            const std::string suffix = side > 0 ? ".L" : ".R";
            const double swing = std::cos(kTurn * (phase - 0.02)) * side;
            const double late = std::cos(kTurn * (phase - 0.10)) * side;
            pose.turn("upperArm" + suffix, 22 * swing, 0, 3 * side * bob);
            pose.turn("foreArm" + suffix, -10 + 16 * late, 0, 0);
            pose.turn("hand" + suffix, 8 * std::cos(kTurn * (phase - 0.16)) * side, 0, 0);
            pose.turn("ear" + suffix, 0, 0, side * (6 * std::cos(2 * kTurn * (phase - 0.50))));
            pose.turn("earTip" + suffix, 0, 0, side * (9 * std::cos(2 * kTurn * (phase - 0.57))));
            pose.turn("wing" + suffix, 0, side * 3 * bob, side * 5 * std::cos(2 * kTurn * (phase - 0.46)));
            pose.turn("wingTip" + suffix, 0, 0, side * 6 * std::cos(2 * kTurn * (phase - 0.54)));
        }
        blink(pose, 0.06 + 0.94 * Curve({{0.60, 0}, {0.635, 1}, {0.66, 1}, {0.71, 0}})(both));
        pose.turn("jaw", 5 + 1.5 * bob, 0, 0);
        curlTail(pose, -2, 0, phase + 0.30, 0.10, 9);
        for (int i = 1; i <= kTailJoints; ++i) {
            pose.turn("tail" + std::to_string(i), 1.6 * std::cos(2 * kTurn * (phase - 0.40 - 0.05 * i)), 0, 0);
        }
        step(pose, ".L", phase, 0.125);
        step(pose, ".R", phase + 0.5, 0.125);
        clip.frames.push_back(pose);
    }
    return clip;
}

// A happy leap with a full turn in the air, wings wide, and a landing that shouts.
Clip joy(const Skeleton& skeleton, const Pose& rest) {
    Clip clip{"joy", 30, {}};
    const int frames = 90;
    // The leap itself, and how far the hips sink or stretch over the feet.
    const Curve lift{{0.82, 0.0}, {1.19, 0.33}, {1.54, 0.0}};
    const Curve sink{{0.0, -0.03}, {0.25, -0.015}, {0.62, -0.15}, {0.70, -0.15},  {0.84, 0.02},
                     {1.0, 0.0},   {1.4, -0.01},   {1.54, -0.02}, {1.69, -0.145}, {1.98, 0.0},
                     {2.2, -0.02}, {2.45, -0.005}, {3.0, -0.03}};
    const Curve tiptoe{{0.72, 0}, {0.84, 1},   {1.0, 0.8},  {1.3, 0.3}, {1.5, 0.5}, {1.58, 0},
                       {1.80, 0}, {1.98, 0.6}, {2.14, 0.0}, {2.3, 0.5}, {2.46, 0.0}};
    const Curve spin{{0.0, 0}, {0.30, 0}, {0.64, -38}, {0.76, -20}, {1.52, 360}, {1.66, 372}, {1.95, 360}, {3.0, 360}};
    const Curve feetSpin{{0.0, 0}, {0.80, 0}, {1.50, 360}, {3.0, 360}};
    const Curve crouch{{0.0, 0},     {0.25, -0.15}, {0.62, 1},   {0.72, 1}, {0.86, -0.3},
                       {1.50, -0.1}, {1.70, 0.9},   {2.0, -0.3}, {2.25, 0}, {3.0, 0}};
    const Curve arms{{0.0, 0},     {0.3, 0.0},  {0.62, -0.45}, {0.90, 1}, {1.45, 0.9},
                     {1.70, 0.55}, {1.98, 1.1}, {2.45, 1.0},   {2.95, 0}, {3.0, 0}};
    const Curve spread{{0.0, 0.15}, {0.3, 0.4},    {0.64, 1.1},  {0.86, -0.5}, {1.5, -0.4},
                       {1.7, 0.2},  {1.95, -0.75}, {2.45, -0.6}, {3.0, 0.15}};
    const Curve flap{{0.0, 0},    {0.64, 10}, {0.84, 34}, {1.0, -30}, {1.16, 30}, {1.32, -26}, {1.5, 24},
                     {1.72, -18}, {1.95, 22}, {2.1, -8},  {2.25, 16}, {2.4, -6},  {2.6, 6},    {2.88, 0}};
    const Curve mouth{{0.0, 0},     {0.6, 0},    {0.88, 1},   {1.45, 0.8}, {1.70, 0.25},
                      {1.95, 1.15}, {2.40, 1.0}, {2.70, 0.2}, {3.0, 0}};
    const Curve squint{{0.0, 0.16}, {0.45, 0.16}, {0.62, 0.6},  {0.82, 0.0}, {1.56, 0},
                       {1.70, 0.9}, {1.95, 0.05}, {2.45, 0.05}, {2.8, 0.16}, {3.0, 0.16}};
    const Curve glee{{0.75, 0}, {1.0, 0.5}, {1.5, 0.4}, {1.70, 0.0}, {1.98, 1}, {2.45, 1}, {2.8, 0}};
    const Curve nod{{0.0, -2},  {0.3, -4},   {0.64, 16}, {0.90, -20}, {1.3, -8}, {1.56, 6},
                    {1.70, 16}, {1.98, -12}, {2.45, -8}, {2.8, -2},   {3.0, -2}};
    const Curve tilt{{0.0, 0}, {1.7, 0}, {2.0, 9}, {2.2, -7}, {2.40, 6}, {2.6, 0}, {3.0, 0}};
    // Out of the standing pose and back into it.
    const Curve own{{0.0, 0}, {0.3, 1}, {2.6, 1}, {3.0, 0}};
    const Curve tuck{{0.84, 0}, {1.15, 1}, {1.5, 0}};
    for (int frame = 0; frame <= frames; ++frame) {
        const double t = 3.0 * frame / frames;
        Pose pose(skeleton);
        carry(pose, spread(t), 1.0 - std::clamp(arms(t), 0.0, 1.0));
        const double c = crouch(t);
        pose.turn("root", 0, feetSpin(t), 0);
        pose.move("hips", {0.03 * tilt(t) / 9, lift(t) + sink(t), -0.02 * c});
        pose.turn("hips", 14 * c, spin(t) - feetSpin(t), -0.5 * tilt(t));
        pose.turn("spine", 9 * c, 0, 0.4 * tilt(t));
        pose.turn("chest", 7 * c - 5 * std::max(0.0, arms(t)), 0, 0.5 * tilt(t));
        pose.turn("neck", nod(t) * 0.3 - 6 * c, 0, 0);
        pose.turn("head", nod(t) * 0.8 - 6 * c, 0, tilt(t));
        const double a = arms(t);
        pose.turnPair("clavicle", 0, 0, 14 * a);
        pose.turnPair("upperArm", 30 * std::min(0.0, a) * -1.0, -14 * a, 56 * std::max(0.0, a));
        pose.turnPair("foreArm", 0, -8 * a, 14 * std::max(0.0, a));
        pose.turnPair("hand", 0, 0, 10 * std::sin(kTurn * 2.2 * t) * std::clamp(a, 0.0, 1.0));
        for (const char* finger : {"index", "pinky"}) {
            const double way = finger[0] == 'i' ? -1 : 1;
            pose.turnPair(std::string(finger) + "A", 0, 10 * way * std::max(0.0, a), 0);
        }
        pose.turnPair("wing", 0, 0, flap(t));
        pose.turnPair("wingMiddle", 0, 0, 0.7 * flap(t - 0.04));
        pose.turnPair("wingTip", 0, 0, 0.7 * flap(t - 0.09));
        pose.turnPair("ear", 0, -12 * c, 18 * nod(t - 0.05) / 20);
        pose.turnPair("earTip", 0, -8 * c, 20 * nod(t - 0.12) / 20);
        pose.turn("jaw", 27 * mouth(t), 0, 0);
        pose.turn("tongue", -5 * mouth(t), 0, 0);
        blink(pose, squint(t));
        beam(pose, glee(t));
        for (int i = 1; i <= kTailJoints; ++i) {
            const double late = t - 0.045 * i;
            const double drag = (spin(late) - spin(t)) * 0.045;
            pose.turn("tail" + std::to_string(i), -7 * crouch(late) + 5 * lift(late),
                      std::clamp(drag, -16.0, 16.0) + 6 * tilt(late) / 9 + 7 * wave(t / 3.0 - 0.09 * i), 0);
        }
        const double up = lift(t);
        for (const char* side : {".L", ".R"}) {
            const double k = tuck(t) * (side[1] == 'L' ? 1.0 : 0.6);
            const double outward = side[1] == 'L' ? 1 : -1;
            const Vec3 shift{outward * (0.02 + 0.05 * tuck(t)), up + 0.06 * k, (side[1] == 'L' ? 0.05 : -0.09) * k};
            // The feet are placed in the turning frame of the root.
            stand(pose, side, shift, 40 * k + 34 * tiptoe(t), 12);
        }
        clip.frames.push_back(between(rest, pose, own(t)));
    }
    return clip;
}

} // namespace

std::vector<Clip> makeClips(const Skeleton& skeleton) {
    const Clip standing = idle(skeleton);
    return {standing, walk(skeleton), joy(skeleton, standing.frames.front())};
}

} // namespace supple::creature
