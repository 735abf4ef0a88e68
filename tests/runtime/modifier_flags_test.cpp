// What the flags and numbers of modifiers change, on the device, to the bit as the CPU has it.
#include "tests/support/crowd.h"
#include "tests/support/modified_groups.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class ModifierFlags : public CrowdContexts {
protected:
    /// Wren at a moment of a clip, in either mapping, first without modifiers.
    static constexpr double kMoment = 0.4;
    template <class Test>
    void inBothMappings(Test test) {
        const ValidationGuard guard;
        for (const SuppleMapping mapping : kMappings) {
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            PlayedGroup stage(own, modifiedGroup(own.asset(kWren), 2));
            ASSERT_TRUE(stage.crowd.valid());
            stage.play(0, 0, 0.2);
            stage.play(1, 0, 0.2);
            EXPECT_EQ(stage.run(kMoment), 0u);
            test(stage);
        }
    }
};

void aimAt(SuppleModifier& modifier, const glm::dvec3& target) {
    std::memcpy(modifier.target, &target, sizeof modifier.target);
}

/// What of `v` is across `along`.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& along) {
    const glm::dvec3 axis = glm::normalize(along);
    return v - axis * glm::dot(v, axis);
}

TEST_F(ModifierFlags, APoleSaysWhereTheMiddlePoints) {
    inBothMappings([](PlayedGroup& stage) {
        const uint32_t end = someEnd(stage);
        const std::vector<uint32_t>& parents = stage.group().asset().rig.jointParents;
        const uint32_t middle = parents[end], root = parents[middle];
        const glm::dvec3 a = stage.placeOf(0, root), c = stage.placeOf(0, end);
        const glm::dvec3 side = glm::normalize(across({0.3, -0.8, 0.5}, c - a));
        SuppleModifier modifier = modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, glm::mix(c, a, 0.3));
        modifier.flags = SUPPLE_MODIFIER_POLE;
        modifier.poleWeight = 1.0f;
        for (const double sign : {1.0, -1.0}) {
            const glm::dvec3 pole = a + sign * stage.extent() * side;
            std::memcpy(modifier.pole, &pole, sizeof modifier.pole);
            stage.modify(0, modifier);
            EXPECT_EQ(stage.run(kMoment), 0u);
            const glm::dvec3 bent = across(stage.placeOf(0, middle) - a, stage.placeOf(0, end) - a);
            EXPECT_GT(glm::length(bent), 1e-3 * stage.extent()) << "it is bent";
            EXPECT_GT(glm::dot(glm::normalize(bent), sign * side), 1.0 - 1e-6);
            EXPECT_LT(glm::length(stage.placeOf(0, end) - glm::mix(c, a, 0.3)), 2e-6 * stage.extent());
        }
    });
}

TEST_F(ModifierFlags, TheEndOfALimbTurnsAsItIsTold) {
    inBothMappings([](PlayedGroup& stage) {
        const uint32_t end = someEnd(stage);
        const glm::dquat turn = glm::normalize(glm::dquat(0.5, -0.3, 0.7, 0.1));
        SuppleModifier modifier = turning(SUPPLE_MODIFIER_TWO_BONE, end, glm::quat(turn), SUPPLE_MODIFIER_END_ROTATION);
        const uint32_t middle = stage.group().asset().rig.jointParents[end];
        aimAt(modifier, glm::mix(stage.placeOf(0, end), stage.placeOf(0, middle), 0.2));
        EXPECT_GT(turnBetween(rotationOf(stage.jointOf(0, end)), turn), 0.1);
        stage.modify(0, modifier);
        EXPECT_EQ(stage.run(kMoment), 0u);
        EXPECT_LT(turnBetween(rotationOf(stage.jointOf(0, end)), turn), 1e-5);
    });
}

TEST_F(ModifierFlags, AnAimFollowsPointsOfTheWorldWithinItsLimit) {
    inBothMappings([](PlayedGroup& stage) {
        const uint32_t end = someEnd(stage), joint = stage.group().asset().rig.jointParents[end];
        for (uint32_t i = 0; i < 2; ++i)
            stage.place(i, glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 0.0f, 1.0f}), 0.7f, {0.0f, 1.0f, 0.0f}));
        EXPECT_EQ(stage.run(kMoment), 0u);
        const glm::dmat4 looks = stage.jointOf(0, joint);
        const glm::dvec3 at(looks[3]), ahead = glm::normalize(glm::dvec3(looks[1])),
                                       beside = glm::normalize(glm::dvec3(looks[0]));
        const glm::dvec3 goal = at + stage.extent() * (ahead + beside); // half a right angle aside
        SuppleModifier aim = modifierOf(SUPPLE_MODIFIER_AIM, joint);
        aim.flags = SUPPLE_MODIFIER_WORLD;
        aim.axis[1] = 1.0f;
        aimAt(aim, goal);
        SuppleModifier limited = aim;
        limited.limit = 0.2f;
        stage.modify(0, aim);
        stage.modify(1, limited);
        EXPECT_EQ(stage.run(kMoment), 0u);
        const glm::dvec3 ray = glm::normalize(glm::dvec3(stage.jointOf(0, joint)[1]));
        EXPECT_GT(glm::dot(ray, glm::normalize(goal - at)), 1.0 - 1e-9);
        const double turned = turnBetween(rotationOf(looks), rotationOf(stage.jointOf(1, joint)));
        EXPECT_NEAR(turned, 0.2, 1e-5);
        const glm::dvec3 towards = glm::normalize(glm::dvec3(stage.jointOf(1, joint)[1]));
        EXPECT_GT(glm::dot(towards, glm::normalize(goal - at)), glm::dot(ahead, glm::normalize(goal - at)));
    });
}

TEST_F(ModifierFlags, ALongChainTurnsTogetherAndGivesUpBehind) {
    inBothMappings([](PlayedGroup& stage) {
        const std::vector<uint32_t>& parents = stage.group().asset().rig.jointParents;
        const uint32_t joint = someEnd(stage);
        uint32_t top = joint;
        for (int up = 0; up < 3; ++up)
            top = parents[top];
        const glm::dmat4 looks = stage.jointOf(0, joint), above = stage.jointOf(0, top);
        const glm::dvec3 at(looks[3]), ahead = glm::normalize(glm::dvec3(looks[1])),
                                       beside = glm::normalize(glm::dvec3(looks[0]));
        SuppleModifier aim = modifierOf(SUPPLE_MODIFIER_AIM, joint);
        aim.chainLength = 4;
        aim.share = 0.4f;
        aim.axis[1] = 1.0f;
        const glm::dvec3 goal = at + stage.extent() * (ahead + 0.7 * beside);
        aimAt(aim, goal);
        stage.modify(0, aim);
        SuppleModifier back = aim;
        aimAt(back, at - stage.extent() * ahead);
        stage.modify(1, back);
        const glm::dmat4 before = stage.jointOf(1, joint);
        EXPECT_EQ(stage.run(kMoment), 0u);
        const glm::dmat4 aimed = stage.jointOf(0, joint);
        EXPECT_LT(glm::length(across(goal - glm::dvec3(aimed[3]), glm::dvec3(aimed[1]))), 1e-5 * stage.extent());
        EXPECT_GT(turnBetween(rotationOf(above), rotationOf(stage.jointOf(0, top))), 1e-3) << "all four turn";
        EXPECT_LT(turnBetween(rotationOf(before), rotationOf(stage.jointOf(1, joint))), 1e-6) << "it is behind";
    });
}

TEST_F(ModifierFlags, AHandOverGoesPartOfTheWayAndTakesWhatHangsOnItAlong) {
    inBothMappings([](PlayedGroup& stage) {
        const uint32_t end = someEnd(stage), joint = stage.group().asset().rig.jointParents[end];
        const std::vector<float> plain = stage.poses;
        const glm::dmat4 before = stage.jointOf(0, joint);
        const glm::dmat4 hangs = glm::inverse(before) * stage.jointOf(0, end);
        const glm::dquat turn = glm::normalize(rotationOf(before) * glm::dquat(0.9, 0.3, -0.2, 0.25));
        const glm::dvec3 goal = glm::dvec3(before[3]) + 0.1 * stage.extent() * glm::dvec3(1.0, 0.5, -0.3);
        SuppleModifier modifier = turning(SUPPLE_MODIFIER_HAND_OVER, joint, glm::quat(turn), SUPPLE_MODIFIER_WORLD);
        aimAt(modifier, goal);
        modifier.weight = 0.0f;
        stage.modify(0, modifier);
        EXPECT_EQ(stage.run(kMoment), 0u);
        EXPECT_EQ(stage.poses, plain);
        modifier.weight = 0.5f;
        stage.modify(0, modifier);
        EXPECT_EQ(stage.run(kMoment), 0u);
        const glm::dmat4 half = stage.jointOf(0, joint);
        EXPECT_LT(glm::length(glm::dvec3(half[3]) - 0.5 * (glm::dvec3(before[3]) + goal)), 1e-5 * stage.extent());
        const double whole = turnBetween(rotationOf(before), turn);
        EXPECT_NEAR(turnBetween(rotationOf(before), rotationOf(half)), 0.5 * whole, 2e-3 * whole);
        const glm::dmat4 child = half * hangs;
        EXPECT_LT(glm::length(stage.placeOf(0, end) - glm::dvec3(child[3])), 1e-5 * stage.extent());
    });
}

TEST_F(ModifierFlags, SixteenOfAllKindsActInTheirOrder) {
    inBothMappings([](PlayedGroup& stage) {
        const uint32_t end = someEnd(stage);
        const std::vector<uint32_t>& parents = stage.group().asset().rig.jointParents;
        const uint32_t middle = parents[end], root = parents[middle];
        const glm::quat turn = glm::normalize(glm::quat(0.95f, 0.1f, -0.2f, 0.15f));
        const glm::dvec3 a = stage.placeOf(0, root), c = stage.placeOf(0, end);
        std::vector<SuppleModifier> list;
        for (int round = 0; round < 3; ++round) {
            list.push_back(turning(SUPPLE_MODIFIER_ADD, root, turn));
            list.push_back(turning(SUPPLE_MODIFIER_SET, middle, turn, SUPPLE_MODIFIER_MODEL));
            SuppleModifier aim =
                modifierOf(SUPPLE_MODIFIER_AIM, middle, a + stage.extent() * glm::dvec3(0.3, 1.0, 0.2));
            aim.chainLength = 2;
            aim.limit = 0.5f;
            list.push_back(aim);
            SuppleModifier held = turning(SUPPLE_MODIFIER_HAND_OVER, middle, turn);
            aimAt(held, stage.placeOf(0, middle));
            held.weight = 0.3f;
            list.push_back(held);
            list.push_back(modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, glm::mix(c, a, 0.1 * round)));
        }
        list.push_back(turning(SUPPLE_MODIFIER_ADD, end, turn, SUPPLE_MODIFIER_MODEL));
        ASSERT_EQ(list.size(), size_t{SUPPLE_MAX_MODIFIERS});
        stage.modify(0, list);
        EXPECT_EQ(stage.run(kMoment), 0u);
        EXPECT_LT(glm::length(stage.placeOf(0, end) - glm::mix(c, a, 0.2)), 1e-3 * stage.extent())
            << "the last limb has come to its goal";
        std::reverse(list.begin(), list.end());
        const std::vector<float> inOrder = stage.poses;
        stage.modify(0, list);
        EXPECT_EQ(stage.run(kMoment), 0u);
        EXPECT_NE(stage.poses, inOrder);
    });
}

} // namespace
} // namespace supple::test
