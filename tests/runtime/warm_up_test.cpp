// suppleRecordWarmUp dispatches every pipeline that later frames run, and changes nothing.
#include "tests/support/meshes.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// Two parts, so that a group can have two surfaces.
cage::Character twoBipeds() {
    return sideBySide(biped(), "biped", 2);
}

/// Groups of many kinds, without a view and in one.
class WarmedStage {
public:
    explicit WarmedStage(host::Device& device)
        : context(device), view_(context, 200000, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL) {
        SuppleAsset tube{};
        EXPECT_EQ(createTube(context.handle(), tube), SUPPLE_OK);
        const SuppleAsset bipeds = context.createAsset(twoBipeds());
        constexpr uint32_t kAll = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES;
        constexpr uint32_t kMesh = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_INDEXED_MESH;
        static constexpr SuppleScheme kTwo[] = {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_FRAGMENTS};
        const auto add = [&](SuppleGroupDesc desc, SuppleAsset asset) {
            if (asset.id == bipeds.id) {
                desc.partSchemes = kTwo;
                desc.partSchemeCount = 2;
            }
            desc.structSize = sizeof desc;
            desc.asset = asset;
            desc.capacity = 2;
            desc.rate = 4;
            desc.view = desc.flags == 0 && desc.scheme != SUPPLE_SCHEME_CAGE ? view_.handle() : SuppleView{};
            SuppleGroup group{};
            EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_OK);
            groups.push_back(group);
            played_.push_back(desc.poseSource == SUPPLE_POSES_PLAYBACK);
        };
        for (const uint32_t flags : {kAll, 0u}) { // 0: in the view
            add({.flags = flags, .scheme = SUPPLE_SCHEME_PM, .poseSource = SUPPLE_POSES_PLAYBACK}, tube);
            add({.flags = flags & ~uint32_t{SUPPLE_GROUP_PATCHES},
                 .scheme = SUPPLE_SCHEME_FRAGMENTS,
                 .skinning = SUPPLE_SKINNING_DUAL_QUATERNION},
                tube);
            add({.flags = flags & ~uint32_t{SUPPLE_GROUP_PATCHES}, .scheme = SUPPLE_SCHEME_BLEND}, tube);
            add({.flags = flags & ~uint32_t{SUPPLE_GROUP_PATCHES},
                 .scheme = SUPPLE_SCHEME_CATMULL_CLARK,
                 .skinning = SUPPLE_SKINNING_CENTERS_OF_ROTATION},
                tube);
            add({.flags = flags & ~uint32_t{SUPPLE_GROUP_PATCHES},
                 .scheme = SUPPLE_SCHEME_POLYGONS,
                 .skinning = SUPPLE_SKINNING_DUAL_QUATERNION,
                 .poseSource = SUPPLE_POSES_PLAYBACK},
                tube);
            add({.flags = flags & ~uint32_t{SUPPLE_GROUP_PATCHES}}, bipeds);
        }
        add({.flags = kMesh, .scheme = SUPPLE_SCHEME_PM}, tube);
        add({.scheme = SUPPLE_SCHEME_CAGE}, tube);
        EXPECT_EQ(context.takeError(), 0);
    }
    ~WarmedStage() {
        for (const SuppleGroup& group : groups) {
            EXPECT_EQ(suppleDestroyGroup(context.handle(), group), SUPPLE_OK);
        }
    }
    WarmedStage(const WarmedStage&) = delete;
    WarmedStage& operator=(const WarmedStage&) = delete;

    void warmUp() {
        context.beginFrame();
        ASSERT_TRUE(context.device()
                        .submitAndWait([&](VkCommandBuffer commands) {
                            EXPECT_EQ(suppleRecordWarmUp(context.handle(), commands, groups.data(),
                                                         static_cast<uint32_t>(groups.size())),
                                      SUPPLE_OK);
                        })
                        .ok());
    }
    /// What a game does in its first frames. The surface of the first group after each.
    std::vector<std::vector<std::byte>> play() {
        for (const SuppleGroup& group : groups) {
            for (std::vector<SuppleInstance>* of : {&near_, &far_}) {
                EXPECT_EQ(suppleCreateInstance(context.handle(), group, &of->emplace_back()), SUPPLE_OK);
            }
            const glm::mat4 away = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 400.0f, 0.0f));
            EXPECT_EQ(suppleSetTransform(context.handle(), far_.back(), &away[0][0]), SUPPLE_OK);
        }
        std::vector<std::vector<std::byte>> bits;
        const auto frame = [&] {
            context.evaluate(groups);
            bits.push_back(surfaceBits(context, groups.front()));
        };
        view_.look({0.0f, -6.0f, 0.0f});
        frame();
        frame(); // with a past
        SupplePlaybackLayer layers[2]{};
        layers[0] = {.flags = SUPPLE_LAYER_LOOP, .weight = 1.0f, .speed = 1.0f};
        layers[1] = {.mode = SUPPLE_LAYER_ADDITIVE, .weight = 0.5f, .speed = 1.0f};
        SupplePlaybackDesc playback{};
        playback.structSize = sizeof playback;
        playback.flags = SUPPLE_PLAYBACK_TRAVEL;
        playback.rootMotion = SUPPLE_ROOT_MOTION_GROUND;
        playback.layers = layers;
        playback.layerCount = 2;
        for (size_t g = 0; g < groups.size(); ++g) {
            if (played_[g]) {
                EXPECT_EQ(suppleSetPlayback(context.handle(), near_[g], &playback), SUPPLE_OK);
                EXPECT_EQ(suppleSetTime(context.handle(), groups[g], 0.5), SUPPLE_OK);
            }
        }
        frame();
        view_.camera.vertexBudget = 3000;
        view_.look({0.0f, -2.0f, 0.0f});
        frame();
        return bits;
    }

    CrowdContext context;
    std::vector<SuppleGroup> groups;

private:
    TestView view_;
    std::vector<bool> played_;
    std::vector<SuppleInstance> near_, far_; ///< by group
};

TEST(WarmUp, DispatchesWhatLaterFramesRunAndChangesNothing) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    std::vector<std::vector<std::byte>> expected;
    {
        WarmedStage plain(*device);
        expected = plain.play();
    }
    wrapped = {};
    {
        WarmedStage stage(*device);
        stage.warmUp();
        const std::set<VkPipeline> warmed = std::exchange(wrapped.pipelinesBound, {});
        EXPECT_GT(warmed.size(), 20u);
        EXPECT_EQ(wrapped.indirectDispatches, 0u);
        EXPECT_EQ(wrapped.workgroups, 0u);
        EXPECT_TRUE(stage.play() == expected);
        std::set<VkPipeline> cold;
        std::ranges::set_difference(wrapped.pipelinesBound, warmed, std::inserter(cold, cold.end()));
        EXPECT_EQ(cold.size(), 0u) << "pipelines of " << wrapped.pipelinesBound.size() << " that frames run first";
        EXPECT_GT(wrapped.workgroups, 0u);
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

TEST(WarmUp, NeedsAFrameAndLivingGroups) {
    const ValidationGuard guard;
    ASSERT_NE(testDevice(), nullptr);
    CrowdContext context(*testDevice());
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    const SmallGroup small = createGroup(context.handle(), asset);
    ASSERT_TRUE(testDevice()
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        const auto warmUp = [&](const SuppleGroup* groups, uint32_t count) {
                            return suppleRecordWarmUp(context.handle(), commands, groups, count);
                        };
                        EXPECT_EQ(warmUp(&small.group, 1), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(context.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
                        context.beginFrame();
                        const SuppleGroup stale{77};
                        EXPECT_EQ(warmUp(&stale, 1), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(context.takeError(), SUPPLE_MESSAGE_STALE_HANDLE);
                        EXPECT_EQ(warmUp(nullptr, 1), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(context.takeError(), SUPPLE_MESSAGE_NULL_POINTER);
                        EXPECT_EQ(warmUp(nullptr, 0), SUPPLE_OK);
                        // In the frame that it belongs to, and in the same command buffer.
                        EXPECT_EQ(warmUp(&small.group, 1), SUPPLE_OK);
                        EXPECT_EQ(context.record(commands, {&small.group, 1}), SUPPLE_OK);
                    })
                    .ok());
}

} // namespace
} // namespace supple::test
