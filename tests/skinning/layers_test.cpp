// Clip layers: what weights, masks, loops and additive clips do to a pose.
#include "skinning/layers.h"

#include "skinning/rotation.h"
#include "tests/support/rigged_tube.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using test::channel;
using test::clipOf;
using test::Noise;

/// A tube with two clips of noise over all joints, node 0 and the morph weights.
cage::Character tubeWithClips() {
    test::TubeOptions options;
    options.joints = 4;
    options.morphTargets = 5;
    cage::Character character = test::riggedTube(options);
    character.morphs.weights = {0.1f, 0.2f, 0.0f, -0.3f, 1.0f};
    Noise noise(11);
    for (int c = 0; c < 2; ++c) {
        std::vector<cage::Channel> channels;
        const std::vector<float> times = {0.0f, 0.4f, 1.5f};
        for (uint32_t node = 0; node < character.skeleton.nodes.size(); ++node) {
            std::vector<float> translations, rotations, scales;
            for (size_t k = 0; k < times.size(); ++k) {
                for (int i = 0; i < 3; ++i) {
                    translations.push_back(3.0f * noise());
                    scales.push_back(1.0f + 0.5f * noise());
                }
                const glm::dquat q = unit({noise(), noise(), noise(), noise()});
                for (const double x : {q.x, q.y, q.z, q.w}) {
                    rotations.push_back(static_cast<float>(x));
                }
            }
            channels.push_back(channel(node, ChannelPath::translation, times, translations));
            channels.push_back(channel(node, ChannelPath::rotation, times, rotations));
            channels.push_back(channel(node, ChannelPath::scale, times, scales));
        }
        std::vector<float> weights;
        for (size_t i = 0; i < times.size() * 5; ++i) {
            weights.push_back(noise());
        }
        channels.push_back(channel(character.parts[0].node, ChannelPath::weights, times, weights));
        character.clips.push_back(clipOf(std::move(channels)));
    }
    return character;
}

class Layers : public testing::Test {
protected:
    Layers() { restPose(character, pose); }
    Layer layer(uint32_t clip, double time, double weight, LayerMode mode = LayerMode::blend) const {
        Layer result;
        result.clip = &character.clips[clip];
        result.time = time;
        result.weight = weight;
        result.mode = mode;
        return result;
    }
    void apply(const Layer& own) { applyLayer(character, rig, own, {}, scratch, pose); }
    Pose clipPose(uint32_t clip, double time) const {
        Pose result;
        sampleClip(character, character.clips[clip], time, result);
        return result;
    }

    const cage::Character character = tubeWithClips();
    const Rig rig = makeRig(character);
    LayerScratch scratch;
    Pose pose;
};

bool sameBits(const Pose& a, const Pose& b) {
    return std::memcmp(a.locals.data(), b.locals.data(), a.locals.size() * sizeof(Transform)) == 0 &&
           std::memcmp(a.morphWeights.data(), b.morphWeights.data(), a.morphWeights.size() * sizeof(double)) == 0;
}

double angle(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(unit(a)) * unit(b);
    return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

TEST_F(Layers, EndsOfACrossfadeAreTheClips) {
    apply(layer(0, 0.3, 1.0));
    EXPECT_TRUE(sameBits(pose, clipPose(0, 0.3)));
    apply(layer(1, 0.9, 0.0));
    EXPECT_TRUE(sameBits(pose, clipPose(0, 0.3))) << "weight 0";
    apply(layer(1, 0.9, 1.0));
    EXPECT_TRUE(sameBits(pose, clipPose(1, 0.9))) << "weight 1";
}

TEST_F(Layers, ACrossfadeGoesStraightAndAlongTheShorterArc) {
    const Pose a = clipPose(0, 0.3), b = clipPose(1, 0.9);
    apply(layer(0, 0.3, 1.0));
    apply(layer(1, 0.9, 0.25));
    for (size_t n = 0; n < pose.locals.size(); ++n) {
        const Transform &from = a.locals[n], &to = b.locals[n], &now = pose.locals[n];
        EXPECT_LT(glm::length(now.translation - (0.75 * from.translation + 0.25 * to.translation)), 1e-12);
        EXPECT_LT(glm::length(now.scale - (0.75 * from.scale + 0.25 * to.scale)), 1e-12);
        EXPECT_NEAR(glm::length(now.rotation), 1.0, 1e-12);
        const double whole = angle(from.rotation, to.rotation);
        EXPECT_LE(whole, 3.1415927);
        EXPECT_NEAR(angle(from.rotation, now.rotation), 0.25 * whole, 1e-7);
        EXPECT_NEAR(angle(now.rotation, to.rotation), 0.75 * whole, 1e-7);
    }
    for (size_t t = 0; t < 5; ++t) {
        EXPECT_NEAR(pose.morphWeights[t], 0.75 * a.morphWeights[t] + 0.25 * b.morphWeights[t], 1e-15);
    }
}

TEST_F(Layers, NodesAClipLeavesAloneAreBlendedTowardsTheirRest) {
    cage::Character part = character;
    part.clips[1].channels.resize(1); // node 0's translation
    Pose rest, now;
    restPose(part, rest);
    restPose(part, now);
    Layer own = layer(0, 0.3, 1.0);
    own.clip = &part.clips[0];
    applyLayer(part, rig, own, {}, scratch, now);
    own.clip = &part.clips[1];
    applyLayer(part, rig, own, {}, scratch, now);
    for (size_t n = 1; n < now.locals.size(); ++n) {
        EXPECT_EQ(now.locals[n].translation, rest.locals[n].translation);
    }
    EXPECT_NE(now.locals[0].translation, rest.locals[0].translation);
    EXPECT_EQ(now.morphWeights, rest.morphWeights) << "the file's weights";
}

TEST_F(Layers, AMaskChoosesJointsAndLeavesMorphsAlone) {
    std::vector<float> mask(4, 0.0f);
    fillJointMask(rig, 2, 1.0f, mask);
    EXPECT_EQ(mask, (std::vector<float>{0, 0, 1, 1}));
    fillJointMask(rig, 3, 0.5f, mask);
    EXPECT_EQ(mask, (std::vector<float>{0, 0, 1, 0.5f}));
    apply(layer(0, 0.3, 1.0));
    Layer masked = layer(1, 0.9, 1.0);
    masked.jointMask = mask;
    apply(masked);
    const Pose a = clipPose(0, 0.3), b = clipPose(1, 0.9);
    const auto same = [](const Transform& x, const Transform& y) { return std::memcmp(&x, &y, sizeof(x)) == 0; };
    // Node 0 is above all joints: the first joint's mask counts.
    EXPECT_TRUE(same(pose.locals[0], a.locals[0]));
    EXPECT_TRUE(same(pose.locals[1], a.locals[1]));
    EXPECT_TRUE(same(pose.locals[2], a.locals[2]));
    EXPECT_TRUE(same(pose.locals[3], b.locals[3]));
    EXPECT_LT(glm::length(pose.locals[4].translation - 0.5 * (a.locals[4].translation + b.locals[4].translation)),
              1e-12);
    EXPECT_EQ(pose.morphWeights, a.morphWeights);

    const std::vector<float> morphMask = {1, 0, 0.5f, 0, 0};
    masked.morphMask = morphMask;
    apply(masked);
    EXPECT_EQ(pose.morphWeights[0], b.morphWeights[0]);
    EXPECT_EQ(pose.morphWeights[1], a.morphWeights[1]);
    EXPECT_NEAR(pose.morphWeights[2], 0.5 * (a.morphWeights[2] + b.morphWeights[2]), 1e-15);
}

TEST_F(Layers, NodesThatAreNoJointsFollowTheirJoints) {
    // rig > hips (joint 1) > twist (none) > chest (joint 0); rig > prop (none).
    cage::Character c;
    c.skeleton.nodes.resize(5);
    c.skeleton.nodes[1].parent = 0;
    c.skeleton.nodes[2].parent = 1;
    c.skeleton.nodes[3].parent = 2;
    c.skeleton.nodes[4].parent = 0;
    c.skeleton.parentsFirst = {0, 4, 1, 2, 3};
    c.skin.joints = {3, 1};
    const Rig own = makeRig(c);
    EXPECT_EQ(own.maskJoints, (std::vector<uint32_t>{1, 1, 1, 0, cage::kNone}));
    EXPECT_EQ(own.jointParents, (std::vector<uint32_t>{1, cage::kNone}));
    EXPECT_EQ(own.root, cage::kNone) << "no clip moves anything";
}

TEST_F(Layers, AnAdditiveClipAtItsReferenceIsNothing) {
    apply(layer(0, 0.3, 1.0));
    for (const double time : {0.0, 0.7}) {
        Layer own = layer(1, time, 1.0, LayerMode::additive);
        own.referenceTime = time;
        apply(own);
        EXPECT_TRUE(sameBits(pose, clipPose(0, 0.3))) << time;
    }
}

TEST_F(Layers, AnAdditiveClipOnItsReferenceIsTheClip) {
    // Reference pose + (sample - reference) = sample.
    apply(layer(1, 0.2, 1.0));
    Layer own = layer(1, 1.1, 1.0, LayerMode::additive);
    own.referenceTime = 0.2;
    apply(own);
    const Pose wanted = clipPose(1, 1.1);
    for (size_t n = 0; n < pose.locals.size(); ++n) {
        EXPECT_LT(glm::length(pose.locals[n].translation - wanted.locals[n].translation), 1e-12);
        EXPECT_LT(angle(pose.locals[n].rotation, wanted.locals[n].rotation), 1e-7);
        EXPECT_LT(glm::length(pose.locals[n].scale - wanted.locals[n].scale), 1e-12);
    }
    for (size_t t = 0; t < 5; ++t) {
        EXPECT_NEAR(pose.morphWeights[t], wanted.morphWeights[t], 1e-15);
    }
}

TEST_F(Layers, AdditiveFollowsItsFormula) {
    apply(layer(0, 0.3, 1.0));
    const Pose before = pose, sample = clipPose(1, 1.1), reference = clipPose(1, 0.0);
    const double weight = -1.5; // any size and sign
    apply(layer(1, 1.1, weight, LayerMode::additive));
    for (size_t n = 0; n < pose.locals.size(); ++n) {
        const Transform &s = sample.locals[n], &r = reference.locals[n], &b = before.locals[n], &now = pose.locals[n];
        EXPECT_LT(glm::length(now.translation - (b.translation + weight * (s.translation - r.translation))), 1e-12);
        EXPECT_LT(glm::length(now.scale - b.scale * (1.0 + weight * (s.scale / r.scale - 1.0))), 1e-12);
        // The joint turns in its own frame: by the difference's axis, its angle times the weight.
        glm::dquat difference = glm::inverse(unit(r.rotation)) * unit(s.rotation);
        difference = difference.w < 0.0 ? -difference : difference;
        const glm::dquat wanted =
            unit(b.rotation) * glm::angleAxis(weight * glm::angle(difference), glm::axis(difference));
        EXPECT_LT(angle(now.rotation, wanted), 1e-7);
    }
}

TEST_F(Layers, AScaleOfNothingIsNoReference) {
    cage::Character c = character;
    c.clips[0] = clipOf({channel(1, ChannelPath::scale, {0, 1}, {0, 1, 1, 2, 2, 1})});
    Layer own = layer(0, 1.0, 1.0, LayerMode::additive);
    own.clip = &c.clips[0];
    applyLayer(c, rig, own, {}, scratch, pose);
    EXPECT_EQ(pose.locals[1].scale, glm::dvec3(1, 2, 1));
}

TEST_F(Layers, LoopingTimesWrapAndOthersAreClamped) {
    Layer own = layer(0, 1.5 + 0.3, 1.0);
    apply(own);
    EXPECT_TRUE(sameBits(pose, clipPose(0, 1.5))) << "clamped";
    own.loop = true;
    for (const double time : {1.5 + 0.375, 15.0 + 0.375, -1.5 + 0.375, -150.0 + 0.375}) {
        own.time = time;
        apply(own);
        EXPECT_TRUE(sameBits(pose, clipPose(0, 0.375))) << time;
    }
    own.time = 1.5;
    apply(own);
    EXPECT_TRUE(sameBits(pose, clipPose(0, 0.0))) << "the end is the beginning";
    own.time = -1e-300;
    apply(own);
    EXPECT_TRUE(sameBits(pose, clipPose(0, 0.0)));
}

TEST_F(Layers, ALoopWhoseEndsMeetHasNoSeam) {
    cage::Character c = character;
    // A full turn in four steps, and back where it began.
    const float h = std::sqrt(0.5f);
    c.clips[0] = clipOf({channel(2, ChannelPath::rotation, {0, 1, 2, 3, 4},
                                 {0, 0, 0, 1, h, 0, 0, h, 1, 0, 0, 0, h, 0, 0, -h, 0, 0, 0, -1}),
                         channel(2, ChannelPath::translation, {0, 2, 4}, {0, 0, 0, 0, 1, 0, 0, 0, 0})});
    Layer own = layer(0, 0.0, 1.0);
    own.clip = &c.clips[0];
    own.loop = true;
    Pose last = pose;
    const double step = 1.0 / 256.0;
    for (int i = 0; i <= 4096; ++i) {
        own.time = -8.0 + i * step;
        applyLayer(c, rig, own, {}, scratch, pose);
        if (i > 0) {
            EXPECT_NEAR(angle(last.locals[2].rotation, pose.locals[2].rotation), 1.5707963 * step, 1e-6) << own.time;
            EXPECT_NEAR(glm::length(last.locals[2].translation - pose.locals[2].translation), 0.5 * step, 1e-9);
        }
        last = pose;
    }
}

TEST_F(Layers, AClipOfNoLengthLoopsInPlace) {
    cage::Character c = character;
    c.clips[0] = clipOf({channel(1, ChannelPath::translation, {0}, {1, 2, 3})});
    Layer own = layer(0, 123.0, 1.0);
    own.clip = &c.clips[0];
    own.loop = true;
    applyLayer(c, rig, own, {}, scratch, pose);
    EXPECT_EQ(pose.locals[1].translation, glm::dvec3(1, 2, 3));
}

TEST(MorphWeights, AreSampledAsAnyProperty) {
    cage::Character c = test::riggedTube({.morphTargets = 2});
    c.morphs.weights = {0.25f, 0.5f};
    const auto at = [&](std::vector<float> values, cage::Interpolation interpolation, double time) {
        const cage::Clip clip =
            clipOf({channel(c.parts[0].node, ChannelPath::weights, {1, 3}, std::move(values), interpolation)});
        Pose pose;
        sampleClip(c, clip, time, pose);
        return pose.morphWeights;
    };
    using Weights = std::vector<double>;
    EXPECT_EQ(at({0, 1, 1, 3}, cage::Interpolation::linear, 0.0), (Weights{0, 1}));
    EXPECT_EQ(at({0, 1, 1, 3}, cage::Interpolation::linear, 1.5), (Weights{0.25, 1.5}));
    EXPECT_EQ(at({0, 1, 1, 3}, cage::Interpolation::linear, 9.0), (Weights{1, 3}));
    EXPECT_EQ(at({0, 1, 1, 3}, cage::Interpolation::step, 2.99), (Weights{0, 1}));
    // In-tangents, values, out-tangents of a key, each one a target; two seconds between the keys.
    const Weights cubic = at({9, 9, 0, 1, 2, 0, 0, 4, 1, 3, 9, 9}, cage::Interpolation::cubicSpline, 2.0);
    EXPECT_NEAR(cubic[0], 0.5 * 0 + 0.125 * 2 * 2 + 0.5 * 1 - 0.125 * 2 * 0, 1e-12);
    EXPECT_NEAR(cubic[1], 0.5 * 1 + 0.125 * 2 * 0 + 0.5 * 3 - 0.125 * 2 * 4, 1e-12);
    Pose rest;
    restPose(c, rest);
    EXPECT_EQ(rest.morphWeights, (Weights{0.25, 0.5}));
}

} // namespace
} // namespace supple::skinning
