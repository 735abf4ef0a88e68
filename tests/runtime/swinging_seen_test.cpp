// What cameras and motion vectors see of what swings and jiggles.
#include "runtime/step_detail.h"
#include "tests/support/played_group.h"
#include "tests/support/springs.h"
#include "tests/support/swinging_jiggles.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <optional>

namespace supple::test {
namespace {

class SwingingSeen : public CrowdContexts {};

constexpr uint32_t kSeenCount = 2;

/// A group that plays: in a view of its own that culls, or cages alone.
class SeenGroup {
public:
    SeenGroup(CrowdContext& context, SuppleAsset asset, uint32_t flags, bool culls) {
        SuppleGroupDesc desc = playedGroup(asset, kSeenCount, flags);
        if (culls) {
            desc.scheme = SUPPLE_SCHEME_PM;
            view_.emplace(context, 1u << 20, SUPPLE_VIEW_CULL);
            view_->camera.pixelsPerUnit = 400.0f;
            desc.view = view_->handle();
        }
        group_.emplace(context, desc);
        for (uint32_t i = 0; group_->crowd.valid() && i < kSeenCount; ++i) {
            group_->play(i, 2, 0.1 * i);
        }
    }
    /// A frame; in the view the camera sees all, or none of them.
    void run(double time, bool seesAll, float distance = 5.0f) {
        if (view_) {
            const glm::vec3 eye(0.0f, 1.0f, distance), to(0.0f, 1.0f, seesAll ? 0.0f : 2.0f * distance);
            view_->look(eye, to, glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 200.0f));
        }
        EXPECT_EQ(suppleSetTime(group_->handle(), group_->crowd.group(), time), SUPPLE_OK);
        group_->crowd.context().run(group_->crowd.group());
        group_->poses = as<float>(group_->crowd.read(group_->crowd.output().info.poses));
    }
    /// The palette of the last frame.
    [[nodiscard]] std::vector<float> palette(uint32_t i) const {
        const skinning::PoseLayout& layout = group_->group().instances().poseLayout();
        const auto begin =
            group_->poses.begin() + static_cast<ptrdiff_t>(4 * size_t{group_->instances[i].slot} * layout.stride);
        return {begin, begin + static_cast<ptrdiff_t>(4 * size_t{layout.morphWeights})};
    }
    /// Of the last frame: instances that it has not posed.
    [[nodiscard]] uint32_t unposed() const {
        group_->crowd.context().beginFrame();
        group_->crowd.context().beginFrame();
        return view_->statistics().unposedInstanceCount;
    }
    /// Steps that it has posed.
    [[nodiscard]] uint32_t steps() const {
        const runtime::PoseList::Round& listed = group_->group().poses().playback()->listedPoses(0).rounds[0];
        return listed.poses.count - listed.shown;
    }
    [[nodiscard]] bool valid() const { return group_->crowd.valid(); }

private:
    std::optional<TestView> view_; // outlives the group
    std::optional<PlayedGroup> group_;
};

TEST_F(SwingingSeen, WhoIsCulledSettlesUnlessAllArePosed) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset wren = wrenWithSprings(own);
    for (const bool posesAll : {false, true}) {
        const uint32_t flags = posesAll ? SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_POSE_UNSEEN : SUPPLE_GROUP_SPRINGS;
        SeenGroup seen(own, wren, flags, true), plain(own, wren, SUPPLE_GROUP_SPRINGS, false),
            still(own, wren, 0, false);
        ASSERT_TRUE(seen.valid() && plain.valid() && still.valid());
        for (uint32_t step = 0; step < 46; ++step) {
            SCOPED_TRACE(std::to_string(step) + (posesAll ? ", all are posed" : ""));
            const bool seesAll = step < 10 || (step > 16 && step < 24) || step >= 40;
            for (SeenGroup* const group : {&seen, &plain, &still}) {
                group->run(step / 60.0, seesAll);
            }
            EXPECT_EQ(seen.unposed(), seesAll || posesAll ? 0u : kSeenCount);
            for (uint32_t i = 0; i < kSeenCount; ++i) {
                const std::vector<float> shown = seen.palette(i);
                if (posesAll || (seesAll && step < 40)) { // 8 steps are due at most
                    EXPECT_EQ(shown, plain.palette(i)) << i;
                } else if (step == 40) {
                    EXPECT_EQ(shown, still.palette(i)) << i << " is at rest in the pose";
                } else if (step > 41) { // what is shown is late by a step
                    EXPECT_NE(shown, still.palette(i)) << i << " swings again";
                }
                if (step == 40) {
                    EXPECT_NE(plain.palette(i), still.palette(i)) << i << " would swing";
                }
            }
        }
    }
}

TEST(StepDetail, FadesOutBelowASizeAndInAboveALargerOne) {
    runtime::StepDetail detail(2);
    const auto springs = [&](uint32_t slot) { return detail.shown(slot).springs; };
    detail.setSize(0, 10.0f, 5.0);
    EXPECT_EQ(springs(0), 0.0f) << "who begins small does not fade";
    detail.setSize(0, 28.0f, 5.1);
    EXPECT_EQ(springs(0), 0.0f);
    detail.setSize(0, 31.0f, 5.2);
    EXPECT_NEAR(springs(0), 0.4f, 1e-6f);
    detail.setSize(0, 25.0f, 5.3);
    EXPECT_NEAR(springs(0), 0.8f, 1e-6f);
    detail.setSize(0, 25.0f, 9.0);
    EXPECT_EQ(springs(0), 1.0f);
    detail.setSize(0, 23.0f, 9.1);
    EXPECT_NEAR(springs(0), 0.6f, 1e-6f);
    detail.setSize(0, 23.0f, 9.0);
    EXPECT_EQ(springs(0), 0.0f) << "time has gone back";
    EXPECT_EQ(springs(1), 1.0f) << "nobody knows its size";
    detail.forget(0);
    EXPECT_EQ(springs(0), 1.0f);
    EXPECT_EQ(runtime::StepDetail().shown(0).springs, 1.0f);
}

TEST(StepDetail, HasFourSteps) {
    runtime::StepDetail detail(1);
    struct Row {
        float pixels, springs, soft;
        bool light;
    };
    double time = 0.0;
    for (const Row& row : {Row{200.0f, 1.0f, 1.0f, false}, Row{65.0f, 1.0f, 1.0f, false}, Row{63.0f, 1.0f, 1.0f, true},
                           Row{79.0f, 1.0f, 1.0f, true}, Row{47.0f, 1.0f, 0.0f, true}, Row{59.0f, 1.0f, 0.0f, true},
                           Row{23.0f, 0.0f, 0.0f, true}, Row{29.0f, 0.0f, 0.0f, true}, Row{59.0f, 1.0f, 0.0f, true},
                           Row{79.0f, 1.0f, 1.0f, true}, Row{81.0f, 1.0f, 1.0f, false}, Row{1.0f, 0.0f, 0.0f, true},
                           Row{1000.0f, 1.0f, 1.0f, false}}) {
        detail.setSize(0, row.pixels, time += 1.0);
        EXPECT_EQ(detail.shown(0).springs, row.springs) << row.pixels;
        EXPECT_EQ(detail.shown(0).soft, row.soft) << row.pixels;
        EXPECT_EQ(detail.shown(0).lightCloths, row.light) << row.pixels;
    }
    detail.setSize(0, 40.0f, time += 0.125);
    EXPECT_EQ(detail.shown(0).soft, 0.5f) << "what is soft fades out";
    EXPECT_EQ(detail.shown(0).springs, 1.0f);
}

TEST_F(SwingingSeen, WhoIsSmallRunsNoStepsUnlessAllDo) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset wren = swingingAndJigglingWren(own);
    constexpr uint32_t kFlags = SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_SOFT;
    for (const bool runsAll : {false, true}) {
        SeenGroup seen(own, wren, kFlags | (runsAll ? SUPPLE_GROUP_POSE_UNSEEN : 0), true),
            plain(own, wren, kFlags, false), still(own, wren, 0, false);
        ASSERT_TRUE(seen.valid() && plain.valid() && still.valid());
        const auto apart = [](const SeenGroup& a, const SeenGroup& b) {
            return farthestApart(a.palette(0), b.palette(0)) + farthestApart(a.palette(1), b.palette(1));
        };
        for (uint32_t step = 0; step < 80; ++step) {
            SCOPED_TRACE(std::to_string(step) + (runsAll ? ", all run" : ""));
            const bool isFar = step > 20 && step < 50;
            for (SeenGroup* const group : {&seen, &plain, &still}) {
                group->run(step / 60.0, true, isFar ? 60.0f : 5.0f);
            }
            if (runsAll || step <= 20) {
                EXPECT_EQ(apart(seen, plain), 0.0);
                EXPECT_EQ(seen.steps(), kSeenCount);
            } else if (step == 30) {
                EXPECT_LT(apart(seen, still), 0.6 * apart(plain, still)) << "it fades";
                EXPECT_GT(apart(seen, still), 0.0);
            } else if (step > 36 && isFar) {
                EXPECT_EQ(apart(seen, still), 0.0);
                EXPECT_EQ(seen.steps(), 0u);
            } else if (step == 55) {
                EXPECT_GT(seen.steps(), 0u) << "it wakes";
            }
        }
        EXPECT_GT(apart(seen, still), 0.0);
        EXPECT_LT(apart(seen, plain), 0.05) << "they come together";
    }
}

/// Previous positions are those that the frame before has shown.
TEST_F(SwingingSeen, MotionVectorsAreOfWhatWasShown) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        SuppleGroupDesc desc = playedGroup(swingingAndJigglingWren(own), 1, SUPPLE_GROUP_MOTION);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 1;
        PlayedGroup still(own, desc);
        desc.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_SPRINGS;
        PlayedGroup swings(own, desc);
        desc.flags |= SUPPLE_GROUP_SOFT;
        PlayedGroup both(own, desc);
        PlayedGroup* const groups[] = {&still, &swings, &both};
        PositionBits before[3];
        for (uint32_t frame = 0; frame < 9; ++frame) { // at 90 Hz, where in some no step is due
            for (size_t g = 0; g < 3; ++g) {
                PlayedGroup& group = *groups[g];
                ASSERT_TRUE(group.crowd.valid());
                if (frame == 0) {
                    group.play(0, 2, 0.1);
                }
                EXPECT_EQ(suppleSetTime(group.handle(), group.crowd.group(), frame / 90.0), SUPPLE_OK);
                group.crowd.run();
                const PositionBits now = group.crowd.positions(0);
                EXPECT_EQ(differences(group.crowd.previous(0), frame > 0 ? before[g] : now), 0u)
                    << "group " << g << ", frame " << frame;
                before[g] = now;
            }
        }
        EXPECT_GT(differences(before[1], before[0]), 100u) << "hair and scarf swing";
        EXPECT_GT(differences(before[2], before[1]), 100u) << "head and middle jiggle";
    }
}

} // namespace
} // namespace supple::test
