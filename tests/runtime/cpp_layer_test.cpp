// The C++ layer: ownership, sized structs, and that everything works through it alone.
#include "tests/support/gpu_surface.h"

#include <array>
#include <gtest/gtest.h>
#include <supple/supple.hpp>

namespace {

constexpr float kPositions[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
constexpr uint32_t kCounts[] = {4, 4, 4, 4, 4, 4};
constexpr uint32_t kIndices[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

TEST(CppLayer, OwnsWhatItMakes) {
    supple::host::Device* device = supple::test::testDevice();
    ASSERT_NE(device, nullptr);
    const supple::test::ValidationGuard guard;
    auto contextDesc = supple::sized<SuppleContextDesc>();
    contextDesc.instance = device->instance();
    contextDesc.physicalDevice = device->physicalDevice();
    contextDesc.device = device->handle();
    contextDesc.queueFamily = device->queueFamily();
    contextDesc.getInstanceProcAddr = device->getInstanceProcAddr();
    supple::Context context;
    ASSERT_EQ(supple::Context::create(contextDesc, context), SUPPLE_OK);

    auto cage = supple::sized<SuppleCageDesc>();
    cage.vertexCount = 8;
    cage.faceCount = 6;
    cage.positions = kPositions;
    cage.faceVertexCounts = kCounts;
    cage.faceVertexIndices = kIndices;
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = "cube";
    assetDesc.cage = &cage;
    supple::Group group, players;
    {
        supple::Asset asset;
        ASSERT_EQ(supple::Asset::create(context, assetDesc, asset), SUPPLE_OK);
        supple::Prepared prepared;
        auto prepareDesc = supple::sized<SupplePrepareDesc>();
        EXPECT_EQ(supple::Prepared::create(prepareDesc, prepared), SUPPLE_ERROR_ARGUMENT) << "no asset";
        prepareDesc.asset = &assetDesc;
        ASSERT_EQ(supple::Prepared::create(prepareDesc, prepared), SUPPLE_OK);
        supple::Prepared moved(std::move(prepared));
        auto preparedDesc = supple::sized<SuppleAssetDesc>();
        preparedDesc.prepared = moved.handle();
        ASSERT_EQ(supple::Asset::create(context, preparedDesc, asset), SUPPLE_OK);
        SuppleAssetInfo info;
        ASSERT_EQ(asset.info(info), SUPPLE_OK);
        EXPECT_EQ(info.faceCount, 6u);
        SupplePartInfo part;
        ASSERT_EQ(asset.partInfo(0, part), SUPPLE_OK);
        EXPECT_EQ(part.faceCount, 6u);
        EXPECT_EQ(asset.partInfo(1, part), SUPPLE_ERROR_ARGUMENT);
        auto groupDesc = supple::sized<SuppleGroupDesc>();
        groupDesc.asset = asset.handle();
        groupDesc.capacity = 1;
        ASSERT_EQ(supple::Group::create(context, groupDesc, group), SUPPLE_OK);
        groupDesc.poseSource = SUPPLE_POSES_PLAYBACK;
        ASSERT_EQ(supple::Group::create(context, groupDesc, players), SUPPLE_OK);
    } // the group keeps what it needs of the asset

    std::vector<SupplePatchInfo> patches(99);
    EXPECT_EQ(group.patches(patches), SUPPLE_OK);
    EXPECT_EQ(patches.size(), 6u);
    std::vector<VkBufferMemoryBarrier2> barriers;
    EXPECT_EQ(context.acquireBarriers({}, {}, barriers), SUPPLE_ERROR_ARGUMENT) << "one queue family";
    EXPECT_EQ(context.setBudget(SUPPLE_PASS_EVALUATE, 1e6), SUPPLE_OK);
    SuppleBudget budget;
    EXPECT_EQ(context.budget(SUPPLE_PASS_EVALUATE, budget), SUPPLE_OK);
    EXPECT_EQ(budget.limit, 1e6);
    EXPECT_EQ(context.setMemoryBudget(VkDeviceSize{1} << 30), SUPPLE_OK);

    std::array<float, 16> identity{};
    identity[0] = identity[5] = identity[10] = identity[15] = 1.0f;
    supple::Instance instance;
    ASSERT_EQ(supple::Instance::create(group, instance), SUPPLE_OK);
    supple::Instance second;
    EXPECT_EQ(supple::Instance::create(group, second), SUPPLE_ERROR_LIMIT) << "room for one";
    EXPECT_EQ(instance.setTransform(identity), SUPPLE_OK);
    EXPECT_EQ(instance.setMatrixPose(identity), SUPPLE_OK);
    EXPECT_EQ(instance.setClipPose(SUPPLE_BIND_POSE, 0.0), SUPPLE_OK);
    EXPECT_EQ(instance.setVisible(true), SUPPLE_OK);
    EXPECT_EQ(instance.setPartVisible(0, true), SUPPLE_OK);
    EXPECT_EQ(instance.teleport(), SUPPLE_OK);
    EXPECT_EQ(group.setRate(4), SUPPLE_OK);
    supple::Instance player;
    ASSERT_EQ(supple::Instance::create(players, player), SUPPLE_OK);
    const float mask[] = {0.5f};
    EXPECT_EQ(players.setMask(3, mask), SUPPLE_OK);
    EXPECT_EQ(players.setTime(1.5), SUPPLE_OK);
    std::array<float, 16> socket{};
    EXPECT_EQ(player.jointTransform(0, socket), SUPPLE_OK);
    EXPECT_EQ(socket, identity);
    EXPECT_EQ(instance.jointTransform(1, socket), SUPPLE_ERROR_ARGUMENT) << "it has one joint";
    EXPECT_EQ(player.setPlayback(std::span<const SupplePlaybackLayer>()), SUPPLE_OK) << "the rest pose";
    auto playback = supple::sized<SupplePlaybackDesc>();
    playback.rootMotion = SUPPLE_ROOT_MOTION_GROUND;
    EXPECT_EQ(player.setPlayback(playback), SUPPLE_OK);
    EXPECT_EQ(player.setClipPose(SUPPLE_BIND_POSE, 0.0), SUPPLE_ERROR_ARGUMENT) << "it plays";
    std::vector<SuppleTiming> timings;
    EXPECT_EQ(context.timings(timings), SUPPLE_NOT_READY);
    for (uint64_t frame = 1; frame <= 2; ++frame) {
        ASSERT_EQ(context.beginFrame(frame, frame - 1), SUPPLE_OK);
        const SuppleGroup handle = group.handle();
        ASSERT_TRUE(device
                        ->submitAndWait([&](VkCommandBuffer commands) {
                            EXPECT_EQ(context.record(commands, {&handle, 1}, {}, {}, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
                        })
                        .ok());
    }
    ASSERT_EQ(context.beginFrame(3, 2), SUPPLE_OK);
    EXPECT_EQ(context.timings(timings), SUPPLE_OK);
    EXPECT_FALSE(timings.empty());
    EXPECT_EQ(timings.back().pass, SUPPLE_PASS_EVALUATE);
    EXPECT_EQ(timings.back().surface, 0u);
    SuppleGroupInfo info;
    ASSERT_EQ(group.info(info), SUPPLE_OK);
    EXPECT_EQ(info.surfaceCount, 1u);
    SuppleSurfaceInfo surface;
    ASSERT_EQ(group.surfaceInfo(surface), SUPPLE_OK);
    EXPECT_EQ(surface.patchCount, 6u);
    SuppleVertexStreams streams;
    SuppleGridOutput grid;
    SuppleLevelOutput levels;
    SuppleBufferRange bounds;
    EXPECT_EQ(group.vertexStreams(streams), SUPPLE_OK);
    EXPECT_NE(streams.vertices.buffer, VkBuffer{VK_NULL_HANDLE});
    EXPECT_EQ(group.gridOutput(grid), SUPPLE_OK);
    EXPECT_GT(grid.drawRangeCount, 0u);
    EXPECT_EQ(group.levelOutput(levels), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.instanceBounds(bounds), SUPPLE_ERROR_ARGUMENT);
    supple::Group moved = std::move(group);
    EXPECT_EQ(group.info(info), SUPPLE_ERROR_ARGUMENT) << "moved from";
    EXPECT_EQ(moved.info(info), SUPPLE_OK);
}

} // namespace
