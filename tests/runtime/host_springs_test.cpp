// Springs of groups whose poses the host sets: on the CPU, by the times of frames.
#include "tests/support/allocation_count.h"
#include "tests/support/poses_of_host.h"
#include "tests/support/recordings.h"
#include "tests/support/springs.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::test {
namespace {

class HostSprings : public CrowdContexts {};

constexpr uint32_t kClip = 2;

SuppleGroupDesc setGroup(SuppleAsset asset, uint32_t capacity, uint32_t flags = SUPPLE_GROUP_SPRINGS,
                         SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR) {
    return posedGroup(asset, capacity, flags, skinning);
}

/// What a second and a half of the clip shows of two groups that swing, and of one that does not: how far the first two
/// are apart, and by how much they swing. `shown`: of a group.
template <class Shown>
std::array<double, 2> swungBesidePlayed(CrowdContext& own, By by, SuppleSkinning skinning, Shown&& shown) {
    const SuppleAsset wren = wrenWithSprings(own);
    const uint32_t flags = by == By::clipWithModifiers ? SUPPLE_GROUP_MODIFIERS : 0;
    PosedGroup played(own, playedGroup(wren, 1, SUPPLE_GROUP_SPRINGS, skinning));
    PosedGroup still(own, playedGroup(wren, 1, 0, skinning));
    PosedGroup set(own, setGroup(wren, 1, SUPPLE_GROUP_SPRINGS | flags, skinning));
    played.play(0, kClip, 0.0);
    still.play(0, kClip, 0.0);
    double off = 0.0, swung = 0.0;
    for (uint32_t n = 0; n < 90; ++n) {
        const double time = n / 60.0;
        for (PosedGroup* const group : {&played, &still, &set}) {
            group->place(0, placedAt(time));
        }
        for (PosedGroup* const group : {&played, &still}) {
            EXPECT_EQ(suppleSetTime(own.handle(), group->crowd.group(), time), SUPPLE_OK);
            group->frame(time);
        }
        pose(set, still, 0, time, by);
        set.frame(time);
        raise(off, farthestApart(shown(set), shown(played)));
        raise(swung, farthestApart(shown(set), shown(still)));
    }
    return {off, swung};
}

TEST_F(HostSprings, SwingAsThoseOfInstancesThatPlay) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    for (const By by : {By::clip, By::layers, By::clipWithModifiers, By::matrices}) {
        const auto [off, swung] = swungBesidePlayed(own, by, SUPPLE_SKINNING_LINEAR,
                                                    [](const PosedGroup& group) { return group.palette(0); });
        EXPECT_LT(off, 1e-4) << static_cast<int>(by) << ": steps are at the frames' own times";
        EXPECT_GT(swung, 0.2);
    }
    const auto [off, swung] = swungBesidePlayed(own, By::clip, SUPPLE_SKINNING_DUAL_QUATERNION,
                                                [](const PosedGroup& group) { return group.cage(); });
    EXPECT_LT(off, 1e-4);
    EXPECT_GT(swung, 0.02);
}

TEST_F(HostSprings, GoStraightFromPoseToPose) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset wren = wrenWithSprings(own);
    const auto shownAfter = [&](double rate) {
        PosedGroup set(own, setGroup(wren, 1));
        for (uint32_t n = 0; n <= static_cast<uint32_t>(1.5 * rate); ++n) {
            set.poseClip(0, set.within(n / rate));
            set.place(0, placedAt(n / rate));
            set.frame(n / rate);
        }
        return set.palette(0);
    };
    const std::vector<float> every = shownAfter(60.0);
    EXPECT_EQ(farthestApart(every, shownAfter(60.0)), 0.0) << "the same frames, the same words";
    EXPECT_LT(farthestApart(every, shownAfter(120.0)), 1e-3);
    EXPECT_LT(farthestApart(every, shownAfter(30.0)), 0.01);
    EXPECT_LT(farthestApart(every, shownAfter(20.0)), 0.05);
}

TEST_F(HostSprings, LeaveWhatDoesNotSwingToTheHost) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset wren = wrenWithSprings(own);
    PosedGroup still(own, playedGroup(wren, 1, 0)), swinging(own, setGroup(wren, 1)), plain(own, setGroup(wren, 1, 0));
    still.play(0, kClip, 0.0);
    const std::vector<cage::Node>& nodes = still.character().skeleton.nodes;
    const std::vector<uint32_t>& joints = still.character().skin.joints;
    const auto hangs = [&](uint32_t node) {
        const std::vector<uint32_t>& swing = swinging.group().asset().clipTable->swinging;
        while (node != cage::kNone && std::ranges::find(swing, node) == swing.end()) {
            node = nodes[node].parent;
        }
        return node != cage::kNone;
    };
    size_t swung = 0, stayed = 0;
    for (uint32_t n = 0; n < 20; ++n) {
        still.place(0, placedAt(n / 60.0));
        EXPECT_EQ(suppleSetTime(own.handle(), still.crowd.group(), n / 60.0), SUPPLE_OK);
        for (PosedGroup* const group : {&swinging, &plain}) {
            pose(*group, still, 0, n / 60.0, By::matrices);
            group->frame(n / 60.0);
        }
        const std::vector<float> a = swinging.palette(0), b = plain.palette(0);
        for (uint32_t j = 0; j < joints.size(); ++j) {
            const auto begin = static_cast<ptrdiff_t>(12 * size_t{j});
            const bool same = std::equal(a.begin() + begin, a.begin() + begin + 12, b.begin() + begin);
            EXPECT_TRUE(same || hangs(joints[j])) << j;
            (same ? stayed : swung) += n > 10 ? 1 : 0;
        }
    }
    EXPECT_GT(swung, 50u);
    EXPECT_GT(stayed, 50u);
}

/// Two groups of wrens, each with an asset of its own.
struct TwoSwingingGroups : TwoPosedGroups {
    TwoSwingingGroups(CrowdContext& context, uint32_t capacity)
        : TwoSwingingGroups(context, wrenWithSprings(context), capacity) {}
    TwoSwingingGroups(CrowdContext& context, SuppleAsset ofOther, uint32_t capacity)
        : TwoPosedGroups(context, setGroup(ofOther, capacity), setGroup(wrenWithSprings(context), capacity), kClip),
          asset(ofOther) {}
    [[nodiscard]] double off(uint32_t i) const { return farthestApart(other.palette(i), plain.palette(i)); }

    SuppleAsset asset; ///< of `other`
};

TEST_F(HostSprings, GoOnWhenTheCapacityChanges) {
    TwoSwingingGroups both(context(SUPPLE_MAPPING_NARROW), 3);
    expectTheSameInAnotherCapacity(both, 15, 25, [&](uint32_t i) { return both.off(i); });
}

TEST_F(HostSprings, AFrameThatIsCancelledHasNotBeen) {
    TwoSwingingGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    expectTheSameBehindCancelledFrames(both, [&](uint32_t i) { return both.off(i); });
}

TEST_F(HostSprings, ANewInstanceBeginsAnewAlsoWhereAFrameIsCancelled) {
    TwoSwingingGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 0; step < 30; ++step) {
        if (step == 15) {
            both.other.crowd.context().setTime(step / 60.0);
            both.other.crowd.context().beginFrame();
            Commands dropped(both.other.crowd.context().device());
            const SuppleGroup group = both.other.crowd.group();
            dropped.record([&](VkCommandBuffer commands) {
                EXPECT_EQ(both.other.crowd.context().record(commands, {&group, 1}), SUPPLE_OK);
            });
            for (PosedGroup* const own : {&both.other, &both.plain}) {
                own->crowd.destroy(own->instances[0]);
                own->instances[0] = own->crowd.spawn();
            }
            EXPECT_EQ(suppleCancelFrame(both.other.handle()), SUPPLE_OK);
        }
        both.run(step);
        EXPECT_TRUE(both.off(0) == 0.0 && both.off(1) == 0.0) << step;
    }
}

TEST_F(HostSprings, HiddenInstancesCatchUpOrSettle) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    TwoSwingingGroups both(own, 2);
    PosedGroup still(own, setGroup(both.asset, 2, 0));
    for (uint32_t step = 0; step < 150; ++step) {
        const bool hidden = (step > 10 && step < 18) || (step > 30 && step < 45);
        both.other.crowd.setVisible(both.other.instances[1], !hidden);
        both.run(step);
        still.poseClip(1, still.within(step / 60.0 + 0.1));
        still.frame(step / 60.0);
        const double swings = farthestApart(both.other.palette(1), still.palette(1));
        EXPECT_EQ(both.off(0), 0.0) << step;
        if (step <= 10) {
            EXPECT_EQ(both.off(1), 0.0) << step;
        } else if (!hidden && step < 31) {
            EXPECT_LT(both.off(1), 0.25) << "posed straight from the last frame that had it";
        }
        if (step == 18) {
            EXPECT_GT(swings, 0.02) << "it has caught up";
        }
        if (step == 45) {
            EXPECT_GT(both.off(1), 0.0) << "more than 8 were due";
            EXPECT_LT(swings, 1e-5) << "it is at rest in the pose";
        }
    }
    EXPECT_LT(both.off(1), 0.05) << "it comes together again";
}

TEST_F(HostSprings, StayFiniteWhereTheHostMakesJointsFlat) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset wren = wrenWithSprings(own);
    PosedGroup still(own, playedGroup(wren, 1, 0)), set(own, setGroup(wren, 1));
    still.play(0, kClip, 0.0);
    for (const glm::vec3 scale : {glm::vec3(0.0f), glm::vec3(1.0f, 0.0f, 1.0f), glm::vec3(-1.0f, 1.0f, 1.0f)}) {
        for (uint32_t n = 0; n < 20; ++n) {
            std::vector<float> matrices;
            for (uint32_t j = 0; j < set.character().skin.joints.size(); ++j) {
                const glm::mat4 m = glm::mat4(still.jointOf(0, j)) * glm::scale(glm::mat4(1.0f), scale);
                matrices.insert(matrices.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
            }
            set.poseMatrices(0, matrices);
            set.frame(n / 60.0);
            for (const float f : set.palette(0)) {
                ASSERT_TRUE(std::isfinite(f)) << n;
            }
        }
    }
}

TEST_F(HostSprings, ComeAndGoWithTheAsset) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(withExtensions(kWren, ""), "wren");
    PosedGroup set(own, setGroup(asset, 2)), plain(own, setGroup(own.asset(kWren), 2, 0));
    for (uint32_t step = 0; step < 60; ++step) {
        if (step == 20 || step == 40) {
            reloadWren(own, asset, step == 20 ? kWrenSprings : std::string());
        }
        for (PosedGroup* const group : {&set, &plain}) {
            group->poseClip(0, group->within(step / 60.0));
            group->frame(step / 60.0);
        }
        const double off = farthestApart(set.palette(0), plain.palette(0));
        EXPECT_EQ(off > 1e-3, step > 21 && step < 40) << step << ": " << off;
    }
}

TEST_F(HostSprings, TeleportsKeepHowTheyHang) {
    TwoSwingingGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    const glm::mat4 far = glm::translate(glm::mat4(1.0f), glm::vec3(100.0f, 0.0f, 0.0f));
    double untold = 0.0;
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 20) {
            both.other.place(0, far);
            both.other.crowd.teleport(both.other.instances[0]);
            both.other.place(1, far);
        }
        both.run(step);
        const auto off = [&](uint32_t i) {
            std::vector<float> here = both.other.palette(i);
            for (size_t k = 3; k < here.size(); k += 12) {
                here[k] -= step >= 20 ? 100.0f : 0.0f;
            }
            return farthestApart(here, both.plain.palette(i));
        };
        EXPECT_LT(off(0), 1e-4) << "floats a hundred metres from the origin";
        raise(untold, off(1));
    }
    EXPECT_GT(untold, 0.1);
}

TEST_F(HostSprings, SettleWhereTimeJumpsOrTheAssetIsLoadedAnewAndNotInTheBindPose) {
    TwoSwingingGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 20) {
            reloadWren(both.other.crowd.context(), both.asset, kWrenSprings);
        }
        both.run(step);
        EXPECT_EQ(both.off(0) == 0.0, step < 20) << step;
    }
    both.run(1000); // by more than eight steps
    EXPECT_EQ(both.off(0), 0.0);
    for (uint32_t step = 1001; step < 1010; ++step) {
        EXPECT_EQ(suppleSetClipPose(both.other.handle(), both.other.instances[1], SUPPLE_BIND_POSE, 0.0), SUPPLE_OK);
        both.other.frame(step / 60.0);
        const std::vector<float> palette = both.other.palette(1);
        for (size_t k = 0; k < palette.size(); ++k) {
            EXPECT_EQ(palette[k], k % 12 % 5 == 0 ? 1.0f : 0.0f);
        }
    }
}

TEST_F(HostSprings, AllocateNothingInFrames) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PosedGroup set(own, setGroup(wrenWithSprings(own), 3));
    set.poseClip(0, 0.0);
    set.frame(0.0);
    runtime::HostPoses& poses = *set.group().poses().host();
    std::vector<std::byte> bytes(3 * poses.instanceBytes());
    std::vector<float> matrices;
    for (uint32_t j = 0; j < set.character().skin.joints.size(); ++j) {
        const glm::mat4 m(set.jointOf(0, j));
        matrices.insert(matrices.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
    }
    const uint64_t before = allocationsCounted();
    for (uint32_t n = 0; n < 100; ++n) {
        const AllocationCount count;
        poses.setClipPose(0, kClip, 0.005 * n);
        poses.setMatrixPose(1, matrices.data());
        poses.setTransform(2, glm::translate(glm::mat4(1.0f), glm::vec3(0.01f * static_cast<float>(n))));
        poses.write({1000 + n, 0.013 * n, false}, set.group().instances().slots(), bytes.data());
    }
    EXPECT_EQ(allocationsCounted(), before);
}

TEST_F(HostSprings, AreRecorded) {
    for (const uint32_t begins : {0u, 9u}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
        PosedGroup set(own, setGroup(wrenWithSprings(own), 2));
        const auto swingAbout = [&](uint32_t first, uint32_t last) {
            for (uint32_t f = first; f < last; ++f) {
                set.poseClip(f % 2, set.within(0.03 * f));
                set.place(1, placedAt(0.05 * f));
                if (f % 7 == 3) {
                    set.crowd.teleport(set.instances[1]);
                }
                set.frame(0.03 * f);
            }
        };
        expectReplayedFrom(begins, begins + 12, own, swingAbout, 21);
    }
}

} // namespace
} // namespace supple::test
