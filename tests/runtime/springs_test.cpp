// Joint springs on the device: the words of the CPU's own steps, whatever the frame rate, and what hosts do to them.
#include "tests/support/springs.h"

#include "cage/gltf/reader.h"
#include "runtime/step_clock.h"
#include "tests/support/allocation_count.h"
#include "tests/support/limited_device.h"
#include "tests/support/played_group.h"
#include "tests/support/played_springs.h"
#include "tests/support/recordings.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sixths.h"
#include "tests/support/worst.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

using cage::ChannelPath;

class Springs : public CrowdContexts {};

constexpr uint32_t kSprings = SUPPLE_GROUP_SPRINGS;
using Pose = std::vector<float>;

/// A group whose instances swing, beside the CPU's steps.
class SwingingGroup : public PlayedGroup {
public:
    SwingingGroup(CrowdContext& context, const SuppleGroupDesc& desc)
        : PlayedGroup(context, desc), clock(desc.capacity, false), places(desc.capacity, glm::mat4(1.0f)),
          travels(desc.capacity, false) {
        const skinning::PoseLayout& layout = group().instances().poseLayout();
        const uint32_t modifiers = (desc.flags & SUPPLE_GROUP_MODIFIERS) != 0 ? shared::kMaxModifiers : 0;
        const uint32_t transition = skinning::PlaybackState::elements(layout.morphCount, modifiers);
        for (uint32_t i = 0; i < desc.capacity; ++i) {
            twins.emplace_back(*group().asset().clipTable, layout, transition);
        }
    }

    void move(uint32_t i, const glm::mat4& place) {
        PlayedGroup::place(i, place);
        places[i] = place;
    }
    void swingOnly(double time) {
        EXPECT_EQ(suppleSetTime(handle(), crowd.group(), time), SUPPLE_OK);
        crowd.context().run(crowd.group());
        poses = as<float>(crowd.read(crowd.output().info.poses));
    }
    /// A frame at a time; how many words of poses are others than the CPU's.
    uint64_t swing(double time) {
        swingOnly(time);
        runtime::Group& own = group();
        const runtime::Playback& playback = *own.poses().playback();
        const skinning::PoseLayout& layout = own.instances().poseLayout();
        std::vector<glm::vec4> pose(layout.stride);
        uint64_t off = 0;
        ++frame;
        for (uint32_t i = 0; i < instances.size(); ++i) {
            const runtime::StepPlace place{glm::dmat3(glm::mat3(places[i])), glm::dvec3(places[i][3])};
            const runtime::StepClock::Due due = clock.take(i, frame, time, place, travels[i]);
            const std::span<const uint32_t> state = playback.stateOf(instances[i].slot);
            for (uint32_t k = 0; k < due.count; ++k) {
                const auto begins = due.settles     ? PlayedSprings::Begins::anew
                                    : due.jump == k ? PlayedSprings::Begins::withoutMove
                                                    : PlayedSprings::Begins::asItIs;
                twins[i].setWind(due.wind[k]);
                twins[i].step(state, playback.masks(), due.first + k, begins,
                              due.moves ? std::optional(due.rows[k]) : std::nullopt);
            }
            twins[i].show(state, playback.masks(), time, due.part, pose);
            const float* const there = poses.data() + 4 * size_t{instances[i].slot} * layout.stride;
            for (size_t k = 0; k < 4 * size_t{layout.morphWeights}; ++k) {
                EXPECT_TRUE(std::isfinite(there[k]));
                off += std::memcmp(&pose[k / 4][static_cast<int>(k % 4)], there + k, sizeof(float)) != 0 ? 1 : 0;
            }
        }
        clock.endFrame(frame);
        return off;
    }
    /// What an instance showed in the last frame.
    [[nodiscard]] Pose shown(uint32_t i) const {
        const size_t stride = size_t{4} * group().instances().poseLayout().stride;
        const auto begin = poses.begin() + static_cast<ptrdiff_t>(instances[i].slot * stride);
        return {begin, begin + static_cast<ptrdiff_t>(4 * size_t{group().instances().poseLayout().morphWeights})};
    }

    runtime::StepClock clock;
    std::vector<glm::mat4> places;
    std::vector<bool> travels;
    std::vector<PlayedSprings> twins;
    uint64_t frame = 0;
};

TEST(StepClock, StepsAreOnAGridOfTimes) {
    for (int64_t n = -200'000; n < 200'000; n += 7) {
        EXPECT_EQ(runtime::lastStepAt(runtime::timeOfStep(n)), n);
        EXPECT_EQ(runtime::lastStepAt(std::nextafter(runtime::timeOfStep(n), -1e9)), n - 1);
    }
    double sum = 0.0;
    for (int64_t n = 0; n < 100'000; ++n) {
        EXPECT_LE(std::abs(runtime::lastStepAt(sum) - n), 1);
        sum += 1.0 / 60.0;
    }
}

TEST(StepClock, SaysWhatIsDue) {
    runtime::StepClock clock(1, false);
    uint64_t frame = 0;
    const auto at = [&](double step) { return clock.take(0, ++frame, step / 60.0 + 1e-9, {}, false); };
    EXPECT_TRUE(at(100).settles);
    EXPECT_EQ(at(100.5).count, 0u);
    runtime::StepClock::Due due = at(102.25);
    EXPECT_FALSE(due.settles);
    EXPECT_EQ(due.first, 101);
    EXPECT_EQ(due.count, 2u);
    EXPECT_NEAR(due.part, 0.25, 1e-3);
    EXPECT_FALSE(due.moves);
    EXPECT_EQ(at(110).count, 8u);
    EXPECT_TRUE(at(119).settles) << "more than 8 are due";
    EXPECT_TRUE(at(118).settles) << "time has gone back";
    clock.settle(0);
    EXPECT_TRUE(at(119).settles);
    due = at(122);
    clock.cancelFrame(frame);
    EXPECT_EQ(at(122).first, due.first) << "what was cancelled is due again";
}

TEST(StepClock, PlacesGoStraightFromFrameToFrame) {
    runtime::StepClock clock(1, false);
    const auto placed = [](double x) { return runtime::StepPlace{glm::dmat3(1.0), glm::dvec3(x, 0.0, 0.0)}; };
    (void)clock.take(0, 1, 10.0 / 60.0, placed(0.0), false);
    const runtime::StepClock::Due due = clock.take(0, 2, 14.0 / 60.0, placed(4.0), false);
    ASSERT_EQ(due.count, 4u);
    ASSERT_TRUE(due.moves);
    for (uint32_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(due.rows[k][0].w, -1.0, 1e-6) << k;
    }
    // Jumps are not moves; a place that is set while root motion travels stands from then on.
    clock.jump(0, 14.5 / 60.0);
    const runtime::StepClock::Due jumped = clock.take(0, 3, 15.0 / 60.0, placed(100.0), false);
    EXPECT_EQ(jumped.jump, 0u);
    EXPECT_FALSE(clock.take(0, 3, 15.0 / 60.0, placed(100.0), false).moves);
    clock.place(0, 17.5 / 60.0);
    const runtime::StepClock::Due later = clock.take(0, 4, 19.0 / 60.0, placed(104.0), true);
    ASSERT_EQ(later.count, 4u);
    const float moved[] = {0.0f, 0.0f, -4.0f, 0.0f};
    for (uint32_t k = 0; k < 4; ++k) {
        EXPECT_EQ(later.rows[k][0].w, moved[k]) << k;
    }
    // Turned and scaled: a quarter, in two steps.
    const runtime::StepPlace a{glm::dmat3(2.0), glm::dvec3(0.0)};
    const runtime::StepPlace b{glm::dmat3(glm::rotate(glm::dmat4(2.0), 1.5707963, glm::dvec3(0, 1, 0))),
                               glm::dvec3(0.0)};
    const runtime::StepPlace half = runtime::placeBetween(a, b, 0.5);
    EXPECT_NEAR(half.linear[0][0], std::sqrt(2.0), 1e-6);
    EXPECT_EQ(runtime::placeBetween(a, b, 1.0), b);
    EXPECT_EQ(runtime::rowsOf(runtime::placeWithin({glm::dmat3(0.0), glm::dvec3(1.0)}, a))[0], glm::vec4(1, 0, 0, 0))
        << "flat";
}

TEST(StepClock, CallsTakeEffectAtTheirTime) {
    runtime::StepClock clock(1, false);
    (void)clock.take(0, 1, 10.0 / 60.0, {}, false);
    EXPECT_FALSE(clock.change(0, 10.5 / 60.0)) << "no step was due before";
    EXPECT_TRUE(clock.change(0, 12.5 / 60.0));
    EXPECT_FALSE(clock.change(0, 13.5 / 60.0)) << "the first call counts";
    const runtime::StepClock::Due due = clock.take(0, 2, 14.0 / 60.0, {}, false);
    ASSERT_EQ(due.count, 4u);
    EXPECT_TRUE(due.before[0] && due.before[1] && !due.before[2] && !due.before[3]);
    EXPECT_FALSE(clock.hasBefore(0));
}

TEST(StepClock, WindBlowsFromItsTimeOn) {
    runtime::StepClock clock(1, true);
    const runtime::StepPlace turned{
        glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.5707963267948966, glm::dvec3(0, 1, 0))) * 2.0, glm::dvec3(5.0)};
    (void)clock.take(0, 1, 10.0 / 60.0, turned, false);
    clock.endFrame(1);
    clock.setWind({8.0, 2.0, 0.0}, 11.5 / 60.0);
    const runtime::StepClock::Due due = clock.take(0, 2, 13.0 / 60.0, turned, false);
    clock.endFrame(2);
    ASSERT_EQ(due.count, 3u);
    EXPECT_TRUE(due.blows);
    EXPECT_EQ(due.wind[0], glm::vec3(0.0f)) << "before the call";
    EXPECT_LT(glm::length(due.wind[1] - glm::vec3(0.0f, 1.0f, 4.0f)), 1e-6f) << "in the model's frame and its units";
    EXPECT_EQ(due.wind[2], due.wind[1]);
    EXPECT_LT(glm::length(due.down[1] - glm::vec3(0.0f, -1.0f, 0.0f)), 1e-6f);
    clock.setWind({0.0, 0.0, 0.0}, 14.5 / 60.0);
    EXPECT_TRUE(clock.take(0, 3, 16.0 / 60.0, turned, false).blows);
    clock.endFrame(3);
    clock.cancelFrame(3);
    const runtime::StepClock::Due again = clock.take(0, 4, 16.0 / 60.0, turned, false);
    EXPECT_TRUE(again.wind[0] == due.wind[1] && again.wind[1] == glm::vec3(0.0f))
        << "as in the frame that was cancelled";
    clock.endFrame(4);
    EXPECT_FALSE(clock.take(0, 5, 18.0 / 60.0, turned, false).blows);
    EXPECT_EQ(runtime::velocityWithin({glm::dmat3(0.0), {}}, {1.0, 0.0, 0.0}), glm::vec3(0.0f)) << "flat";
    EXPECT_NEAR(runtime::velocityWithin({glm::dmat3(1e-9), {}}, {1.0, 0.0, 0.0}).x, 1e6f, 1.0f);
}

TEST(StepClock, SeveralWindsBlowEachInItsSteps) {
    runtime::StepClock clock(1, false);
    const auto take = [&](uint64_t frame, double step) {
        const runtime::StepClock::Due due = clock.take(0, frame, step / 60.0 + 1e-9, {}, false);
        clock.endFrame(frame);
        return due;
    };
    (void)take(1, 10);
    for (const double step : {10.5, 11.5, 13.5}) {
        clock.setWind({step, 0.0, 0.0}, step / 60.0);
    }
    clock.setWind({7.0, 0.0, 0.0}, 13.5 / 60.0);
    for (const uint64_t frame : {2u, 3u}) { // the second behind the first, which is cancelled
        const runtime::StepClock::Due due = take(frame, 15);
        ASSERT_EQ(due.count, 5u);
        const float blows[] = {10.5f, 11.5f, 11.5f, 7.0f, 7.0f};
        for (uint32_t k = 0; k < 5; ++k) {
            EXPECT_EQ(due.wind[k].x, blows[k]) << k;
        }
        if (frame == 2) {
            clock.cancelFrame(2);
        }
    }
    for (uint32_t n = 0; n < 40; ++n) { // more than anybody needs
        clock.setWind({n, 0.0, 0.0}, (15.5 + 0.1 * n) / 60.0);
    }
    const runtime::StepClock::Due due = take(4, 20);
    EXPECT_EQ(due.wind[4].x, 39.0f);
    EXPECT_EQ(due.wind[3].x, 35.0f);
    EXPECT_EQ(due.wind[0].x, 5.0f);
}

TEST(StepClock, WhatIsSoftSleepsAndWakesByItself) {
    runtime::StepClock clock(1, true);
    uint64_t frame = 0;
    const auto at = [&](double step, bool runsSoft) {
        return clock.take(0, ++frame, step / 60.0 + 1e-9, {}, false, runsSoft);
    };
    EXPECT_FALSE(at(10, true).softSleeps);
    EXPECT_FALSE(at(12, true).softWakes);
    EXPECT_TRUE(at(15, false).softSleeps);
    EXPECT_TRUE(at(15.5, true).softSleeps) << "it has no step to wake with";
    runtime::StepClock::Due due = at(17, true);
    EXPECT_TRUE(due.softWakes);
    EXPECT_FALSE(due.settles) << "springs have not slept";
    EXPECT_EQ(due.softSkipped, 5u) << "from step 12 to step 17";
    clock.cancelFrame(frame);
    EXPECT_EQ(at(18, true).softSkipped, 6u);
    EXPECT_FALSE(at(19, true).softWakes);
    EXPECT_TRUE(at(20, false).softSleeps);
    due = at(40, true);
    EXPECT_TRUE(due.settles && due.softWakes);
    EXPECT_EQ(due.softSkipped, 21u);
    clock.settle(0);
    due = at(41, false);
    EXPECT_TRUE(due.settles && due.softSleeps);
    due = at(42, true);
    EXPECT_TRUE(due.softWakes);
    EXPECT_EQ(due.softSkipped, 0u) << "nothing of it is left";
}

TEST(StepClock, AnotherCapacityKeepsWhatACancelledFrameUndoes) {
    runtime::StepClock clock(1, true);
    (void)clock.take(0, 1, 10.0 / 60.0, {}, false);
    (void)clock.take(0, 2, 12.0 / 60.0, {}, false);
    runtime::StepClock larger(3, true);
    larger.takeOver(clock, 1);
    larger.cancelFrame(2);
    EXPECT_EQ(larger.take(0, 3, 12.0 / 60.0, {}, false).first, 11);
}

TEST_F(Springs, StandInTheWind) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset wren = wrenWithSprings(own);
    SwingingGroup calm(own, playedGroup(wren, 1, kSprings)), windy(own, playedGroup(wren, 1, kSprings));
    for (SwingingGroup* const stage : {&calm, &windy}) {
        stage->play(0, 0, 0.0);
    }
    windy.setWind({0.0f, 0.0f, -8.0f});
    for (uint32_t f = 0; f < 90; ++f) {
        calm.swingOnly(f / 60.0);
        windy.swingOnly(f / 60.0);
    }
    EXPECT_GT(farthestApart(calm.shown(0), windy.shown(0)), 0.05);
    windy.setWind({0.0f, 0.0f, 0.0f});
    for (uint32_t f = 90; f < 300; ++f) {
        calm.swingOnly(f / 60.0);
        windy.swingOnly(f / 60.0);
    }
    EXPECT_LT(farthestApart(calm.shown(0), windy.shown(0)), 1e-3) << "it hangs as before";
}

TEST_F(Springs, SwingWithTheWordsOfTheCpu) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const bool isPip : {false, true}) {
            const SuppleAsset asset = isPip ? pipWithSprings(own) : wrenWithSprings(own);
            for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
                constexpr uint32_t kCount = 6;
                const uint32_t modifiers = isPip ? 0 : SUPPLE_GROUP_MODIFIERS;
                SwingingGroup swinging(own, playedGroup(asset, kCount, kSprings | modifiers, skinning));
                SwingingGroup still(own, playedGroup(asset, kCount, modifiers, skinning));
                ASSERT_TRUE(swinging.crowd.valid());
                for (uint32_t i = 0; i < kCount; ++i) {
                    const bool travels = i == 1 || i == 4;
                    for (SwingingGroup* const stage : {&swinging, &still}) {
                        stage->play(i, 1 + i % 2, 0.1 * i,
                                    travels ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW : 0,
                                    travels ? SUPPLE_PLAYBACK_TRAVEL : 0);
                    }
                    swinging.travels[i] = travels;
                }
                if (!isPip) {
                    SuppleModifier aim{};
                    aim.kind = SUPPLE_MODIFIER_AIM;
                    aim.joint = swinging.joint("head");
                    aim.weight = 1.0f;
                    aim.target[0] = 3.0f;
                    aim.target[2] = 1.0f;
                    swinging.modify(2, aim);
                    still.modify(2, aim);
                }
                double swung = 0.0;
                for (uint32_t f = 0; f < 24; ++f) {
                    const double time = 0.35 + 0.021 * f;
                    const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.1f * f, 0, 0)),
                                                        0.1f * f, glm::vec3(0.2f, 1.0f, 0.0f));
                    for (const uint32_t i : {3u, 4u}) {
                        swinging.move(i, place);
                        still.move(i, place);
                        swinging.clock.place(i, f == 0 ? 0.0 : 0.35 + 0.021 * (f - 1)); // before the time is set
                    }
                    if (f % 6 == 2) { // each wind blows for a while
                        swinging.setWind({0.3f * static_cast<float>(f), 0.5f, -4.0f});
                        swinging.clock.setWind({0.3f * static_cast<float>(f), 0.5f, -4.0f}, 0.35 + 0.021 * (f - 1));
                    }
                    EXPECT_EQ(swinging.swing(time), 0u) << time;
                    still.swingOnly(time);
                    for (uint32_t i = 0; i < kCount; ++i) {
                        if (f == 0) {
                            EXPECT_EQ(swinging.shown(i), still.shown(i)) << "at rest in the pose";
                        }
                        raise(swung, farthestApart(swinging.shown(i), still.shown(i)));
                    }
                }
                EXPECT_GT(swung, 0.1);
                for (PlayedSprings& twin : swinging.twins) {
                    for (const PlayedSprings::Bone& bone : twin.bones()) {
                        EXPECT_NEAR(glm::distance(bone.head, bone.tail), glm::distance(bone.head, bone.posedTail),
                                    1e-5f);
                    }
                }
            }
        }
    }
}

/// What four instances show at each sixth of a second, in frames at these times.
ShownAtSixths swungInFrames(CrowdContext& own, SuppleAsset asset, uint32_t flags, std::span<const double> times) {
    SwingingGroup stage(own, playedGroup(asset, 4, flags | SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS));
    playFour(stage);
    return shownAtSixths(
        stage, times, [&](uint32_t sixth, double time) { callAt(stage, 3, sixth, time); },
        [&](double time) { stage.swingOnly(time); });
}

TEST_F(Springs, DoNotDependOnTheFrameRate) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = wrenWithSprings(own);
    constexpr uint32_t kSixths = 9;
    std::vector<std::vector<double>> rates;
    for (const uint32_t rate : {24u, 30u, 90u, 144u}) {
        rates.push_back(framesOf(rate, kSixths));
    }
    rates.push_back(irregularFrames(40, kSixths));

    const ShownAtSixths first = swungInFrames(own, asset, kSprings, framesOf(60, kSixths));
    ASSERT_EQ(first.size(), kSixths + 1);
    for (const std::vector<double>& times : rates) {
        EXPECT_EQ(swungInFrames(own, asset, kSprings, times), first) << times.size() << " frames";
    }
    const ShownAtSixths still = swungInFrames(own, asset, 0, framesOf(24, kSixths));
    ASSERT_EQ(still.size(), first.size());
    for (size_t i = 0; i < first.back().size(); ++i) {
        EXPECT_GT(farthestApart(first.back()[i], still.back()[i]), 0.02) << i << " swings";
    }
}

TEST_F(Springs, HaveTheSameWordsInBothMappingsAndSharedDispatches) {
    const ValidationGuard guard;
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext* const contexts[] = {&context(SUPPLE_MAPPING_NARROW), &context(SUPPLE_MAPPING_WIDE), &shared};
    std::vector<Pose> first;
    for (CrowdContext* const own : contexts) {
        SwingingGroup stage(*own, playedGroup(pipWithSprings(*own), 3, kSprings));
        ASSERT_TRUE(stage.crowd.valid());
        for (uint32_t i = 0; i < 3; ++i) {
            stage.play(i, i, 0.3 * i);
        }
        std::vector<Pose> shown;
        for (uint32_t f = 0; f < 30; ++f) {
            stage.move(1, glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, 0.03f * static_cast<float>(f * f))));
            stage.swingOnly(f / 50.0);
            shown.push_back(stage.shown(f % 3));
        }
        first = first.empty() ? shown : first;
        EXPECT_EQ(shown, first);
    }
}

cage::Character readWren() {
    Result<cage::Character> wren = cage::readGltf(withExtensions(kWren, kWrenSprings), "wren", "");
    EXPECT_TRUE(wren.ok());
    EXPECT_EQ(wren->springBones.springs.size(), 2u);
    EXPECT_EQ(wren->springBones.colliders.size(), 5u);
    return wren ? std::move(*wren) : cage::Character();
}

TEST_F(Springs, KeepTheirLengthsForHours) {
    const cage::Character wren = readWren();
    const skinning::ClipTable table = skinning::buildClipTable(wren);
    const skinning::PoseLayout layout = skinning::PoseLayout::of(skinning::SkinningMode::linear, table.jointCount, 0);
    PlayedSprings twin(table, layout, 0);
    std::vector<uint32_t> words(4 * size_t{skinning::PlaybackState::elements(0)});
    skinning::PlaybackState state(words);
    skinning::PlaybackLayer layer;
    layer.clip = 3; // she attacks
    layer.loop = true;
    state.set(wren, table, {{&layer, 1}, {}, false});
    state.setTransform(glm::mat4(1.0f));
    const std::vector<float> masks(4 * size_t{skinning::maskElements(table)} * shared::kMaxMasks, 1.0f);
    double stretch = 0.0, swung = 0.0;
    for (int64_t n = 0; n < 100'000; ++n) {
        twin.step(words, masks, n, n == 0 ? PlayedSprings::Begins::anew : PlayedSprings::Begins::asItIs);
        for (const PlayedSprings::Bone& bone : twin.bones()) {
            const double posed = static_cast<double>(glm::distance(bone.head, bone.posedTail));
            raise(stretch, std::abs(static_cast<double>(glm::distance(bone.head, bone.tail)) - posed));
            raise(swung, static_cast<double>(glm::distance(bone.tail, bone.posedTail)));
        }
    }
    EXPECT_LT(stretch, 1e-6);
    EXPECT_GT(swung, 0.02);
    std::printf("lengths off by %.1e, tails off the pose by %.3f\n", stretch, swung);
}

/// Two groups that do the same, but for what `differs` does to the first.
class TwoGroups {
public:
    TwoGroups(CrowdContext& context, uint32_t capacity)
        : asset(wrenWithSprings(context)), other(context, playedGroup(asset, capacity, kSprings)),
          plain(context, playedGroup(wrenWithSprings(context), capacity, kSprings)) {
        for (uint32_t i = 0; i < capacity; ++i) {
            other.play(i, 2, 0.1 * i);
            plain.play(i, 2, 0.1 * i);
        }
    }
    void run(uint32_t step) {
        other.swingOnly(step / 60.0);
        plain.swingOnly(step / 60.0);
    }
    [[nodiscard]] bool same(uint32_t i) const { return other.shown(i) == plain.shown(i); }

    SuppleAsset asset;
    SwingingGroup other, plain;
};

TEST_F(Springs, GoOnWhenTheCapacityChanges) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        TwoGroups both(context(mapping), 3);
        for (uint32_t step = 0; step < 40; ++step) {
            if (step == 15 || step == 25) {
                EXPECT_EQ(suppleSetCapacity(both.other.handle(), both.other.crowd.group(), step == 15 ? 9 : 5),
                          SUPPLE_OK);
            }
            both.run(step);
            for (uint32_t i = 0; i < 3; ++i) {
                EXPECT_TRUE(both.same(i)) << step;
            }
        }
    }
}

TEST_F(Springs, AFrameThatIsCancelledHasNotBeen) {
    const ValidationGuard guard;
    TwoGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    for (uint32_t step = 0; step < 30; ++step) {
        if (step % 5 == 3 || step == 0) {
            EXPECT_EQ(suppleSetTime(both.other.handle(), both.other.crowd.group(), step / 60.0), SUPPLE_OK);
            both.other.crowd.context().cancel(both.other.crowd.group());
        }
        both.run(step);
        EXPECT_TRUE(both.same(0) && both.same(1)) << step;
    }
}

TEST_F(Springs, HiddenInstancesCatchUpOrSettle) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    TwoGroups both(own, 2);
    SwingingGroup still(own, playedGroup(both.asset, 2, 0));
    still.play(1, 2, 0.1);
    for (uint32_t step = 0; step < 60; ++step) {
        const bool hidden = (step > 10 && step < 18) || (step > 30 && step < 39);
        both.other.crowd.setVisible(both.other.instances[1], !hidden);
        both.run(step);
        EXPECT_TRUE(both.same(0)) << step;
        if (!hidden && step < 39) {
            EXPECT_TRUE(both.same(1)) << step << ": 8 steps were due at most";
        }
        if (step == 39) {
            EXPECT_FALSE(both.same(1)) << "9 were due";
            still.swingOnly(step / 60.0);
            EXPECT_EQ(both.other.shown(1), still.shown(1)) << "it is at rest in the pose";
        }
    }
    EXPECT_LT(farthestApart(both.other.shown(1), both.plain.shown(1)), 0.05) << "it comes together again";
}

TEST_F(Springs, SettleWhenTheirAssetIsLoadedAnew) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    TwoGroups both(own, 2);
    SwingingGroup still(own, playedGroup(wrenWithSprings(own), 2, 0));
    still.play(0, 2, 0.0);
    still.play(1, 2, 0.1);
    for (uint32_t step = 0; step < 60; ++step) {
        if (step == 20) {
            reloadWren(both.other.crowd.context(), both.asset, kWrenSprings);
        }
        both.run(step);
        EXPECT_EQ(both.same(0), step < 20) << step;
        if (step == 20) {
            still.swingOnly(step / 60.0);
            for (uint32_t i = 0; i < 2; ++i) {
                EXPECT_EQ(both.other.shown(i), still.shown(i)) << i << " is at rest in the pose";
            }
        }
    }
    EXPECT_LT(farthestApart(both.other.shown(1), both.plain.shown(1)), 0.05) << "it comes together again";
}

TEST_F(Springs, TeleportsKeepHowTheyHang) {
    const ValidationGuard guard;
    TwoGroups both(context(SUPPLE_MAPPING_NARROW), 2);
    const glm::mat4 far = glm::translate(glm::mat4(1.0f), glm::vec3(100.0f, 0.0f, 0.0f));
    double told = 0.0, untold = 0.0;
    for (uint32_t step = 0; step < 40; ++step) {
        if (step == 20) {
            both.other.move(0, far);
            both.other.crowd.teleport(both.other.instances[0]);
            both.other.move(1, far);
        }
        both.run(step);
        const auto off = [&](uint32_t i) {
            Pose here = both.other.shown(i);
            for (size_t k = 3; k < here.size(); k += 12) {
                here[k] -= step >= 20 ? 100.0f : 0.0f;
            }
            return farthestApart(here, both.plain.shown(i));
        };
        raise(told, off(0));
        raise(untold, off(1));
    }
    EXPECT_LT(told, 1e-4) << "floats a hundred metres from the origin";
    EXPECT_GT(untold, 0.1);
}

TEST_F(Springs, AreRefusedWhereTheyCannotBe) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = wrenWithSprings(own);
    const auto created = [&](SuppleGroupDesc desc) {
        desc.structSize = sizeof desc;
        SuppleGroup group{};
        const SuppleResult result = suppleCreateGroup(own.handle(), &desc, &group);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyGroup(own.handle(), group), SUPPLE_OK);
        }
        return result;
    };
    SuppleGroupDesc desc = playedGroup(asset, 1, kSprings);
    EXPECT_EQ(created(desc), SUPPLE_OK);
    desc.flags |= SUPPLE_GROUP_UPDATE_RATES;
    EXPECT_EQ(created(desc), SUPPLE_ERROR_ARGUMENT);
    desc.flags = kSprings;
    desc.poseSource = SUPPLE_POSES_SET;
    EXPECT_EQ(created(desc), SUPPLE_OK);
    desc.poseSource = SUPPLE_POSES_PALETTE_BUFFER;
    EXPECT_EQ(created(desc), SUPPLE_ERROR_ARGUMENT);
    (void)own.takeError();
    EXPECT_EQ(created(playedGroup(own.asset(kWren), 1, kSprings)), SUPPLE_OK) << "nothing swings";
}

TEST_F(Springs, NothingSwingsWithoutSpringsOrInTheBindPose) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PlayedGroup none(own, playedGroup(own.asset(kPip), 2, kSprings));
    none.play(0, 1, 0.0);
    for (uint32_t step = 0; step < 5; ++step) {
        EXPECT_EQ(none.run(step / 60.0), 0u) << "the CPU's words, without springs";
    }
    PlayedGroup bind(own, playedGroup(pipWithSprings(own), 2, kSprings));
    for (uint32_t step = 0; step < 5; ++step) {
        EXPECT_EQ(bind.run(step / 60.0), 0u);
    }
}

TEST_F(Springs, SwingInWindowsOfInstances) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        LimitedDevice limited(mapping, [](WrappedVulkan& says) { says.maxStorageBufferRange = 1u << 20; });
        ASSERT_NE(limited.context(), nullptr);
        constexpr uint32_t kCount = 80;
        SwingingGroup stage(*limited.context(),
                            playedGroup(wrenWithSprings(*limited.context()), kCount, kSprings | SUPPLE_GROUP_WINDOWS));
        ASSERT_TRUE(stage.crowd.valid());
        EXPECT_GT(stage.group().windows().count(), 1u);
        for (uint32_t i = 0; i < kCount; ++i) {
            stage.play(i, 1 + i % 2, 0.1 * i);
        }
        for (uint32_t f = 0; f < 4; ++f) {
            EXPECT_EQ(stage.swing(0.1 * f), 0u);
        }
    }
}

TEST_F(Springs, AllocateNothingInFrames) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SwingingGroup stage(own, playedGroup(wrenWithSprings(own), 4, kSprings | SUPPLE_GROUP_TRANSITIONS));
    for (uint32_t i = 0; i < 4; ++i) {
        stage.play(i, 1, 0.1 * i);
    }
    runtime::Group& group = stage.group();
    runtime::Playback& playback = *group.poses().playback();
    double time = 0.0;
    uint64_t frame = 1000;
    stage.swingOnly(time);
    const uint64_t before = allocationsCounted();
    for (uint32_t n = 0; n < 200; ++n) {
        time += 0.01 * (n % 13);
        const AllocationCount count;
        playback.setTime(time);
        playback.setTransform(n % 4, glm::translate(glm::mat4(1.0f), glm::vec3(0.01f * static_cast<float>(n))));
        playback.listPoses(++frame, group.windows(), 4, [](uint32_t) { return true; });
    }
    EXPECT_EQ(allocationsCounted(), before);
}

/// A host with springs that calls all that concerns them, from a frame to another.
void swingAbout(CrowdContext& own, SwingingGroup& stage, uint32_t first, uint32_t last) {
    for (uint32_t f = first; f < last; ++f) {
        EXPECT_EQ(suppleSetTime(own.handle(), stage.crowd.group(), 0.03 * f), SUPPLE_OK);
        const uint32_t i = f % 3;
        if (f % 4 == 1) { // so does the first frame of the late recording
            stage.play(i, f % 3, 0.1 * f);
            stage.setWind({0.5f * static_cast<float>(f), 0.0f, -4.0f});
        }
        if (f % 5 == 2) {
            stage.move(i, glm::rotate(glm::mat4(1.0f), 0.3f * static_cast<float>(f), glm::vec3(0, 1, 0)));
        }
        if (f % 7 == 3) {
            stage.crowd.teleport(stage.instances[i]);
        }
        stage.crowd.setVisible(stage.instances[2], f % 6 > 2);
        own.run(stage.crowd.group());
    }
}

TEST_F(Springs, AreRecorded) {
    for (const uint32_t begins : {0u, 9u}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
        SwingingGroup stage(own, playedGroup(wrenWithSprings(own), 3, kSprings));
        for (uint32_t i = 0; i < 3; ++i) {
            stage.play(i, 1, 0.1 * i);
        }
        const auto run = [&](uint32_t first, uint32_t last) { swingAbout(own, stage, first, last); };
        expectReplayedFrom(begins, begins + 16, own, run, 21);
    }
}

TEST_F(Springs, AreRefusedWhereTheListOfPosesHasTooManyTexels) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    constexpr uint32_t kTexels = 4096, kMost = kTexels / runtime::PoseList::kWordsOfStepping;
    const Result<cage::GlbFile> tube = cage::writeGlb(riggedTube({.segments = 8, .sides = 8, .joints = 4}));
    ASSERT_TRUE(tube);
    const std::vector<std::byte> swinging =
        withExtensions(tube->bytes, R"("VRMC_springBone":{"springs":[{"joints":[{"node":2},{"node":3},{"node":4}]}]})");
    wrapped.maxTexelBufferElements = kTexels;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext own(*device, mapping);
        const SuppleAsset swings = own.createAsset(swinging, "tube"), stands = own.createAsset(tube->bytes, "tube");
        const auto created = [&](SuppleAsset asset, uint32_t capacity,
                                 SupplePoseSource source = SUPPLE_POSES_PLAYBACK) {
            SuppleGroupDesc desc = playedGroup(asset, capacity, kSprings);
            desc.structSize = sizeof desc;
            desc.poseSource = source;
            SuppleGroup group{};
            return suppleCreateGroup(own.handle(), &desc, &group);
        };
        const bool narrow = mapping == SUPPLE_MAPPING_NARROW;
        EXPECT_EQ(created(swings, kMost), SUPPLE_OK);
        EXPECT_EQ(created(swings, kMost + 1), narrow ? SUPPLE_ERROR_LIMIT : SUPPLE_OK);
        if (narrow) {
            EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_LIMIT);
        }
        EXPECT_EQ(created(stands, kMost + 1), SUPPLE_OK) << "without springs there is no list";
        EXPECT_EQ(created(swings, kMost + 1, SUPPLE_POSES_SET), SUPPLE_OK) << "nor of poses that the host sets";
    }
    wrapped.maxTexelBufferElements = 0;
}

TEST_F(Springs, BoxesHoldWhatSwings) {
    cage::Character tube = riggedTube({.joints = 4});
    tube.clips.push_back(clipOf({channel(2, ChannelPath::rotation, {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f})}));
    const skinning::Reach reach = skinning::reachOf(tube);
    const auto isKnown = [&](std::vector<uint32_t> swinging) {
        runtime::PlayedBounds bounds(tube, {}, false, 1);
        bounds.setSwinging(swinging);
        skinning::PlaybackLayer layer;
        bounds.set(0, {{&layer, 1}, {}, false});
        return bounds.of(0, 0.0, reach, {}).has_value();
    };
    EXPECT_TRUE(isKnown({}));
    EXPECT_TRUE(isKnown({2, 3}));
    EXPECT_FALSE(isKnown({1})) << "no clip moves it, or what it hangs on";
}

} // namespace
} // namespace supple::test
