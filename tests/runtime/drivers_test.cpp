// Pose drivers on the device: the words of the CPU's, in groups of all sources of poses that carry joints.
#include "cage/gltf/reader.h"
#include "cage/solved_driver.h"
#include "skinning/reach.h"
#include "tests/support/allocation_count.h"
#include "tests/support/limited_device.h"
#include "tests/support/played_group.h"
#include "tests/support/recordings.h"
#include "tests/support/rigged_tube.h"
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
    const float half[] = {1.0f, 0.5f, 0.25f};
    SuppleMaskDesc mask{};
    mask.structSize = sizeof mask;
    mask.mask = layers[2].mask = 1;
    mask.jointMask = half;
    mask.jointMaskCount = 3;
    EXPECT_EQ(suppleSetMask(stage.handle(), stage.crowd.group(), &mask), SUPPLE_OK);
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

        // Poses that the host sets swing after drivers have looked, too.
        SetGroup set(own, swings, 1, SUPPLE_GROUP_SPRINGS);
        for (uint32_t f = 0; f < 5; ++f) {
            own.setTime(0.05 * f);
            set.setClip(0, kBendClip, f % 2 == 0 ? 1.0 : 0.5);
            const ArmWeights wanted = f % 2 == 0 ? ArmWeights{0, 1, 0, 0, 0} : ArmWeights{1, 0, 0, 0, 0};
            expectNear(set.weights(0), wanted, 2e-6f, "set");
        }
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

/// A node between the upper arm and the forearm, which is no joint, turned and grown at rest.
constexpr uint32_t kRoll = 4;
cage::Character armWithRoll() {
    cage::Character arm = readArm();
    std::vector<cage::Node>& nodes = arm.skeleton.nodes;
    EXPECT_EQ(nodes.size(), kRoll);
    const glm::quat turn = glm::angleAxis(0.5f, glm::vec3(0, 0, 1)), back = glm::conjugate(turn);
    cage::Node roll = nodes[1];
    roll.name = "roll";
    roll.rotation = turn;
    roll.scale = glm::vec3(2.0f);
    nodes[1].parent = kRoll;
    nodes[1].translation = glm::vec3(0.0f);
    nodes[1].rotation = back;
    nodes[1].scale = glm::vec3(0.5f);
    nodes.push_back(roll);
    arm.skeleton.parentsFirst = {0, 3, kRoll, 1, 2};
    // The wrist's driver looks at the roll, which its clip turns.
    arm.drivers[1].inputs[0].node = kRoll;
    const auto turnAll = [](cage::Channel& channel, const glm::quat& first) {
        for (size_t i = 0; i + 3 < channel.values.size(); i += 4) {
            float* const v = &channel.values[i];
            const glm::quat q = first * glm::quat(v[3], v[0], v[1], v[2]);
            v[0] = q.x;
            v[1] = q.y;
            v[2] = q.z;
            v[3] = q.w;
        }
    };
    turnAll(arm.clips[kBendClip].channels[0], back);
    turnAll(arm.clips[kTwistClip].channels[0], turn);
    arm.clips[kTwistClip].channels[0].node = kRoll;
    return arm;
}

/// What an instance shows whose joints stand as a clip has them.
ArmWeights weightsByMatrices(SetGroup& stage, uint32_t clip, double time, const std::vector<glm::mat4>& changes) {
    stage.setClip(0, clip, time);
    std::vector<glm::mat4> matrices(changes.size());
    for (uint32_t j = 0; j < matrices.size(); ++j) {
        EXPECT_EQ(suppleGetJointTransform(stage.handle(), stage.instances[0], j, &matrices[j][0][0]), SUPPLE_OK);
        matrices[j] = matrices[j] * changes[j];
    }
    EXPECT_EQ(suppleSetMatrixPose(stage.handle(), stage.instances[1], &matrices[0][0][0], 3), SUPPLE_OK);
    return stage.weights(1);
}

TEST_F(Drivers, MatricesTellHowNodesAreTurned) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const std::vector<glm::mat4> asIs(3, glm::mat4(1.0f));
    {
        SetGroup stage(own, own.createAsset(armWithRoll()), 2);
        stage.setClip(0, kBendClip, 1.0);
        expectNear(stage.weights(0), {0, 1, 0, 0, 0}, 3e-6f, "through a node that is no joint");
        expectNear(weightsByMatrices(stage, kBendClip, 1.0, asIs), {0, 1, 0, 0, 0}, 3e-6f, "by matrices");
        stage.setClip(0, kTwistClip, 0.5);
        EXPECT_NEAR(stage.weights(0)[3], 1.0f, 3e-6f) << "it is turned";
        EXPECT_NEAR(weightsByMatrices(stage, kTwistClip, 0.5, asIs)[3], 0.0f, 3e-6f) << "matrices do not tell";
    }
    for (const glm::vec3 scale : {glm::vec3(1, 1, -1), glm::vec3(-2, 0.5f, 1), glm::vec3(-1, -1, -1)}) {
        cage::Character mirrored = readArm();
        mirrored.skeleton.nodes[1].scale = scale;
        SetGroup stage(own, own.createAsset(mirrored), 2);
        expectNear(weightsByMatrices(stage, kBendClip, 1.0, asIs), {0, 1, 0, 0, 0}, 4e-6f, "mirrored");
        expectNear(weightsByMatrices(stage, kTwistClip, 0.5, asIs), {0, 0, 0, 1, 0}, 4e-6f, "below a mirror");
    }
    cage::Character turned = readArm();
    turned.skeleton.nodes[1].rotation = glm::angleAxis(1.5f, glm::vec3(0, 0, 1));
    SetGroup stage(own, own.createAsset(turned), 2);
    const auto scaled = [&](const glm::vec3& by) {
        return weightsByMatrices(stage, kBendClip, 1.5, {asIs[0], glm::scale(asIs[1], by), asIs[2]});
    };
    expectNear(scaled(glm::vec3(0.0f)), ArmWeights(kArmTargets, 0.0f), 3e-6f, "a point is as at rest");
    expectNear(scaled(glm::vec3(1, 0, 0)), ArmWeights(kArmTargets, 0.0f), 3e-6f, "and so is a line");
    stage.setClip(0, kBendClip, 1.5);
    ArmWeights wanted = stage.weights(0);
    EXPECT_GT(wanted[0] + wanted[1] + wanted[2], 0.1f);
    wanted[3] = wanted[4] = 0.0f; // below what is flat
    expectNear(scaled(glm::vec3(1, 1, 0)), wanted, 4e-6f, "a plane tells");
}

TEST_F(Drivers, AsManyAsThereMayBeAreAllDriven) {
    const ValidationGuard guard;
    cage::Character many = readArm(), large = many;
    cage::PoseDriver small = many.drivers[0];
    small.targets = {1};
    small.poses = {small.poses[1]};
    small.values = {1.0f};
    const size_t count = cage::kMaxDriverWork / driverWork(small);
    small.values[0] = 1.0f / static_cast<float>(count);
    many.drivers.assign(count, small);
    cage::PoseDriver full = small;
    full.inputs = {{.node = 0}, {.node = 1}, {.node = 2}, {.node = 1, .weight = 0.5f}};
    full.targets = {0, 1, 2, 3, 4};
    full.poses.clear();
    full.values.clear();
    Noise noise(7);
    for (size_t i = 0; i < cage::kMaxDriverPoses * 4; ++i) {
        full.poses.push_back(glm::normalize(glm::vec4(noise(), noise(), noise(), noise())));
    }
    for (size_t i = 0; i < cage::kMaxDriverPoses * kArmTargets; ++i) {
        full.values.push_back(0.01f * noise());
    }
    large.drivers.assign(cage::kMaxDriverWork / driverWork(full), full);
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const cage::Character* const character : {&many, &large}) {
            PlayedGroup stage(own, playedGroup(own.createAsset(*character), 9, 0));
            ASSERT_TRUE(stage.crowd.valid());
            for (uint32_t i = 0; i < 9; ++i) {
                stage.play(i, i % 2, 0.2 * i);
            }
            stage.play(0, kBendClip, 1.0);
            EXPECT_EQ(stage.run(0.0), 0u) << "none is lost";
            if (character == &many) {
                EXPECT_NEAR(weightsOf(stage, 0)[1], 1.0f, 1e-3f);
            }
        }
    }
}

TEST_F(Drivers, BoxesOfInstancesHoldWhatTheySet) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    cage::Character arm = readArm();
    for (cage::MorphTarget& target : arm.morphs.targets) {
        for (glm::vec3& delta : target.deltas) {
            delta = delta * 8.0f;
        }
    }
    cage::Character silent = arm;
    silent.drivers.clear();
    const skinning::Reach reach = skinning::reachOf(arm);
    const SuppleAsset asset = own.createAsset(arm);
    SetGroup set(own, asset, 1), without(own, own.createAsset(silent), 1);
    PlayedGroup played(own, playedGroup(asset, 1, 0));
    const auto groupOf = [](const SetGroup& stage) -> runtime::Group& {
        return *stage.handle()->context->groups.find(stage.crowd.group().id);
    };
    const auto outside = [&](Crowd& crowd, runtime::Group& boxed) {
        const std::optional<skinning::Box> box = boxed.poses().boundsOf(0, reach);
        const std::vector<float> cage = as<float>(crowd.read(crowd.output().info.deformedCage));
        size_t count = 0;
        for (size_t v = 0; v < arm.cage.vertexCount(); ++v) {
            const glm::dvec3 p(cage[4 * v], cage[4 * v + 1], cage[4 * v + 2]);
            count += glm::all(glm::lessThanEqual(box->low, p)) && glm::all(glm::greaterThanEqual(box->high, p)) ? 0 : 1;
        }
        return count;
    };
    size_t left = 0;
    for (const double time : {0.5, 0.8, 1.0, 1.5}) {
        set.setClip(0, kBendClip, time);
        without.setClip(0, kBendClip, time);
        (void)set.weights(0);
        EXPECT_EQ(outside(set.crowd, groupOf(set)), 0u) << time;
        left += outside(set.crowd, groupOf(without));
        played.play(0, kBendClip, time);
        EXPECT_EQ(played.run(0.0), 0u);
        EXPECT_EQ(outside(played.crowd, played.group()), 0u) << time;
    }
    EXPECT_GT(left, 0u) << "the box without drivers would not";
}

TEST_F(Drivers, LeaveAloneWhatTheHostWritesOnTheDevice) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kArm);
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.poseSource = SUPPLE_POSES_PALETTE_BUFFER;
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    (void)crowd.spawn();
    const runtime::Group& group = *own.handle()->context->groups.find(crowd.group().id);
    const skinning::PoseLayout& layout = group.instances().poseLayout();
    std::vector<float> pose(4 * size_t{layout.stride}, 0.0f);
    const float turned[] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0};
    for (size_t joint = 0; joint < 3; ++joint) {
        std::copy(std::begin(turned), std::end(turned), pose.begin() + static_cast<ptrdiff_t>(12 * joint));
    }
    pose[4 * size_t{layout.morphWeights} + 1] = 0.25f;
    crowd.context().run(crowd.group(), [&](VkCommandBuffer commands) {
        const host::GroupOutput output = crowd.output();
        vkCmdUpdateBuffer(commands, output.info.poses.buffer, output.info.poses.offset, pose.size() * sizeof(float),
                          pose.data());
    });
    EXPECT_EQ(weightsOf(group, as<float>(crowd.read(crowd.output().info.poses)), 0), (ArmWeights{0, 0.25f, 0, 0, 0}));
}

TEST_F(Drivers, WeightsThatStayAsTheyAreCostNoPoses) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PlayedGroup stage(own, playedGroup(own.asset(kArm), 1, SUPPLE_GROUP_UPDATE_RATES));
    SupplePlaybackDesc desc{};
    desc.updateInterval = 8;
    stage.play(0, kBendClip, 0.3, desc);
    ArmWeights weights = {0.25f, -0.5f, 0.0f, 0.125f, 2.0f};
    const auto posesAt = [&](double time, const float* set) {
        EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[0], set, set != nullptr ? kArmTargets : 0),
                  SUPPLE_OK);
        EXPECT_EQ(stage.run(time), 0u);
        return stage.group().poses().playback()->poseCount(stage.group().windows());
    };
    EXPECT_EQ(posesAt(0.010, weights.data()), 2u);
    EXPECT_EQ(posesAt(0.011, weights.data()), 0u);
    weights[0] = 0.5f;
    EXPECT_EQ(posesAt(0.012, weights.data()), 2u);
    EXPECT_EQ(posesAt(0.013, nullptr), 2u);
    EXPECT_EQ(posesAt(0.014, nullptr), 0u);
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
    expectReplayed(own.handle(), recorded, 11);
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
    runtime::Group& setGroup = *set.handle()->context->groups.find(set.crowd.group().id);
    runtime::HostPoses& poses = *setGroup.poses().host();
    runtime::Playback& playback = *played.group().poses().playback();
    std::vector<std::byte> bytes(2 * poses.instanceBytes());
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
        // What frames do.
        poses.write({uint64_t{1000} + i, 0.01 * i, false}, setGroup.instances().slots(), bytes.data());
        playback.setTime(0.01 * i);
        playback.listPoses(1000 + i, played.group().windows(), 2, [](uint32_t) { return true; });
    }
    EXPECT_TRUE(good);
    EXPECT_EQ(allocationsCounted(), before);
}

} // namespace
} // namespace supple::test
