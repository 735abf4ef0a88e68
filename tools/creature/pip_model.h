// The character: Pip, a small dragon. Half the body is modelled (x >= 0), then mirrored.
#pragma once

#include "modeller.h"

namespace supple::creature {

// Where things are in the rest pose, on the character's left (+x); the modeller and the skeleton share them.
namespace landmark {
constexpr Vec3 kHips{0, 0.50, -0.02};
constexpr Vec3 kSpine{0, 0.60, -0.03};
constexpr Vec3 kChest{0, 0.72, -0.04};
constexpr Vec3 kNeck{0, 0.87, -0.02};
constexpr Vec3 kHead{0, 0.97, 0.0};
constexpr Vec3 kJaw{0, 1.05, 0.10};
constexpr Vec3 kShoulder{0.165, 0.805, 0.0};
constexpr Vec3 kElbow{0.285, 0.685, 0.0};
constexpr Vec3 kWrist{0.395, 0.575, 0.035};
constexpr Vec3 kKnuckles{0.455, 0.505, 0.065};
constexpr Vec3 kThigh{0.155, 0.44, 0.0};
constexpr Vec3 kKnee{0.185, 0.265, 0.035};
constexpr Vec3 kAnkle{0.195, 0.10, -0.015};
constexpr Vec3 kBall{0.215, 0.045, 0.12};
constexpr Vec3 kEye{0.172, 1.305, 0.225};
constexpr double kEyeRadius = 0.132;
constexpr Vec3 kEyeOut{0.30, 0.02, 0.95}; // where the socket faces; not unit length
constexpr Vec3 kEar{0.345, 1.33, -0.06};
constexpr Vec3 kEarMiddle{0.445, 1.37, -0.10};
constexpr Vec3 kEarTip{0.58, 1.42, -0.16};
constexpr Vec3 kWing{0.10, 0.83, -0.16};
constexpr Vec3 kWingMiddle{0.26, 0.92, -0.28};
constexpr Vec3 kWingTip{0.42, 0.98, -0.38};
constexpr Vec3 kTail[] = {{0, 0.47, -0.16},  {0, 0.385, -0.33}, {0, 0.275, -0.49}, {0, 0.20, -0.655},
                          {0, 0.195, -0.82}, {0, 0.27, -0.965}, {0, 0.39, -1.045}, {0, 0.56, -1.05}};
constexpr int kTailJoints = 7;
} // namespace landmark

// The line of one finger on the left hand, from its knuckle to its tip.
struct FingerLine {
    const char* name;
    Part part;
    Vec3 from;
    Vec3 to;
};
std::array<FingerLine, 4> fingerLines();

enum class Variant {
    mixed, // triangles, quads and pentagons, polar tips, creases, open eyes
    quads
};

Cage modelPip(Variant variant);

// Eyes, teeth, horns, claws: shells beside the body. The first is called on the half model.
void addPairedDetails(Cage& cage, Variant variant);
void addMiddleDetails(Cage& cage, Variant variant);

} // namespace supple::creature
