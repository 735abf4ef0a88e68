// What an instance plays, on the CPU: the state that the device reads, read back; layers at a time; whole poses;
// travel. That the device does the same is tested in tests/runtime/playback_test.cpp.
#include "skinning/joints.h"
#include "skinning/played_pose.h"
#include "tests/support/rigged_tube.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using test::channel;
using test::clipOf;

class PlayedPose : public testing::Test {
protected:
    PlayedPose() : character(test::riggedTube({.segments = 4, .sides = 4, .joints = 3})) {
        character.clips.push_back(
            clipOf({channel(1, ChannelPath::translation, {0, 1, 2}, {0, 0, 0, 1, 0.5f, 0, 2, 0, 0.25f}),
                    channel(2, ChannelPath::rotation, {0, 2}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f})}));
        character.clips.push_back(clipOf({channel(2, ChannelPath::scale, {0, 1.5f}, {1, 1, 1, 2, 1, 0.5f}),
                                          channel(3, ChannelPath::translation, {0, 1}, {1, 0, 0, 0, 3, 0})}));
        rig = makeRig(character);
        table = buildClipTable(character);
        words.resize(4 * size_t{PlaybackState::elements(0)});
        memory = PoseMemory(character);
    }

    cage::Character character;
    Rig rig;
    ClipTable table;
    std::vector<uint32_t> words;
    PoseMemory memory;
};

TEST_F(PlayedPose, TheStateTellsWhatWasSet) {
    PlaybackLayer layers[2];
    layers[0] = {.clip = 1,
                 .mode = LayerMode::additive,
                 .mask = 3,
                 .weight = -0.5f,
                 .fadeWeight = 2.0f,
                 .fadeStart = 1e6 + 0.123456,
                 .fadeDuration = 0.75f,
                 .start = 123456.789,
                 .offset = -7.125,
                 .speed = -3.5f,
                 .referenceTime = 0.3};
    layers[1] = {.clip = 0, .loop = true, .start = -1e9, .offset = 2e8 + 0.5};
    PlaybackState state(words);
    state.setBindPose();
    EXPECT_TRUE(state.inBindPose());
    const glm::mat4 transform = glm::translate(glm::rotate(glm::mat4(1.0f), 0.3f, {0, 1, 0}), {1, 2, 3});
    state.setTransform(transform);
    state.set(character, table, {layers, {1, kRootGround | kRootYaw}, true});
    EXPECT_FALSE(state.inBindPose());
    EXPECT_EQ(state.transform(), transform);
    PlaybackState::Layers memoryOfLayers;
    const PlaybackDesc desc = state.read(table, memoryOfLayers);
    EXPECT_EQ(desc.root.node, 1u);
    EXPECT_EQ(desc.root.axes, kRootGround | kRootYaw);
    EXPECT_TRUE(desc.travels);
    ASSERT_EQ(desc.layers.size(), 2u);
    const PlaybackLayer &first = desc.layers[0], &second = desc.layers[1];
    EXPECT_EQ(first.clip, 1u);
    EXPECT_EQ(first.mode, LayerMode::additive);
    EXPECT_FALSE(first.loop);
    EXPECT_EQ(first.mask, 3u);
    EXPECT_EQ(first.weight, -0.5f);
    EXPECT_EQ(first.fadeWeight, 2.0f);
    EXPECT_EQ(first.fadeDuration, 0.75f);
    EXPECT_EQ(first.speed, -3.5f);
    EXPECT_EQ(first.offset, -7.125);
    EXPECT_NEAR(first.fadeStart, 1e6 + 0.123456, 1e-8);
    EXPECT_NEAR(first.start, 123456.789, 1e-9);
    EXPECT_NEAR(first.referenceTime, 0.3, 1e-14);
    EXPECT_TRUE(second.loop);
    EXPECT_EQ(second.mode, LayerMode::blend);
    EXPECT_EQ(second.start, -1e9);
    EXPECT_EQ(second.offset, 0.5) << "the whole loops of two seconds are left out";
    // Without a root nothing travels.
    state.set(character, table, {{}, {}, true});
    const PlaybackDesc none = state.read(table, memoryOfLayers);
    EXPECT_TRUE(none.layers.empty());
    EXPECT_EQ(none.root.node, cage::kNone);
    EXPECT_FALSE(none.travels);
}

TEST_F(PlayedPose, LayersFollowTheTime) {
    const std::vector<float> mask = {0.0f, 0.5f, 1.0f};
    PlaybackLayer layer{.clip = 1, .weight = 0.2f, .fadeWeight = 0.6f, .fadeStart = 10.0, .fadeDuration = 2.0f};
    layer.start = 4.0;
    layer.offset = 0.5;
    layer.speed = -2.0f;
    const struct {
        double time, clipTime, weight;
    } cases[] = {{4.0, 0.5, 0.2}, {10.0, -11.5, 0.2}, {11.0, -13.5, 0.4}, {12.0, -15.5, 0.6}, {1e6, -1999991.5, 0.6}};
    for (const auto& c : cases) {
        const Layer at = layerAt(character, layer, c.time, mask);
        EXPECT_EQ(at.clip, &character.clips[1]);
        EXPECT_EQ(at.time, c.clipTime);
        EXPECT_EQ(at.previousTime, 0.5);
        EXPECT_NEAR(at.weight, c.weight, 1e-7) << c.time;
        EXPECT_EQ(at.jointMask.data(), mask.data());
    }
    layer.fadeDuration = 0.0f;
    EXPECT_EQ(layerAt(character, layer, 12.0, {}).weight, static_cast<double>(0.2f)) << "no fade";
}

TEST_F(PlayedPose, IsThatOfTheLayersOfTheMoment) {
    const std::vector<float> masks = {1.0f, 1.0f, 1.0f, 0.0f, 0.5f, 1.0f};
    PlaybackLayer layers[2];
    layers[0] = {.clip = 0, .loop = true, .speed = 0.7f};
    layers[1] = {.clip = 1, .mask = 2, .weight = 0.8f, .offset = 0.1};
    PlaybackDesc desc{layers, {1, kRootGround}, true};
    const double time = 5.3;
    poseNodes(character, rig, desc, time, masks, memory);

    PoseMemory other(character);
    restPose(character, other.pose);
    const RootSelection root{1, kRootGround};
    const std::span<const float> second(masks.data() + 3, 3);
    applyLayer(character, rig, layerAt(character, layers[0], time, {}), root, other.scratch, other.pose);
    applyLayer(character, rig, layerAt(character, layers[1], time, second), root, other.scratch, other.pose);
    localMatrices(character.skeleton, other.pose, other.nodes);
    globalTransforms(character.skeleton, other.nodes, other.nodes);
    EXPECT_EQ(memory.nodes, other.nodes);
    std::vector<glm::mat4> joints(3);
    jointTransforms(character.skin, memory.nodes, joints);
    for (size_t j = 0; j < 3; ++j) {
        EXPECT_EQ(joints[j], memory.nodes[character.skin.joints[j]]);
    }

    const RootMotion moved = traveledBy(character, desc, time);
    const RootMotion wanted =
        rootMotionBetween(character, character.clips[0], root, 0.0, static_cast<double>(0.7f) * time, true);
    EXPECT_EQ(moved.translation, wanted.translation);
    EXPECT_GT(moved.translation.x, 1.0);
    desc.travels = false;
    EXPECT_EQ(traveledBy(character, desc, time).translation, glm::dvec3(0.0));
}

TEST_F(PlayedPose, JointFramesAreRestAndBind) {
    character.skeleton.nodes[2].translation += glm::vec3(0.0f, 1.0f, 0.0f);
    character.skin.inverseBinds[2] = glm::mat4(0.0f);
    const JointFrames frames = jointFrames(character);
    for (size_t j = 0; j < 2; ++j) {
        EXPECT_EQ(frames.bindIsSingular[j], 0);
        const glm::mat4 one = frames.bind[j] * character.skin.inverseBinds[j];
        EXPECT_EQ(one, glm::mat4(1.0f)) << "a translation";
    }
    EXPECT_EQ(frames.rest[1], glm::translate(frames.bind[1], {0, 1, 0}));
    EXPECT_EQ(frames.bindIsSingular[2], 1);
    EXPECT_EQ(frames.bind[2], frames.rest[2]);
    const glm::mat4 joint = frames.rest[1];
    EXPECT_EQ(placedJoint(glm::dmat4(1.0), joint), joint);
    EXPECT_EQ(placedJoint(glm::translate(glm::dmat4(1.0), {2, 0, 0}), joint)[3].x, joint[3].x + 2.0f);
}

} // namespace
} // namespace supple::skinning
