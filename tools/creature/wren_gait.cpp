// Wren walks and runs, on the spot: the ground moves back under the feet at a steady speed.
#include "wren_stance.h"

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

double wave(double phase) {
    return std::sin(kTurn * phase);
}
double swing(double phase) {
    return std::cos(kTurn * phase);
}

struct Gait {
    double stance; // share of the cycle that a foot is on the ground
    double stride; // half of the way it goes back meanwhile
    double lift;   // of the ball in the air
    double peak;   // when, in the air
    double inward; // of the feet from where they stand
    Curve roll;    // of the foot about its ball, positive heel up
};

// Where a foot is at `phase` of its cycle, 0 when it lands.
void step(Pose& pose, const std::string& side, double phase, const Gait& gait) {
    phase -= std::floor(phase);
    const double heel = gait.roll(phase);
    Vec3 shift{side == ".L" ? -gait.inward : gait.inward, 0, 0};
    if (phase < gait.stance) {
        shift.z = gait.stride * (1 - 2 * phase / gait.stance);
    } else {
        const double s = (phase - gait.stance) / (1 - gait.stance);
        // Leaves and meets the ground at the ground's speed, so that the foot does not kick.
        const double ground = -2 * (1 - gait.stance) / gait.stance;
        const double s2 = s * s, s3 = s2 * s;
        shift.z = gait.stride *
                  ((2 * s3 - 3 * s2 + 1) * -1 + (s3 - 2 * s2 + s) * ground + (3 * s2 - 2 * s3) + (s3 - s2) * ground);
        const double arch = std::sin(kPi * std::pow(s, std::log(0.5) / std::log(gait.peak)));
        shift.y += gait.lift * arch * arch;
    }
    const Vec3 ball = (side == ".L" ? kBall : kBall * Vec3{-1, 1, 1}) + shift;
    const double radians = kPi / 180;
    const double out = side == ".L" ? 5 : -5;
    if (heel < 0) {
        // On the heel: the ball is off the ground by as much as the foot is long.
        const double length = kBall.z + 0.085;
        pose.plant(side, ball + Vec3{0, std::sin(-heel * radians) * length - (1 - std::cos(heel * radians)) * 0.035, 0},
                   eulerDegrees(0, out, 0) * eulerDegrees(heel, 0, 0), 0);
        return;
    }
    // The toes stay flat till they leave the ground, then trail; the foot is raised by what they reach down.
    const double toes = 1 - 0.7 * std::clamp((phase - gait.stance) / 0.12, 0.0, 1.0);
    pose.plant(side, ball + Vec3{0, 0.078 * std::sin(heel * (1 - toes) * radians), 0},
               eulerDegrees(0, out, 0) * eulerDegrees(heel, 0, 0), -heel * toes);
}

// Eyes stay with what they look at while the head turns under them: degrees to her left, and down.
void look(Pose& pose, double aside, double down) {
    for (const char* side : {".L", ".R"}) {
        pose.turn(std::string("eye") + side, down, aside, 0);
    }
}

Clip walk(const Skeleton& skeleton) {
    Clip clip{"walk", 30, {}};
    constexpr int kFrames = 32;
    const Gait gait{
        0.60, 0.215, 0.045,
        0.42, 0.034, {{0.0, -22}, {0.09, 0}, {0.34, 0}, {0.60, 44}, {0.69, 50}, {0.83, 14}, {0.94, -20}, {1.0, -22}}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double phase = static_cast<double>(frame % kFrames) / kFrames;
        const double bob = std::cos(2 * kTurn * (phase - 0.31));
        Pose pose(skeleton);
        pose.move("hips", {0.020 * wave(phase - 0.04), -0.030 + 0.013 * bob, 0.004});
        pose.turn("hips", 3, -8 * swing(phase), 3.4 * wave(phase - 0.03));
        pose.turn("spine", 1.5, 4.5 * swing(phase), -2.6 * wave(phase - 0.05));
        pose.turn("chest", 0.8 * bob - 1, 9 * swing(phase - 0.03), -2.2 * wave(phase - 0.06));
        pose.turn("neck", -1 - 0.6 * bob, -3 * swing(phase - 0.04), 1.0 * wave(phase - 0.1));
        pose.turn("head", -1.5 - 1.2 * std::cos(2 * kTurn * (phase - 0.42)), -3 * swing(phase - 0.05),
                  1.6 * wave(phase - 0.02));
        pose.turnPair("clavicle", 0, 0, 1.2 * bob);
        const double back = swing(phase - 0.02), late = swing(phase - 0.07);
        const double ahead = std::max(0.0, -late);
        place(pose, ".L",
              {{0.225 - 0.020 * ahead, 0.818 + 0.045 * ahead, 0.012 - 0.150 * back},
               {0.35, -0.15, -1},
               {-0.04 - 0.15 * ahead, -0.95, 0.22 - 0.25 * late},
               {-0.12, 0.22, 0.95}});
        const double right = std::max(0.0, late);
        place(pose, ".R",
              {{-0.232 + 0.010 * right, 0.826 + 0.035 * right, 0.030 + 0.105 * back},
               {-0.35, -0.15, -1},
               {0.05, -0.97, -0.02 + 0.10 * late},
               {-0.16, -0.16 + 0.10 * late, 0.96}});
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", 0.36 + 0.06 * late, 0.3);
        step(pose, ".L", phase, gait);
        step(pose, ".R", phase + 0.5, gait);
        drape(pose);
        pose.turn("scabbard", -3 * bob + 5 * swing(phase - 0.1), 0, 2 * wave(phase - 0.1));
        clip.frames.push_back(pose);
        look(pose, 3 * swing(phase - 0.04), 1.2 * std::cos(2 * kTurn * (phase - 0.42)));
        clip.morphs["smile"].push_back(0.26 + 0.07 * wave(phase + 0.1));
        clip.morphs["open"].push_back(0.05 + 0.04 * wave(phase - 0.2));
        clip.morphs["brows"].push_back(0.14 + 0.12 * wave(phase + 0.35));
        clip.morphs["blink"].push_back(0.05 + 0.95 * Curve({{0.55, 0}, {0.62, 1}, {0.66, 1}, {0.76, 0}})(phase));
    }
    hang(clip, skeleton, true, 0.0012);
    return clip;
}

Clip run(const Skeleton& skeleton) {
    Clip clip{"run", 30, {}};
    constexpr int kFrames = 20;
    const Gait gait{0.36,  0.235,
                    0.165, 0.40,
                    0.032, {{0.0, -6}, {0.05, 0}, {0.14, 0}, {0.36, 50}, {0.52, 76}, {0.70, 48}, {0.90, 0}, {1.0, -6}}};
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double phase = static_cast<double>(frame % kFrames) / kFrames;
        const double bob = -std::cos(2 * kTurn * (phase - 0.16));
        Pose pose(skeleton);
        pose.move("hips", {0.010 * wave(phase - 0.02), -0.038 + 0.030 * bob, 0.02});
        pose.turn("hips", 10, -11 * swing(phase), 3.0 * wave(phase - 0.02));
        pose.turn("spine", 5, 7 * swing(phase), -2 * wave(phase - 0.04));
        pose.turn("chest", 3 + 1.5 * bob, 14 * swing(phase - 0.02), -2 * wave(phase - 0.05));
        pose.turn("neck", -7, -5 * swing(phase - 0.03), 0);
        pose.turn("head", -8 + 1.5 * std::cos(2 * kTurn * (phase - 0.30)), -5 * swing(phase - 0.04), 1.5 * wave(phase));
        const double back = swing(phase - 0.01);
        const auto arm = [&](double side, double b) {
            const double a = std::max(0.0, -b), r = std::max(0.0, b);
            return Hand{{side * (0.215 - 0.055 * a + 0.015 * r), 0.985 + 0.090 * a + 0.000 * r, 0.075 - 0.165 * b},
                        {side * 0.45, -0.35 + 0.2 * r, -1},
                        {side * (-0.10 - 0.30 * a), -0.25 + 0.75 * a - 0.25 * r, 0.80 - 0.1 * a - 0.2 * r},
                        {side * (-0.22), 0.86 - 0.1 * a + 0.1 * r, 0.35 - 0.2 * a + 0.2 * r}};
        };
        place(pose, ".L", arm(1, back));
        Hand right = arm(-1, -back);
        right.thumb = mix(right.thumb, Vec3{-0.35, 0.75, 0.62}, 0.8);
        right.wrist.x -= 0.045; // past the pouch
        place(pose, ".R", right);
        curl(pose, ".R", 1, 1);
        curl(pose, ".L", 0.75, 0.7);
        step(pose, ".L", phase, gait);
        step(pose, ".R", phase + 0.5, gait);
        drape(pose);
        pose.turn("scabbard", -6 * bob + 9 * swing(phase - 0.1), 0, 3 * wave(phase - 0.1));
        clip.frames.push_back(pose);
        look(pose, 5 * swing(phase - 0.04), -1.5 * std::cos(2 * kTurn * (phase - 0.30)));
        // A breath a cycle. Feet that land are felt in lids and brow.
        const double landing = std::pow(0.5 - 0.5 * bob, 2);
        clip.morphs["open"].push_back(0.26 + 0.17 * wave(phase - 0.1));
        clip.morphs["frown"].push_back(0.28 + 0.22 * landing);
        clip.morphs["smile"].push_back(0.10 * (1 - landing));
        clip.morphs["blink"].push_back(
            std::max(0.06 + 0.16 * landing, Curve({{0.50, 0}, {0.59, 1}, {0.64, 1}, {0.76, 0}})(phase)));
    }
    hang(clip, skeleton, true, 0.0055);
    return clip;
}

} // namespace

std::vector<Clip> makeGaits(const Skeleton& skeleton) {
    return {walk(skeleton), run(skeleton)};
}

} // namespace supple::creature::wren
