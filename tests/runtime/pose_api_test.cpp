// Posing through the public interface: layers, masks, root motion, morph weights; what it refuses, what it allocates
// and what crosses to the device.
#include "cage/gltf/reader.h"
#include "skinning/layers.h"
#include "tests/support/allocation_count.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/not_finite.h"
#include "tests/support/posed_group.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/skinnings.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/gltf/writer.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

std::vector<std::byte> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> chars((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<std::byte> bytes(chars.size());
    std::memcpy(bytes.data(), chars.data(), chars.size());
    return bytes;
}

/// The largest distance of an instance's cage from the wanted one.
double worstDistance(const std::vector<std::byte>& cage, const std::vector<glm::dvec3>& wanted) {
    double worst = 0.0;
    for (size_t v = 0; v < wanted.size(); ++v) {
        glm::vec3 p;
        std::memcpy(&p, cage.data() + 16 * v, 12);
        worst = std::max(worst, glm::length(glm::dvec3(p) - wanted[v]));
    }
    return worst;
}

/// A character in the public interface's hands, and as the reader gives it: the demo character unless load() is called.
class PoseApi : public testing::Test {
protected:
    void SetUp() override {
        host::Device* device = testDevice();
        ASSERT_NE(device, nullptr);
        host::ContextOptions options;
        options.printWarnings = false;
        Result<std::unique_ptr<host::Context>> created = host::Context::create(*device, options);
        ASSERT_TRUE(created.ok()) << created.error().message;
        context_ = std::move(*created);
        load(bytesOf(kPip));
    }

    void load(const std::vector<std::byte>& bytes) {
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.name = "loaded";
        assetDesc.bytes = bytes.data();
        assetDesc.byteCount = bytes.size();
        ASSERT_EQ(suppleCreateAsset(handle(), &assetDesc, &asset), SUPPLE_OK);
        Result<cage::Character> read = cage::readGltf(bytes, "loaded", "");
        ASSERT_TRUE(read.ok()) << read.error().message;
        character = std::move(*read);
        rig = skinning::makeRig(character);
        info.structSize = sizeof(info);
        ASSERT_EQ(suppleGetAssetInfo(handle(), asset, &info), SUPPLE_OK);
        group = makeGroup(SUPPLE_SKINNING_LINEAR);
        instances = instancesOf(group);
    }
    /// Fills a group.
    [[nodiscard]] std::vector<SuppleInstance> instancesOf(SuppleGroup own) const {
        std::vector<SuppleInstance> result;
        EXPECT_TRUE(context_->createInstances(own, 3, result).ok());
        return result;
    }

    [[nodiscard]] SuppleContext handle() const { return context_->handle(); }
    [[nodiscard]] SuppleGroup makeGroup(SuppleSkinning skinning) {
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = asset;
        desc.capacity = 3;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        desc.skinning = skinning;
        SuppleGroup result{};
        EXPECT_EQ(suppleCreateGroup(handle(), &desc, &result), SUPPLE_OK);
        return result;
    }
    /// The cages of all instances as the device has them, without the padding between them.
    [[nodiscard]] std::vector<std::vector<std::byte>> cages() {
        EXPECT_TRUE(context_->evaluate({&group, 1}).ok());
        host::GroupOutput output{};
        EXPECT_EQ(host::getGroupOutput(handle(), group, output), SUPPLE_OK);
        const Result<std::vector<std::byte>> bytes = context_->device().readBuffer(output.info.deformedCage);
        EXPECT_TRUE(bytes.ok());
        std::vector<std::vector<std::byte>> result;
        for (uint32_t i = 0; i < output.info.capacity && bytes.ok(); ++i) {
            const auto begin =
                bytes->begin() + static_cast<ptrdiff_t>(16 * size_t{i} * output.info.cageVerticesPerInstance);
            result.emplace_back(begin, begin + static_cast<ptrdiff_t>(16 * size_t{output.info.cageVertexCount}));
        }
        return result;
    }
    /// The line Supple logged about a refused call.
    [[nodiscard]] std::string refusal(SuppleResult result) {
        EXPECT_EQ(result, SUPPLE_ERROR_ARGUMENT);
        const Status status = context_->check(result, "call");
        return status.ok() ? std::string() : status.error().message;
    }
    static SuppleClipLayer layer(uint32_t clip, double time, float weight = 1.0f) {
        SuppleClipLayer result{};
        result.clip = clip;
        result.time = time;
        result.weight = weight;
        return result;
    }
    static SupplePoseDesc poseOf(std::span<const SuppleClipLayer> layers) {
        auto pose = sized<SupplePoseDesc>();
        pose.layers = layers.data();
        pose.layerCount = static_cast<uint32_t>(layers.size());
        return pose;
    }

    std::unique_ptr<host::Context> context_; ///< declared first: goes last, and frees the rest
    SuppleAsset asset{};
    SuppleGroup group{};
    std::vector<SuppleInstance> instances;
    SuppleAssetInfo info{};
    cage::Character character;
    skinning::Rig rig;
};

TEST_F(PoseApi, TellsJointsAndTargets) {
    ASSERT_EQ(info.jointCount, character.skin.joints.size());
    EXPECT_EQ(info.morphTargetCount, character.morphs.targets.size());
    uint32_t roots = 0;
    for (uint32_t j = 0; j < info.jointCount; ++j) {
        auto joint = sized<SuppleJointInfo>();
        ASSERT_EQ(suppleGetJointInfo(handle(), asset, j, &joint), SUPPLE_OK);
        EXPECT_EQ(joint.name, character.skeleton.nodes[character.skin.joints[j]].name);
        if (joint.parent == SUPPLE_NO_JOINT) {
            ++roots;
            continue;
        }
        ASSERT_LT(joint.parent, info.jointCount);
        EXPECT_EQ(character.skeleton.nodes[character.skin.joints[j]].parent, character.skin.joints[joint.parent]);
    }
    EXPECT_EQ(roots, 1u);
    auto joint = sized<SuppleJointInfo>();
    const std::string count = std::to_string(info.jointCount);
    EXPECT_NE(
        refusal(suppleGetJointInfo(handle(), asset, info.jointCount, &joint)).find("joint " + count + " of " + count),
        std::string::npos);
    joint.structSize = 1;
    EXPECT_NE(refusal(suppleGetJointInfo(handle(), asset, 0, &joint)).find("structSize"), std::string::npos);
    EXPECT_NE(refusal(suppleGetJointInfo(handle(), SuppleAsset{77}, 0, &joint)).find("asset handle"),
              std::string::npos);
    auto target = sized<SuppleMorphTargetInfo>();
    EXPECT_NE(
        refusal(suppleGetMorphTargetInfo(handle(), asset, info.morphTargetCount, &target)).find("morph target 0 of 0"),
        std::string::npos);
    EXPECT_NE(refusal(suppleGetMorphTargetInfo(handle(), asset, 0, nullptr)).find("null"), std::string::npos);
}

TEST_F(PoseApi, EndsOfACrossfadeAreTheClips) {
    const ValidationGuard guard;
    ASSERT_EQ(suppleSetClipPose(handle(), instances[0], 0, 0.4), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(handle(), instances[1], 1, 0.9), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(handle(), instances[2], SUPPLE_REST_POSE, 0.0), SUPPLE_OK);
    const auto clips = cages();
    const SuppleClipLayer alone[] = {layer(0, 0.4)};
    const SuppleClipLayer begin[] = {layer(0, 0.4), layer(1, 0.9, 0.0f)};
    const SuppleClipLayer end[] = {layer(0, 0.4), layer(1, 0.9, 1.0f)};
    const SuppleClipLayer between[] = {layer(0, 0.4), layer(1, 0.9, 0.5f)};
    const auto set = [&](uint32_t instance, std::span<const SuppleClipLayer> layers) {
        const SupplePoseDesc pose = poseOf(layers);
        ASSERT_EQ(suppleSetPose(handle(), instances[instance], &pose), SUPPLE_OK);
    };
    set(0, alone);
    set(1, end);
    set(2, {});
    EXPECT_TRUE(cages() == clips) << "one layer; weight 1; no layers";
    set(0, begin);
    EXPECT_TRUE(cages()[0] == clips[0]) << "weight 0";
    set(0, between);
    EXPECT_FALSE(cages()[0] == clips[0]);
    EXPECT_FALSE(cages()[0] == clips[1]);
}

TEST_F(PoseApi, LayersAreThoseOfTheSkinningFloor) {
    const ValidationGuard guard;
    std::vector<float> mask(info.jointCount, 0.0f);
    ASSERT_EQ(suppleFillJointMask(handle(), asset, info.jointCount / 3, 1.0f, mask.data(), info.jointCount), SUPPLE_OK);
    SuppleClipLayer layers[] = {layer(0, 7.3), layer(1, -0.2, 0.6f), layer(2, 1.3, -0.8f)};
    layers[0].flags = SUPPLE_LAYER_LOOP;
    layers[1].jointMask = mask.data();
    layers[1].jointMaskCount = info.jointCount;
    layers[2].mode = SUPPLE_LAYER_ADDITIVE;
    layers[2].referenceTime = 0.4;
    SupplePoseDesc pose = poseOf(layers);
    pose.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
    pose.flags = SUPPLE_POSE_ROOT_JOINT;
    pose.rootJoint = 1;
    ASSERT_EQ(suppleSetPose(handle(), instances[1], &pose), SUPPLE_OK);

    skinning::Pose wanted;
    skinning::LayerScratch scratch;
    skinning::restPose(character, wanted);
    const skinning::RootSelection root{character.skin.joints[1], skinning::kRootGround | skinning::kRootYaw};
    for (const SuppleClipLayer& own : layers) {
        skinning::Layer l;
        l.clip = &character.clips[own.clip];
        l.time = own.time;
        l.weight = static_cast<double>(own.weight);
        l.referenceTime = own.referenceTime;
        l.mode = own.mode == SUPPLE_LAYER_ADDITIVE ? skinning::LayerMode::additive : skinning::LayerMode::blend;
        l.loop = own.flags == SUPPLE_LAYER_LOOP;
        l.jointMask = {own.jointMask, own.jointMaskCount};
        applyLayer(character, rig, l, root, scratch, wanted);
    }
    const std::vector<glm::dvec3> deformed = skinning::deformOnCpu(character, wanted);
    EXPECT_LT(worstDistance(cages()[1], deformed), 1e-5);
}

TEST_F(PoseApi, SkinningIsASwitchOfTheGroup) {
    const ValidationGuard guard;
    ASSERT_EQ(suppleSetClipPose(handle(), instances[1], 2, 1.1), SUPPLE_OK);
    const auto linear = cages();
    auto before = linear;
    for (const SuppleSkinning skinning : {SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION,
                                          SUPPLE_SKINNING_DELTA_MUSH, SUPPLE_SKINNING_DELTA_MUSH_LIGHT}) {
        ASSERT_EQ(suppleDestroyGroup(handle(), group), SUPPLE_OK);
        group = makeGroup(skinning);
        instances = instancesOf(group);
        ASSERT_EQ(suppleSetClipPose(handle(), instances[1], 2, 1.1), SUPPLE_OK);
        const auto own = cages();
        for (uint32_t v = 0; v < info.cageVertexCount; ++v) {
            ASSERT_EQ(std::memcmp(own[0].data() + 16 * size_t{v}, &character.cage.positions[v], 12), 0)
                << "the bind pose is the cage, whatever the weights add up to";
        }
        EXPECT_FALSE(linear[1] == own[1]);
        EXPECT_FALSE(before[1] == own[1]);
        before = own;
    }
}

TEST_F(PoseApi, RootMotionIsReported) {
    // A foot, taken for the root: it moves in all directions.
    uint32_t foot = 0;
    for (uint32_t j = 0; j < info.jointCount; ++j) {
        foot = character.skeleton.nodes[character.skin.joints[j]].name.find("foot") != std::string::npos ? j : foot;
    }
    ASSERT_NE(foot, 0u);
    SuppleClipLayer walk = layer(1, 1e3 + 0.9);
    walk.previousTime = 1e3 + 0.2;
    walk.flags = SUPPLE_LAYER_LOOP;
    SupplePoseDesc pose = poseOf({&walk, 1});
    pose.flags = SUPPLE_POSE_ROOT_JOINT;
    pose.rootJoint = foot;
    pose.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_HEIGHT | SUPPLE_ROOT_MOTION_YAW;
    auto motion = sized<SuppleRootMotion>();
    ASSERT_EQ(suppleGetRootMotion(handle(), asset, &pose, &motion), SUPPLE_OK);
    const skinning::RootMotion wanted =
        skinning::rootMotionBetween(character, character.clips[1], {character.skin.joints[foot], pose.rootMotion},
                                    walk.previousTime, walk.time, true);
    EXPECT_GT(glm::length(wanted.translation), 0.05);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_FLOAT_EQ(motion.translation[axis], static_cast<float>(wanted.translation[axis]));
        EXPECT_EQ(motion.transform[12 + axis], motion.translation[axis]);
    }
    EXPECT_FLOAT_EQ(motion.yaw, static_cast<float>(wanted.yaw));
    EXPECT_FLOAT_EQ(motion.transform[0], std::cos(motion.yaw));
    EXPECT_FLOAT_EQ(motion.transform[8], std::sin(motion.yaw));
    EXPECT_EQ(suppleSetTransform(handle(), instances[0], motion.transform), SUPPLE_OK) << "it is a transform";
    // Nothing asked for, nothing moves; the automatic root of clips that walk on the spot comes back after a loop.
    pose.rootMotion = 0;
    ASSERT_EQ(suppleGetRootMotion(handle(), asset, &pose, &motion), SUPPLE_OK);
    EXPECT_EQ(motion.translation[0], 0.0f);
    EXPECT_EQ(motion.transform[0], 1.0f);
    pose.flags = 0;
    pose.rootMotion = SUPPLE_ROOT_MOTION_GROUND;
    walk.previousTime = walk.time - character.clips[1].duration;
    ASSERT_EQ(suppleGetRootMotion(handle(), asset, &pose, &motion), SUPPLE_OK);
    EXPECT_NEAR(motion.translation[2], 0.0f, 1e-6f);

    motion.structSize = 3;
    EXPECT_NE(refusal(suppleGetRootMotion(handle(), asset, &pose, &motion)).find("structSize"), std::string::npos);
    EXPECT_NE(refusal(suppleGetRootMotion(handle(), asset, &pose, nullptr)).find("null"), std::string::npos);
    motion.structSize = sizeof(motion);
    EXPECT_NE(refusal(suppleGetRootMotion(handle(), asset, nullptr, &motion)).find("null"), std::string::npos);
    walk.time = kInfinity;
    EXPECT_NE(refusal(suppleGetRootMotion(handle(), asset, &pose, &motion)).find("layer 0"), std::string::npos);
}

/// A tube in a file: morph targets with weights of their own and animated ones, and a root that walks along -x.
std::vector<std::byte> walkingTube() {
    cage::Character tube = riggedTube({.morphTargets = 4});
    tube.morphs.weights = {0.25f, 0.0f, 1.0f, -0.5f};
    tube.clips.push_back(
        clipOf({channel(1, cage::ChannelPath::translation, {0, 1, 2}, {0, 0, 0, -1, 0.5f, 0, -2, 0, 0}),
                channel(tube.parts[0].node, cage::ChannelPath::weights, {0, 2}, {0, 0, 0, 0, 1, -1, 2, 0.5f})}));
    tube.clips[0].name = "walk";
    const Result<cage::GlbFile> file = cage::writeGlb(tube);
    EXPECT_TRUE(file.ok());
    return file.ok() ? file->bytes : std::vector<std::byte>();
}

TEST_F(PoseApi, MorphWeightsComeFromClipsUntilTheHostSetsThem) {
    const ValidationGuard guard;
    load(walkingTube());
    ASSERT_EQ(info.morphTargetCount, 4u);
    auto target = sized<SuppleMorphTargetInfo>();
    ASSERT_EQ(suppleGetMorphTargetInfo(handle(), asset, 3, &target), SUPPLE_OK);
    EXPECT_STREQ(target.name, "target 3");
    EXPECT_EQ(target.weight, -0.5f);
    EXPECT_EQ(target.vertexCount, info.cageVertexCount);
    ASSERT_EQ(suppleGetMorphTargetInfo(handle(), asset, 2, &target), SUPPLE_OK);
    EXPECT_EQ(target.vertexCount, 0u);

    skinning::Pose rest, walk;
    skinning::restPose(character, rest);
    skinning::sampleClip(character, character.clips[0], 0.5, walk);
    ASSERT_EQ(suppleSetClipPose(handle(), instances[0], SUPPLE_BIND_POSE, 0.0), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(handle(), instances[1], SUPPLE_REST_POSE, 0.0), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(handle(), instances[2], 0, 0.5), SUPPLE_OK);
    auto now = cages();
    EXPECT_LT(worstDistance(now[0], {character.cage.positions.begin(), character.cage.positions.end()}), 1e-6);
    EXPECT_LT(worstDistance(now[1], skinning::deformOnCpu(character, rest)), 1e-6);
    EXPECT_LT(worstDistance(now[2], skinning::deformOnCpu(character, walk)), 2e-6);

    // The host's weights stand, whatever pose comes; given back, the pose's are there again.
    const float weights[] = {1.0f, 0.5f, 0.0f, 2.0f};
    for (uint32_t i = 0; i < 3; ++i) {
        ASSERT_EQ(suppleSetMorphWeights(handle(), instances[i], weights, 4), SUPPLE_OK);
    }
    ASSERT_EQ(suppleSetClipPose(handle(), instances[1], 0, 0.5), SUPPLE_OK);
    skinning::Pose host = walk;
    host.morphWeights = {1.0, 0.5, 0.0, 2.0};
    now = cages();
    EXPECT_LT(worstDistance(now[1], skinning::deformOnCpu(character, host)), 2e-6);
    EXPECT_TRUE(now[1] == now[2]);
    ASSERT_EQ(suppleSetMorphWeights(handle(), instances[1], nullptr, 0), SUPPLE_OK);
    EXPECT_LT(worstDistance(cages()[1], skinning::deformOnCpu(character, walk)), 2e-6);

    // Two clips' weights, crossfaded; a masked layer spares them unless it says otherwise.
    const std::vector<float> mask(info.jointCount, 0.0f), morphMask = {0, 1, 0, 0};
    SuppleClipLayer layers[] = {layer(0, 0.5), layer(0, 2.0)};
    layers[1].jointMask = mask.data();
    layers[1].jointMaskCount = info.jointCount;
    const SupplePoseDesc pose = poseOf(layers);
    ASSERT_EQ(suppleSetPose(handle(), instances[1], &pose), SUPPLE_OK);
    EXPECT_LT(worstDistance(cages()[1], skinning::deformOnCpu(character, walk)), 2e-6);
    layers[1].morphMask = morphMask.data();
    layers[1].morphMaskCount = 4;
    ASSERT_EQ(suppleSetPose(handle(), instances[1], &pose), SUPPLE_OK);
    skinning::Pose masked = walk;
    masked.morphWeights[1] = -1.0;
    EXPECT_LT(worstDistance(cages()[1], skinning::deformOnCpu(character, masked)), 2e-6);

    const float bad[] = {0, 0, kNan, 0};
    EXPECT_NE(refusal(suppleSetMorphWeights(handle(), instances[0], bad, 4)).find("not finite"), std::string::npos);
    EXPECT_NE(refusal(suppleSetMorphWeights(handle(), instances[0], weights, 3)).find("the asset has"),
              std::string::npos);
}

TEST_F(PoseApi, AHostThatFollowsTheRootSeesTheClip) {
    // Frame by frame over several loops: instance 0 walks in place and is moved by what is reported; its root stays on
    // the line that the clip, repeated, draws.
    const ValidationGuard guard;
    load(walkingTube());
    SuppleClipLayer walk = layer(0, 0.0);
    walk.flags = SUPPLE_LAYER_LOOP;
    SupplePoseDesc pose = poseOf({&walk, 1});
    pose.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
    glm::mat4 placed(1.0f);
    for (int frame = 1; frame <= 330; ++frame) {
        walk.previousTime = walk.time;
        walk.time = frame / 60.0;
        auto motion = sized<SuppleRootMotion>();
        ASSERT_EQ(suppleGetRootMotion(handle(), asset, &pose, &motion), SUPPLE_OK);
        placed = placed * glm::make_mat4(motion.transform);
    }
    ASSERT_EQ(suppleSetPose(handle(), instances[0], &pose), SUPPLE_OK);
    ASSERT_EQ(suppleSetTransform(handle(), instances[0], glm::value_ptr(placed)), SUPPLE_OK);
    skinning::Pose wanted;
    skinning::sampleClip(character, character.clips[0], 1.5, wanted); // 5.5 s: two loops of 2 s and three quarters
    wanted.locals[1].translation.x -= 4.0;
    EXPECT_NEAR(placed[3].x, -5.5f, 1e-4f);
    EXPECT_LT(worstDistance(cages()[0], skinning::deformOnCpu(character, wanted)), 1e-4);
}

TEST_F(PoseApi, WrongPosesAreRefusedByNameAndChangeNothing) {
    const ValidationGuard guard;
    ASSERT_EQ(suppleSetClipPose(handle(), instances[0], 1, 0.5), SUPPLE_OK);
    const auto before = cages();
    const std::vector<float> mask(info.jointCount + 1, 0.5f), outside(info.jointCount, 1.5f),
        nan(info.jointCount, kNan);
    struct Pose {
        SuppleClipLayer layers[2] = {layer(0, 0.1), layer(1, 0.2, 0.5f)};
        SupplePoseDesc desc = poseOf(layers);
    };
    struct Case {
        std::function<void(Pose&)> spoil;
        const char* reason;
    };
    const Case cases[] = {
        {[](Pose& p) { p.desc.structSize = 4; }, "structSize"},
        {[](Pose& p) { p.desc.layers = nullptr; }, "layers is null"},
        {[](Pose& p) { p.desc.flags = 8; }, "unknown flags"},
        {[](Pose& p) { p.desc.rootMotion = 8; }, "unknown flags"},
        {[&](Pose& p) {
             p.desc.flags = SUPPLE_POSE_ROOT_JOINT;
             p.desc.rootJoint = info.jointCount;
         },
         "rootJoint: no such joint"},
        {[](Pose& p) { p.layers[1].clip = 3; }, "layer 1: no such clip"},
        {[](Pose& p) { p.layers[1].clip = SUPPLE_REST_POSE; }, "layer 1: no such clip"},
        {[](Pose& p) { p.layers[0].mode = static_cast<SuppleLayerMode>(2); }, "layer 0: no such mode"},
        {[](Pose& p) { p.layers[0].flags = 2; }, "layer 0: unknown flags"},
        {[](Pose& p) { p.layers[0].time = kInfinity; }, "layer 0: a time is not finite"},
        {[](Pose& p) { p.layers[0].previousTime = -kInfinity; }, "layer 0: a time is not finite"},
        {[](Pose& p) { p.layers[0].referenceTime = std::nan(""); }, "layer 0: a time is not finite"},
        {[](Pose& p) { p.layers[1].weight = kNan; }, "layer 1: weight is not finite"},
        {[](Pose& p) { p.layers[1].weight = 1.01f; }, "layer 1: weight leaves 0..1"},
        {[](Pose& p) { p.layers[1].weight = -0.01f; }, "layer 1: weight leaves 0..1"},
        {[&](Pose& p) {
             p.layers[1].jointMask = mask.data();
             p.layers[1].jointMaskCount = info.jointCount + 1;
         },
         "layer 1: jointMask has not one value for each"},
        {[&](Pose& p) { p.layers[1].jointMaskCount = info.jointCount; }, "layer 1: jointMask is null"},
        {[&](Pose& p) {
             p.layers[1].jointMask = outside.data();
             p.layers[1].jointMaskCount = info.jointCount;
         },
         "layer 1: jointMask leaves 0..1"},
        {[&](Pose& p) {
             p.layers[1].jointMask = nan.data();
             p.layers[1].jointMaskCount = info.jointCount;
         },
         "layer 1: jointMask leaves 0..1"},
        {[&](Pose& p) {
             p.layers[1].morphMask = mask.data();
             p.layers[1].morphMaskCount = info.morphTargetCount + 1;
         },
         "layer 1: morphMask has not one value for each"},
    };
    for (const Case& c : cases) {
        Pose pose;
        c.spoil(pose);
        const std::string line = refusal(suppleSetPose(handle(), instances[0], &pose.desc));
        EXPECT_NE(line.find("suppleSetPose: "), std::string::npos) << line;
        EXPECT_NE(line.find(c.reason), std::string::npos) << line;
    }
    const Pose good;
    EXPECT_NE(refusal(suppleSetPose(handle(), instances[0], nullptr)).find("pose is null"), std::string::npos);
    EXPECT_NE(refusal(suppleSetPose(handle(), {group, 3, 1}, &good.desc)).find("slot 3"), std::string::npos);
    EXPECT_NE(refusal(suppleSetPose(handle(), {SuppleGroup{99}, 0, 1}, &good.desc)).find("group handle"),
              std::string::npos);
    EXPECT_NE(refusal(suppleSetClipPose(handle(), instances[0], 0, kInfinity)).find("not finite"), std::string::npos);

    const float weights[] = {0.5f, kNan};
    EXPECT_NE(refusal(suppleSetMorphWeights(handle(), instances[0], weights, info.morphTargetCount + 1))
                  .find("the asset has"),
              std::string::npos);
    EXPECT_EQ(suppleSetMorphWeights(handle(), instances[0], nullptr, 12), SUPPLE_OK) << "null needs no count";
    EXPECT_EQ(suppleSetMorphWeights(handle(), instances[0], weights, 0), SUPPLE_OK) << "no targets, no weights";

    std::vector<float> written(info.jointCount, 0.25f);
    EXPECT_NE(refusal(suppleFillJointMask(handle(), asset, 0, 1.0f, nullptr, info.jointCount)).find("null"),
              std::string::npos);
    EXPECT_NE(refusal(suppleFillJointMask(handle(), asset, 0, 1.0f, written.data(), 1)).find("jointCount"),
              std::string::npos);
    EXPECT_NE(refusal(suppleFillJointMask(handle(), asset, info.jointCount, 1.0f, written.data(), info.jointCount))
                  .find("joint"),
              std::string::npos);
    EXPECT_NE(refusal(suppleFillJointMask(handle(), asset, 0, kNan, written.data(), info.jointCount)).find("0..1"),
              std::string::npos);
    EXPECT_EQ(written, std::vector<float>(info.jointCount, 0.25f));

    auto groupDesc = sized<SuppleGroupDesc>();
    groupDesc.asset = asset;
    groupDesc.capacity = 1;
    groupDesc.skinning = static_cast<SuppleSkinning>(SUPPLE_SKINNING_FROM_FILE + 1);
    SuppleGroup none{};
    EXPECT_NE(refusal(suppleCreateGroup(handle(), &groupDesc, &none)).find("skinning or poseSource"),
              std::string::npos);
    EXPECT_TRUE(cages() == before);
}

TEST(PoseSkinning, TheFileMayNameIt) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_AUTO);
    Result<cage::Character> character = cage::readGltfFile(kPip);
    ASSERT_TRUE(character.ok());
    const auto groupOf = [&](SuppleAsset asset, SuppleSkinning skinning) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        desc.skinning = skinning;
        return std::make_unique<Crowd>(own, desc);
    };
    const auto cageOf = [&](Crowd& crowd) {
        crowd.pose(crowd.spawn(), 1, 0.4, glm::mat4(1.0f));
        crowd.run();
        std::vector<std::byte> bytes = crowd.slotBytes(crowd.output().info.deformedCage, 0);
        bytes.resize(size_t{16} * crowd.output().info.cageVertexCount); // without padding
        return bytes;
    };
    const SuppleAsset silent = own.createAsset(*character);
    const auto plain = groupOf(silent, SUPPLE_SKINNING_FROM_FILE);
    EXPECT_EQ(plain->output().info.skinning, SUPPLE_SKINNING_LINEAR);
    character->parts.back().skinning = cage::SkinningMode::centersOfRotation;
    const SuppleAsset naming = own.createAsset(*character); // through a file
    const auto fromFile = groupOf(naming, SUPPLE_SKINNING_FROM_FILE);
    EXPECT_EQ(fromFile->output().info.skinning, SUPPLE_SKINNING_CENTERS_OF_ROTATION);
    const auto linear = groupOf(naming, SUPPLE_SKINNING_LINEAR);
    EXPECT_EQ(linear->output().info.skinning, SUPPLE_SKINNING_LINEAR) << "hosts that say nothing get what they got";
    const auto named = groupOf(naming, SUPPLE_SKINNING_CENTERS_OF_ROTATION);
    const auto cage = cageOf(*fromFile);
    EXPECT_EQ(cage, cageOf(*named));
    EXPECT_NE(cage, cageOf(*linear));
}

TEST_F(PoseApi, PosingAllocatesNothing) {
    std::vector<float> mask(info.jointCount, 0.5f);
    SuppleClipLayer layers[] = {layer(0, 0.0), layer(1, 0.0, 0.6f), layer(2, 0.0, 0.8f)};
    layers[1].jointMask = mask.data();
    layers[1].jointMaskCount = info.jointCount;
    layers[1].flags = SUPPLE_LAYER_LOOP;
    layers[2].mode = SUPPLE_LAYER_ADDITIVE;
    SupplePoseDesc pose = poseOf(layers);
    pose.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
    auto motion = sized<SuppleRootMotion>();
    const std::vector<SuppleInstance> groups[] = {instances, instancesOf(makeGroup(SUPPLE_SKINNING_DUAL_QUATERNION)),
                                                  instancesOf(makeGroup(SUPPLE_SKINNING_CENTERS_OF_ROTATION))};
    bool good = true;
    const uint64_t before = allocationsCounted();
    for (int i = 0; i < 100; ++i) {
        const AllocationCount count;
        for (SuppleClipLayer& own : layers) {
            own.previousTime = own.time;
            own.time += 0.05;
        }
        for (const std::vector<SuppleInstance>& own : groups) {
            good = good && suppleSetPose(handle(), own[0], &pose) == SUPPLE_OK;
            good = good && suppleSetClipPose(handle(), own[1], 1, 0.05 * i) == SUPPLE_OK;
            good = good && suppleSetClipPose(handle(), own[2], SUPPLE_REST_POSE, 0.0) == SUPPLE_OK;
            good = good && suppleSetMorphWeights(handle(), own[2], nullptr, 0) == SUPPLE_OK;
        }
        good = good && suppleGetRootMotion(handle(), asset, &pose, &motion) == SUPPLE_OK;
        good = good && suppleFillJointMask(handle(), asset, 1, 0.01f * static_cast<float>(i), mask.data(),
                                           info.jointCount) == SUPPLE_OK;
    }
    EXPECT_TRUE(good);
    EXPECT_EQ(allocationsCounted(), before);
    {
        const AllocationCount count;
        ::operator delete(::operator new(1)); // and the count counts
    }
    EXPECT_GT(allocationsCounted(), before);
}

TEST_F(PoseApi, TheCppLayerPosesToo) {
    const ValidationGuard guard;
    supple::Context context;
    ASSERT_EQ(supple::Context::create(host::contextDesc(*testDevice()), context), SUPPLE_OK);
    const std::vector<std::byte> bytes = bytesOf(kPip);
    auto assetDesc = sized<SuppleAssetDesc>();
    assetDesc.bytes = bytes.data();
    assetDesc.byteCount = bytes.size();
    supple::Asset own;
    ASSERT_EQ(supple::Asset::create(context, assetDesc, own), SUPPLE_OK);
    auto groupDesc = sized<SuppleGroupDesc>();
    groupDesc.asset = own.handle();
    groupDesc.capacity = 1;
    groupDesc.skinning = SUPPLE_SKINNING_DUAL_QUATERNION;
    supple::Group dual;
    ASSERT_EQ(supple::Group::create(context, groupDesc, dual), SUPPLE_OK);
    supple::Instance only;
    ASSERT_EQ(supple::Instance::create(dual, only), SUPPLE_OK);

    SuppleClipInfo clip;
    EXPECT_EQ(own.clipInfo(1, clip), SUPPLE_OK);
    EXPECT_EQ(clip.name, character.clips[1].name);
    SuppleJointInfo joint;
    EXPECT_EQ(own.jointInfo(0, joint), SUPPLE_OK);
    SuppleMorphTargetInfo target;
    EXPECT_EQ(own.morphTargetInfo(0, target), SUPPLE_ERROR_ARGUMENT) << "it has none";
    std::vector<float> mask(info.jointCount);
    EXPECT_EQ(own.fillJointMask(0, 1.0f, mask), SUPPLE_OK);
    EXPECT_EQ(mask, std::vector<float>(info.jointCount, 1.0f)) << "joint 0 is the root of all";
    SuppleClipLayer layers[] = {layer(0, 0.1), layer(1, 0.2, 0.5f)};
    layers[1].jointMask = mask.data();
    layers[1].jointMaskCount = info.jointCount;
    EXPECT_EQ(only.setPose(layers), SUPPLE_OK);
    EXPECT_EQ(only.setPose(poseOf(layers)), SUPPLE_OK);
    EXPECT_EQ(only.setMorphWeights({}), SUPPLE_OK);
    SuppleRootMotion motion;
    EXPECT_EQ(own.rootMotion(poseOf(layers), motion), SUPPLE_OK);
    EXPECT_EQ(motion.transform[15], 1.0f);
}

TEST(PoseUpload, OneCopyOfPosesAFrame) {
    struct Case {
        SuppleSkinning skinning;
        uint32_t targets;
        uint64_t bytes; ///< an instance
    };
    // Three joints. Targets 2 and 5 of six move nothing; their weights are uploaded all the same.
    const Case cases[] = {{SUPPLE_SKINNING_LINEAR, 0, 3 * 48},
                          {SUPPLE_SKINNING_LINEAR, 6, 3 * 48 + 2 * 16},
                          {SUPPLE_SKINNING_DUAL_QUATERNION, 0, 48 + 3 * 64},
                          {SUPPLE_SKINNING_DUAL_QUATERNION, 4, 48 + 3 * 64 + 16},
                          {SUPPLE_SKINNING_CENTERS_OF_ROTATION, 4, 48 + 3 * 64 + 16},
                          {SUPPLE_SKINNING_DELTA_MUSH, 4, 48 + 3 * 64 + 16}};
    wrappedVulkan();
    host::DeviceOptions deviceOptions;
    deviceOptions.validation = true;
    deviceOptions.suppleGetInstanceProcAddr = &wrappedGetInstanceProcAddr;
    Result<std::unique_ptr<host::Device>> device = host::Device::create(deviceOptions);
    ASSERT_TRUE(device.ok()) << device.error().message;
    {
        PosedContext context(**device, SUPPLE_MAPPING_AUTO);
        constexpr uint32_t kInstances = 5;
        for (const Case& c : cases) {
            PosedGroup gpu(context, riggedTube({.morphTargets = c.targets}), {c.skinning, kInstances});
            ASSERT_TRUE(gpu.valid());
            gpu.deform(); // the first frame uploads the static tables
            const std::vector<float> weights(c.targets, 0.5f);
            for (int frame = 0; frame < 3; ++frame) {
                const WrappedVulkan& counts = wrappedVulkan();
                gpu.poses().setMorphWeights(1, weights.data());
                gpu.deform();
                // In the second frame the instances have come to have a past; then the lists stand.
                const bool listed = frame == 0;
                EXPECT_EQ(counts.copies, listed ? 3u : 1u) << "poses; the two lists of instances";
                EXPECT_EQ(counts.copiedBytes, kInstances * (c.bytes + (listed ? 8 : 0)));
                EXPECT_EQ(counts.maps + counts.updates + counts.fills + counts.invalidates, 0u);
                EXPECT_LE(counts.flushes, 1u);
            }
            std::printf("%s, %u morph targets: %llu bytes a pose of 3 joints\n", skinningName(c.skinning), c.targets,
                        static_cast<unsigned long long>(c.bytes));
        }
    }
    EXPECT_EQ((*device)->validation()->messageCount(), 0u);
}

} // namespace
} // namespace supple::test
