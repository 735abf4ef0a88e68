// What is soft in groups whose poses the host sets: it moves by the times of frames, between the poses of two.
#include "tests/support/allocation_count.h"
#include "tests/support/limited_device.h"
#include "tests/support/poses_of_host.h"
#include "tests/support/recordings.h"
#include "tests/support/soft_assets.h"
#include "tests/support/springs.h"
#include "tests/support/swinging_jiggles.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace supple::test {
namespace {

class HostSoft : public CrowdContexts {};

constexpr uint32_t kSoftFlag = SUPPLE_GROUP_SOFT;
constexpr uint32_t kHop = 1; ///< the clip

/// What two thirds of a second of the clip show of two groups of which something is soft, one of which plays, and of
/// one that is stiff: how far the first two are apart, and by how much they move.
std::array<double, 2> movedBesidePlayed(CrowdContext& own, SuppleAsset asset, By by, SuppleSkinning skinning,
                                        uint32_t flags, uint32_t clip) {
    const uint32_t modifiers = by == By::clipWithModifiers ? SUPPLE_GROUP_MODIFIERS : 0;
    PosedGroup played(own, playedGroup(asset, 1, kSoftFlag | flags, skinning), clip);
    PosedGroup still(own, playedGroup(asset, 1, 0, skinning), clip);
    PosedGroup set(own, posedGroup(asset, 1, kSoftFlag | flags | modifiers, skinning), clip);
    played.play(0, clip, 0.0);
    still.play(0, clip, 0.0);
    double off = 0.0, moved = 0.0;
    for (uint32_t n = 0; n < 40; ++n) {
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
        raise(off, farthestApart(set.cage(), played.cage()));
        raise(moved, farthestApart(set.cage(), still.cage()));
    }
    return {off, moved};
}

TEST_F(HostSoft, MovesAsThatOfInstancesThatPlay) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset caped = own.asset(kCapedFile);
    for (const By by : {By::clip, By::layers, By::clipWithModifiers, By::matrices}) {
        const auto [off, moved] = movedBesidePlayed(own, caped, by, SUPPLE_SKINNING_LINEAR, 0, kHop);
        EXPECT_LT(off, 2e-3) << static_cast<int>(by) << ": steps are at the frames' own times";
        EXPECT_GT(moved, 0.05);
    }
    for (const SuppleSkinning skinning :
         {SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION, SUPPLE_SKINNING_DELTA_MUSH}) {
        const auto [off, moved] = movedBesidePlayed(own, own.asset(kBellyFile), By::clip, skinning, 0, 0);
        EXPECT_LT(off, 1e-4) << static_cast<int>(skinning);
        EXPECT_GT(moved, 0.02);
    }
    // What hangs on joints that swing jiggles by how they swing.
    const auto [off, moved] =
        movedBesidePlayed(own, swingingAndJigglingWren(own), By::clip, SUPPLE_SKINNING_LINEAR, SUPPLE_GROUP_SPRINGS, 2);
    EXPECT_LT(off, 1e-3);
    EXPECT_GT(moved, 0.02);
}

TEST_F(HostSoft, GoesStraightFromPoseToPose) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset belly = own.asset(kBellyFile);
    const auto shownAfter = [&](double rate) {
        PosedGroup set(own, posedGroup(belly, 1, kSoftFlag), 0);
        for (uint32_t n = 0; n <= static_cast<uint32_t>(0.5 * rate); ++n) {
            set.poseClip(0, set.within(n / rate));
            set.place(0, placedAt(n / rate));
            set.frame(n / rate);
        }
        return set.cage();
    };
    const std::vector<float> every = shownAfter(60.0);
    EXPECT_EQ(farthestApart(every, shownAfter(60.0)), 0.0) << "the same frames, the same words";
    EXPECT_LT(farthestApart(every, shownAfter(120.0)), 0.01);
    EXPECT_LT(farthestApart(every, shownAfter(30.0)), 0.02);
    EXPECT_LT(farthestApart(every, shownAfter(20.0)), 0.05);
}

TEST_F(HostSoft, HasTheSameWordsInBothMappingsAndSharedDispatches) {
    const ValidationGuard guard;
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext* const contexts[] = {&context(SUPPLE_MAPPING_NARROW), &context(SUPPLE_MAPPING_WIDE), &shared};
    std::vector<std::vector<float>> first;
    for (CrowdContext* const own : contexts) {
        PosedGroup set(*own, posedGroup(own->asset(kCapedFile), 3, kSoftFlag), kHop);
        std::vector<std::vector<float>> shown;
        double time = 0.0;
        for (uint32_t f = 0; f < 14; ++f) {
            time += 0.009 * (f % 5); // none are due, or some
            for (uint32_t i = 0; i < (f < 7 ? 2u : 3u); ++i) {
                set.poseClip(i, set.within(time + 0.1 * i));
            }
            set.place(1, placedAt(time));
            const float wind[3] = {static_cast<float>(f % 4), 0.0f, -2.0f};
            EXPECT_EQ(suppleSetWind(own->handle(), set.crowd.group(), wind), SUPPLE_OK);
            set.frame(time);
            for (uint32_t i = 0; i < 3; ++i) {
                shown.push_back(set.cage(i));
            }
        }
        first = first.empty() ? shown : first;
        EXPECT_EQ(shown, first);
    }
}

/// Two groups of capes.
struct TwoSoftGroups : TwoPosedGroups {
    TwoSoftGroups(CrowdContext& context, uint32_t capacity)
        : TwoSoftGroups(context, posedGroup(context.asset(kCapedFile), capacity, kSoftFlag)) {}
    TwoSoftGroups(CrowdContext& context, const SuppleGroupDesc& desc)
        : TwoPosedGroups(context, desc, desc, kHop), asset(desc.asset) {}
    [[nodiscard]] double off(uint32_t i) const { return farthestApart(other.cage(i), plain.cage(i)); }

    SuppleAsset asset;
};

TEST_F(HostSoft, GoesOnWhenTheCapacityChanges) {
    const ValidationGuard guard;
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 3);
    expectTheSameInAnotherCapacity(both, 10, 20, [&](uint32_t i) { return both.off(i); });
}

TEST_F(HostSoft, AFrameThatIsCancelledHasNotBeen) {
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    expectTheSameBehindCancelledFrames(both, [&](uint32_t i) { return both.off(i); });
}

TEST_F(HostSoft, AnotherCapacityBehindACancelledFrameChangesNothing) {
    const ValidationGuard guard;
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    expectTheSameBehindCancelledCapacities(
        both, [&](uint32_t i) { return both.off(i); }, false);
}

TEST_F(HostSoft, TeleportsKeepHowItMoves) {
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 2);
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
            std::vector<float> here = both.other.cage(i);
            for (size_t k = 0; k < here.size(); k += 4) {
                here[k] -= step >= 20 ? 100.0f : 0.0f;
            }
            return farthestApart(here, both.plain.cage(i));
        };
        EXPECT_LT(off(0), step < 20 ? 1e-6 : 0.03) << step << ": its shape stays for a step";
        raise(untold, off(1));
    }
    EXPECT_GT(untold, 0.1);
}

TEST_F(HostSoft, RestsInTheBindPoseAndComesBackFromIt) {
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 1);
    PosedGroup stiff(context(SUPPLE_MAPPING_NARROW), posedGroup(both.asset, 1, 0), kHop);
    for (uint32_t step = 0; step < 12; ++step) {
        both.run(step);
    }
    stiff.frame(0.0);
    for (uint32_t step = 12; step < 16; ++step) {
        EXPECT_EQ(suppleSetClipPose(both.other.handle(), both.other.instances[0], SUPPLE_BIND_POSE, 0.0), SUPPLE_OK);
        both.other.frame(step / 60.0);
        EXPECT_EQ(both.other.cage(), stiff.cage()) << step;
    }
    for (uint32_t step = 16; step < 60; ++step) {
        both.run(step);
    }
    EXPECT_LT(both.off(0), 0.2) << "it has begun anew";
    EXPECT_GT(both.off(0), 0.0);
}

TEST_F(HostSoft, HugeMatricesLeaveOnlyTheirInstanceAndNotForLong) {
    TwoSoftGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    std::vector<float> huge;
    for (size_t j = 0; j < both.other.character().skin.joints.size(); ++j) {
        for (int k = 0; k < 16; ++k) {
            huge.push_back(k == 15 ? 1.0f : k % 4 == 3 ? 0.0f : 1e30f);
        }
    }
    for (uint32_t step = 0; step < 60; ++step) {
        if (step == 20) {
            both.other.poseClip(1, both.other.within(step / 60.0 + 0.1));
            both.other.poseMatrices(0, huge);
            both.other.frame(step / 60.0);
            both.plain.poseClip(1, both.plain.within(step / 60.0 + 0.1));
            both.plain.frame(step / 60.0);
        } else {
            both.run(step);
        }
        EXPECT_EQ(both.off(1), 0.0) << step;
        const std::vector<float> cage = both.other.cage(0);
        EXPECT_TRUE((step >= 20 && step < 24) ||
                    std::all_of(cage.begin(), cage.end(), [](float f) { return std::abs(f) < 100.0f; }))
            << step;
    }
    EXPECT_LT(both.off(0), 0.3);
}

TEST_F(HostSoft, TakesWindowsOfInstances) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        LimitedDevice limited(mapping, [](WrappedVulkan& says) { says.maxStorageBufferRange = 1u << 18; });
        ASSERT_NE(limited.context(), nullptr);
        constexpr uint32_t kCount = 40;
        CrowdContext &small = *limited.context(), &large = context(mapping);
        PosedGroup cut(small, posedGroup(small.asset(kCapedFile), kCount, kSoftFlag | SUPPLE_GROUP_WINDOWS), kHop);
        PosedGroup whole(large, posedGroup(large.asset(kCapedFile), kCount, kSoftFlag), kHop);
        ASSERT_TRUE(cut.crowd.valid() && whole.crowd.valid());
        EXPECT_GT(cut.group().windows().count(), 1u);
        for (uint32_t f = 0; f < 4; ++f) {
            for (PosedGroup* const group : {&cut, &whole}) {
                for (uint32_t i = 0; i < kCount; ++i) {
                    if (i % 3 != 1) { // some stay in the bind pose
                        group->poseClip(i, group->within(f / 40.0 + 0.1 * i));
                    }
                }
                group->frame(f / 40.0);
            }
            for (uint32_t i = 0; i < kCount; i += f == 3 ? 1 : 13) {
                EXPECT_EQ(cut.cage(i), whole.cage(i)) << f << ", " << i;
            }
        }
    }
}

TEST_F(HostSoft, AllocatesNothingInFrames) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PosedGroup set(own, posedGroup(own.asset(kCapedFile), 3, kSoftFlag), kHop);
    set.poseClip(0, 0.0);
    set.frame(0.0);
    runtime::HostPoses& poses = *set.group().poses().host();
    std::vector<std::byte> bytes(3 * poses.instanceBytes());
    const std::vector<float> matrices = jointMatrices(set, 0, 0.0);
    uint64_t steps = 0;
    const uint64_t before = allocationsCounted();
    for (uint32_t n = 0; n < 100; ++n) {
        const AllocationCount count;
        poses.setClipPose(0, kHop, 0.005 * n);
        poses.setMatrixPose(1, matrices.data());
        poses.setTransform(2, glm::translate(glm::mat4(1.0f), glm::vec3(0.01f * static_cast<float>(n))));
        poses.write({1000 + n, 0.013 * n, false}, set.group().instances().slots(), bytes.data());
        const runtime::PoseList::Round& listed = poses.soft().listed(0).rounds[0];
        steps += listed.poses.count - listed.shown;
    }
    EXPECT_EQ(allocationsCounted(), before);
    EXPECT_GT(steps, 100u);
}

TEST_F(HostSoft, IsRecorded) {
    for (const uint32_t begins : {0u, 9u}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
        PosedGroup set(own, posedGroup(own.asset(kCapedFile), 2, kSoftFlag), kHop);
        const auto moveAbout = [&](uint32_t first, uint32_t last) {
            for (uint32_t f = first; f < last; ++f) {
                set.poseClip(f % 2, set.within(0.03 * f));
                set.place(1, placedAt(0.05 * f));
                if (f % 7 == 3) {
                    const float wind[3] = {static_cast<float>(f), 0.0f, 2.0f};
                    EXPECT_EQ(suppleSetWind(own.handle(), set.crowd.group(), wind), SUPPLE_OK);
                    set.crowd.teleport(set.instances[1]);
                }
                set.frame(0.03 * f);
            }
        };
        expectReplayedFrom(begins, begins + 12, own, moveAbout, 21);
    }
}

} // namespace
} // namespace supple::test
