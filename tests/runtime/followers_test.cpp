// Groups that draw the instances of another group (SuppleGroupDesc.instancesOf): a second view, another scheme or rate.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

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
            // In any order; and in frame 4 the mirror is not looked at. As it shares coefficients with the leader, its
            // instances are new afterwards.
            for (const SuppleInstance instance : frame == 5 ? alone[1] : std::vector<SuppleInstance>{}) {
                mirrorAlone.teleport(instance);
            }
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

/// Groups that are created in a frame behind the recording of the one that they follow: what that one has left unposed,
/// they cannot draw in this frame.
void expectLateFollowers(CrowdContext& own, bool seesAll) {
    const SuppleAsset asset = own.asset(kFollowed);
    TestView view(own, 300000, SUPPLE_VIEW_CULL | SUPPLE_VIEW_MOTION);
    Crowd leader(own, followedDesc(asset, view.handle()));
    ASSERT_TRUE(leader.valid());
    std::vector<SuppleInstance> instances;
    const glm::vec3 eye(0.0f, 1.0f, seesAll ? 40.0f : 6.0f), ahead(0, 0, -1), aside(1, 0, 0);
    for (uint32_t frame = 0; frame < 3; ++frame) {
        moveFollowed(leader, instances, frame);
        view.look(eye, eye + (seesAll ? ahead : aside), glm::perspectiveRH_ZO(0.7f, 1.0f, 0.1f, 500.0f));
        leader.run();
    }
    own.beginFrame();
    SuppleGroupDesc desc = followerDesc(leader, asset, SUPPLE_SCHEME_FRAGMENTS, {});
    std::unique_ptr<Crowd> late;
    Commands commands(own.device());
    const SuppleGroup first = leader.group();
    commands.record([&](VkCommandBuffer buffer) {
        EXPECT_EQ(own.record(buffer, {&first, 1}), SUPPLE_OK);
        late = std::make_unique<Crowd>(own, desc);
        const SuppleGroup second = late->group();
        EXPECT_EQ(own.record(buffer, {&second, 1}), SUPPLE_OK);
    });
    commands.submit();
    commands.wait();
    desc = followedDesc(asset, {});
    desc.scheme = SUPPLE_SCHEME_FRAGMENTS;
    desc.rate = 4;
    Crowd alone(own, desc);
    ASSERT_TRUE(late->valid() && alone.valid());
    std::vector<SuppleInstance> ownInstances;
    for (uint32_t frame = 0; frame < 3; ++frame) {
        moveFollowed(alone, ownInstances, frame);
        alone.run();
    }
    const DrawnPatches expected = drawnPatches(alone);
    ASSERT_FALSE(expected.empty());
    if (seesAll) {
        EXPECT_TRUE(drawnPatches(*late) == expected) << "all were posed";
    } else {
        const std::vector<VkDrawIndexedIndirectCommand> draws = late->draws();
        ASSERT_FALSE(draws.empty());
        for (const VkDrawIndexedIndirectCommand& draw : draws) {
            EXPECT_EQ(draw.indexCount * draw.instanceCount, 0u) << "it waits";
        }
    }
    const SuppleGroup both[] = {first, late->group()};
    own.run(both);
    EXPECT_TRUE(drawnPatches(*late) == expected) << "the leader poses all that others draw";
}

TEST_F(Followers, ThatComeBehindTheRecordingOfTheirLeaderWaitForPosesThatItHasLeftOut) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        expectLateFollowers(context(mapping), false);
        expectLateFollowers(context(mapping), true);
    }
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    expectLateFollowers(shared, false);
    expectLateFollowers(shared, true);
}

/// Views of the followed instances, from the left and from the right: each sees some that the other does not.
void lookFromTwoSides(TestView& left, TestView& right) {
    for (TestView* view : {&left, &right}) {
        const float x = view == &left ? -4.0f : 4.0f;
        view->look(glm::vec3(x, 1, 8), glm::vec3(x, 0, 0), glm::perspectiveRH_ZO(0.3f, 1.0f, 0.1f, 500.0f));
    }
}

uint64_t coefficientsOf(const Crowd& crowd) {
    SuppleMemoryUse use{};
    use.structSize = sizeof(use);
    EXPECT_EQ(suppleGetGroupMemory(crowd.context().handle(), crowd.group(), &use), SUPPLE_OK);
    return use.coefficients;
}

bool drawsOneThatIsNotIn(const DrawnPatches& some, const DrawnPatches& others) {
    return std::any_of(some.begin(), some.end(), [&](const auto& own) {
        return std::none_of(others.begin(), others.end(),
                            [&](const auto& other) { return other.first.slot == own.first.slot; });
    });
}

/// In every view the coefficients are those that the followed group has made, of what either of them sees.
void expectSharedCoefficients(CrowdContext& own, SuppleScheme scheme, bool shares) {
    const SuppleAsset asset = own.asset(kFollowed);
    constexpr uint32_t kFlags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL;
    TestView left(own, 300000, kFlags, 0, 0), right(own, 300000, kFlags, 0, 0);
    TestView leftAlone(own, 300000, kFlags, 0, 0), rightAlone(own, 300000, kFlags, 0, 0);
    lookFromTwoSides(left, right);
    lookFromTwoSides(leftAlone, rightAlone);
    SuppleGroupDesc desc = followedDesc(asset, left.handle());
    desc.scheme = scheme;
    desc.rate = 4;
    Crowd leader(own, desc);
    Crowd mirror(own, followerDesc(leader, asset, scheme, right.handle()));
    desc.view = leftAlone.handle();
    Crowd leaderAlone(own, desc);
    desc.view = rightAlone.handle();
    Crowd mirrorAlone(own, desc);
    EXPECT_EQ(coefficientsOf(leader), coefficientsOf(leaderAlone));
    EXPECT_EQ(coefficientsOf(mirror), shares ? 0 : coefficientsOf(mirrorAlone));
    std::vector<SuppleInstance> together, alone[2];
    bool onLeft = false, onRight = false;
    for (uint32_t frame = 0; frame < 6; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        moveFollowed(leader, together, frame);
        moveFollowed(leaderAlone, alone[0], frame);
        moveFollowed(mirrorAlone, alone[1], frame);
        const SuppleGroup first = leader.group(), second = mirror.group();
        own.beginFrame();
        ASSERT_TRUE(own.device()
                        .submitAndWait([&](VkCommandBuffer commands) {
                            if (frame == 3) { // the followed group does not know what the mirror sees
                                EXPECT_EQ(own.record(commands, {&first, 1}), SUPPLE_OK);
                                EXPECT_EQ(own.record(commands, {&second, 1}), SUPPLE_OK);
                            } else {
                                EXPECT_EQ(own.record(commands, std::array{first, second}), SUPPLE_OK);
                            }
                        })
                        .ok());
        leaderAlone.run();
        mirrorAlone.run();
        const DrawnPatches ofLeader = drawnPatches(leader), ofMirror = drawnPatches(mirror);
        EXPECT_TRUE(ofLeader == drawnPatches(leaderAlone));
        EXPECT_TRUE(ofMirror == drawnPatches(mirrorAlone));
        onLeft = onLeft || drawsOneThatIsNotIn(ofLeader, ofMirror);
        onRight = onRight || drawsOneThatIsNotIn(ofMirror, ofLeader);
    }
    EXPECT_TRUE(onLeft && onRight) << "each has drawn what the other did not see";
}

TEST_F(Followers, ReadTheCoefficientsOfTheGroupThatTheyFollow) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleScheme scheme :
             {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_CATMULL_CLARK}) {
            SCOPED_TRACE(std::string(mappingName(mapping)) + ", scheme " + std::to_string(scheme));
            expectSharedCoefficients(context(mapping), scheme, scheme != SUPPLE_SCHEME_CATMULL_CLARK);
        }
    }
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    expectSharedCoefficients(shared, SUPPLE_SCHEME_PM, true);
}

TEST_F(Followers, AnyNumberOfThemDrawsTheSame) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.asset(kFollowed);
    TestView left(own, 300000, SUPPLE_VIEW_CULL, 0, 0), right(own, 300000, SUPPLE_VIEW_CULL, 0, 0);
    lookFromTwoSides(left, right);
    Crowd leader(own, followedDesc(asset, left.handle()));
    std::vector<SuppleInstance> instances;
    moveFollowed(leader, instances, 0);
    std::vector<std::unique_ptr<TestView>> views;
    std::vector<std::unique_ptr<Crowd>> mirrors;
    std::vector<SuppleGroup> groups = {leader.group()};
    constexpr uint32_t kSharing = 7; // places
    const auto add = [&] {
        auto& view = views.emplace_back(std::make_unique<TestView>(own, 300000, SUPPLE_VIEW_CULL, 0, 0));
        lookFromTwoSides(left, *view);
        mirrors.push_back(std::make_unique<Crowd>(own, followerDesc(leader, asset, SUPPLE_SCHEME_PM, view->handle())));
        groups.push_back(mirrors.back()->group());
        EXPECT_EQ(coefficientsOf(*mirrors.back()) == 0, mirrors.size() <= kSharing);
    };
    while (mirrors.size() < kSharing + 2) {
        add();
    }
    own.run(groups);
    const DrawnPatches expected = drawnPatches(*mirrors.back());
    EXPECT_FALSE(expected.empty());
    for (const std::unique_ptr<Crowd>& mirror : mirrors) {
        EXPECT_TRUE(drawnPatches(*mirror) == expected);
    }
    // Who goes leaves a place.
    const SuppleGroup gone = mirrors[2]->group();
    std::erase_if(groups, [&](SuppleGroup group) { return group.id == gone.id; });
    mirrors.erase(mirrors.begin() + 2);
    for (uint32_t frame = 0; frame < 3; ++frame) {
        own.run(groups);
    }
    mirrors.erase(mirrors.end() - 1);
    groups.pop_back();
    mirrors.erase(mirrors.end() - 1);
    groups.pop_back();
    add();
    own.run(groups);
    EXPECT_TRUE(drawnPatches(*mirrors.back()) == expected);
    EXPECT_TRUE(drawnPatches(*mirrors.front()) == expected);
}

} // namespace
} // namespace supple::test
