// Pose drivers on the device: the words of the CPU's, in groups of all sources of poses that carry joints.
#include "cage/gltf/reader.h"
#include "tests/support/allocation_count.h"
#include "tests/support/limited_device.h"
#include "tests/support/played_group.h"
#include "tests/support/recordings.h"
#include "tests/support/spring_files.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

const std::string kArm = std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb";
constexpr uint32_t kArmTargets = 5; // bend 45, bend 90, bend 135, twist left, twist right
constexpr uint32_t kBendClip = 0, kTwistClip = 1;
using ArmWeights = std::vector<float>;

class Drivers : public CrowdContexts {};

cage::Character readArm() {
    Result<cage::Character> read = cage::readGltfFile(kArm);
    EXPECT_TRUE(read.ok());
    EXPECT_EQ(read->drivers.size(), 2u);
    return std::move(*read);
}

/// What a slot's pose has of morph weights.
ArmWeights weightsOf(const runtime::Group& group, const std::vector<float>& poses, uint32_t slot) {
    const skinning::PoseLayout& layout = group.instances().poseLayout();
    const float* const first = poses.data() + 4 * (size_t{slot} * layout.stride + layout.morphWeights);
    return {first, first + layout.morphCount};
}
ArmWeights weightsOf(const PlayedGroup& stage, uint32_t i) {
    return weightsOf(stage.group(), stage.poses, stage.instances[i].slot);
}
void expectNear(const ArmWeights& found, const ArmWeights& wanted, float tolerance, const std::string& what = "") {
    ASSERT_EQ(found.size(), wanted.size());
    for (size_t t = 0; t < wanted.size(); ++t) {
        EXPECT_NEAR(found[t], wanted[t], tolerance) << what << " target " << t;
    }
}

TEST_F(Drivers, SetWhatTheArtistHasSetAtHerPoses) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
            PlayedGroup stage(own, playedGroup(own.asset(kArm), 4, 0, skinning));
            ASSERT_TRUE(stage.crowd.valid());
            stage.play(0, kBendClip, 0.5);
            stage.play(1, kBendClip, 1.0);
            stage.play(2, kBendClip, 1.5);
            EXPECT_EQ(stage.run(0.0), 0u) << "words that are others than the CPU's";
            for (uint32_t i = 0; i < 3; ++i) {
                ArmWeights wanted(kArmTargets, 0.0f);
                wanted[i] = 1.0f;
                expectNear(weightsOf(stage, i), wanted, 2e-6f, "bend " + std::to_string(i));
            }
            EXPECT_EQ(weightsOf(stage, 3), ArmWeights(kArmTargets, 0.0f)) << "in the bind pose nothing is turned";
            for (uint32_t i = 0; i < 4; ++i) {
                stage.play(i, kTwistClip, 0.5 * i);
            }
            EXPECT_EQ(stage.run(0.0), 0u);
            expectNear(weightsOf(stage, 0), {0, 0, 0, 0, 0}, 2e-6f);
            expectNear(weightsOf(stage, 1), {0, 0, 0, 1, 0}, 2e-6f);
            expectNear(weightsOf(stage, 3), {0, 0, 0, 0, 1}, 2e-6f);
        }
    }
}

/// Plays all that instances can do, on six instances.
void playAll(const PlayedGroup& stage) {
    SupplePlaybackLayer layers[] = {PlayedGroup::loops(kBendClip, 0.3), PlayedGroup::loops(kTwistClip, 0.2),
                                    PlayedGroup::loops(kBendClip, 1.1)};
    layers[1].mode = SUPPLE_LAYER_ADDITIVE;
    stage.play(0, layers);
    layers[1].mode = SUPPLE_LAYER_BLEND;
    layers[1].weight = 0.4f;
    stage.play(1, layers);
    stage.play(2, kBendClip, 0.9);
    stage.play(3, kTwistClip, 0.7);
    stage.play(4, kBendClip, 0.1);
    const float weights[kArmTargets] = {0.25f, -0.5f, 0.0f, 0.125f, 2.0f};
    EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[2], weights, kArmTargets), SUPPLE_OK);
    stage.place(3, glm::rotate(glm::mat4(1.0f), 1.0f, glm::vec3(0.3f, 1.0f, 0.2f)));
}

TEST_F(Drivers, HaveTheWordsOfTheCpuWhateverIsPlayed) {
    const ValidationGuard guard;
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext* const contexts[] = {&context(SUPPLE_MAPPING_NARROW), &context(SUPPLE_MAPPING_WIDE), &shared};
    std::vector<std::vector<float>> first;
    for (CrowdContext* const own : contexts) {
        PlayedGroup stage(*own, playedGroup(own->asset(kArm), 6, SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS));
        ASSERT_TRUE(stage.crowd.valid());
        playAll(stage);
        SuppleModifier turn{};
        turn.kind = SUPPLE_MODIFIER_ADD;
        turn.joint = stage.joint("forearm");
        turn.weight = 1.0f;
        turn.rotation[2] = 0.3826834f;
        turn.rotation[3] = 0.9238795f;
        stage.modify(4, turn); // 45 degrees
        std::vector<std::vector<float>> shown;
        for (uint32_t f = 0; f < 12; ++f) {
            if (f == 5) {
                SupplePlaybackLayer layer = PlayedGroup::loops(kTwistClip, 0.1);
                layer.startTime = 0.17 * f;
                SupplePlaybackDesc desc{};
                desc.transition = 0.4;
                stage.play(0, {&layer, 1}, desc);
            }
            EXPECT_EQ(stage.run(0.17 * f), 0u) << f;
            shown.push_back(stage.poses);
        }
        first = first.empty() ? shown : first;
        EXPECT_EQ(shown, first);
    }
}

TEST_F(Drivers, LookAtWhatModifiersLeave) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PlayedGroup stage(own, playedGroup(own.asset(kArm), 1, SUPPLE_GROUP_MODIFIERS));
    stage.play(0, kTwistClip, 0.0);
    SuppleModifier turn{};
    turn.kind = SUPPLE_MODIFIER_ADD;
    turn.joint = stage.joint("forearm");
    turn.weight = 1.0f;
    turn.rotation[2] = turn.rotation[3] = 0.70710678f;
    stage.modify(0, turn);
    EXPECT_EQ(stage.run(0.0), 0u);
    expectNear(weightsOf(stage, 0), {0, 1, 0, 0, 0}, 2e-6f);
}

TEST_F(Drivers, AddToWhatTheHostHasSet) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    for (const uint32_t flags : {0u, uint32_t{SUPPLE_GROUP_UPDATE_RATES}}) {
        PlayedGroup stage(own, playedGroup(own.asset(kArm), 1, flags));
        SupplePlaybackDesc desc{};
        desc.updateInterval = flags != 0 ? 4 : 0;
        stage.play(0, kBendClip, 0.0, desc);
        const float weights[kArmTargets] = {0.25f, -0.5f, 0.0f, 0.125f, 2.0f};
        EXPECT_EQ(stage.run(0.0), 0u);
        EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[0], weights, kArmTargets), SUPPLE_OK);
        EXPECT_EQ(stage.run(1.0), 0u);
        expectNear(weightsOf(stage, 0), {0.25f, 0.5f, 0.0f, 0.125f, 2.0f}, flags != 0 ? 1e-2f : 2e-6f,
                   "with the host's");
        EXPECT_EQ(stage.run(1.01), 0u);
        EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[0], nullptr, 0), SUPPLE_OK);
        EXPECT_EQ(stage.run(1.011), 0u);
        expectNear(weightsOf(stage, 0), {0, 1, 0, 0, 0}, 5e-2f, "without");
    }
}

TEST_F(Drivers, GoWithUpdateRatesAndSprings) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        PlayedGroup rated(own, playedGroup(own.asset(kArm), 4, SUPPLE_GROUP_UPDATE_RATES));
        for (uint32_t i = 0; i < 4; ++i) {
            SupplePlaybackDesc desc{};
            desc.updateInterval = 1u << i;
            rated.play(i, kBendClip, 0.1 * i, desc);
        }
        for (uint32_t f = 0; f < 20; ++f) {
            EXPECT_EQ(rated.run(0.5 + 0.013 * f), 0u) << f;
        }
        EXPECT_GT(weightsOf(rated, 3)[1], 0.1f);

        // The hand swings: drivers look at the forearm alone.
        cage::Character bending = readArm();
        bending.drivers.pop_back();
        const Result<cage::GlbFile> glb = cage::writeGlb(bending);
        ASSERT_TRUE(glb.ok());
        const std::vector<std::byte> bytes =
            withExtensions(glb->bytes, R"("VRMC_springBone":{"springs":[{"joints":[{"node":1},{"node":2}]}]})");
        const SuppleAsset refused = own.createAsset(bytes, "arm"); // it reads the forearm, which swings: left out
        PlayedGroup none(own, playedGroup(refused, 1, SUPPLE_GROUP_SPRINGS));
        none.play(0, kBendClip, 1.0);
        none.crowd.context().run(none.crowd.group());
        EXPECT_FALSE(none.group().poses().playback()->hasDrivers());
        EXPECT_TRUE(none.group().poses().playback()->hasSprings()) << "a .glb may have springs as well as a .vrm";

        const SuppleAsset swings = own.createAsset(
            withExtensions(glb->bytes, R"("VRMC_springBone":{"springs":[{"joints":[{"node":0},{"node":1}]}]})"), "arm");
        PlayedGroup both(own, playedGroup(swings, 2, SUPPLE_GROUP_SPRINGS));
        both.play(0, kBendClip, 0.9);
        both.play(1, kBendClip, 0.2);
        for (uint32_t f = 0; f < 9; ++f) {
            EXPECT_EQ(suppleSetTime(both.handle(), both.crowd.group(), 0.03 * f), SUPPLE_OK);
            both.crowd.context().run(both.crowd.group());
            both.poses = as<float>(both.crowd.read(both.crowd.output().info.poses));
            for (uint32_t i = 0; i < 2; ++i) {
                const skinning::PoseLayout& layout = both.group().instances().poseLayout();
                std::vector<glm::vec4> pose(layout.stride);
                both.group().poses().playback()->writePose(both.instances[i].slot, pose);
                const float* const here = &pose[layout.morphWeights].x;
                EXPECT_EQ(weightsOf(both, i), ArmWeights(here, here + kArmTargets)) << f;
            }
        }
        EXPECT_GT(weightsOf(both, 0)[1], 0.5f);
    }
}

TEST_F(Drivers, GoInWindowsOfInstances) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        LimitedDevice limited(mapping, [](WrappedVulkan& says) { says.maxStorageBufferRange = 1u << 18; });
        ASSERT_NE(limited.context(), nullptr);
        constexpr uint32_t kCount = 150;
        PlayedGroup stage(*limited.context(),
                          playedGroup(limited.context()->asset(kArm), kCount, SUPPLE_GROUP_WINDOWS));
        ASSERT_TRUE(stage.crowd.valid());
        EXPECT_GT(stage.group().windows().count(), 1u);
        for (uint32_t i = 0; i < kCount; ++i) {
            stage.play(i, i % 2, 0.013 * i);
        }
        EXPECT_EQ(stage.run(0.4), 0u);
    }
}

/// Instances whose poses the host sets.
class SetGroup {
public:
    SetGroup(CrowdContext& context, SuppleAsset asset, uint32_t capacity, uint32_t flags = 0)
        : crowd(context, descOf(asset, capacity, flags)) {
        for (uint32_t i = 0; i < capacity; ++i) {
            instances.push_back(crowd.spawn());
        }
    }
    [[nodiscard]] SuppleContext handle() const { return crowd.context().handle(); }
    [[nodiscard]] ArmWeights weights(uint32_t i) {
        crowd.context().run(crowd.group());
        const runtime::Group& own = *handle()->context->groups.find(crowd.group().id);
        return weightsOf(own, as<float>(crowd.read(crowd.output().info.poses)), instances[i].slot);
    }
    void setClip(uint32_t i, uint32_t clip, double time) {
        EXPECT_EQ(suppleSetClipPose(handle(), instances[i], clip, time), SUPPLE_OK);
    }

    Crowd crowd;
    std::vector<SuppleInstance> instances;

private:
    static SuppleGroupDesc descOf(SuppleAsset asset, uint32_t capacity, uint32_t flags) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = capacity;
        desc.flags = flags;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        return desc;
    }
};

TEST_F(Drivers, FollowPosesThatTheHostSets) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    for (const uint32_t flags : {0u, uint32_t{SUPPLE_GROUP_MODIFIERS}}) {
        SetGroup stage(own, own.asset(kArm), 2, flags);
        ASSERT_TRUE(stage.crowd.valid());
        EXPECT_EQ(stage.weights(0), ArmWeights(kArmTargets, 0.0f)) << "the bind pose";
        stage.setClip(0, kBendClip, 1.0);
        expectNear(stage.weights(0), {0, 1, 0, 0, 0}, 2e-6f, "a clip");
        const float weights[kArmTargets] = {0.25f, -0.5f, 0.0f, 0.125f, 2.0f};
        EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[0], weights, kArmTargets), SUPPLE_OK);
        expectNear(stage.weights(0), {0.25f, 0.5f, 0.0f, 0.125f, 2.0f}, 2e-6f, "and the host's weights");
        EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[0], nullptr, 0), SUPPLE_OK);

        SuppleClipLayer layers[2]{};
        layers[0].clip = kBendClip;
        layers[1].clip = kTwistClip;
        layers[0].time = 1.5;
        layers[1].time = 0.5;
        layers[0].weight = layers[1].weight = 1.0f;
        layers[1].mode = SUPPLE_LAYER_ADDITIVE;
        SupplePoseDesc pose{};
        pose.structSize = sizeof pose;
        pose.layers = layers;
        pose.layerCount = 2;
        EXPECT_EQ(suppleSetPose(stage.handle(), stage.instances[0], &pose), SUPPLE_OK);
        expectNear(stage.weights(0), {0, 0, 1, 1, 0}, 2e-6f, "layers");

        // The same joints as matrices.
        std::vector<float> matrices(size_t{16} * 3);
        for (uint32_t j = 0; j < 3; ++j) {
            EXPECT_EQ(suppleGetJointTransform(stage.handle(), stage.instances[0], j, &matrices[size_t{16} * j]),
                      SUPPLE_OK);
        }
        EXPECT_EQ(suppleSetMatrixPose(stage.handle(), stage.instances[1], matrices.data(), 3), SUPPLE_OK);
        expectNear(stage.weights(1), {0, 0, 1, 1, 0}, 3e-6f, "matrices");
        stage.setClip(0, SUPPLE_REST_POSE, 0.0);
        expectNear(stage.weights(0), ArmWeights(kArmTargets, 0.0f), 2e-6f, "the rest pose");
    }
}

TEST_F(Drivers, HostPosesWithModifiersAndPlayedOnesAgree) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    SetGroup stage(own, own.asset(kArm), 1, SUPPLE_GROUP_MODIFIERS);
    PlayedGroup played(own, playedGroup(own.asset(kArm), 1, SUPPLE_GROUP_MODIFIERS));
    SuppleModifier turn{};
    turn.kind = SUPPLE_MODIFIER_ADD;
    turn.joint = played.joint("forearm");
    turn.weight = 1.0f;
    turn.rotation[2] = 0.25881905f;
    turn.rotation[3] = 0.96592583f;
    SuppleModifiersDesc desc{};
    desc.structSize = sizeof desc;
    desc.modifiers = &turn;
    desc.modifierCount = 1;
    EXPECT_EQ(suppleSetModifiers(stage.handle(), stage.instances[0], &desc), SUPPLE_OK);
    stage.setClip(0, kBendClip, 0.8);
    played.modify(0, turn);
    played.play(0, kBendClip, 0.8);
    EXPECT_EQ(played.run(0.0), 0u);
    expectNear(stage.weights(0), weightsOf(played, 0), 2e-6f);
    EXPECT_GT(weightsOf(played, 0)[1], 0.5f);
}

TEST_F(Drivers, AreThoseOfTheNewVersionOfAnAsset) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    cage::Character arm = readArm();
    const SuppleAsset asset = own.createAsset(arm);
    SetGroup set(own, asset, 2);
    PlayedGroup played(own, playedGroup(asset, 1, 0));
    set.setClip(0, kBendClip, 1.0);
    played.play(0, kBendClip, 1.0);
    EXPECT_EQ(played.run(0.0), 0u);
    expectNear(set.weights(0), {0, 1, 0, 0, 0}, 2e-6f);
    for (float& value : arm.drivers[0].values) {
        value *= 0.5f;
    }
    EXPECT_EQ(own.reloadAsset(asset, arm), SUPPLE_OK);
    EXPECT_EQ(played.run(0.0), 0u);
    expectNear(weightsOf(played, 0), {0, 0.5f, 0, 0, 0}, 2e-6f, "what plays");
    expectNear(set.weights(0), {0, 0.5f, 0, 0, 0}, 3e-6f, "what the host has set");
    EXPECT_EQ(set.weights(1), ArmWeights(kArmTargets, 0.0f)) << "in the bind pose";
    arm.drivers.clear();
    EXPECT_EQ(own.reloadAsset(asset, arm), SUPPLE_OK);
    EXPECT_EQ(played.run(0.0), 0u);
    EXPECT_EQ(weightsOf(played, 0), ArmWeights(kArmTargets, 0.0f));
    EXPECT_EQ(set.weights(0), ArmWeights(kArmTargets, 0.0f));
    EXPECT_FALSE(played.group().poses().playback()->has(runtime::Playback::Part::drivers))
        << "who has none pays nothing";
    EXPECT_EQ(own.reloadAsset(asset, readArm()), SUPPLE_OK);
    EXPECT_TRUE(played.group().poses().playback()->has(runtime::Playback::Part::drivers));
    EXPECT_EQ(suppleSetCapacity(own.handle(), set.crowd.group(), 7), SUPPLE_OK);
    expectNear(set.weights(0), {0, 1, 0, 0, 0}, 3e-6f, "after a change of capacity");
}

TEST_F(Drivers, AreRecorded) {
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
    PlayedGroup stage(own, playedGroup(own.asset(kArm), 6, SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS));
    SetGroup set(own, own.asset(kArm), 1);
    Recorded recorded;
    own.beginFrame();
    ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
    playAll(stage);
    for (uint32_t f = 0; f < 5; ++f) {
        EXPECT_EQ(stage.run(0.2 * f), 0u);
        set.setClip(0, kBendClip, 0.3 * f);
        (void)set.weights(0);
    }
    own.beginFrame();
    own.beginFrame();
    EXPECT_EQ(suppleStopRecording(own.handle()), SUPPLE_OK);
    const Hashes hashes = read(recorded.bytes).hashes;
    EXPECT_GT(hashes.size(), 10u);
    for (const SuppleMapping mapping : kMappings) {
        tools::Replayer::Options options;
        options.mapping = mapping;
        EXPECT_EQ(expectSame(hashes, replay(*testDevice(), recorded.bytes, options)), hashes.size());
    }
}

TEST_F(Drivers, AllocateNothingInFrames) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SetGroup set(own, own.asset(kArm), 2);
    PlayedGroup played(own, playedGroup(own.asset(kArm), 2, SUPPLE_GROUP_UPDATE_RATES));
    std::vector<float> matrices(size_t{16} * 3);
    for (uint32_t j = 0; j < 3; ++j) {
        EXPECT_EQ(suppleGetJointTransform(set.handle(), set.instances[0], j, &matrices[size_t{16} * j]), SUPPLE_OK);
    }
    played.play(0, kBendClip, 0.2);
    EXPECT_EQ(played.run(0.0), 0u);
    (void)set.weights(0);
    const float weights[kArmTargets] = {0.25f, -0.5f, 0.0f, 0.125f, 2.0f};
    bool good = true;
    const uint64_t before = allocationsCounted();
    for (int i = 0; i < 20; ++i) {
        const AllocationCount count;
        good = good && suppleSetClipPose(set.handle(), set.instances[0], kBendClip, 0.05 * i) == SUPPLE_OK;
        good = good && suppleSetMatrixPose(set.handle(), set.instances[1], matrices.data(), 3) == SUPPLE_OK;
        good = good && suppleSetMorphWeights(set.handle(), set.instances[0], weights, kArmTargets) == SUPPLE_OK;
        good = good && suppleSetMorphWeights(played.handle(), played.instances[0], weights, kArmTargets) == SUPPLE_OK;
        float m[16];
        good = good && suppleGetJointTransform(played.handle(), played.instances[0], 1, m) == SUPPLE_OK;
    }
    EXPECT_TRUE(good);
    EXPECT_EQ(allocationsCounted(), before);
}

} // namespace
} // namespace supple::test
