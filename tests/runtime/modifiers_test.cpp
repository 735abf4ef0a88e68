// Modifiers of instances that play on the device: joints come where they shall, with the bits that the CPU has,
// whatever is played, wherever the instance stands, and however the group is made anew.
#include "tests/support/boxes.h"
#include "tests/support/crowd.h"
#include "tests/support/modified_groups.h"
#include "tests/support/played_group.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/skinnings.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class Modifiers : public CrowdContexts {};

/// Where the end of a limb is, but for a part of the way to its root: well within reach.
glm::dvec3 towardsTheRoot(const PlayedGroup& group, uint32_t i, uint32_t end, double part) {
    const std::vector<uint32_t>& parents = group.group().asset().rig.jointParents;
    return glm::mix(group.placeOf(i, end), group.placeOf(i, parents[parents[end]]), part);
}

TEST_F(Modifiers, BringJointsWhereTheyShallBe) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : kSkinnings) {
            for (const std::string& file : {kPip, kWren}) {
                CrowdContext& own = context(mapping);
                ASSERT_TRUE(own.valid());
                PlayedGroup stage(own, modifiedGroup(own.asset(file), 5, skinning));
                ASSERT_TRUE(stage.crowd.valid());
                const uint32_t end = someEnd(stage);
                const double extent = stage.extent();
                for (uint32_t i = 0; i < 5; ++i) {
                    stage.play(i, i % stage.crowd.clipCount(), 0.13 * i);
                }
                EXPECT_EQ(stage.run(0.4), 0u) << "without modifiers";
                const std::vector<uint32_t>& parents = stage.group().asset().rig.jointParents;
                const uint32_t middle = parents[end], root = parents[middle];
                const glm::dquat turn = glm::normalize(glm::dquat(0.9, 0.3, -0.2, 0.25));
                // In reach: a little from where it is, towards the root. Out of reach: far off.
                const glm::dvec3 a = stage.placeOf(1, root), b = stage.placeOf(1, middle), c = stage.placeOf(1, end);
                const glm::dvec3 goal = c + 0.3 * (a - c) + 0.1 * glm::length(b - a) * glm::dvec3(0.3, 0.5, 0.2);
                const glm::dquat before = rotationOf(stage.jointOf(1, end));
                stage.modify(0, turning(SUPPLE_MODIFIER_SET, middle, glm::quat(turn), SUPPLE_MODIFIER_MODEL));
                stage.modify(1, modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, goal));
                stage.modify(2, modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, c + 10.0 * extent));
                SuppleModifier aim = modifierOf(SUPPLE_MODIFIER_AIM, middle);
                aim.chainLength = 2;
                aim.share = 0.5f;
                aim.axis[1] = 1.0f;
                aim.offset[0] = static_cast<float>(0.01 * extent);
                const glm::dmat4 looks = stage.jointOf(3, middle);
                const glm::dvec3 seen = glm::dvec3(looks[3]) + extent * glm::normalize(glm::dvec3(looks[1])) +
                                        0.4 * extent * glm::normalize(glm::dvec3(looks[0]));
                for (int axis = 0; axis < 3; ++axis) {
                    aim.target[axis] = seen[axis];
                }
                const SuppleModifier list[] = {turning(SUPPLE_MODIFIER_ADD, root, glm::quat(turn)), aim};
                stage.modify(3, list);
                EXPECT_EQ(stage.run(0.4), 0u) << mappingName(mapping) << " " << file;

                EXPECT_LT(turnBetween(rotationOf(stage.jointOf(0, middle)), turn), 1e-5);
                EXPECT_LT(glm::length(stage.placeOf(1, end) - goal), 2e-6 * extent);
                EXPECT_LT(turnBetween(rotationOf(stage.jointOf(1, end)), before), 1e-5) << "the end stays turned";
                const double limb = glm::length(b - a) + glm::length(c - b);
                const double reached = glm::length(stage.placeOf(2, end) - stage.placeOf(2, root));
                EXPECT_GT(reached, 0.97 * limb);
                EXPECT_LT(reached, limb) << "never quite straight";
                const glm::dmat4 aimed = stage.jointOf(3, middle);
                const glm::dvec3 eye(aimed * glm::dvec4(0.01 * extent, 0.0, 0.0, 1.0));
                const glm::dvec3 ray = glm::normalize(glm::dvec3(aimed[1]));
                EXPECT_LT(glm::length(glm::cross(ray, seen - eye)), 1e-5 * extent);
                EXPECT_GT(glm::dot(ray, seen - eye), 0.0);
            }
        }
    }
}

TEST_F(Modifiers, DoNothingWithWeightZeroAndFadeByTheGroupsTime) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, modifiedGroup(own.asset(kPip), 2));
    ASSERT_TRUE(stage.crowd.valid());
    const uint32_t end = someEnd(stage);
    stage.play(0, 0, 0.2);
    stage.play(1, 0, 0.2);
    EXPECT_EQ(stage.run(1.0), 0u);
    const std::vector<float> plain = stage.poses;
    const glm::dvec3 from = stage.placeOf(0, end), goal = towardsTheRoot(stage, 0, end, 0.5);
    SuppleModifier modifier = modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, goal);
    modifier.weight = 0.0f;
    modifier.fadeWeight = 1.0f;
    modifier.fadeStart = 1.0;
    modifier.fadeDuration = 0.5f;
    stage.modify(0, modifier);
    EXPECT_EQ(stage.run(1.0), 0u);
    EXPECT_EQ(stage.poses, plain) << "it has not begun";
    // The clip stands, so that the fade alone moves it.
    SupplePlaybackLayer still{};
    still.flags = SUPPLE_LAYER_LOOP;
    still.weight = 1.0f;
    still.offset = 1.2;
    SupplePlaybackDesc desc{};
    desc.structSize = sizeof desc;
    desc.layers = &still;
    desc.layerCount = 1;
    EXPECT_EQ(suppleSetPlayback(stage.handle(), stage.instances[0], &desc), SUPPLE_OK);
    for (const double part : {0.25, 0.5, 1.0}) {
        EXPECT_EQ(stage.run(1.0 + 0.5 * part), 0u);
        EXPECT_LT(glm::length(stage.placeOf(0, end) - glm::mix(from, goal, part)), 1e-5);
    }
    // Another target in the same place of the list; and none.
    SuppleModifierTarget target{};
    target.structSize = sizeof target;
    target.weight = 1.0f;
    const glm::dvec3 other = glm::mix(from, goal, 0.6);
    std::memcpy(target.target, &other, sizeof target.target);
    EXPECT_EQ(suppleSetModifierTarget(stage.handle(), stage.instances[0], 0, &target), SUPPLE_OK);
    EXPECT_EQ(stage.run(1.1), 0u);
    EXPECT_LT(glm::length(stage.placeOf(0, end) - other), 1e-5);
    stage.modify(0, std::span<const SuppleModifier>());
    EXPECT_EQ(suppleSetModifierTarget(stage.handle(), stage.instances[0], 0, &target), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    stage.play(0, 0, 0.2);
    EXPECT_EQ(stage.run(1.0), 0u);
    EXPECT_EQ(stage.poses, plain);
}

TEST_F(Modifiers, ReachPointsOfTheWorldWhereverTheInstanceStands) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        PlayedGroup stage(own, modifiedGroup(own.asset(kWren), 2));
        ASSERT_TRUE(stage.crowd.valid());
        const uint32_t end = someEnd(stage);
        const double extent = stage.extent();
        stage.play(0, 0, 0.2);
        stage.play(1, 0, 0.2, SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW, SUPPLE_PLAYBACK_TRAVEL);
        const double away[3] = {4e5, -2e5, 1e5};
        for (uint32_t i = 0; i < 2; ++i) {
            stage.place(i, glm::rotate(glm::mat4(1.0f), 0.7f, {0.0f, 1.0f, 0.0f}));
            EXPECT_EQ(suppleSetPosition(stage.handle(), stage.instances[i], away), SUPPLE_OK);
        }
        EXPECT_EQ(suppleSetOrigin(stage.handle(), away), SUPPLE_OK);
        EXPECT_EQ(stage.run(0.6), 0u);
        const glm::dvec3 origin(away[0], away[1], away[2]);
        std::vector<glm::dvec3> goals;
        for (uint32_t i = 0; i < 2; ++i) {
            goals.push_back(origin + stage.placeOf(i, end) + 0.01 * extent * glm::dvec3(1.0, 1.0, -1.0));
            SuppleModifier modifier = modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, goals.back());
            modifier.flags = SUPPLE_MODIFIER_WORLD;
            stage.modify(i, modifier);
        }
        for (const double shift : {0.0, 30.0}) { // another origin
            const double begin[3] = {away[0] + shift, away[1], away[2] - shift};
            EXPECT_EQ(suppleSetOrigin(stage.handle(), begin), SUPPLE_OK);
            EXPECT_EQ(stage.run(0.6), 0u);
            for (uint32_t i = 0; i < 2; ++i) {
                const glm::dvec3 off = stage.placeOf(i, end) + glm::dvec3(begin[0], begin[1], begin[2]) - goals[i];
                EXPECT_LT(glm::length(off), 1e-5 * (extent + shift)) << i;
            }
        }
        const double none[3] = {};
        EXPECT_EQ(suppleSetOrigin(stage.handle(), none), SUPPLE_OK);
    }
}

TEST_F(Modifiers, ChangePosesThatAreSetAsThoseThatArePlayed) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    for (const SuppleSkinning skinning : kSkinnings) {
        const SuppleAsset asset = own.asset(kWren);
        PlayedGroup played(own, modifiedGroup(asset, 1, skinning));
        SuppleGroupDesc desc = modifiedGroup(asset, 2, skinning);
        desc.poseSource = SUPPLE_POSES_SET;
        Crowd told(own, desc);
        ASSERT_TRUE(played.crowd.valid() && told.valid());
        const SuppleInstance instance = told.spawn();
        const uint32_t end = someEnd(played);
        const double extent = played.extent();
        const glm::mat4 place =
            glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 0.0f, 1.0f}), 0.7f, {0.0f, 1.0f, 0.0f});
        played.play(0, 0, 0.0);
        played.place(0, place);
        EXPECT_EQ(played.run(0.4), 0u);
        const glm::dvec3 goal = towardsTheRoot(played, 0, end, 0.3), other = towardsTheRoot(played, 0, end, 0.4);
        SuppleModifier list[] = {
            turning(SUPPLE_MODIFIER_ADD, played.group().asset().rig.jointParents[end], {0.9f, 0.1f, 0.2f, 0.1f}),
            modifierOf(SUPPLE_MODIFIER_TWO_BONE, end, goal)};
        list[1].flags = SUPPLE_MODIFIER_WORLD;
        played.modify(0, list);
        EXPECT_EQ(played.run(0.4), 0u);

        SuppleModifiersDesc modifiers{};
        modifiers.structSize = sizeof modifiers;
        modifiers.modifiers = list;
        modifiers.modifierCount = 2;
        const auto joint = [&](uint32_t j) {
            float m[16];
            EXPECT_EQ(suppleGetJointTransform(own.handle(), instance, j, m), SUPPLE_OK);
            return glm::dmat4(glm::make_mat4(m));
        };
        const auto off = [&] {
            double worst = 0.0;
            for (uint32_t j = 0; j < played.character().skin.joints.size(); ++j) {
                const glm::dmat4 d = joint(j) - played.jointOf(0, j);
                for (int column = 0; column < 4; ++column) {
                    worst = std::max(worst, glm::length(d[column]) / (column == 3 ? extent : 1.0));
                }
            }
            return worst;
        };
        // Whatever is said first.
        EXPECT_EQ(suppleSetModifiers(own.handle(), instance, &modifiers), SUPPLE_OK);
        EXPECT_EQ(suppleSetClipPose(own.handle(), instance, 0, 0.4), SUPPLE_OK);
        EXPECT_EQ(suppleSetTransform(own.handle(), instance, glm::value_ptr(place)), SUPPLE_OK);
        EXPECT_LT(off(), 2e-5);
        EXPECT_LT(glm::length(glm::dvec3(joint(end)[3]) - goal), 1e-5 * extent);
        own.run(told.group());
        const std::vector<glm::vec4> cage = as<glm::vec4>(told.read(told.output().info.deformedCage)),
                                     wanted = as<glm::vec4>(played.crowd.read(played.crowd.output().info.deformedCage));
        double apart = 0.0;
        for (uint32_t v = 0; v < played.character().cage.vertexCount(); ++v) {
            apart = std::max(apart, static_cast<double>(glm::length(glm::vec3(cage[v]) - glm::vec3(wanted[v]))));
        }
        EXPECT_LT(apart, 2e-5 * extent);
        // Another target; a larger group; none.
        SuppleModifierTarget target{};
        target.structSize = sizeof target;
        std::memcpy(target.target, &other, sizeof target.target);
        target.weight = 1.0f;
        EXPECT_EQ(suppleSetModifierTarget(own.handle(), instance, 1, &target), SUPPLE_OK);
        EXPECT_LT(glm::length(glm::dvec3(joint(end)[3]) - other), 1e-5 * extent);
        ASSERT_EQ(suppleSetCapacity(own.handle(), told.group(), 4), SUPPLE_OK);
        EXPECT_LT(glm::length(glm::dvec3(joint(end)[3]) - other), 1e-5 * extent);
        modifiers.modifierCount = 0;
        EXPECT_EQ(suppleSetModifiers(own.handle(), instance, &modifiers), SUPPLE_OK);
        played.modify(0, std::span<const SuppleModifier>());
        EXPECT_EQ(played.run(0.4), 0u);
        EXPECT_LT(off(), 2e-5);
        list[1].fadeDuration = 1.0f;
        modifiers.modifierCount = 2;
        EXPECT_EQ(suppleSetModifiers(own.handle(), instance, &modifiers), SUPPLE_ERROR_ARGUMENT) << "it has no time";
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT);
    }
}

TEST_F(Modifiers, SomeJointsHaveMatrices) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 2});
    tube.clips.push_back(clipOf({channel(1, cage::ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f})}));
    tube.clips.back().name = "bend";
    SuppleGroupDesc desc = modifiedGroup(own.createAsset(tube), 1);
    desc.poseSource = SUPPLE_POSES_SET;
    desc.flags = 0;
    Crowd crowd(own, desc);
    const SuppleInstance instance = crowd.spawn();
    EXPECT_EQ(suppleSetClipPose(own.handle(), instance, 0, 0.5), SUPPLE_OK);
    const auto joint = [&](uint32_t j) {
        std::array<float, 16> m{};
        EXPECT_EQ(suppleGetJointTransform(own.handle(), instance, j, m.data()), SUPPLE_OK);
        return m;
    };
    const auto first = joint(0), second = joint(1);
    const glm::mat4 matrix = glm::translate(glm::mat4(1.0f), {0.5f, 0.25f, 2.0f});
    const uint32_t which = 2;
    const float weights[] = {0.5f, 2.0f};
    SuppleJointMatricesDesc some{};
    some.structSize = sizeof some;
    some.jointCount = 1;
    some.jointMatrices = glm::value_ptr(matrix);
    some.joints = &which;
    some.morphWeights = weights;
    some.morphTargetCount = 2;
    EXPECT_EQ(suppleSetJointMatrices(own.handle(), instance, &some), SUPPLE_OK);
    EXPECT_EQ(joint(0), first);
    EXPECT_EQ(joint(1), second);
    EXPECT_EQ(std::memcmp(joint(2).data(), glm::value_ptr(matrix), 64), 0);
    const auto morphs = [&] {
        own.run(crowd.group());
        const skinning::PoseLayout& layout =
            own.handle()->context->groups.find(crowd.group().id)->instances().poseLayout();
        const std::vector<glm::vec4> poses = as<glm::vec4>(crowd.read(crowd.output().info.poses));
        return glm::vec2(poses[layout.morphWeights]);
    };
    EXPECT_EQ(morphs(), glm::vec2(0.5f, 2.0f));
    some.morphWeights = nullptr;
    some.morphTargetCount = 0;
    EXPECT_EQ(suppleSetJointMatrices(own.handle(), instance, &some), SUPPLE_OK);
    EXPECT_EQ(morphs(), glm::vec2(0.5f, 2.0f)) << "they stay";
    const std::vector<glm::mat4> all(3, matrix);
    some.joints = nullptr;
    some.jointCount = 3;
    some.jointMatrices = glm::value_ptr(all[0]);
    EXPECT_EQ(suppleSetJointMatrices(own.handle(), instance, &some), SUPPLE_OK);
    EXPECT_EQ(morphs(), glm::vec2(tube.morphs.weights[0], tube.morphs.weights[1]));
    EXPECT_EQ(std::memcmp(joint(0).data(), glm::value_ptr(matrix), 64), 0);
}

TEST_F(Modifiers, HandJointsOver) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        PlayedGroup stage(own, modifiedGroup(own.asset(kPip), 1));
        ASSERT_TRUE(stage.crowd.valid());
        const uint32_t end = someEnd(stage), middle = stage.group().asset().rig.jointParents[end];
        stage.play(0, 0, 0.0);
        const glm::dquat turn = glm::normalize(glm::dquat(0.5, -0.3, 0.7, 0.1));
        SuppleModifier both[2] = {turning(SUPPLE_MODIFIER_HAND_OVER, middle, glm::quat(turn)),
                                  turning(SUPPLE_MODIFIER_HAND_OVER, end, glm::quat(turn))};
        const glm::dvec3 places[2] = {{0.3, 1.0, 0.1}, {0.5, 0.9, 0.2}};
        for (size_t k = 0; k < 2; ++k) {
            std::memcpy(both[k].target, &places[k], sizeof both[k].target);
        }
        stage.modify(0, both);
        EXPECT_EQ(stage.run(0.3), 0u);
        EXPECT_LT(glm::length(stage.placeOf(0, middle) - places[0]), 1e-5);
        EXPECT_LT(glm::length(stage.placeOf(0, end) - places[1]), 1e-5);
        EXPECT_LT(turnBetween(rotationOf(stage.jointOf(0, end)), turn), 1e-5);
    }
}

TEST_F(Modifiers, StayWhenTheGroupIsMadeAnew) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 4});
    tube.clips.push_back(clipOf({channel(1, cage::ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f})}));
    tube.clips.back().name = "bend";
    const SuppleAsset asset = own.createAsset(tube);
    PlayedGroup stage(own, modifiedGroup(asset, 2));
    ASSERT_TRUE(stage.crowd.valid());
    for (uint32_t i = 0; i < 2; ++i) {
        stage.play(i, 0, 0.3);
    }
    EXPECT_EQ(stage.run(0.1), 0u);
    const glm::dvec3 goal = towardsTheRoot(stage, 1, 3, 0.3);
    stage.modify(1, modifierOf(SUPPLE_MODIFIER_TWO_BONE, 3, goal));
    EXPECT_EQ(stage.run(0.1), 0u);
    const glm::dvec3 reached = stage.placeOf(1, 3);
    EXPECT_LT(glm::length(reached - goal), 1e-5);
    ASSERT_EQ(suppleSetCapacity(own.handle(), stage.crowd.group(), 5), SUPPLE_OK);
    EXPECT_EQ(stage.run(0.1), 0u);
    EXPECT_EQ(stage.placeOf(1, 3), reached);
    // Another version of the asset, with a joint more in front: the limb is found by its names.
    cage::Character other = riggedTube({.segments = 6, .sides = 6, .joints = 5});
    other.clips = tube.clips;
    ASSERT_EQ(own.reloadAsset(asset, other), SUPPLE_OK);
    EXPECT_EQ(stage.run(0.1), 0u);
    EXPECT_EQ(stage.group().poses().playback()->modifierCount(stage.instances[1].slot), 1u);
    // And one that lacks the end.
    cage::Character shorter = riggedTube({.segments = 6, .sides = 6, .joints = 3});
    shorter.clips = tube.clips;
    ASSERT_EQ(own.reloadAsset(asset, shorter), SUPPLE_OK);
    EXPECT_EQ(stage.run(0.1), 0u);
    EXPECT_EQ(stage.group().poses().playback()->modifierCount(stage.instances[1].slot), 0u);
}

TEST_F(Modifiers, KeepWithinTheBoxesThatCullingKnows) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    // Joint 0 is moved by no clip, all below joint 1 hang on what is.
    cage::Character tube = riggedTube({.segments = 8, .sides = 6, .joints = 4});
    tube.clips.push_back(clipOf({channel(2, cage::ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f})}));
    tube.clips.back().name = "bend";
    PlayedGroup stage(own, modifiedGroup(own.createAsset(tube), 1));
    ASSERT_TRUE(stage.crowd.valid());
    stage.play(0, 0, 0.3);
    runtime::Group& group = stage.group();
    const skinning::Reach reach = skinning::reachOf(stage.character());
    Noise noise(8);
    size_t held = 0;
    for (int k = 0; k < 40; ++k) {
        const glm::quat turn = glm::normalize(glm::quat(noise(), noise(), noise(), noise()));
        const SuppleModifier list[] = {turning(SUPPLE_MODIFIER_SET, 1, turn, SUPPLE_MODIFIER_MODEL),
                                       modifierOf(SUPPLE_MODIFIER_TWO_BONE, 3, glm::dvec3(noise.vector()) * 3.0)};
        stage.modify(0, list);
        EXPECT_EQ(stage.run(0.1 * k), 0u);
        const auto box = group.poses().playback()->boundsOf(stage.instances[0].slot, reach);
        ASSERT_TRUE(box.has_value());
        const std::vector<glm::vec4> cage = as<glm::vec4>(stage.crowd.read(stage.crowd.output().info.deformedCage));
        for (uint32_t v = 0; v < stage.character().cage.vertexCount(); ++v) {
            const glm::dvec3 p(cage[v]);
            held += glm::all(glm::greaterThanEqual(p, box->low)) && glm::all(glm::lessThanEqual(p, box->high)) ? 1 : 0;
        }
    }
    EXPECT_EQ(held, 40u * stage.character().cage.vertexCount());
    const auto unknown = [&](const SuppleModifier& modifier) {
        stage.modify(0, modifier);
        return !group.poses().playback()->boundsOf(stage.instances[0].slot, reach).has_value();
    };
    EXPECT_TRUE(unknown(turning(SUPPLE_MODIFIER_SET, 0, {1.0f, 0.0f, 0.0f, 0.0f}))) << "no clip bounds what it carries";
    EXPECT_TRUE(unknown(turning(SUPPLE_MODIFIER_HAND_OVER, 3, {1.0f, 0.0f, 0.0f, 0.0f})));
    EXPECT_FALSE(unknown(turning(SUPPLE_MODIFIER_SET, 3, {1.0f, 0.0f, 0.0f, 0.0f})));
    stage.modify(0, std::span<const SuppleModifier>());
    EXPECT_TRUE(group.poses().playback()->boundsOf(stage.instances[0].slot, reach).has_value());
}

} // namespace
} // namespace supple::test
