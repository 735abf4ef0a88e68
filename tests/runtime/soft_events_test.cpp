// What hosts do to what is soft: they hide, move and teleport instances, leave frames out, and set another
// time.
#include "tests/support/poses_of_host.h"
#include "tests/support/recordings.h"
#include "tests/support/soft_groups.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

namespace supple::test {
namespace {

class SoftEvents : public CrowdContexts {};

TEST_F(SoftEvents, GoOnWhenTheCapacityChanges) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SoftPair both(context(mapping), 3);
        for (uint32_t step = 0; step < 30; ++step) {
            if (step == 11 || step == 19) {
                EXPECT_EQ(suppleSetCapacity(both.other.handle(), both.other.crowd.group(), step == 11 ? 9 : 5),
                          SUPPLE_OK);
            }
            both.run(step);
            for (uint32_t i = 0; i < 3; ++i) {
                EXPECT_TRUE(both.same(i)) << step;
            }
        }
    }
}

TEST_F(SoftEvents, AFrameThatIsCancelledHasNotBeen) {
    const ValidationGuard guard;
    SoftPair both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 0; step < 24; ++step) {
        if (step % 5 == 3 || step == 0) {
            EXPECT_EQ(suppleSetTime(both.other.handle(), both.other.crowd.group(), step / 60.0), SUPPLE_OK);
            both.other.crowd.context().cancel(both.other.crowd.group());
        }
        both.run(step);
        EXPECT_TRUE(both.same(0) && both.same(1)) << step;
    }
}

TEST_F(SoftEvents, AnotherCapacityBehindACancelledFrameChangesNothing) {
    const ValidationGuard guard;
    SoftPair both(context(SUPPLE_MAPPING_NARROW), 2);
    expectTheSameBehindCancelledCapacities(
        both, [&](uint32_t i) { return farthestApart(both.other.shown(i), both.plain.shown(i)); }, true);
}

TEST_F(SoftEvents, HiddenInstancesCatchUpOrSwingOn) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SoftPair both(own, 2);
    SoftGroup stiff(own, playedGroup(both.asset, 2, 0));
    stiff.play(1, 1, 0.1);
    for (uint32_t step = 0; step < 90; ++step) {
        const bool hidden = (step > 10 && step < 18) || (step > 30 && step < 39);
        both.other.crowd.setVisible(both.other.instances[1], !hidden);
        both.run(step);
        stiff.frame(step / 60.0);
        EXPECT_TRUE(both.same(0)) << step;
        if (!hidden && step < 39) {
            EXPECT_TRUE(both.same(1)) << step << ": 8 steps were due at most";
        }
        if (step == 39) {
            EXPECT_FALSE(both.same(1)) << "9 were due";
            EXPECT_GT(farthestApart(both.other.shown(1), stiff.shown(1)), 1e-3) << "it swings on, and is not at rest";
        }
    }
    EXPECT_LT(farthestApart(both.other.shown(1), both.plain.shown(1)), 0.05) << "it comes together again";
}

TEST_F(SoftEvents, SettleWhenTheirAssetIsLoadedAnew) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    SoftGroup soft(own, playedGroup(asset, 1, kSoft));
    SoftGroup stiff(own, playedGroup(own.createAsset(jigglingWren()), 1, 0));
    soft.play(0, 2, 0.1);
    stiff.play(0, 2, 0.1);
    cage::Character none = jigglingWren();
    none.jiggles.clear();
    none.weights.jiggles.clear();
    for (uint32_t step = 0; step < 30; ++step) {
        if (step == 10 || step == 20) {
            EXPECT_EQ(own.reloadAsset(asset, step == 10 ? none : jigglingWren()), SUPPLE_OK);
        }
        soft.frame(step / 60.0);
        stiff.frame(step / 60.0);
        const double apart = farthestApart(soft.shown(0), stiff.shown(0));
        if (step >= 10 && step <= 20) {
            EXPECT_EQ(apart, 0.0) << step << ": nothing is painted, then all is at rest";
        }
        if (step == 9 || step == 29) {
            EXPECT_GT(apart, 1e-3) << step;
        }
    }
}

TEST_F(SoftEvents, TeleportsKeepHowTheyMove) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SoftPair both(own, 2);
    SoftGroup stiff(own, playedGroup(both.asset, 2, 0));
    stiff.play(0, 0, 0.0);
    const glm::mat4 far = glm::translate(glm::mat4(1.0f), glm::vec3(64.0f, 0.0f, 0.0f));
    double told = 0.0, untold = 0.0, swings = 0.0;
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 20) {
            both.other.place(0, far);
            both.other.crowd.teleport(both.other.instances[0]);
            both.other.place(1, far);
        }
        both.run(step);
        stiff.frame(step / 60.0);
        const auto off = [&](uint32_t i) {
            Floats here = both.other.shown(i);
            for (size_t k = 0; k < here.size(); k += 4) {
                here[k] -= step >= 20 ? 64.0f : 0.0f;
            }
            return farthestApart(here, both.plain.shown(i));
        };
        raise(told, off(0));
        raise(untold, off(1));
        raise(swings, step >= 20 ? farthestApart(both.plain.shown(0), stiff.shown(0)) : 0.0);
    }
    EXPECT_GT(swings, 0.02) << "or nobody could tell";
    EXPECT_LT(told, 0.3 * swings) << "the goals' own change of speed in a step is not seen";
    EXPECT_GT(untold, 0.03);
}

/// Two instances that play the same. The host moves the first.
struct RunnerBesideOneWhoStands {
    RunnerBesideOneWhoStands(CrowdContext& context, SuppleAsset asset)
        : runs(context, playedGroup(asset, 1, kSoft)), stands(context, playedGroup(asset, 1, kSoft)) {
        for (const SoftGroup* const group : {&runs, &stands}) {
            if (group->crowd.valid()) {
                group->play(0, 0, 0.0);
            }
        }
    }
    [[nodiscard]] bool valid() const { return runs.crowd.valid() && stands.crowd.valid(); }
    /// A frame; how far the runner's vertices are off those of the other, but for its place.
    double offAt(double time, const glm::vec3& place, bool teleports) {
        EXPECT_EQ(suppleSetTime(runs.handle(), runs.crowd.group(), time), SUPPLE_OK);
        runs.place(0, glm::translate(glm::mat4(1.0f), place));
        if (teleports) {
            runs.crowd.teleport(runs.instances[0]);
        }
        runs.frame(time);
        stands.frame(time);
        Floats here = runs.shown(0);
        for (size_t k = 0; k < here.size(); ++k) {
            here[k] -= k % 4 < 3 ? place[static_cast<int>(k % 4)] : 0.0f;
        }
        return farthestApart(here, stands.shown(0));
    }

    SoftGroup runs, stands;
};

/// Frames of a rate, which begin some time behind a step.
struct Frames {
    double rate, begin;
    [[nodiscard]] double time(uint32_t frame) const { return begin + frame / rate; }
};
constexpr Frames kFrames[] = {{60, 0.0}, {60, 0.008}, {60, 0.016}, {30, 0.0}, {30, 0.016}, {24, 0.0}, {144, 0.006}};
constexpr float kRun = 5.0f; // units a second: the host moves the instance

TEST_F(SoftEvents, WhoRunsGoesOnAfterATeleport) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    for (const Frames& frames : kFrames) {
        RunnerBesideOneWhoStands both(own, asset);
        ASSERT_TRUE(both.valid());
        const auto jump = static_cast<uint32_t>(frames.rate * 0.6);
        double most = 0.0;
        for (uint32_t f = 0; f < 2 * jump; ++f) {
            const double time = frames.time(f);
            const glm::vec3 place(kRun * static_cast<float>(time), 0.0f, f >= jump ? 32.0f : 0.0f);
            const double off = both.offAt(time, place, f == jump);
            raise(most, f >= jump ? off : 0.0);
        }
        EXPECT_LT(most, 0.005) << frames.rate << " frames a second from " << frames.begin;
    }
}

TEST_F(SoftEvents, WhoRunsFromTheFirstFrameIsNotStruck) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    for (const Frames& frames : kFrames) {
        RunnerBesideOneWhoStands both(own, asset);
        ASSERT_TRUE(both.valid());
        double most = 0.0;
        for (uint32_t f = 0; f < static_cast<uint32_t>(frames.rate); ++f) {
            const double gap = f > frames.rate / 2 ? 0.3 : 0.0; // and again when frames have been left out
            const double time = frames.time(f) + gap;
            const glm::vec3 place(kRun * static_cast<float>(time), 0.0f, 0.0f);
            raise(most, both.offAt(time, place, false));
        }
        EXPECT_LT(most, 0.005) << frames.rate << " frames a second from " << frames.begin;
    }
}

TEST_F(SoftEvents, LongGapsGoOnWithoutASnap) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    SoftGroup soft(own, playedGroup(asset, 2, kSoft)), stiff(own, playedGroup(asset, 2, 0));
    for (uint32_t i = 0; i < 2; ++i) {
        soft.play(i, 2, 0.1 * i);
        stiff.play(i, 2, 0.1 * i);
    }
    double before = 0.0;
    const auto at = [&](double time) {
        soft.frame(time);
        stiff.frame(time);
        return farthestApart(soft.shown(0), stiff.shown(0));
    };
    for (uint32_t step = 0; step < 30; ++step) {
        raise(before, at(step / 60.0));
    }
    const double behind = at(45 / 60.0);
    EXPECT_GT(behind, 0.1 * before) << "a quarter of a second later, a soft spring is not at rest";
    EXPECT_LT(behind, before) << "nothing has struck it";
    EXPECT_LT(at(45 / 60.0 + 60.0), 1e-4) << "a minute later it is";
    EXPECT_EQ(at(0.5), 0.0) << "time that goes back begins at rest";
}

TEST_F(SoftEvents, TimeThatGoesBackPlaysTheSameAgain) {
    const ValidationGuard guard;
    SoftPair both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 7; step < 20; ++step) {
        both.other.frame(step / 60.0);
    }
    for (uint32_t step = 0; step < 30; ++step) {
        both.run(step);
        EXPECT_TRUE(both.same(0) && both.same(1)) << step;
    }
}

TEST_F(SoftEvents, ASlotThatIsUsedAgainBeginsAtRest) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    SoftGroup soft(own, playedGroup(asset, 1, kSoft)), stiff(own, playedGroup(asset, 1, 0));
    soft.play(0, 2, 0.0);
    stiff.play(0, 2, 0.0);
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 20) {
            const uint32_t slot = soft.instances[0].slot;
            EXPECT_EQ(suppleDestroyInstance(own.handle(), soft.instances[0]), SUPPLE_OK);
            soft.instances[0] = soft.crowd.spawn();
            EXPECT_EQ(soft.instances[0].slot, slot);
            soft.play(0, 2, 0.0);
        }
        soft.frame(step / 60.0);
        stiff.frame(step / 60.0);
        const double apart = farthestApart(soft.shown(0), stiff.shown(0));
        EXPECT_EQ(apart == 0.0, step < 4 || (step >= 20 && step < 24)) << step;
    }
}

/// A group in a view of its own that culls. It looks at where the instances are, or away from there.
struct WatchedGroup {
    WatchedGroup(CrowdContext& context, SuppleGroupDesc desc) : view(context, 1u << 18, SUPPLE_VIEW_CULL) {
        desc.view = view.handle();
        group = std::make_unique<SoftGroup>(context, desc);
        view.camera.pixelsPerUnit = 400.0f;
    }
    void frame(double time, bool looksAway) {
        const glm::vec3 eye(0.0f, 1.0f, 5.0f), to(0.0f, 1.0f, looksAway ? 10.0f : 0.0f);
        view.look(eye, to, glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 200.0f));
        group->frame(time);
    }
    /// What the view counted in the last frame.
    [[nodiscard]] SuppleViewStatistics statistics() {
        group->crowd.context().beginFrame();
        group->crowd.context().beginFrame();
        return view.statistics();
    }

    TestView view;
    std::unique_ptr<SoftGroup> group;
};

TEST_F(SoftEvents, WhoIsOutOfSightHasTheSameBits) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc = playedGroup(own.asset(kCapedFile), 2, kSoft);
    desc.scheme = SUPPLE_SCHEME_PM;
    SoftGroup plain(own, desc);
    WatchedGroup seen(own, desc);
    desc.flags = 0;
    WatchedGroup stiff(own, desc);
    ASSERT_TRUE(plain.crowd.valid() && seen.group->crowd.valid() && stiff.group->crowd.valid());
    for (const SoftGroup* const group : {&plain, seen.group.get(), stiff.group.get()}) {
        group->play(0, 0, 0.0);
        group->play(1, 0, 0.2);
    }
    double swings = 0.0;
    for (uint32_t step = 0; step < 40; ++step) {
        const bool looksAway = step < 25;
        plain.frame(step / 60.0);
        seen.frame(step / 60.0, looksAway);
        const SuppleViewStatistics ofSeen = seen.statistics();
        stiff.frame(step / 60.0, looksAway);
        const SuppleViewStatistics ofStiff = stiff.statistics();
        EXPECT_EQ(ofSeen.unposedInstanceCount, 0u) << step;
        EXPECT_EQ(ofSeen.drawnInstanceCount, looksAway ? 0u : 2u) << step;
        EXPECT_EQ(ofStiff.unposedInstanceCount, looksAway ? 2u : 0u) << step << ": nothing of them jiggles";
        for (uint32_t i = 0; i < 2; ++i) {
            EXPECT_EQ(seen.group->shown(i), plain.shown(i)) << step << ", " << i;
        }
        raise(swings, looksAway ? 0.0 : farthestApart(seen.group->shown(0), stiff.group->shown(0)));
    }
    EXPECT_GT(swings, 0.01);
}

TEST_F(SoftEvents, BoxesHoldWhatIsShown) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SoftGroup soft(own, playedGroup(own.asset(kCapedFile), 1, kSoft | SUPPLE_GROUP_BOUNDS));
    ASSERT_TRUE(soft.crowd.valid());
    soft.play(0, 0, 0.0);
    for (uint32_t step = 0; step < 40; ++step) {
        soft.frame(step / 60.0);
        const uint64_t ran = own.frame;
        own.beginFrame();
        SuppleBounds box{};
        uint64_t frame = 0;
        ASSERT_EQ(suppleReadInstanceBounds(own.handle(), soft.instances[0], &box, &frame), SUPPLE_OK);
        ASSERT_EQ(frame, ran);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LT(box.max[axis] - box.min[axis], 10.0f) << "a figure, and no box around everything";
        }
        const Floats shown = soft.shown(0);
        for (size_t k = 0; k < shown.size(); ++k) {
            if (k % 4 < 3) {
                ASSERT_GE(shown[k], box.min[k % 4]) << step;
                ASSERT_LE(shown[k], box.max[k % 4]) << step;
            }
        }
    }
}

TEST_F(SoftEvents, AreRecorded) {
    for (const uint32_t begins : {0u, 9u}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
        SoftGroup stage(own, playedGroup(own.asset(kCapedFile), 3, kSoft));
        ASSERT_TRUE(stage.crowd.valid());
        for (uint32_t i = 0; i < 3; ++i) {
            stage.play(i, 0, 0.1 * i);
        }
        const auto hop = [&](uint32_t first, uint32_t last) {
            for (uint32_t f = first; f < last; ++f) {
                EXPECT_EQ(suppleSetTime(own.handle(), stage.crowd.group(), 0.03 * f), SUPPLE_OK);
                const uint32_t i = f % 3;
                if (f % 4 == 1) { // so does the first frame of the late recording
                    stage.setWind({0.5f * static_cast<float>(f), 0.0f, -4.0f});
                }
                if (f % 3 == 2) {
                    stage.place(i, glm::rotate(glm::mat4(1.0f), 0.3f * static_cast<float>(f), glm::vec3(0, 1, 0)));
                }
                if (f % 7 == 3) {
                    stage.crowd.teleport(stage.instances[i]);
                }
                stage.crowd.setVisible(stage.instances[2], f % 6 > 2);
                own.run(stage.crowd.group());
            }
        };
        expectReplayedFrom(begins, begins + 16, own, hop, 21);
    }
}

TEST_F(SoftEvents, WindsBetweenTwoFramesBlowEachInItsSteps) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.asset(kCapedFile);
    SoftGroup often(own, playedGroup(asset, 1, kSoft)), seldom(own, playedGroup(asset, 1, kSoft));
    SoftGroup calm(own, playedGroup(asset, 1, kSoft));
    for (const SoftGroup* const group : {&often, &seldom, &calm}) {
        group->play(0, 0, 0.0);
    }
    double blown = 0.0;
    for (uint32_t step = 0; step < 60; ++step) {
        const double time = step / 60.0;
        const glm::vec3 gust(0.0f, 0.0f, 8.0f * std::sin(0.3f * static_cast<float>(step)));
        for (SoftGroup* const group : {&often, &seldom}) {
            EXPECT_EQ(suppleSetTime(own.handle(), group->crowd.group(), time - 0.004), SUPPLE_OK);
            group->setWind(gust);
        }
        often.frame(time);
        calm.frame(time);
        if (step % 6 == 0) {
            seldom.frame(time);
            EXPECT_EQ(seldom.shown(0), often.shown(0)) << step;
            raise(blown, farthestApart(often.shown(0), calm.shown(0)));
        }
    }
    EXPECT_GT(blown, 0.02);
}

TEST_F(SoftEvents, AbsurdPlacesLeaveThemAgain) {
    const ValidationGuard guard;
    SoftPair both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 0; step < 120; ++step) {
        if (step == 5 || step == 7) {
            glm::mat4 place(1.0f);
            place[3].x = step == 5 ? 1e30f : 0.0f;
            place[0].x = step == 5 ? 1e-25f : 1.0f;
            both.other.place(0, place);
        }
        both.run(step);
        EXPECT_TRUE(both.same(1)) << step;
        if (step == 5) {
            EXPECT_FALSE(both.same(0)) << "it is somewhere absurd";
        }
        if (step > 8) {
            EXPECT_LT(farthestApart(both.other.shown(0), both.plain.shown(0)), 1.5) << step;
        }
    }
    EXPECT_LT(farthestApart(both.other.shown(0), both.plain.shown(0)), 0.06);
}

} // namespace
} // namespace supple::test
