// Groups that are made anew under their handles: another capacity, another version of their asset.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class Remake : public CrowdContexts {};

/// A tube with two clips, a morph target and three joints.
cage::Character tube(uint32_t sides = 8) {
    using enum cage::ChannelPath;
    cage::Character c = riggedTube({.segments = 6, .sides = sides, .morphTargets = 2});
    c.name = "tube";
    c.morphs.targets[0].name = "wide";
    c.morphs.targets[1].name = "dent";
    for (uint32_t n = 0; n < c.skeleton.nodes.size(); ++n) {
        c.skeleton.nodes[n].name = "node " + std::to_string(n);
    }
    c.parts[0].name = "tube";
    for (const float angle : {0.4f, -0.6f}) {
        const glm::quat turn = glm::angleAxis(angle, glm::vec3(0, 0, 1));
        c.clips.push_back(clipOf({channel(2, rotation, {0, 1}, {0, 0, 0, 1, turn.x, turn.y, turn.z, turn.w})}));
        c.clips.back().name = "bend " + std::to_string(c.clips.size());
    }
    return c;
}

struct RemakeCase {
    const char* name;
    SupplePoseSource source;
    SuppleSkinning skinning;
    bool viewed;
};
constexpr RemakeCase kRemakeCases[] = {
    {"set", SUPPLE_POSES_SET, SUPPLE_SKINNING_LINEAR, false},
    {"dualQuaternions", SUPPLE_POSES_SET, SUPPLE_SKINNING_DUAL_QUATERNION, false},
    {"centers", SUPPLE_POSES_SET, SUPPLE_SKINNING_CENTERS_OF_ROTATION, false},
    {"mush", SUPPLE_POSES_SET, SUPPLE_SKINNING_DELTA_MUSH_LIGHT, false},
    {"playback", SUPPLE_POSES_PLAYBACK, SUPPLE_SKINNING_LINEAR, false},
    {"view", SUPPLE_POSES_SET, SUPPLE_SKINNING_LINEAR, true},
};
class RemakeOf : public Remake, public testing::WithParamInterface<RemakeCase> {};
INSTANTIATE_TEST_SUITE_P(Kinds, RemakeOf, testing::ValuesIn(kRemakeCases),
                         [](const auto& param) { return std::string(param.param.name); });

/// A group of tubes, each with a pose, a place, a morph weight and a visibility of its own.
struct Tubes {
    Tubes(CrowdContext& context, const RemakeCase& c, SuppleAsset asset, uint32_t capacity) : kind(c) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = capacity;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 4;
        desc.poseSource = c.source;
        desc.skinning = c.skinning;
        if (c.viewed) {
            view = std::make_unique<TestView>(context, 400000);
            view->look({4.0f, 6.0f, 20.0f});
            desc.view = view->handle();
        } else {
            desc.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES;
        }
        crowd = std::make_unique<Crowd>(context, desc);
    }
    void add() {
        const SuppleContext context = crowd->context().handle();
        const SuppleInstance instance = crowd->spawn();
        instances.push_back(instance);
        const auto s = static_cast<float>(instance.slot);
        const float weights[] = {0.2f * s, 0.1f};
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), {0, 3 * s, 0}), s, {1, 0, 0});
        if (kind.source == SUPPLE_POSES_PLAYBACK) {
            SupplePlaybackLayer layer{};
            layer.clip = instance.slot % 2;
            layer.weight = 1.0f;
            layer.speed = 1.0f;
            layer.offset = 0.1 * instance.slot;
            SupplePlaybackDesc desc{};
            desc.structSize = sizeof desc;
            desc.layers = &layer;
            desc.layerCount = 1;
            EXPECT_EQ(suppleSetPlayback(context, instance, &desc), SUPPLE_OK);
            EXPECT_EQ(suppleSetTime(context, crowd->group(), 0.45), SUPPLE_OK);
        } else {
            EXPECT_EQ(suppleSetClipPose(context, instance, instance.slot % 2, 0.3 + 0.1 * s), SUPPLE_OK);
        }
        if (instance.slot % 2 == 1) {
            EXPECT_EQ(suppleSetMorphWeights(context, instance, weights, 2), SUPPLE_OK);
        }
        EXPECT_EQ(suppleSetTransform(context, instance, glm::value_ptr(place)), SUPPLE_OK);
        crowd->setVisible(instance, instance.slot != 2);
    }
    DrawnPatches drawn() {
        crowd->run();
        return drawnPatches(*crowd);
    }

    RemakeCase kind;
    std::unique_ptr<TestView> view;
    std::unique_ptr<Crowd> crowd;
    std::vector<SuppleInstance> instances;
};

TEST_P(RemakeOf, CapacityGrowsUnderTheSameHandles) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(tube());
        Tubes grown(own, GetParam(), asset, 4), large(own, GetParam(), asset, 9);
        ASSERT_TRUE(grown.crowd->valid() && large.crowd->valid());
        for (uint32_t i = 0; i < 4; ++i) {
            grown.add();
            large.add();
        }
        EXPECT_TRUE(grown.drawn() == large.drawn());
        SuppleInstance none{};
        EXPECT_EQ(suppleCreateInstance(own.handle(), grown.crowd->group(), &none), SUPPLE_ERROR_LIMIT);
        ASSERT_EQ(suppleSetCapacity(own.handle(), grown.crowd->group(), 9), SUPPLE_OK);
        EXPECT_EQ(grown.crowd->output().info.capacity, 9u);
        for (uint32_t i = 0; i < 4; ++i) {
            EXPECT_EQ(suppleTeleport(own.handle(), large.instances[i]), SUPPLE_OK); // after growing all are new
        }
        EXPECT_TRUE(grown.drawn() == large.drawn()) << "what was set is gone";
        for (uint32_t i = 4; i < 9; ++i) {
            grown.add();
            large.add();
        }
        const DrawnPatches all = large.drawn();
        EXPECT_TRUE(grown.drawn() == all);
        EXPECT_TRUE(grown.drawn() == large.drawn()) << "with a past";

        // Slots that are in use must stay.
        (void)own.takeLines();
        EXPECT_EQ(suppleSetCapacity(own.handle(), grown.crowd->group(), 8), SUPPLE_ERROR_LIMIT);
        EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_LIMIT), 1u);
        for (uint32_t i = 3; i < 9; ++i) {
            grown.crowd->destroy(grown.instances[i]);
            large.crowd->destroy(large.instances[i]);
        }
        ASSERT_EQ(suppleSetCapacity(own.handle(), grown.crowd->group(), 3), SUPPLE_OK);
        EXPECT_EQ(suppleTeleport(own.handle(), grown.instances[5]), SUPPLE_ERROR_ARGUMENT) << "long gone";
        for (uint32_t i = 0; i < 3; ++i) {
            EXPECT_EQ(suppleTeleport(own.handle(), large.instances[i]), SUPPLE_OK);
        }
        EXPECT_TRUE(grown.drawn() == large.drawn());
        (void)own.takeLines();
    }
}

/// The options are the host's, and gone when the group is made anew.
TEST_F(Remake, FragmentsKeepTheirRules) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    auto byLoop = std::make_unique<SuppleFragmentsOptions>();
    byLoop->structSize = sizeof(*byLoop);
    byLoop->rules = SUPPLE_RULES_LOOP;
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(tube());
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_FRAGMENTS;
    desc.rate = 4;
    desc.fragments = byLoop.get();
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    byLoop.reset();
    const auto allByLoop = [&] {
        uint32_t count = crowd.output().surface.patchCount;
        std::vector<SupplePatchInfo> patches(count);
        EXPECT_EQ(suppleGetPatches(own.handle(), crowd.group(), 0, patches.data(), &count), SUPPLE_OK);
        return !patches.empty() && std::all_of(patches.begin(), patches.end(), [](const SupplePatchInfo& patch) {
            return patch.patchClass == SUPPLE_PATCH_LOOP;
        });
    };
    EXPECT_TRUE(allByLoop());
    ASSERT_EQ(suppleSetCapacity(own.handle(), crowd.group(), 5), SUPPLE_OK);
    EXPECT_EQ(crowd.output().info.capacity, 5u);
    EXPECT_TRUE(allByLoop());
}

TEST_F(Remake, CapacityThatThereIsNoMemoryForChangesNothing) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    {
        CrowdContext own(*device);
        ASSERT_TRUE(own.valid());
        Tubes tubes(own, kRemakeCases[0], own.createAsset(tube()), 2);
        ASSERT_TRUE(tubes.crowd->valid());
        tubes.add();
        tubes.add();
        (void)tubes.drawn();
        const DrawnPatches before = tubes.drawn();
        uint32_t refused = 0;
        for (int64_t n = 0;; ++n) {
            wrapped = {};
            wrapped.failAllocation = n;
            const SuppleResult result = suppleSetCapacity(own.handle(), tubes.crowd->group(), 6);
            wrapped = {};
            if (result == SUPPLE_OK) {
                break;
            }
            EXPECT_EQ(result, SUPPLE_ERROR_DEVICE_MEMORY);
            EXPECT_EQ(tubes.crowd->output().info.capacity, 2u);
            EXPECT_TRUE(tubes.drawn() == before) << "allocation " << n;
            ++refused;
        }
        EXPECT_GT(refused, 2u);
        EXPECT_EQ(tubes.crowd->output().info.capacity, 6u);
        EXPECT_TRUE(tubes.drawn().size() == before.size());
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

TEST_P(RemakeOf, AssetIsReloadedInPlace) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(tube());
        Tubes tubes(own, GetParam(), asset, 4);
        ASSERT_TRUE(tubes.crowd->valid());
        for (uint32_t i = 0; i < 4; ++i) {
            tubes.add();
        }
        (void)tubes.drawn();
        const DrawnPatches before = tubes.drawn();

        // The same file: the same character, whose instances are new.
        ASSERT_EQ(own.reloadAsset(asset, tube()), SUPPLE_OK);
        DrawnPatches same = tubes.drawn();
        same = tubes.drawn();
        EXPECT_TRUE(same == before);

        // A file with more sides, a joint's node and the clips in another order: as if the group had begun with it.
        cage::Character other = tube(11);
        std::swap(other.clips[0], other.clips[1]);
        ASSERT_EQ(own.reloadAsset(asset, other), SUPPLE_OK);
        const SuppleAsset fresh = own.createAsset(other);
        Tubes wanted(own, GetParam(), fresh, 4);
        ASSERT_TRUE(wanted.crowd->valid());
        for (uint32_t i = 0; i < 4; ++i) {
            wanted.add();
        }
        for (uint32_t i = 0; i < 4; ++i) { // the clips of the same names
            const SuppleInstance instance = wanted.instances[i];
            if (GetParam().source == SUPPLE_POSES_PLAYBACK) {
                SupplePlaybackLayer layer{};
                layer.clip = 1 - i % 2;
                layer.weight = 1.0f;
                layer.speed = 1.0f;
                layer.offset = 0.1 * i;
                SupplePlaybackDesc desc{};
                desc.structSize = sizeof desc;
                desc.layers = &layer;
                desc.layerCount = 1;
                EXPECT_EQ(suppleSetPlayback(own.handle(), instance, &desc), SUPPLE_OK);
            } else {
                EXPECT_EQ(suppleSetClipPose(own.handle(), instance, 1 - i % 2, 0.3 + 0.1 * i), SUPPLE_OK);
            }
        }
        const DrawnPatches expected = wanted.drawn();
        EXPECT_NE(expected.size(), before.size());
        EXPECT_TRUE(tubes.drawn() == expected);
        SuppleAssetInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(suppleGetAssetInfo(own.handle(), asset, &info), SUPPLE_OK);
        EXPECT_EQ(info.cageVertexCount, other.cage.vertexCount());
    }
}

TEST_F(Remake, ReloadKeepsMasksAndPosesWithoutClips) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    // Both clips move the morph targets too; the first node is no longer where it was bound.
    const auto moving = [](bool secondClip) {
        cage::Character c = tube();
        c.skeleton.nodes[1].translation.x = 0.4f;
        for (cage::Clip& clip : c.clips) {
            clip.channels.push_back(channel(0, cage::ChannelPath::weights, {0, 1}, {0.2f, 0.9f, 0.7f, 0.1f}));
        }
        c.clips.resize(secondClip ? 2 : 1);
        return c;
    };
    const SuppleAsset asset = own.createAsset(moving(true));
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 4;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 2;
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    const float morphs[] = {0.25f, 1.0f};
    const float joints[] = {1.0f, 0.5f, 0.0f};
    SuppleMaskDesc mask{};
    mask.structSize = sizeof mask;
    mask.mask = 1;
    mask.morphMask = morphs;
    mask.morphMaskCount = 2;
    EXPECT_EQ(suppleSetMask(own.handle(), crowd.group(), &mask), SUPPLE_OK);
    mask.mask = 2;
    mask.jointMask = joints;
    mask.jointMaskCount = 3;
    EXPECT_EQ(suppleSetMask(own.handle(), crowd.group(), &mask), SUPPLE_OK);
    for (uint32_t i = 0; i < 4; ++i) { // two masks, no layer, a layer whose clip will be gone
        const SuppleInstance instance = crowd.spawn();
        SupplePlaybackLayer layer{};
        layer.clip = i == 3 ? 1 : 0;
        layer.mask = i < 2 ? i + 1 : 0;
        layer.weight = 1.0f;
        layer.speed = 1.0f;
        SupplePlaybackDesc plays{};
        plays.structSize = sizeof plays;
        plays.layers = &layer;
        plays.layerCount = i == 2 ? 0 : 1;
        EXPECT_EQ(suppleSetPlayback(own.handle(), instance, &plays), SUPPLE_OK);
    }
    EXPECT_EQ(suppleSetTime(own.handle(), crowd.group(), 0.6), SUPPLE_OK);
    crowd.run();
    std::vector<PositionBits> before;
    for (uint32_t slot = 0; slot < 4; ++slot) {
        before.push_back(crowd.positions(slot));
    }
    EXPECT_GT(differences(before[0], before[1]), 0u);
    EXPECT_GT(differences(before[2], before[3]), 0u);
    ASSERT_EQ(own.reloadAsset(asset, moving(false)), SUPPLE_OK);
    crowd.run();
    for (uint32_t slot = 0; slot < 4; ++slot) {
        const PositionBits& expected = before[slot == 3 ? 2 : slot]; // without its layer it is in the rest pose
        EXPECT_EQ(differences(crowd.positions(slot), expected), 0u) << "slot " << slot;
    }
    (void)own.takeLines();
}

TEST_F(Remake, AssetThatDoesNotLoadChangesNothing) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(tube());
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_PREP; // of quads
    desc.rate = 4;
    Crowd quads(own, desc);
    Tubes tubes(own, kRemakeCases[0], asset, 2);
    ASSERT_TRUE(quads.valid() && tubes.crowd->valid());
    (void)quads.spawn();
    tubes.add();
    quads.run();
    (void)tubes.drawn();
    const DrawnPatches before = tubes.drawn(), quadsBefore = drawnPatches(quads);
    (void)own.takeLines();

    SuppleAssetDesc broken{};
    broken.structSize = sizeof broken;
    broken.name = "broken";
    broken.bytes = "glTF";
    broken.byteCount = 4;
    EXPECT_EQ(suppleReloadAsset(own.handle(), asset, &broken), SUPPLE_ERROR_ASSET);
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_ASSET_REFUSED), 1u);
    // It loads, and P_m takes it, but p-rep does not.
    cage::Character triangles = tube();
    triangles.cage = gyroBipyramid(5);
    triangles.weights.influences.assign(triangles.cage.vertexCount(), {0, 1.0f});
    triangles.weights.starts.clear();
    for (uint32_t v = 0; v <= triangles.cage.vertexCount(); ++v) {
        triangles.weights.starts.push_back(v);
    }
    triangles.morphs = {};
    triangles.parts[0].targetCount = 0;
    EXPECT_EQ(own.reloadAsset(asset, triangles), SUPPLE_ERROR_ASSET);
    EXPECT_TRUE(tubes.drawn() == before);
    quads.run();
    EXPECT_TRUE(drawnPatches(quads) == quadsBefore);

    // Without the group that cannot take it, it goes.
    quads.end();
    EXPECT_EQ(own.reloadAsset(asset, triangles), SUPPLE_OK);
    EXPECT_FALSE(tubes.drawn().empty());
    (void)own.takeLines();
}

} // namespace
} // namespace supple::test
