// Root motion: what is taken out of a pose, and that the host's copy of it puts it back.
#include "skinning/root_motion.h"

#include "skinning/layers.h"
#include "skinning/rotation.h"
#include "tests/support/rigged_tube.h"

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using test::channel;
using test::clipOf;

constexpr uint32_t kAll = kRootGround | kRootHeight | kRootYaw;

std::vector<float> aboutY(std::initializer_list<double> degrees) {
    std::vector<float> values;
    for (const double d : degrees) {
        values.insert(values.end(), {0, static_cast<float>(std::sin(d * std::numbers::pi / 360.0)), 0,
                                     static_cast<float>(std::cos(d * std::numbers::pi / 360.0))});
    }
    return values;
}

/// A root that walks a bow, bobs, leans and turns by 120 degrees a loop of 2 s; clip 1 walks straight.
cage::Character walker() {
    cage::Character c = test::riggedTube();
    c.clips.push_back(
        clipOf({channel(1, ChannelPath::translation, {0, 0.5f, 1.2f, 2}, {1, 2, 0, 2, 2.5f, 1, 3, 2, 1.5f, 4, 2, 3}),
                channel(1, ChannelPath::rotation, {0, 1, 2}, aboutY({20, 70, 140})),
                channel(2, ChannelPath::rotation, {0, 1, 2}, {0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0, 0, 1})}));
    c.clips.push_back(clipOf({channel(1, ChannelPath::translation, {0, 1}, {0, 0, 0, 0, 0, 4})}));
    return c;
}

glm::dmat4 globalOf(const cage::Character& c, const Pose& pose, uint32_t node) {
    glm::dmat4 global(1.0);
    for (; node != cage::kNone; node = c.skeleton.nodes[node].parent) {
        global = localMatrix(c.skeleton.nodes[node], pose.locals[node]) * global;
    }
    return global;
}

double distance(const glm::dmat4& a, const glm::dmat4& b) {
    double worst = 0.0;
    for (int column = 0; column < 4; ++column) {
        worst = std::max(worst, glm::length(a[column] - b[column]));
    }
    return worst;
}

/// The largest entry by which motion * (pose without it) misses the pose, over a clip.
double putBackError(const cage::Character& c, uint32_t root, uint32_t axes) {
    double worst = 0.0;
    for (double time = 0.0; time <= c.clips[0].duration; time += 0.125) {
        Pose whole, rest;
        sampleClip(c, c.clips[0], time, whole);
        rest = whole;
        removeRootMotion(c, c.clips[0], {root, axes}, rest);
        const RootMotion motion = rootMotionBetween(c, c.clips[0], {root, axes}, 0.0, time, false);
        for (const uint32_t node : {root, root + 1}) {
            worst = std::max(worst, distance(toMatrix(motion) * globalOf(c, rest, node), globalOf(c, whole, node)));
        }
    }
    return worst;
}

TEST(RootMotion, PoseAndMotionTogetherAreTheClip) {
    cage::Character c = walker();
    for (uint32_t axes = 1; axes <= kAll; ++axes) {
        EXPECT_LT(putBackError(c, 1, axes), 1e-12) << axes;
    }
    // Under a parent that turns +Z up, scales and stands elsewhere, as exporters write.
    cage::Node& parent = c.skeleton.nodes[0];
    parent.rotation = glm::angleAxis(-1.5707963f, glm::vec3(1, 0, 0));
    parent.scale = glm::vec3(0.01f);
    parent.translation = {5, 6, 7};
    for (uint32_t axes = 1; axes <= kAll; ++axes) {
        EXPECT_LT(putBackError(c, 1, axes), 1e-6) << axes << ": the quaternion is rounded to single precision";
    }
    // Mirrored, and as a matrix.
    parent.hasMatrix = true;
    parent.matrix = glm::scale(glm::translate(glm::mat4(1.0f), {1, 2, 3}), {-2, 2, 2});
    for (uint32_t axes = 1; axes <= kAll; ++axes) {
        EXPECT_LT(putBackError(c, 1, axes), 1e-12) << axes;
    }
    // A root deeper down, below nodes that move too: its own pose is put back, whoever moved it.
    EXPECT_LT(putBackError(walker(), 2, kAll), 1e-6);
}

TEST(RootMotion, TheRootStaysWhereTheClipStarts) {
    const cage::Character c = walker();
    Pose start, pose;
    sampleClip(c, c.clips[0], 0.0, start);
    for (const double time : {0.0, 0.4, 1.1, 2.0}) {
        sampleClip(c, c.clips[0], time, pose);
        const double height = pose.locals[1].translation.y;
        removeRootMotion(c, c.clips[0], {1, kRootGround | kRootYaw}, pose);
        EXPECT_NEAR(pose.locals[1].translation.x, start.locals[1].translation.x, 1e-12);
        EXPECT_NEAR(pose.locals[1].translation.z, start.locals[1].translation.z, 1e-12);
        EXPECT_NEAR(pose.locals[1].translation.y, height, 1e-12) << "not asked for";
        const glm::dquat turn = unit(pose.locals[1].rotation) * glm::conjugate(unit(start.locals[1].rotation));
        EXPECT_NEAR(turn.y, 0.0, 1e-12);
    }
}

TEST(RootMotion, StepsAddUpOverLoops) {
    const cage::Character c = walker();
    for (const uint32_t axes : {uint32_t{kRootGround}, kRootGround | kRootYaw, kAll}) {
        const RootSelection root{1, axes};
        glm::dmat4 steps(1.0);
        const double from = -3.3, step = 1.0 / 60.0;
        double time = from;
        for (int i = 0; i < 1000; ++i) {
            steps = steps * toMatrix(rootMotionBetween(c, c.clips[0], root, time, time + step, true));
            time += step;
        }
        const RootMotion once = rootMotionBetween(c, c.clips[0], root, from, time, true);
        EXPECT_LT(distance(steps, toMatrix(once)), 1e-10) << axes;
        // And back again.
        const RootMotion back = rootMotionBetween(c, c.clips[0], root, time, from, true);
        EXPECT_LT(distance(toMatrix(once) * toMatrix(back), glm::dmat4(1.0)), 1e-10);
    }
}

TEST(RootMotion, ALoopEndsWhereTheNextBegins) {
    const cage::Character c = walker();
    const RootSelection root{1, kRootGround | kRootYaw};
    const RootMotion whole = rootMotionBetween(c, c.clips[0], root, 0.0, 2.0, true);
    EXPECT_NEAR(whole.yaw, 120.0 * std::numbers::pi / 180.0, 1e-6);
    // Three loops of 120 degrees make a turn that ends where it began.
    const RootMotion three = rootMotionBetween(c, c.clips[0], root, 0.0, 6.0, true);
    EXPECT_NEAR(three.yaw, 0.0, 1e-6);
    EXPECT_LT(glm::length(three.translation), 1e-6);
    // A million loops of the straight walk.
    const RootMotion far = rootMotionBetween(c, c.clips[1], root, 0.25, 1e6 + 0.5, true);
    EXPECT_NEAR(far.translation.z, 4e6 + 1.0, 1e-3);
    EXPECT_EQ(far.translation.x, 0.0);
    // Across the seam.
    const RootMotion seam = rootMotionBetween(c, c.clips[1], root, 0.75, 1.25, true);
    EXPECT_NEAR(seam.translation.z, 2.0, 1e-12);
    // Without looping the clip's end is the end.
    EXPECT_NEAR(rootMotionBetween(c, c.clips[1], root, 0.75, 9.0, false).translation.z, 1.0, 1e-12);
    EXPECT_NEAR(rootMotionBetween(c, c.clips[1], root, -9.0, 0.25, false).translation.z, 1.0, 1e-12);
}

TEST(RootMotion, TurnsOfMoreThanHalfAreTakenStepByStep) {
    cage::Character c = walker();
    c.clips[1] = clipOf({channel(1, ChannelPath::rotation, {0, 1, 2, 3, 4}, aboutY({0, 90, 180, 270, 360}))});
    for (double time = 0.0; time < 8.0; time += 0.0625) {
        const RootMotion motion = rootMotionBetween(c, c.clips[1], {1, kRootYaw}, time, time + 0.0625, true);
        EXPECT_NEAR(motion.yaw, 0.0625 * std::numbers::pi / 2.0, 1e-6) << time;
    }
}

TEST(RootMotion, CrossfadesBlendMovements) {
    const cage::Character c = walker();
    const Rig rig = makeRig(c);
    EXPECT_EQ(rig.root, 1u);
    const RootSelection root{rig.root, kAll};
    Layer a, b;
    a.clip = &c.clips[0];
    b.clip = &c.clips[1];
    a.loop = b.loop = true;
    a.previousTime = 0.9;
    a.time = 1.0;
    b.previousTime = 0.95;
    b.time = 1.05;
    const RootMotion first = layerRootMotion(c, rig, a, root, {});
    const RootMotion second = layerRootMotion(c, rig, b, root, {});
    EXPECT_NEAR(second.translation.z, 0.4, 1e-12);
    b.weight = 0.25;
    const RootMotion mixed = layerRootMotion(c, rig, b, root, first);
    EXPECT_LT(glm::length(mixed.translation - (0.75 * first.translation + 0.25 * second.translation)), 1e-12);
    EXPECT_NEAR(mixed.yaw, 0.75 * first.yaw, 1e-12);
    b.weight = 1.0;
    EXPECT_EQ(layerRootMotion(c, rig, b, root, first).translation, second.translation) << "exactly the one clip's";
    b.weight = 0.0;
    EXPECT_EQ(layerRootMotion(c, rig, b, root, first).translation, first.translation);
    // A mask that spares the root spares its movement.
    const std::vector<float> mask = {0, 1, 1};
    b.weight = 1.0;
    b.jointMask = mask;
    EXPECT_EQ(layerRootMotion(c, rig, b, root, first).translation, first.translation);
    b.jointMask = {};
    b.mode = LayerMode::additive;
    b.weight = 0.5;
    EXPECT_LT(glm::length(layerRootMotion(c, rig, b, root, first).translation -
                          (first.translation + 0.5 * second.translation)),
              1e-12);
}

TEST(RootMotion, LayersAreAppliedInPlace) {
    const cage::Character c = walker();
    const Rig rig = makeRig(c);
    const RootSelection root{rig.root, kRootGround};
    Pose pose;
    LayerScratch scratch;
    restPose(c, pose);
    Layer own;
    own.clip = &c.clips[0];
    own.loop = true;
    own.time = 1.7;
    applyLayer(c, rig, own, root, scratch, pose);
    EXPECT_NEAR(pose.locals[1].translation.x, 1.0, 1e-12);
    EXPECT_NEAR(pose.locals[1].translation.z, 0.0, 1e-12);
    own.clip = &c.clips[1];
    own.weight = 0.5;
    applyLayer(c, rig, own, root, scratch, pose);
    EXPECT_NEAR(pose.locals[1].translation.x, 0.5, 1e-12) << "half way between the clips' starts";
    EXPECT_NEAR(pose.locals[1].translation.z, 0.0, 1e-12);
}

TEST(RootMotion, TheRootIsTheTopmostThatMoves) {
    cage::Character c = test::riggedTube();
    EXPECT_EQ(findRoot(c), cage::kNone);
    // Still channels do not make a root, nor do scales.
    c.clips.push_back(
        clipOf({channel(1, ChannelPath::translation, {0, 1}, {1, 2, 3, 1, 2, 3}),
                channel(1, ChannelPath::scale, {0, 1}, {1, 1, 1, 2, 2, 2}),
                channel(0, ChannelPath::translation, {0, 1}, {9, 9, 9, 1, 1, 1, 9, 9, 9, 9, 9, 9, 1, 1, 1, 9, 9, 9},
                        cage::Interpolation::cubicSpline)}));
    c.clips[0].channels[2].values = {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0};
    EXPECT_EQ(findRoot(c), cage::kNone);
    c.clips.push_back(clipOf({channel(3, ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 1, 0, 0, 0})}));
    EXPECT_EQ(findRoot(c), 3u);
    c.clips.push_back(clipOf({channel(2, ChannelPath::translation, {0, 1}, {0, 0, 0, 1, 0, 0})}));
    EXPECT_EQ(findRoot(c), 2u) << "over all clips";
    // A second moving branch with fewer joints below it.
    cage::Node other;
    other.parent = 0;
    c.skeleton.nodes.push_back(other);
    c.skeleton.parentsFirst.push_back(4);
    c.skin.joints.push_back(4);
    c.skin.inverseBinds.emplace_back(1.0f);
    c.clips.push_back(clipOf({channel(4, ChannelPath::translation, {0, 1}, {0, 0, 0, 1, 0, 0})}));
    EXPECT_EQ(findRoot(c), 2u);
    EXPECT_EQ(rootMotionBetween(c, c.clips[0], {cage::kNone, kAll}, 0.0, 1.0, true).translation, glm::dvec3(0.0));
}

} // namespace
} // namespace supple::skinning
