// The second character: Wren, a wandering guard. Each piece is modelled as one cage; pieces become the file's parts.
#pragma once

#include "skeleton.h"
#include "solids.h"
#include "weights.h"

#include <string>
#include <vector>

namespace supple::creature {

// Where things are in the rest pose, on the character's left (+x); modellers and skeleton share them.
namespace wren {
constexpr Vec3 kHips{0, 0.86, -0.005};
constexpr Vec3 kSpine{0, 0.965, -0.005};
constexpr Vec3 kChest{0, 1.085, -0.012};
constexpr Vec3 kNeck{0, 1.262, -0.020};
constexpr Vec3 kHead{0, 1.345, -0.012};
constexpr Vec3 kShoulder{0.142, 1.205, -0.018};
constexpr Vec3 kElbow{0.3085, 1.037, -0.026};
constexpr Vec3 kWrist{0.458, 0.885, -0.010};
constexpr Vec3 kKnuckles{0.519, 0.823, -0.004};
constexpr Vec3 kThigh{0.084, 0.835, 0.0};
constexpr Vec3 kKnee{0.097, 0.468, 0.012};
constexpr Vec3 kAnkle{0.106, 0.095, -0.022};
constexpr Vec3 kBall{0.114, 0.035, 0.085};
constexpr Vec3 kEye{0.0525, 1.4660, 0.0550};
constexpr double kEyeRadius = 0.0415;
constexpr Vec3 kEyeOut{0.10, 0.0, 1.0}; // where the eye's opening faces; not unit length
constexpr double kMouthLine = 1.3865;
constexpr Vec3 kTail[] = {{0, 1.628, -0.155}, {0, 1.560, -0.240}, {0, 1.450, -0.278}, {0, 1.330, -0.272}};
constexpr int kTailJoints = 3;
constexpr Vec3 kScabbard{0.152, 0.925, -0.02};
constexpr Vec3 kScarfTail[] = {
    {-0.062, 1.262, -0.096}, {-0.080, 1.120, -0.158}, {-0.092, 0.985, -0.170}, {-0.098, 0.860, -0.162}};
constexpr int kScarfJoints = 3;
// The pouches at the belt, on her right side: where they hang, and their lower ends.
struct Pouch {
    const char* name;
    Vec3 top, bottom;
};
constexpr Pouch kPouches[] = {{"pouchFront", {-0.093, 0.955, 0.082}, {-0.103, 0.885, 0.098}},
                              {"pouchBack", {-0.078, 0.955, -0.096}, {-0.084, 0.890, -0.116}}};

// The head is modelled at one size and worn at another.
Vec3 grown(const Vec3& p);
void grow(Cage& cage);

// How far the face is on the way to each of its shapes, 0 to 1.
struct FaceShape {
    double blink = 0;
    double smile = 0;
    double open = 0;
    double round = 0;
    double brows = 0;
    double frown = 0;
};

// The line of one finger on the left hand, from its knuckle to its tip.
struct Finger {
    const char* name;
    Vec3 from;
    Vec3 to;
    double radius;
};
std::array<Finger, 5> fingers();
// Hands, too, are modelled at one size and worn at another.
Vec3 handGrown(const Vec3& p);
// Where the left hand holds; the sword is in the right one.
Vec3 grip();

Cage modelHead(const FaceShape& shape);
Cage modelEyes(double blink);
Cage modelHair();
Cage modelHands();
Cage modelJacket();
Cage modelTrousers();
Cage modelBoots();
Cage modelGear(const Cage& jacket);
Cage modelScarf();
Cage modelSword();

// `springs`: as Skeleton has it. The scarf then has twice as many joints, and pouches have some of their own.
Skeleton makeSkeleton(bool springs);
// By place and part alone, so that layers of clothes move as one.
std::vector<Influences> weightsOf(const Cage& cage, const Skeleton& skeleton);
} // namespace wren

} // namespace supple::creature
