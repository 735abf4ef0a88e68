#include "tests/support/rig_bends.h"

#include <cstdio>
#include <gtest/gtest.h>

namespace supple::test {

namespace {

using About = Turn::About;
const glm::dvec3 kUp(0, 1, 0);

const RigBend kRigs[] = {
    {"mh_female1605",
     "elbow 120",
     {"lowerarm_l", 120, About::hinge, {}, .05},
     {42, {.13, 1.01}, 2},
     {53, {.13, 1.08}, 2},
     {36, {.26, 1.09}, 4},
     {37, {.38, 1.01}, 0},
     {35, {.44, 1.01}, 0}},
    {"mh_female1605",
     "shoulder 120",
     {"upperarm_l", 120, About::given, kUp, .07},
     {44, {.45, 1.02}, 6},
     {86, {.53, 1.37}, 4},
     {64, {.46, 1.17}, 7},
     {37, {.29, 1.30}, 5},
     {32, {.23, 1.29}, 4}},
    {"mh_female1605",
     "knee 120",
     {"calf_l", 120, About::hinge, {}, .07},
     {41, {.26, 1.00}, 5},
     {62, {.29, 1.32}, 5},
     {46, {.26, 1.23}, 7},
     {24, {.53, 1.17}, 3},
     {24, {.64, 1.28}, 2}},
    {"mh_female1605",
     "wrist twist 180",
     {"hand_l", 179.99, About::bone, {}, .05},
     {85, {.18, 1.00}, 1},
     {94, {1.0, 1.00}, 1},
     {94, {.84, 1.03}, 1},
     {67, {.75, 1.29}, 8},
     {74, {.54, 1.00}, 0}},
    {"mh_female1605",
     "upper arm twist 180",
     {"upperarm_l", 179.99, About::bone, {}, .07},
     {30, {.18, .91}, 11},
     {53, {.49, 1.04}, 7},
     {38, {.44, 1.08}, 10},
     {54, {.51, .95}, 5},
     {38, {.33, .95}, 11}},
    {"mh_body_13k_infl8",
     "elbow 120",
     {"lowerarm01.L", 120, About::hinge, {}, .05},
     {67, {.33, 1.01}, 35},
     {74, {.31, 1.16}, 49},
     {72, {.44, 1.08}, 56},
     {49, {.31, 1.02}, 38},
     {46, {.32, 1.02}, 44}},
    {"mh_body_13k_infl8",
     "shoulder 120",
     {"upperarm01.L", 120, About::given, kUp, .07},
     {63, {.35, 1.28}, 32},
     {99, {.57, 1.64}, 33},
     {69, {.58, 1.37}, 50},
     {56, {.40, 1.10}, 36},
     {55, {.42, 1.07}, 33}},
    {"mh_body_13k_infl8",
     "knee 120",
     {"lowerleg01.L", 120, About::hinge, {}, .07},
     {75, {.39, 1.01}, 18},
     {92, {.42, 1.20}, 15},
     {90, {.43, 1.16}, 25},
     {57, {.36, 1.00}, 27},
     {55, {.43, 1.00}, 14}},
    {"mh_body_13k_infl8",
     "wrist twist 180",
     {"wrist.L", 179.99, About::bone, {}, .05},
     {78, {.14, 1.00}, 30},
     {96, {.97, 1.02}, 10},
     {97, {.86, 1.08}, 13},
     {67, {.18, 1.00}, 19},
     {68, {.20, 1.00}, 9}},
    {"mh_body_13k_infl8",
     "upper arm twist 180",
     {"upperarm01.L", 179.99, About::bone, {}, .07},
     {46, {.13, 1.00}, 53},
     {91, {.50, 1.09}, 40},
     {61, {.58, 1.30}, 67},
     {40, {.12, .96}, 55},
     {37, {.14, .96}, 55}},
    {"man_casual_quads",
     "elbow 120",
     {"LowerArm.L", 120, About::hinge, {}, .06},
     {54, {.30, 1.08}, 0},
     {84, {.32, 1.41}, 0},
     {70, {.36, 1.23}, 9},
     {44, {.52, 1.01}, 1},
     {44, {.41, 1.02}, 0}},
    {"man_casual_quads",
     "shoulder 120",
     {"UpperArm.L", 120, About::given, kUp, .08},
     {63, {.35, 1.00}, 23},
     {91, {.41, 1.15}, 16},
     {87, {.44, 1.17}, 29},
     {52, {.32, 1.00}, 19},
     {50, {.28, 1.00}, 23}},
    {"man_casual_quads",
     "knee 120",
     {"LowerLeg.L", 120, About::hinge, {}, .08},
     {49, {.27, 1.05}, 20},
     {55, {.25, 1.46}, 18},
     {57, {.27, 1.49}, 21},
     {41, {.32, 1.08}, 13},
     {39, {.38, 1.06}, 6}},
    {"man_casual_quads",
     "wrist twist 180",
     {"Palm.L", 179.99, About::bone, {}, .06},
     {80, {.18, 1.00}, 13},
     {107, {.42, 1.28}, 6},
     {97, {.40, 1.29}, 19},
     {56, {.31, 1.05}, 27},
     {46, {.36, 1.66}, 47}},
    {"man_casual_quads",
     "upper arm twist 180",
     {"UpperArm.L", 179.99, About::bone, {}, .08},
     {41, {.10, 1.00}, 52},
     {97, {.62, 1.02}, 30},
     {81, {.73, 1.14}, 36},
     {30, {.16, .96}, 52},
     {28, {.18, .95}, 48}},
    {"horse",
     "knee 120",
     {"FrontLowLeg.L", 120, About::hinge, {}, .08},
     {33, {.42, 1.04}, 4},
     {38, {.43, 1.17}, 2},
     {38, {.49, 1.32}, 5},
     {38, {.54, 1.28}, 3},
     {33, {.61, 1.21}, 2}},
    {"horse",
     "neck twist 180",
     {"Neck", 179.99, About::bone, {}, .14},
     {8, {.04, .91}, 10},
     {106, {.98, 1.01}, 3},
     {99, {.86, 1.03}, 4},
     {13, {.10, .81}, 23},
     {18, {.18, .87}, 8}},
};

} // namespace

std::span<const RigBend> rigBends() {
    return kRigs;
}

LimbMeasure measured(const Bend& bend, std::span<const glm::dvec3> skinned) {
    return {100.0 * bend.volume(skinned), bend.thickness(skinned), bend.turnedOver(skinned)};
}

void expectMeasure(const RigBend& bend, const LimbMeasure& own, const LimbMeasure& wanted,
                   const LimbTolerance& tolerance) {
    std::printf("  %3.0f (%.2f %.2f) %u", own.volume, own.thickness[0], own.thickness[1], own.turnedOver);
    EXPECT_NEAR(own.volume, wanted.volume, tolerance.volume) << bend.file << ", " << bend.name;
    EXPECT_NEAR(own.thickness[0], wanted.thickness[0], tolerance.thickness) << bend.file << ", " << bend.name;
    EXPECT_NEAR(own.thickness[1], wanted.thickness[1], tolerance.thickness) << bend.file << ", " << bend.name;
    EXPECT_NEAR(own.turnedOver, wanted.turnedOver, tolerance.turnedOver) << bend.file << ", " << bend.name;
}

} // namespace supple::test
