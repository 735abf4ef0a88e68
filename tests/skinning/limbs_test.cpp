// The formulas of modifiers in the device's floats, on many random limbs and eyes: ends come to goals, rays pass
// points, poles count, and nothing jumps. That devices have the same bits is tested in
// tests/runtime/modifiers_test.cpp.
#include "shaders/pose/limbs.h"
#include "skinning/modifiers.h"
#include "tests/support/rigged_tube.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using test::Noise;

glm::dvec3 turned(const glm::vec4& q, const glm::dvec3& v) {
    const glm::dquat turn(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                          static_cast<double>(q.z));
    return turn * v;
}
glm::vec3 unitVector(Noise& noise) {
    glm::vec3 v(1.0f);
    do {
        v = noise.vector();
    } while (glm::length(v) < 0.1f);
    return glm::normalize(v);
}

struct RandomLimb {
    glm::vec3 a, b, c, hinge;
    float length;
};
/// Every tenth is straight or nearly so.
RandomLimb randomLimb(Noise& noise, int i) {
    RandomLimb limb{};
    const float upper = 0.4f + 0.2f * noise(), lower = 0.4f + 0.2f * noise();
    const glm::vec3 u = unitVector(noise);
    limb.a = noise.vector();
    limb.hinge = glm::normalize(glm::cross(u, unitVector(noise)));
    const float bend = i % 20 == 0 ? 0.0f : i % 20 == 1 ? 0.015f * (1.0f + noise()) : 1.3f * (1.0f + noise());
    const glm::vec3 v = std::cos(bend) * u + std::sin(bend) * glm::cross(limb.hinge, u);
    limb.b = limb.a + upper * u;
    limb.c = limb.b + lower * v;
    limb.length = upper + lower;
    return limb;
}

TEST(Limbs, EndsComeToTheirGoals) {
    Noise noise(11);
    double worst = 0.0, near = 0.0, inReach = 0.0, offPole = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const RandomLimb limb = randomLimb(noise, i);
        // A third out of reach, some at the root.
        const float distance = limb.length * 0.8f * (1.0f + noise());
        const glm::vec3 goal = limb.a + distance * unitVector(noise), pole = limb.a + noise.vector();
        const bool poled = i % 2 == 0;
        const shared::LimbTurns turns =
            shared::bentLimb(limb.a, limb.b, limb.c, goal, limb.hinge, pole, poled ? 1.0f : 0.0f, 0.97f);
        const glm::dvec3 a(limb.a), middle = a + turned(turns.root, glm::dvec3(limb.b) - a),
                                    end = middle + turned(turns.middle, glm::dvec3(limb.c) - glm::dvec3(limb.b));
        const double size = static_cast<double>(limb.length), off = glm::length(end - glm::dvec3(turns.end)) / size;
        ASSERT_TRUE(std::isfinite(off));
        (distance > 0.2f * limb.length ? worst : near) = std::max(distance > 0.2f * limb.length ? worst : near, off);
        const float upper = glm::length(limb.b - limb.a), lower = glm::length(limb.c - limb.b);
        if (distance > 0.2f * limb.length && distance < 0.97f * limb.length &&
            distance > 1.001f * std::abs(upper - lower) + 2e-4f * limb.length) {
            inReach = std::max(inReach, glm::length(end - glm::dvec3(goal)) / size);
        }
        const glm::dvec3 n = glm::normalize(end - a), toPole = glm::dvec3(pole) - a;
        const glm::dvec3 e = toPole - n * glm::dot(toPole, n), h = (middle - a) - n * glm::dot(middle - a, n);
        if (poled && glm::length(e) > 0.05 && glm::length(h) > 0.02 * size) {
            offPole = std::max(offPole, std::acos(std::min(glm::dot(glm::normalize(e), glm::normalize(h)), 1.0)));
        }
    }
    std::printf("off the goal by %.2g of the limb, %.2g near the root; in reach by %.2g; off the pole's half plane by "
                "%.2g rad\n",
                worst, near, inReach, offPole);
    EXPECT_LT(worst, 3e-6);
    EXPECT_LT(near, 2.4e-5);
    EXPECT_LT(inReach, 3e-6);
    EXPECT_LT(offPole, 1e-3);
}

TEST(Limbs, NeverSnapAtTheEndOfTheirReach) {
    const glm::vec3 a(0.0f), b(0.5f * std::cos(0.6f), 0.5f * std::sin(0.6f), 0.0f), c(std::cos(0.6f), 0.0f, 0.0f);
    double before = 0.0, fastest = 0.0;
    for (int i = 0; i <= 3000; ++i) {
        const float distance = 0.9f + 0.0001f * static_cast<float>(i);
        const shared::LimbTurns turns =
            shared::bentLimb(a, b, c, {distance, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f}, 1.0f, 0.97f);
        const glm::dvec3 middle = turned(turns.root, glm::dvec3(b));
        const double angle = std::atan2(middle.y, middle.x);
        EXPECT_GT(angle, 0.0) << "never quite straight";
        fastest = std::max(fastest, i > 0 ? std::abs(angle - before) / 0.0001 : 0.0);
        before = angle;
    }
    std::printf("the knee turns by at most %.2f rad while the goal moves by a limb\n", fastest);
    EXPECT_LT(fastest, 6.0);
}

TEST(Limbs, RaysPassTheirGoals) {
    Noise noise(12);
    double worst = 0.0, beyond = 0.0;
    size_t none = 0, behind = 0;
    for (int i = 0; i < 200000; ++i) {
        const glm::vec3 joint = noise.vector(), eye = joint + 0.1f * noise.vector(), forward = unitVector(noise);
        const bool straightBehind = i % 1000 == 0;
        const glm::vec3 goal = straightBehind ? eye - 3.0f * forward : joint + 2.0f * noise.vector();
        const glm::vec4 q = shared::aimedTurn(joint, eye, forward, goal, unitVector(noise));
        if (q == shared::noTurn()) {
            ++none;
            continue;
        }
        behind += straightBehind ? 1 : 0;
        const glm::dvec3 from = glm::dvec3(joint) + turned(q, glm::dvec3(eye) - glm::dvec3(joint)),
                         ray = turned(q, glm::dvec3(forward)), way = glm::dvec3(goal) - from;
        ASSERT_TRUE(std::isfinite(ray.x));
        if (glm::length(way) > 0.3) {
            EXPECT_GT(glm::dot(ray, way), 0.0);
            worst = std::max(worst, glm::length(glm::cross(ray, way)));
        }
        const glm::vec4 limited = shared::limitedTurn(q, std::cos(0.25f), std::sin(0.25f));
        const double sine = static_cast<double>(glm::length(glm::vec3(limited)));
        beyond = std::max(beyond, 2.0 * std::atan2(sine, std::abs(static_cast<double>(limited.w))));
    }
    std::printf("rays pass at %.2g; %zu goals behind, %zu without an answer; limited to 0.5 rad: %.6f\n", worst, behind,
                none, beyond);
    EXPECT_LT(worst, 6e-5);
    EXPECT_GT(behind, 150u);
    EXPECT_LT(none, 4000u);
    EXPECT_LT(beyond, 0.5 + 1e-5);
}

TEST(Limbs, AnAimGivesUpBehind) {
    const glm::vec3 forward(0.0f, 0.0f, 1.0f);
    float before = 1.0f;
    for (int degrees = 0; degrees <= 180; ++degrees) {
        const float angle = 3.14159265f * static_cast<float>(degrees) / 180.0f;
        const float weight = shared::aheadWeight(forward, {std::sin(angle), 0.0f, std::cos(angle)});
        if (degrees != 120 && degrees != 160) { // there the last bit decides
            EXPECT_EQ(weight == 1.0f, degrees < 120) << degrees;
            EXPECT_EQ(weight == 0.0f, degrees > 160) << degrees;
        }
        EXPECT_LE(weight, before);
        EXPECT_LT(before - weight, 0.05f) << "no jump";
        before = weight;
    }
}

/// A skeleton with named joints in a row, each 1 above the next, but for a bend.
cage::Character named(std::initializer_list<const char*> names, float bend) {
    cage::Character c = test::riggedTube({.segments = 4, .sides = 4, .joints = static_cast<uint32_t>(names.size())});
    uint32_t joint = 0;
    for (const char* name : names) {
        cage::Node& node = c.skeleton.nodes[c.skin.joints[joint]];
        node.name = name;
        node.translation = joint == 0 ? glm::vec3(0.0f) : glm::vec3(0.0f, -1.0f, joint == 2 ? -bend : 0.0f);
        node.rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
        ++joint;
    }
    return c;
}

TEST(ModifierChains, TakeTwistJointsForPartsOfABone) {
    const cage::Character cut =
        named({"hips", "upperleg01.L", "upperleg02.L", "lowerleg01.L", "lowerleg02.L", "foot.L"}, 0.0f);
    const std::vector<uint32_t> parents = {cage::kNone, 0, 1, 2, 3, 4};
    const auto limb = limbOf(cut, makeRig(cut), 5);
    ASSERT_TRUE(limb.has_value());
    EXPECT_EQ(limb->chain[0], cut.skin.joints[1]);
    EXPECT_EQ(limb->chain[1], cut.skin.joints[3]);
    EXPECT_EQ(limb->chain[2], cut.skin.joints[5]);
    const cage::Character tail = named({"tail1", "tail2", "tail3", "tail4"}, 0.0f);
    const auto end = limbOf(tail, makeRig(tail), 3);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->chain[0], tail.skin.joints[1]) << "joints that are called alike are bones each";
    EXPECT_FALSE(limbOf(tail, makeRig(tail), 1).has_value());
    EXPECT_FALSE(chainOf(tail, parents, 1, 3).has_value());
    EXPECT_TRUE(chainOf(tail, parents, 1, 2).has_value());
    cage::Character fixed = tail;
    fixed.skeleton.nodes[fixed.skin.joints[2]].hasMatrix = true;
    EXPECT_FALSE(limbOf(fixed, makeRig(fixed), 3).has_value());
}

TEST(ModifierChains, BendAsInTheRestPoseOrAsKneesDo) {
    // A leg: the shin goes back, so the knee is in front, and the hinge points to +X.
    for (const float bend : {0.3f, 0.0f}) {
        const cage::Character leg = named({"thigh", "shin", "foot"}, bend);
        const auto limb = limbOf(leg, makeRig(leg), 2);
        ASSERT_TRUE(limb.has_value());
        const glm::vec3 hinge = restHinge(leg, *limb);
        EXPECT_NEAR(hinge.x, 1.0f, 1e-6f) << bend;
        const shared::LimbTurns turns =
            shared::bentLimb({0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {0, -1.5f, 0}, hinge, glm::vec3(0.0f), 0.0f, 0.97f);
        EXPECT_GT(turned(turns.root, {0.0, -1.0, 0.0}).z, 0.3) << "the knee goes forward";
    }
    EXPECT_NEAR(restForward(named({"a", "b", "c"}, 0.0f), 1).z, 1.0f, 1e-6f);
}

} // namespace
} // namespace supple::skinning
