// Groups that draw the instances of another group (SuppleGroupDesc.instancesOf): a second view, another scheme or rate.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

const std::string kFollowed = std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb";
constexpr uint32_t kFollowedCount = 5;

class Followers : public CrowdContexts {};

SuppleGroupDesc followedDesc(SuppleAsset asset, SuppleView view) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = kFollowedCount;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.view = view;
    return desc;
}

SuppleGroupDesc followerDesc(const Crowd& leader, SuppleAsset asset, SuppleScheme scheme, SuppleView view) {
    SuppleGroupDesc desc = followedDesc(asset, view);
    desc.scheme = scheme;
    desc.rate = 4;
    desc.capacity = 0;
    desc.instancesOf = leader.group();
    return desc;
}

/// Instances that move, hide, teleport and come anew.
void moveFollowed(Crowd& crowd, std::vector<SuppleInstance>& instances, uint32_t frame) {
    for (auto i = static_cast<uint32_t>(instances.size()); i < kFollowedCount; ++i) {
        instances.push_back(crowd.spawn());
    }
    if (frame == 3) {
        crowd.destroy(instances[1]);
        instances[1] = crowd.spawn();
    }
    for (const SuppleInstance& instance : instances) {
        const auto f = static_cast<float>(frame), s = static_cast<float>(instance.slot);
        crowd.pose(instance, instance.slot % crowd.clipCount(), 0.13 * frame,
                   glm::translate(glm::mat4(1.0f), {2.0f * s - 4.0f + 0.1f * f, 0.0f, -s * s}));
        crowd.setVisible(instance, instance.slot != 2 || frame == 4);
        EXPECT_EQ(suppleSetPartVisible(crowd.context().handle(), instance, 0, instance.slot == 4 ? 0 : 1), SUPPLE_OK);
    }
    if (frame == 2) {
        crowd.teleport(instances[0]);
    }
}

TEST_F(Followers, DrawWhatGroupsOfTheirOwnDraw) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.asset(kFollowed);
        constexpr uint32_t kFlags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL;
        // Two halves of a split screen, once with instances of both groups' own, once shared.
        TestView left(own, 300000, kFlags), right(own, 300000, kFlags);
        TestView leftAlone(own, 300000, kFlags), rightAlone(own, 300000, kFlags);
        for (TestView* view : {&left, &right, &leftAlone, &rightAlone}) {
            const bool isLeft = view == &left || view == &leftAlone;
            const glm::vec3 eye = isLeft ? glm::vec3(0, 1, 6) : glm::vec3(9, 2, -14);
            const glm::mat4 seen = glm::perspectiveRH_ZO(0.7f, 1.0f, 0.1f, 500.0f) *
                                   glm::lookAt(eye, glm::vec3(0, 0, -4), glm::vec3(0, 1, 0));
            std::memcpy(view->camera.viewProjection, &seen, sizeof seen);
            view->look(eye);
        }
        Crowd leader(own, followedDesc(asset, left.handle()));
        ASSERT_TRUE(leader.valid());
        Crowd mirror(own, followerDesc(leader, asset, SUPPLE_SCHEME_PM, right.handle()));
        Crowd grids(own, followerDesc(leader, asset, SUPPLE_SCHEME_FRAGMENTS, {}));
        Crowd leaderAlone(own, followedDesc(asset, leftAlone.handle()));
        Crowd mirrorAlone(own, followedDesc(asset, rightAlone.handle()));
        SuppleGroupDesc gridsDesc = followedDesc(asset, {});
        gridsDesc.scheme = SUPPLE_SCHEME_FRAGMENTS;
        gridsDesc.rate = 4;
        Crowd gridsAlone(own, gridsDesc);
        ASSERT_TRUE(mirror.valid() && grids.valid() && leaderAlone.valid() && mirrorAlone.valid() &&
                    gridsAlone.valid());
        EXPECT_EQ(mirror.output().info.deformedCage.buffer, leader.output().info.deformedCage.buffer);
        std::vector<SuppleInstance> shared, alone[3];
        for (uint32_t frame = 0; frame < 6; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            moveFollowed(leader, shared, frame);
            uint32_t k = 0;
            for (Crowd* crowd : {&leaderAlone, &mirrorAlone, &gridsAlone}) {
                moveFollowed(*crowd, alone[k++], frame);
            }
            // In any order; and in frame 4 the mirror is not looked at, so that its instances are new afterwards.
            std::vector<SuppleGroup> together = {grids.group(), leader.group()};
            if (frame != 4) {
                together.push_back(mirror.group());
                mirrorAlone.run();
            }
            own.run(together);
            leaderAlone.run();
            gridsAlone.run();
            EXPECT_TRUE(drawnPatches(leader) == drawnPatches(leaderAlone));
            EXPECT_TRUE(drawnPatches(grids) == drawnPatches(gridsAlone));
            if (frame != 4) {
                const DrawnPatches expected = drawnPatches(mirrorAlone);
                EXPECT_FALSE(expected.empty());
                EXPECT_TRUE(drawnPatches(mirror) == expected);
            }
        }
    }
}

TEST_F(Followers, CountWhatTheyHideThemselves) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(sideBySide(cage::makeCubeSphere(3), "sphere", 3));
    TestView view(own, 300000), viewAlone(own, 300000);
    SuppleGroupDesc desc = followedDesc(asset, {});
    desc.rate = 2;
    Crowd leader(own, desc);
    ASSERT_TRUE(leader.valid());
    Crowd follower(own, followerDesc(leader, asset, SUPPLE_SCHEME_PM, view.handle()));
    Crowd alone(own, followedDesc(asset, viewAlone.handle()));
    ASSERT_TRUE(follower.valid() && alone.valid());
    for (Crowd* crowd : {&leader, &alone}) {
        const SuppleInstance instances[] = {crowd->spawn(), crowd->spawn()};
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instances[0], 1, 0), SUPPLE_OK);
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instances[1], 0, 0), SUPPLE_OK);
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instances[1], 2, 0), SUPPLE_OK);
    }
    for (TestView* const both : {&view, &viewAlone}) {
        both->look({0, 1, 20});
    }
    const SuppleGroup groups[] = {leader.group(), follower.group(), alone.group()};
    own.run(groups);
    own.beginFrame(); // the frame is complete
    const SuppleViewStatistics found = view.statistics(), expected = viewAlone.statistics();
    EXPECT_EQ(expected.hiddenPatchCount, follower.output().surface.patchCount);
    EXPECT_EQ(found.hiddenPatchCount, expected.hiddenPatchCount);
    EXPECT_EQ(found.backFaceCount, expected.backFaceCount);
    EXPECT_EQ(found.patchCount, expected.patchCount);
}

TEST_F(Followers, OutliveALeaderWhoseAssetIsReloaded) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(sideBySide(cage::makeCubeSphere(3), "sphere", 2));
    Crowd leader(own, followedDesc(asset, {}));
    ASSERT_TRUE(leader.valid());
    Crowd follower(own, followerDesc(leader, asset, SUPPLE_SCHEME_PM, {}));
    ASSERT_TRUE(follower.valid());
    (void)leader.spawn();
    const SuppleGroup groups[] = {leader.group(), follower.group()};
    own.run(groups);
    leader.end();
    ASSERT_EQ(own.reloadAsset(asset, sideBySide(cage::makeCubeSphere(4), "sphere", 2)), SUPPLE_OK);
    for (int frame = 0; frame < 4; ++frame) { // what was replaced is freed
        own.run(std::span<const SuppleGroup>{});
    }
    SuppleGroupInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(suppleGetGroupInfo(own.handle(), follower.group(), &info), SUPPLE_OK);
    EXPECT_EQ(info.capacity, kFollowedCount);
    (void)own.takeLines();
}

TEST_F(Followers, AreRecordedWithTheirLeader) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.asset(kFollowed);
    Crowd leader(own, followedDesc(asset, {}));
    ASSERT_TRUE(leader.valid());
    Crowd follower(own, followerDesc(leader, asset, SUPPLE_SCHEME_PM, {}));
    ASSERT_TRUE(follower.valid());
    std::vector<SuppleInstance> instances;
    moveFollowed(leader, instances, 0);
    (void)own.takeLines();

    Commands commands(own.device());
    const SuppleGroup groups[] = {leader.group(), follower.group()};
    own.beginFrame();
    commands.record([&](VkCommandBuffer buffer) {
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[1], 1}), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_OUT_OF_ORDER), 1u) << "its leader is not recorded";
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[0], 1}), SUPPLE_OK);
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[1], 1}), SUPPLE_OK) << "a later suppleRecord of the frame";
    });
    commands.submit();
    commands.wait();
    EXPECT_FALSE(drawnPatches(follower).empty());

    // What belongs to the leader.
    SuppleInstance instance{};
    EXPECT_EQ(suppleCreateInstance(own.handle(), follower.group(), &instance), SUPPLE_ERROR_ARGUMENT);
    instance = {follower.group(), instances[0].slot, instances[0].generation};
    EXPECT_EQ(suppleSetVisible(own.handle(), instance, 0), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetCapacity(own.handle(), follower.group(), 9), SUPPLE_ERROR_ARGUMENT);
    SuppleGroupDesc desc = followerDesc(follower, asset, SUPPLE_SCHEME_PM, {});
    desc.structSize = sizeof desc;
    SuppleGroup none{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &none), SUPPLE_ERROR_ARGUMENT) << "a follower is not followed";
    desc.instancesOf = leader.group();
    desc.capacity = 3;
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &none), SUPPLE_ERROR_ARGUMENT);
    desc.capacity = 0;
    desc.asset = own.createAsset(riggedTube());
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &none), SUPPLE_ERROR_ARGUMENT) << "another asset";
    EXPECT_EQ(own.takeLines().size(), 6u) << "one line for each";

    // Growing makes both anew.
    EXPECT_EQ(suppleSetCapacity(own.handle(), leader.group(), 12), SUPPLE_OK);
    EXPECT_EQ(follower.output().info.capacity, 12u);
    own.run(groups);
    const DrawnPatches expected = drawnPatches(leader);
    EXPECT_TRUE(drawnPatches(follower).size() == expected.size());

    leader.end();
    own.beginFrame();
    commands.record([&](VkCommandBuffer buffer) {
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[1], 1}), SUPPLE_ERROR_ARGUMENT);
    });
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_OUT_OF_ORDER), 1u);
}

} // namespace
} // namespace supple::test
