// Which structures a frame builds and updates (host/ray_plan.h). No device is needed.
#include "host/ray_plan.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <vector>

namespace supple::test {
namespace {

using host::RayPlan;
using host::TracedInstance;

std::vector<TracedInstance> crowdOf(uint32_t count) {
    std::vector<TracedInstance> crowd(count);
    for (uint32_t i = 0; i < count; ++i) {
        crowd[i].slot = i;
    }
    return crowd;
}

SuppleBounds boxOf(float size) {
    return {{0.0f, 0.0f, 0.0f}, {size, size, size}};
}

uint32_t countOf(const RayPlan& plan, RayPlan::Work work) {
    return static_cast<uint32_t>(
        std::ranges::count_if(plan.tasks(), [=](const RayPlan::Task& task) { return task.work == work; }));
}

TEST(RayPlans, WhoIsNewIsBuiltAndThenUpdated) {
    RayPlan plan(3, {.mostPerFrame = 3});
    const std::vector<TracedInstance> crowd = crowdOf(3);
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 3u);
    EXPECT_EQ(plan.traced().size(), 3u);
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 0u);
    EXPECT_EQ(countOf(plan, RayPlan::Work::update), 3u);
}

TEST(RayPlans, AFrameHasNoMoreThanItMayAndAllComeInTurn) {
    constexpr uint32_t kCount = 10, kMost = 3;
    RayPlan plan(kCount, {.mostPerFrame = kMost});
    std::vector<TracedInstance> crowd = crowdOf(kCount);
    std::map<uint32_t, uint32_t> lastFrames;
    for (uint32_t frame = 0; frame < 4; ++frame) { // builds come first
        plan.plan(crowd);
        EXPECT_LE(plan.tasks().size(), kMost);
        EXPECT_EQ(plan.traced().size(), std::min(kCount, kMost * (frame + 1)));
    }
    for (uint32_t frame = 1; frame <= 20; ++frame) {
        plan.plan(crowd);
        EXPECT_EQ(plan.tasks().size(), kMost);
        EXPECT_EQ(plan.traced().size(), kCount) << "who has no turn is traced as it was";
        for (const RayPlan::Task& task : plan.tasks()) {
            lastFrames[task.slot] = frame;
        }
        for (uint32_t slot = 0; slot < kCount; ++slot) {
            EXPECT_LE(frame - lastFrames[slot], (kCount + kMost - 1) / kMost) << slot;
        }
    }
}

TEST(RayPlans, WhoTeleportsOrComesBackIsBuilt) {
    RayPlan plan(2, {.mostPerFrame = 1});
    std::vector<TracedInstance> crowd = crowdOf(2);
    plan.plan(crowd);
    plan.plan(crowd);
    EXPECT_EQ(plan.traced().size(), 2u);
    crowd[1].isNew = true;
    plan.plan(crowd);
    ASSERT_EQ(plan.tasks().size(), 1u);
    EXPECT_EQ(plan.tasks()[0].slot, 1u) << "it comes before who waits to be updated";
    EXPECT_EQ(plan.tasks()[0].work, RayPlan::Work::build);
    crowd[1].isNew = false;
    plan.plan(std::span(crowd).first(1));
    EXPECT_EQ(plan.traced().size(), 1u);
    plan.plan(crowd);
    ASSERT_EQ(plan.tasks().size(), 1u);
    EXPECT_EQ(plan.tasks()[0].slot, 1u);
    EXPECT_EQ(plan.tasks()[0].work, RayPlan::Work::build);
}

TEST(RayPlans, WhoIsNewWithoutATurnIsNotTraced) {
    RayPlan plan(2, {.mostPerFrame = 1});
    std::vector<TracedInstance> crowd = crowdOf(2);
    plan.plan(crowd);
    plan.plan(crowd);
    crowd[0].isNew = crowd[1].isNew = true;
    plan.plan(crowd);
    EXPECT_EQ(plan.traced().size(), 1u);
}

TEST(RayPlans, OtherHiddenPartsAreABuild) {
    RayPlan plan(1, {.mostPerFrame = 1});
    std::vector<TracedInstance> crowd = crowdOf(1);
    plan.plan(crowd);
    const uint32_t hidden[] = {2, 5};
    crowd[0].hiddenParts = hidden;
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 1u);
    EXPECT_TRUE(std::ranges::equal(plan.hiddenParts(0), hidden));
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::update), 1u);
    EXPECT_TRUE(std::ranges::equal(plan.hiddenParts(0), hidden)) << "an update has the parts of its build";
    crowd[0].hiddenParts = {};
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 1u);
    EXPECT_TRUE(plan.hiddenParts(0).empty());
}

TEST(RayPlans, FarOnesAreUpdatedLessOften) {
    RayPlan plan(2, {.mostPerFrame = 2});
    std::vector<TracedInstance> crowd = crowdOf(2);
    crowd[1].interval = 4;
    std::map<uint32_t, uint32_t> updates;
    for (uint32_t frame = 0; frame < 9; ++frame) {
        plan.plan(crowd);
        for (const RayPlan::Task& task : plan.tasks()) {
            updates[task.slot] += task.work == RayPlan::Work::update ? 1 : 0;
        }
        EXPECT_EQ(plan.traced().size(), 2u);
    }
    EXPECT_EQ(updates[0], 8u);
    EXPECT_EQ(updates[1], 2u);
}

TEST(RayPlans, AgeRebuildsAFewAFrame) {
    constexpr uint32_t kCount = 32, kAge = 16;
    RayPlan plan(kCount, {.mostPerFrame = kCount, .rebuildAge = kAge, .rebuildShare = 16});
    const std::vector<TracedInstance> crowd = crowdOf(kCount);
    plan.plan(crowd);
    std::map<uint32_t, uint32_t> builds;
    for (uint32_t frame = 0; frame < 4 * kAge; ++frame) {
        plan.plan(crowd);
        EXPECT_LE(countOf(plan, RayPlan::Work::build), kCount / 16);
        EXPECT_EQ(plan.tasks().size(), kCount);
        for (const RayPlan::Task& task : plan.tasks()) {
            builds[task.slot] += task.work == RayPlan::Work::build ? 1 : 0;
        }
    }
    for (uint32_t slot = 0; slot < kCount; ++slot) {
        EXPECT_GE(builds[slot], 3u) << slot;
        EXPECT_LE(builds[slot], 4u) << slot;
    }
}

TEST(RayPlans, ABoxThatChangesRebuilds) {
    RayPlan plan(1, {.mostPerFrame = 1, .rebuildAge = 1000});
    std::vector<TracedInstance> crowd = crowdOf(1);
    plan.plan(crowd);
    crowd[0].box = boxOf(1.0f);
    for (const float size : {1.0f, 1.0f, 1.2f, 0.9f}) {
        crowd[0].box = boxOf(size);
        plan.plan(crowd);
        EXPECT_EQ(countOf(plan, RayPlan::Work::update), 1u) << size;
    }
    crowd[0].box = boxOf(1.5f); // more than twice the area
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 1u);
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::update), 1u);
    crowd[0].box = boxOf(1.0f); // less than half
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 1u);
}

TEST(RayPlans, WhoIsNotFiniteIsNotTraced) {
    RayPlan plan(2, {.mostPerFrame = 2});
    std::vector<TracedInstance> crowd = crowdOf(2);
    plan.plan(crowd);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        crowd[0].box = boxOf(bad);
        plan.plan(crowd);
        EXPECT_EQ(plan.tasks().size(), 1u);
        ASSERT_EQ(plan.traced().size(), 1u);
        EXPECT_EQ(plan.traced()[0], 1u);
    }
    crowd[0].box = boxOf(1.0f);
    plan.plan(crowd);
    EXPECT_EQ(countOf(plan, RayPlan::Work::build), 1u);
}

} // namespace
} // namespace supple::test
