// The body as a chain: which joints a fall moves, and how they hang together. Names are those of wren.glb.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace play {

/// Points of the body. The first kMoved of them are joints that a fall hands over to Supple, parents first; the others
/// only say where a limb ends.
enum Point : uint8_t {
    kHips,
    kSpine,
    kChest,
    kNeck,
    kHead,
    kTail,
    kUpperArmL,
    kUpperArmR,
    kForeArmL,
    kForeArmR,
    kThighL,
    kThighR,
    kShinL,
    kShinR,
    kFootL,
    kFootR,
    kKnucklesL,
    kKnucklesR,
    kToesL,
    kToesR,
    kTailTip,
    kCrown,
    kPoints
};
inline constexpr uint32_t kMoved = kKnucklesL;
inline constexpr uint32_t kJoints = kCrown; ///< all but the crown are joints of the file

struct BodyPoint {
    const char* joint; ///< its name in the file; the crown has none
    Point parent;      ///< the hips have themselves
    float radius;      ///< how near it comes to the ground
    float mass;
    float push; ///< the part of a blow that it takes: a blow comes from above the hips
};
inline constexpr std::array<BodyPoint, kPoints> kBody = {
    {{"hips", kHips, 0.15f, 4.0f, 0.4f},           {"spine", kHips, 0.13f, 3.0f, 0.7f},
     {"chest", kSpine, 0.14f, 3.0f, 1.0f},         {"neck", kChest, 0.09f, 1.5f, 1.0f},
     {"head", kNeck, 0.11f, 1.5f, 1.0f},           {"ponytail1", kHead, 0.05f, 0.03f, 1.0f},
     {"upperArm.L", kChest, 0.07f, 1.5f, 1.0f},    {"upperArm.R", kChest, 0.07f, 1.5f, 1.0f},
     {"foreArm.L", kUpperArmL, 0.05f, 0.8f, 1.0f}, {"foreArm.R", kUpperArmR, 0.05f, 0.8f, 1.0f},
     {"thigh.L", kHips, 0.11f, 2.0f, 0.0f},        {"thigh.R", kHips, 0.11f, 2.0f, 0.0f},
     {"shin.L", kThighL, 0.065f, 1.2f, 0.0f},      {"shin.R", kThighR, 0.065f, 1.2f, 0.0f},
     {"foot.L", kShinL, 0.06f, 0.8f, 0.0f},        {"foot.R", kShinR, 0.06f, 0.8f, 0.0f},
     {"middleA.L", kForeArmL, 0.05f, 0.5f, 1.0f},  {"middleA.R", kForeArmR, 0.05f, 0.5f, 1.0f},
     {"toes.L", kFootL, 0.04f, 0.4f, 0.0f},        {"toes.R", kFootR, 0.04f, 0.4f, 0.0f},
     {"ponytail3", kTail, 0.05f, 0.01f, 1.0f},     {"", kHead, 0.14f, 1.5f, 1.0f}}};
/// The middle of the skull, in the frame of the head.
inline constexpr glm::vec3 kCrownInHead{0.0f, 0.2f, 0.0f};

/// Where all joints of the body are in the world.
using BodyPose = std::array<glm::mat4, kJoints>;
/// The same as points.
using BodyPoints = std::array<glm::vec3, kPoints>;
[[nodiscard]] inline BodyPoints pointsOf(const BodyPose& pose) {
    BodyPoints points;
    for (uint32_t i = 0; i < kJoints; ++i)
        points[i] = glm::vec3(pose[i][3]);
    points[kCrown] = glm::vec3(pose[kHead] * glm::vec4(kCrownInHead, 1.0f));
    return points;
}

} // namespace play
