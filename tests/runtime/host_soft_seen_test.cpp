// What is soft in groups whose poses the host sets: in views, with motion vectors, and behind a reload.
#include "tests/support/poses_of_host.h"
#include "tests/support/soft_assets.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

class HostSoftSeen : public CrowdContexts {};

constexpr uint32_t kHopSeen = 1; ///< the clip

/// A group in a view of its own that culls, by levels of detail.
struct WatchedByHost {
    WatchedByHost(CrowdContext& context, SuppleGroupDesc desc) : view(context, 1u << 18, SUPPLE_VIEW_CULL) {
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        group = std::make_unique<PosedGroup>(context, desc, kHopSeen);
        view.camera.pixelsPerUnit = 400.0f;
    }
    void look(float away, bool looksAway) {
        const glm::vec3 eye(0.0f, 1.0f, away), to(0.0f, 1.0f, looksAway ? 2.0f * away : 0.0f);
        view.look(eye, to, glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 500.0f));
    }
    /// What the view counted in the last frame.
    [[nodiscard]] SuppleViewStatistics statistics() {
        group->crowd.context().beginFrame();
        group->crowd.context().beginFrame();
        return view.statistics();
    }

    TestView view; // outlives the group
    std::unique_ptr<PosedGroup> group;
};

void poseAll(const PosedGroup& group, double time) {
    for (uint32_t i = 0; i < group.instances.size(); ++i) {
        group.poseClip(i, group.within(time + 0.1 * i));
    }
}

TEST_F(HostSoftSeen, WhoIsOutOfSightOrFarAwayHasTheSameBits) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset caped = own.asset(kCapedFile);
        const SuppleGroupDesc desc = posedGroup(caped, 2, SUPPLE_GROUP_SOFT);
        PosedGroup plain(own, desc, kHopSeen), stiff(own, posedGroup(caped, 2, 0), kHopSeen);
        WatchedByHost seen(own, desc);
        ASSERT_TRUE(plain.crowd.valid() && stiff.crowd.valid() && seen.group->crowd.valid());
        double moves = 0.0;
        for (uint32_t step = 0; step < 36; ++step) {
            const bool looksAway = step >= 10 && step < 24;
            seen.look(step >= 28 ? 300.0f : 5.0f, looksAway); // where it is 3 pixels large
            for (PosedGroup* const group : {&plain, &stiff, seen.group.get()}) {
                poseAll(*group, step / 60.0);
                group->frame(step / 60.0);
            }
            for (uint32_t i = 0; i < 2; ++i) {
                EXPECT_EQ(seen.group->cage(i), plain.cage(i)) << step << ", " << i;
            }
            const SuppleViewStatistics statistics = seen.statistics();
            EXPECT_EQ(statistics.unposedInstanceCount, 0u) << step;
            EXPECT_EQ(statistics.drawnInstanceCount, looksAway ? 0u : 2u) << step;
            raise(moves, farthestApart(plain.cage(0), stiff.cage(0)));
        }
        EXPECT_GT(moves, 0.02);
    }
}

/// Previous positions are those that the frame before has shown.
TEST_F(HostSoftSeen, MotionVectorsAreOfWhatWasShown) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        SuppleGroupDesc desc = posedGroup(own.asset(kCapedFile), 1, SUPPLE_GROUP_MOTION);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 1;
        PosedGroup still(own, desc, kHopSeen);
        desc.flags |= SUPPLE_GROUP_SOFT;
        PosedGroup soft(own, desc, kHopSeen);
        ASSERT_TRUE(still.crowd.valid() && soft.crowd.valid());
        PosedGroup* const groups[] = {&still, &soft};
        PositionBits before[2];
        for (uint32_t frame = 0; frame < 12; ++frame) { // at 90 Hz, where in some no step is due
            for (size_t g = 0; g < 2; ++g) {
                poseAll(*groups[g], frame / 90.0);
                own.setTime(frame / 90.0);
                groups[g]->crowd.run();
                const PositionBits now = groups[g]->crowd.positions(0);
                EXPECT_EQ(differences(groups[g]->crowd.previous(0), frame > 0 ? before[g] : now), 0u)
                    << "group " << g << ", frame " << frame;
                before[g] = now;
            }
        }
        EXPECT_GT(differences(before[1], before[0]), 100u) << "belly and cape move";
    }
}

TEST_F(HostSoftSeen, AnotherVersionOfTheAssetBeginsAtRest) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const cage::Character wren = jigglingWren();
    cage::Character none = wren;
    none.jiggles.clear();
    none.weights.jiggles.clear();
    const SuppleAsset asset = own.createAsset(wren);
    PosedGroup soft(own, posedGroup(asset, 2, SUPPLE_GROUP_SOFT)), stiff(own, posedGroup(own.createAsset(wren), 2, 0));
    ASSERT_TRUE(soft.crowd.valid() && stiff.crowd.valid());
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 12 || step == 24) {
            EXPECT_EQ(own.reloadAsset(asset, step == 12 ? none : wren), SUPPLE_OK);
        }
        for (PosedGroup* const group : {&soft, &stiff}) {
            poseAll(*group, step / 60.0);
            group->frame(step / 60.0);
        }
        for (uint32_t i = 0; i < 2; ++i) {
            const double apart = farthestApart(soft.cage(i), stiff.cage(i));
            if (step >= 12 && step <= 24) {
                EXPECT_EQ(apart, 0.0) << step << ": nothing is painted, then all is at rest";
            } else if (step == 11 || step == 39) {
                EXPECT_GT(apart, 1e-3) << step;
            }
        }
    }
}

TEST_F(HostSoftSeen, BoxesHoldWhatIsShown) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    PosedGroup soft(own, posedGroup(own.asset(kCapedFile), 1, SUPPLE_GROUP_SOFT | SUPPLE_GROUP_BOUNDS), kHopSeen);
    ASSERT_TRUE(soft.crowd.valid());
    for (uint32_t step = 0; step < 30; ++step) {
        poseAll(soft, step / 60.0);
        soft.frame(step / 60.0);
        const uint64_t ran = own.frame;
        own.beginFrame();
        SuppleBounds box{};
        uint64_t frame = 0;
        ASSERT_EQ(suppleReadInstanceBounds(own.handle(), soft.instances[0], &box, &frame), SUPPLE_OK);
        ASSERT_EQ(frame, ran);
        const std::vector<float> shown = soft.cage();
        for (size_t k = 0; k < shown.size(); ++k) {
            if (k % 4 < 3) {
                ASSERT_GE(shown[k], box.min[k % 4]) << step;
                ASSERT_LE(shown[k], box.max[k % 4]) << step;
                ASSERT_LT(box.max[k % 4] - box.min[k % 4], 10.0f) << "a figure, and no box around everything";
            }
        }
    }
}

TEST_F(HostSoftSeen, ViewsGoOnInAnotherCapacity) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleGroupDesc desc = posedGroup(own.asset(kCapedFile), 2, SUPPLE_GROUP_SOFT);
    PosedGroup plain(own, desc, kHopSeen);
    WatchedByHost seen(own, desc);
    ASSERT_TRUE(plain.crowd.valid() && seen.group->crowd.valid());
    seen.look(5.0f, false);
    for (uint32_t step = 0; step < 24; ++step) {
        if (step == 8 || step == 16) {
            EXPECT_EQ(suppleSetCapacity(own.handle(), seen.group->crowd.group(), step == 8 ? 7 : 3), SUPPLE_OK);
        }
        for (PosedGroup* const group : {&plain, seen.group.get()}) {
            poseAll(*group, step / 60.0);
            group->frame(step / 60.0);
        }
        for (uint32_t i = 0; i < 2; ++i) {
            EXPECT_EQ(seen.group->cage(i), plain.cage(i)) << step << ", " << i;
        }
    }
}

} // namespace
} // namespace supple::test
