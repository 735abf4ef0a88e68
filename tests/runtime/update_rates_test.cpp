// Update rates: poses at grid times, straight between them, with the bits that the CPU has, whatever the frame rate;
// and by the size on the screen.
#include "runtime/update_rates.h"

#include "shaders/pose/straight.h"
#include "tests/support/played_group.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

using cage::ChannelPath;

class UpdateRates : public CrowdContexts {};

constexpr uint32_t kEvery[] = {1, 2, 4, 8};

SuppleGroupDesc ratedGroup(SuppleAsset asset, uint32_t capacity, SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR,
                           uint32_t flags = 0) {
    return playedGroup(asset, capacity, SUPPLE_GROUP_UPDATE_RATES | flags, skinning);
}

SupplePlaybackDesc every(uint32_t interval, SupplePlaybackDesc desc = {}) {
    desc.updateInterval = interval;
    return desc;
}

/// What an instance shows at a time, by the CPU.
std::vector<glm::vec4> shownAt(const PlayedGroup& stage, uint32_t i, double time) {
    EXPECT_EQ(suppleSetTime(stage.handle(), stage.crowd.group(), time), SUPPLE_OK);
    const skinning::PoseLayout& layout = stage.group().instances().poseLayout();
    std::vector<glm::vec4> pose(layout.stride);
    stage.group().poses().playback()->writePose(stage.instances[i].slot, pose);
    pose.resize(layout.elements());
    return pose;
}

bool same(std::span<const glm::vec4> a, std::span<const glm::vec4> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// What an instance showed in the last frame, by the device.
std::vector<glm::vec4> shownBy(const PlayedGroup& stage, uint32_t i) {
    const skinning::PoseLayout& layout = stage.group().instances().poseLayout();
    std::vector<glm::vec4> pose(layout.elements());
    std::memcpy(pose.data(), stage.poses.data() + size_t{4} * stage.instances[i].slot * layout.stride,
                pose.size() * sizeof(glm::vec4));
    return pose;
}

/// How many instances a frame poses, from what is timed.
uint32_t posedBy(CrowdContext& context, const SuppleGroup& group, uint32_t joints) {
    const auto timings = [&] {
        uint32_t count = 0;
        EXPECT_NE(suppleGetTimings(context.handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_ERROR_ARGUMENT);
        std::vector<SuppleTiming> all(count);
        EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(SuppleTiming), all.data(), &count), SUPPLE_OK);
        return all;
    };
    context.beginFrame();
    EXPECT_TRUE(
        testDevice()
            ->submitAndWait([&](VkCommandBuffer commands) {
                EXPECT_EQ(context.LoggedContext::record(commands, {&group, 1}, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
            })
            .ok());
    context.beginFrame(); // the frame is complete
    context.beginFrame();
    uint64_t points = 0;
    for (const SuppleTiming& timing : timings()) {
        points += timing.group.id == group.id && timing.pass == SUPPLE_PASS_POSE ? timing.points : 0;
    }
    return static_cast<uint32_t>(points / joints);
}

TEST(UpdateGrid, HoldsEveryTimeBetweenTwoOfItsOwn) {
    Noise noise(3);
    for (uint32_t run = 0; run < 20000; ++run) {
        const uint32_t slot = run % 29, interval = kEvery[1 + run % 3];
        const double far = run % 5 == 0 ? 1e9 : 100.0;
        const double anywhere = far * static_cast<double>(noise()) * 2.0;
        const double time = run % 2 == 0 ? anywhere : std::floor(anywhere * 60.0) / 60.0;
        const runtime::PoseSpan span = runtime::gridSpan(time, slot, interval);
        ASSERT_LE(span.begin, time);
        ASSERT_GT(span.end, time);
        ASSERT_NEAR(span.end - span.begin, interval / 60.0, 1e-6);
        const double k = (span.begin * 60.0 + slot % interval) / interval;
        ASSERT_NEAR(k, std::round(k), 1e-4);
        const float part = span.partAt(time);
        ASSERT_TRUE(part >= 0.0f && part <= 1.0f);
        // Coarser grids are parts of finer ones, so that poses serve both.
        const runtime::PoseSpan fine = runtime::gridSpan(span.begin, slot, interval / 2 > 1 ? interval / 2 : interval);
        ASSERT_EQ(fine.begin, span.begin);
    }
}

TEST(UpdateGrid, PosesThatBothSpansHaveStay) {
    runtime::UpdateRates rates(1);
    rates.set(0, {8, {}});
    EXPECT_FALSE(rates.holds(0, {1.0, 2.0}));
    EXPECT_EQ(rates.take(0, {1.0, 2.0}).dueCount, 2u);
    EXPECT_TRUE(rates.holds(0, {1.0, 2.0}));
    EXPECT_EQ(rates.take(0, {1.0, 2.0}).dueCount, 0u);
    const runtime::UpdateRates::Ends later = rates.take(0, {2.0, 3.0}), back = rates.take(0, {1.0, 2.0});
    ASSERT_EQ(later.dueCount, 1u);
    EXPECT_EQ(later.due[0].time, 3.0);
    EXPECT_EQ(later.due[0].end, 1u) << "in the place of what is over";
    EXPECT_EQ(later.earlier, 2u);
    ASSERT_EQ(back.dueCount, 1u);
    EXPECT_EQ(back.due[0].time, 1.0);
    EXPECT_EQ(back.earlier, 1u);
    rates.forget(0);
    EXPECT_EQ(rates.take(0, {1.0, 2.0}).dueCount, 2u);
}

TEST(UpdateGrid, SizesChooseWithHysteresis) {
    runtime::UpdateRates rates(1);
    rates.set(0, {0, {0.01f, 0.04f, 0.1f}});
    EXPECT_EQ(rates.interval(0), 1u) << "until somebody knows";
    const auto at = [&](float pixels) {
        rates.choose(0, pixels);
        return rates.interval(0);
    };
    EXPECT_EQ(at(9.0f), 8u) << "the first time, at once";
    EXPECT_EQ(at(11.0f), 4u);
    EXPECT_EQ(at(9.0f), 4u);
    EXPECT_EQ(at(6.5f), 8u);
    EXPECT_EQ(at(9.9f), 8u);
    EXPECT_EQ(at(99.0f), 2u);
    EXPECT_EQ(at(101.0f), 1u);
    EXPECT_EQ(at(80.0f), 1u);
    EXPECT_EQ(at(66.0f), 2u);
    EXPECT_EQ(at(std::numeric_limits<float>::infinity()), 1u);
}

TEST(UpdateGrid, IntervalsThatSaveNothingAreNotChosen) {
    runtime::UpdateRates rates(1);
    rates.set(0, {0, {0.01f, 0.01f, 0.1f}});
    const auto at = [&](double least) {
        rates.choose(0, 50.0f, least);
        return rates.interval(0);
    };
    EXPECT_EQ(at(1.75), 4u);
    EXPECT_EQ(at(4.0), 4u);
    EXPECT_EQ(at(4.375), 1u) << "8 is too coarse, 4 is posed more often than every other frame";
    runtime::TimeSteps steps;
    for (const double time : {3.0, 3.04, 3.08}) {
        steps.take(time);
    }
    EXPECT_NEAR(steps.leastInterval(), 1.75 * 2.4, 1e-9);
    steps.take(100.0);
    EXPECT_NEAR(steps.leastInterval(), 1.75 * 2.4, 1e-9) << "a seek";
    steps.take(100.0);
    EXPECT_EQ(steps.leastInterval(), 0.0) << "paused";
}

TEST(UpdateGrid, WhatWasChosenStaysWhileItIsChosenBy) {
    runtime::UpdateRates rates(1);
    const runtime::UpdateCourse walk{0, {0.01f, 0.04f, 0.1f}};
    rates.set(0, walk);
    rates.choose(0, 11.0f);
    EXPECT_EQ(rates.interval(0), 4u);
    rates.set(0, walk); // at another time, or with another weight
    EXPECT_EQ(rates.interval(0), 4u);
    rates.choose(0, 9.0f);
    EXPECT_EQ(rates.interval(0), 4u) << "hysteresis";
    rates.set(0, {0, {0.02f, 0.04f, 0.1f}});
    EXPECT_EQ(rates.interval(0), 1u);
    rates.choose(0, 9.0f);
    EXPECT_EQ(rates.interval(0), 8u) << "at once";
    rates.reset(0);
    EXPECT_EQ(rates.interval(0), 1u);
}

TEST_F(UpdateRates, GoStraightBetweenPosesOfTheGrid) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const std::string& file : {kPip, kWren}) {
            for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
                constexpr uint32_t kCount = 12;
                const bool dual = skinning == SUPPLE_SKINNING_DUAL_QUATERNION;
                PlayedGroup rated(own, ratedGroup(own.asset(file), kCount, skinning));
                PlayedGroup exact(own, playedGroup(own.asset(file), kCount, 0, skinning));
                ASSERT_TRUE(rated.crowd.valid() && exact.crowd.valid());
                for (uint32_t i = 0; i < kCount; ++i) {
                    rated.play(i, 1 + i % 2, 0.1 * i, every(kEvery[i % 4]));
                    exact.play(i, 1 + i % 2, 0.1 * i);
                }
                uint32_t straight = 0;
                for (const double time : {0.35, 0.354, 0.36, 0.4, 0.61, 0.3, 0.7, 3.1, 3.5}) {
                    EXPECT_EQ(rated.run(time), 0u) << time;
                    for (uint32_t i = 0; i < kCount; ++i) {
                        const runtime::PoseSpan span =
                            i % 4 == 0 ? runtime::exactSpan(time) : runtime::gridSpan(time, i, kEvery[i % 4]);
                        std::vector<glm::vec4> wanted = shownAt(exact, i, span.begin);
                        const std::vector<glm::vec4> shown = shownBy(rated, i);
                        if (same(shown, shownAt(exact, i, time))) {
                            continue; // a seam, or posed in every frame
                        }
                        ++straight;
                        const std::vector<glm::vec4> later = shownAt(exact, i, span.end);
                        const skinning::PoseLayout& layout = exact.group().instances().poseLayout();
                        for (size_t k = 0; k < wanted.size(); ++k) {
                            const bool rotation = dual && k >= 3 && k < layout.morphWeights && (k - 3) % 4 == 3;
                            wanted[k] = rotation ? shared::straightRotation(wanted[k], later[k], span.partAt(time))
                                                 : shared::straight(wanted[k], later[k], span.partAt(time));
                        }
                        EXPECT_TRUE(same(shown, wanted)) << i << " at " << time;
                    }
                }
                EXPECT_GT(straight, 9 * kCount / 2);
            }
        }
    }
}

TEST_F(UpdateRates, DependOnTimeSlotAndIntervalAlone) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    constexpr uint32_t kCount = 8, kSixths = 7; // of a second: frames of all rates come to them
    const auto framesOf = [&](uint32_t rate) {
        std::vector<double> times;
        for (uint32_t k = 0; k <= rate * kSixths / 6; ++k) {
            times.push_back(k * 6 % rate == 0 ? k * 6 / rate / 6.0 : static_cast<double>(k) / rate);
        }
        return times;
    };
    std::vector<std::vector<double>> rates = {framesOf(24), framesOf(30), framesOf(60), framesOf(144)};
    Noise noise(11);
    std::vector<double> irregular;
    for (uint32_t sixth = 0; sixth <= kSixths; ++sixth) {
        irregular.push_back(sixth / 6.0);
        irregular.push_back(sixth / 6.0 + 0.16 * std::abs(static_cast<double>(noise())));
        irregular.push_back(sixth / 6.0 - 0.4 * std::abs(static_cast<double>(noise()))); // and back
    }
    rates.push_back(irregular);
    std::vector<std::vector<float>> wanted(kSixths + 1);
    for (size_t n = 0; n < rates.size(); ++n) {
        PlayedGroup stage(own, ratedGroup(own.asset(kWren), kCount));
        for (uint32_t i = 0; i < kCount; ++i) {
            stage.play(i, 1, 0.07 * i, every(kEvery[1 + i % 3]));
        }
        uint32_t compared = 0;
        for (const double time : rates[n]) {
            EXPECT_EQ(stage.run(time), 0u);
            const double sixth = std::round(time * 6.0);
            if (time < 0.0 || sixth / 6.0 != time) {
                continue;
            }
            std::vector<float> shown;
            for (uint32_t i = 0; i < kCount; ++i) {
                for (const glm::vec4& v : shownBy(stage, i)) {
                    shown.insert(shown.end(), {v.x, v.y, v.z, v.w});
                }
            }
            std::vector<float>& first = wanted[static_cast<size_t>(sixth)];
            if (n == 0) {
                first = shown;
            }
            EXPECT_TRUE(std::equal(shown.begin(), shown.end(), first.begin(), first.end())) << n << " at " << time;
            ++compared;
        }
        EXPECT_EQ(compared, kSixths + 1) << n;
    }
}

TEST_F(UpdateRates, TakeTurns) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    constexpr uint32_t kCount = 16;
    PlayedGroup stage(own, ratedGroup(own.asset(kWren), kCount));
    const auto joints = static_cast<uint32_t>(stage.character().skin.joints.size());
    for (const uint32_t interval : kEvery) {
        const double start = 0.1; // in the clip's middle, far from the seam
        for (uint32_t i = 0; i < kCount; ++i) {
            stage.play(i, 1, 0.3, every(interval));
        }
        const auto posedAt = [&](double time) {
            EXPECT_EQ(suppleSetTime(own.handle(), stage.crowd.group(), time), SUPPLE_OK);
            return posedBy(own, stage.crowd.group(), joints);
        };
        EXPECT_EQ(posedAt(start), interval == 1 ? kCount : 2 * kCount) << "both ends of all at once";
        for (uint32_t frame = 1; frame < 9; ++frame) {
            EXPECT_EQ(posedAt(start + frame / 60.0), kCount / interval) << interval << " in frame " << frame;
        }
        // Nothing is posed while no instance comes to a time of its own, wherever it stands.
        stage.place(3, glm::translate(glm::mat4(1.0f), {1.0f, 2.0f, 3.0f}));
        EXPECT_EQ(posedAt(start + 8.1 / 60.0), interval == 1 ? kCount : 0) << interval;
        EXPECT_EQ(stage.run(start + 8.2 / 60.0), 0u);
        // Nor by the host's weights, whatever they are, until the clips' own are back.
        const auto targets = static_cast<uint32_t>(stage.character().morphs.targets.size());
        std::vector<float> weights(targets, 0.25f);
        for (const float weight : {0.25f, 0.5f}) {
            std::fill(weights.begin(), weights.end(), weight);
            EXPECT_EQ(suppleSetMorphWeights(own.handle(), stage.instances[5], weights.data(), targets), SUPPLE_OK);
            EXPECT_EQ(posedAt(start + 8.15 / 60.0), interval == 1 ? kCount : 0) << interval;
        }
        for (const uint32_t posed : {2u, 0u}) {
            EXPECT_EQ(suppleSetMorphWeights(own.handle(), stage.instances[5], nullptr, 0), SUPPLE_OK);
            EXPECT_EQ(posedAt(start + 8.15 / 60.0), interval == 1 ? kCount : posed) << interval;
        }
        // A mask: whose layers name it.
        const std::vector<float> half(joints, 0.5f);
        SuppleMaskDesc mask{};
        mask.structSize = sizeof mask;
        mask.jointMask = half.data();
        mask.jointMaskCount = joints;
        for (const uint32_t number : {1u, 2u}) {
            mask.mask = number;
            EXPECT_EQ(suppleSetMask(own.handle(), stage.crowd.group(), &mask), SUPPLE_OK);
        }
        SupplePlaybackLayer masked = PlayedGroup::loops(1, 0.3);
        masked.mask = 2;
        stage.play(6, {&masked, 1}, every(interval));
        EXPECT_EQ(posedAt(start + 8.16 / 60.0), interval == 1 ? kCount : 2) << interval;
        for (const uint32_t number : {1u, 2u}) {
            mask.mask = number;
            EXPECT_EQ(suppleSetMask(own.handle(), stage.crowd.group(), &mask), SUPPLE_OK);
            EXPECT_EQ(posedAt(start + 8.17 / 60.0), interval == 1 ? kCount : 2 * (number - 1)) << interval;
        }
        // What plays changes at once.
        stage.play(3, 2, 0.0, every(interval));
        EXPECT_EQ(posedAt(start + 8.3 / 60.0), interval == 1 ? kCount : 2) << interval;
        EXPECT_EQ(stage.run(start + 8.3 / 60.0), 0u);
    }
}

TEST_F(UpdateRates, DoNotLagAndStayWithinWhatWasMeasured) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    for (const std::string& file : {kPip, kWren}) {
        const cage::Character& character = PlayedGroup(own, playedGroup(own.asset(file), 1, 0)).character();
        const skinning::UpdateFacts facts = skinning::measureUpdates(character);
        const auto clips = static_cast<uint32_t>(character.clips.size());
        PlayedGroup rated(own, ratedGroup(own.asset(file), 3 * clips)),
            exact(own, playedGroup(own.asset(file), clips, 0));
        for (uint32_t i = 0; i < 3 * clips; ++i) {
            rated.play(i, i / 3, 0.0, every(kEvery[1 + i % 3]));
            if (i % 3 == 0) {
                exact.play(i / 3, i / 3, 0.0);
            }
        }
        const skinning::DeformTable table = skinning::buildDeformTable(character, {});
        std::vector<glm::vec4> here(character.cage.vertexCount()), there(here);
        std::vector<double> most(3 * clips, 0.0);
        for (double time = 0.0; time < 1.2; time += 1.0 / 97.0) {
            for (uint32_t i = 0; i < 3 * clips; ++i) {
                skinning::deformLikeTheDevice(table, rated.group().instances().poseLayout(), shownAt(rated, i, time),
                                              here);
                skinning::deformLikeTheDevice(table, exact.group().instances().poseLayout(),
                                              shownAt(exact, i / 3, time), there);
                for (size_t v = 0; v < here.size(); ++v) {
                    raise(most[i], static_cast<double>(glm::length(glm::vec3(here[v] - there[v]))));
                }
            }
        }
        for (uint32_t c = 0; c < clips; ++c) {
            const skinning::UpdateErrors& errors = facts.ofClips[c];
            std::printf("%-10s clip %u%s: every 2, 4, 8 measured %.4f %.4f %.4f, seen %.4f %.4f %.4f\n",
                        character.name.c_str(), c, errors.closes ? " closes" : "", errors.every[0], errors.every[1],
                        errors.every[2], most[3 * c] / facts.extent, most[3 * c + 1] / facts.extent,
                        most[3 * c + 2] / facts.extent);
            for (size_t n = 0; n < 3; ++n) {
                // Measured at the grid's own times: between them it may be a little more.
                EXPECT_LE(most[3 * c + n], (1.3 * errors.every[n] + 1e-3) * facts.extent) << c << " " << n;
            }
        }
    }
}

/// It moves along x by a jump at the end, so that loops of it have a seam.
cage::Character jumper() {
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 1});
    tube.clips.push_back(clipOf({channel(1, ChannelPath::translation, {0, 0.5f, 1}, {0, 0, 0, 1, 0.25f, 0, 4, 0, 0}),
                                 channel(2, ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f})}));
    tube.clips.push_back(
        clipOf({channel(2, ChannelPath::rotation, {0, 0.5f, 1}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f, 0, 0, 0, 1})}));
    return tube;
}

TEST_F(UpdateRates, AreExactAtSeams) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    const SuppleAsset asset = own.createAsset(jumper());
    PlayedGroup rated(own, ratedGroup(asset, 4)), exact(own, playedGroup(asset, 4, 0));
    // Over the seam, over one where the root travels on, over none that shows, and without a loop.
    for (PlayedGroup* stage : {&rated, &exact}) {
        const SupplePlaybackDesc desc = every(stage == &rated ? 8 : 0);
        SupplePlaybackDesc travels = desc;
        travels.flags = SUPPLE_PLAYBACK_TRAVEL;
        travels.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
        stage->play(0, 0, 0.0, desc);
        stage->play(1, 0, 0.0, travels);
        stage->play(2, 1, 0.0, desc);
        SupplePlaybackLayer once = PlayedGroup::loops(0, 0.0);
        once.flags = 0;
        stage->play(3, {&once, 1}, desc);
    }
    uint32_t straight[4] = {}, atSeams = 0;
    for (double time = 0.7; time < 1.4; time += 1.0 / 50.0) {
        EXPECT_EQ(rated.run(time), 0u) << time;
        EXPECT_EQ(exact.run(time), 0u);
        for (uint32_t i = 0; i < 4; ++i) {
            const std::vector<glm::vec4> a = shownBy(rated, i), b = shownBy(exact, i);
            const runtime::PoseSpan span = runtime::gridSpan(time, i, 8);
            const bool meets = i != 2 && span.begin < 1.0 && span.end > 1.0;
            atSeams += meets ? 1 : 0;
            EXPECT_TRUE(!meets || same(a, b)) << i << " at " << time;
            straight[i] += same(a, b) ? 0 : 1;
            for (size_t k = 0; i < 2 && k < a.size(); ++k) { // the others have corners within
                EXPECT_LT(glm::length(a[k] - b[k]), 0.02f) << i << " at " << time << ", element " << k;
            }
        }
    }
    EXPECT_GE(atSeams, 15u);
    EXPECT_GE(straight[0], 20u);
    EXPECT_GE(straight[1], 20u);
    EXPECT_GE(straight[2], 30u);
    EXPECT_GE(straight[3], 8u) << "before its end";
}

TEST_F(UpdateRates, AreExactWhileWeightsFadeAndWhereClipsBegin) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PlayedGroup rated(own, ratedGroup(own.asset(kWren), 2)), exact(own, playedGroup(own.asset(kWren), 2, 0));
    for (PlayedGroup* stage : {&rated, &exact}) {
        const SupplePlaybackDesc desc = every(stage == &rated ? 8 : 0);
        SupplePlaybackLayer layers[] = {PlayedGroup::loops(1, 0.1), PlayedGroup::loops(2, 0.0)};
        layers[1].weight = 0.0f;
        layers[1].fadeWeight = 1.0f;
        layers[1].fadeStart = 0.3;
        layers[1].fadeDuration = 0.05f;
        stage->play(0, layers, desc);
        SupplePlaybackLayer once = PlayedGroup::loops(1, 0.0);
        once.flags = 0;
        once.startTime = 0.3;
        stage->play(1, {&once, 1}, desc);
    }
    const double ends[] = {0.35, 0.3};
    uint32_t met[2] = {}, straight[2] = {};
    for (double time = 0.05; time < 0.75; time += 1.0 / 97.0) {
        EXPECT_EQ(rated.run(time), 0u) << time;
        EXPECT_EQ(exact.run(time), 0u);
        for (uint32_t i = 0; i < 2; ++i) {
            const runtime::PoseSpan span = runtime::gridSpan(time, i, 8);
            const bool meets = span.begin < ends[i] + 1e-5 && span.end > 0.3 - 1e-5;
            const bool equal = same(shownBy(rated, i), shownBy(exact, i));
            met[i] += meets ? 1 : 0;
            EXPECT_TRUE(!meets || equal) << i << " at " << time;
            straight[i] += equal ? 0 : 1;
        }
    }
    EXPECT_GE(met[0], 12u);
    EXPECT_GE(met[1], 12u);
    EXPECT_GE(straight[0], 20u);
    EXPECT_GE(straight[1], 20u);
}

/// It runs along x, and moves one joint about as it does: what is left without the root's movement has no seam.
cage::Character runner() {
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3});
    tube.clips.push_back(
        clipOf({channel(1, ChannelPath::translation, {0, 1}, {0, 0, 0, 4, 0, 0}),
                channel(2, ChannelPath::rotation, {0, 0.5f, 1}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f, 0, 0, 0, 1})}));
    return tube;
}

TEST_F(UpdateRates, HaveNoSeamWhereTheRootIsTakenOut) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(runner());
    PlayedGroup rated(own, ratedGroup(asset, 3)), exact(own, playedGroup(asset, 3, 0));
    const uint32_t taken[] = {SUPPLE_ROOT_MOTION_GROUND, 0, SUPPLE_ROOT_MOTION_YAW};
    for (PlayedGroup* stage : {&rated, &exact}) {
        for (uint32_t i = 0; i < 3; ++i) {
            SupplePlaybackDesc desc = every(stage == &rated ? 8 : 0);
            desc.rootMotion = taken[i];
            stage->play(i, 0, 0.0, desc);
        }
    }
    for (const double time : {0.95, 0.97, 1.01, 1.03}) {
        EXPECT_EQ(rated.run(time), 0u) << time;
        EXPECT_EQ(exact.run(time), 0u);
        for (uint32_t i = 0; i < 3; ++i) {
            const runtime::PoseSpan span = runtime::gridSpan(time, i, 8);
            const bool seam = i != 0 && span.begin < 1.0 && span.end > 1.0;
            EXPECT_EQ(same(shownBy(rated, i), shownBy(exact, i)), seam) << i << " at " << time;
        }
    }
}

/// The draws' queue family gets the poses of every frame, and nothing comes back: whatever stands there afterwards, the
/// ends of earlier frames still serve.
TEST_F(UpdateRates, KeepTheirEndsWhereNobodyElseGetsThem) {
    const ValidationGuard guard;
    for (const uint32_t flags : {0u, uint32_t{SUPPLE_CONTEXT_ASYNC_COMPUTE}}) {
        for (const SuppleMapping mapping : kMappings) {
            CrowdContext own(*testDevice(), mapping, 2, flags);
            PlayedGroup stage(own, ratedGroup(own.asset(kPip), 8)), exact(own, playedGroup(own.asset(kPip), 8, 0));
            ASSERT_TRUE(stage.crowd.valid() && exact.crowd.valid());
            const SuppleBufferRange poses = stage.crowd.output().info.poses;
            EXPECT_EQ(poses.stride, exact.crowd.output().info.poses.stride) << "one pose an instance";
            for (uint32_t i = 0; i < 8; ++i) {
                stage.play(i, 1, 0.1 * i, every(8));
            }
            for (uint32_t frame = 0; frame < 12; ++frame) {
                const auto overwrite = [&](VkCommandBuffer commands) {
                    vkCmdFillBuffer(commands, poses.buffer, 0, VK_WHOLE_SIZE, 0xCDCDCDCDu);
                };
                EXPECT_EQ(stage.run(0.1 + frame / 60.0, overwrite), 0u) << frame;
                if (flags != 0) {
                    std::vector<VkBufferMemoryBarrier2> barriers(64);
                    auto count = static_cast<uint32_t>(barriers.size());
                    const SuppleGroup group = stage.crowd.group();
                    EXPECT_EQ(suppleGetAcquireBarriers(own.handle(), &group, 1, kAnyUse, barriers.data(), &count),
                              SUPPLE_OK);
                    barriers.resize(count);
                    EXPECT_EQ(std::ranges::count(barriers, poses.buffer, &VkBufferMemoryBarrier2::buffer), 1);
                }
            }
        }
    }
}

TEST_F(UpdateRates, AreRefusedWhereTheListOfPosesHasTooManyTexels) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    constexpr uint32_t kTexels = 4096, kMost = kTexels / runtime::PoseList::kWordsOfInstance;
    wrapped.maxTexelBufferElements = kTexels;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext own(*device, mapping);
        const SuppleAsset asset = own.createAsset(jumper());
        const auto created = [&](uint32_t capacity, uint32_t flags) {
            SuppleGroupDesc desc = playedGroup(asset, capacity, flags);
            desc.structSize = sizeof desc;
            SuppleGroup group{};
            const SuppleResult result = suppleCreateGroup(own.handle(), &desc, &group);
            if (result == SUPPLE_OK) {
                EXPECT_EQ(suppleDestroyGroup(own.handle(), group), SUPPLE_OK);
            }
            return result;
        };
        const bool narrow = mapping == SUPPLE_MAPPING_NARROW;
        EXPECT_EQ(created(kMost + 1, 0), SUPPLE_OK);
        EXPECT_EQ(created(kMost + 1, SUPPLE_GROUP_UPDATE_RATES), narrow ? SUPPLE_ERROR_LIMIT : SUPPLE_OK);
        if (narrow) {
            EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_LIMIT);
        }
        PlayedGroup stage(own, ratedGroup(asset, kMost));
        ASSERT_TRUE(stage.crowd.valid());
        for (uint32_t i = 0; i < kMost; ++i) {
            stage.play(i, 1, 0.01 * i, every(2)); // all ends in one frame
        }
        EXPECT_EQ(stage.run(0.3), 0u);
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
    wrapped.maxTexelBufferElements = 0;
}

TEST_F(UpdateRates, GoWithAllThatInstancesDo) {
    const ValidationGuard guard;
    for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
        CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
        constexpr uint32_t kFlags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS;
        PlayedGroup rated(own, ratedGroup(own.asset(kWren), 8, skinning, kFlags)),
            exact(own, playedGroup(own.asset(kWren), 8, kFlags, skinning));
        const auto both = [&](auto&& set) {
            set(rated);
            set(exact);
        };
        const auto desc = [&](const PlayedGroup& stage, uint32_t interval) {
            return every(&stage == &rated ? interval : 0);
        };
        both([&](PlayedGroup& stage) {
            for (uint32_t i = 0; i < 8; ++i) {
                stage.play(i, 1, 0.1 * i, desc(stage, kEvery[i % 4]));
            }
        });
        EXPECT_EQ(rated.run(0.501), 0u);
        EXPECT_EQ(exact.run(0.501), 0u);
        // Modifiers: posed in every frame.
        both([&](PlayedGroup& stage) {
            SuppleModifier turn{};
            turn.kind = SUPPLE_MODIFIER_ADD;
            turn.joint = 10;
            turn.weight = 1.0f;
            turn.rotation[1] = 0.6f;
            turn.rotation[3] = 0.8f;
            stage.modify(1, turn);
        });
        // A transition: the same, from the call to its end.
        both([&](PlayedGroup& stage) {
            SupplePlaybackDesc over = desc(stage, 8);
            over.transition = 0.2;
            stage.play(3, 2, 0.0, over);
        });
        for (const double time : {0.501, 0.52, 0.6, 0.69}) {
            EXPECT_EQ(rated.run(time), 0u);
            EXPECT_EQ(exact.run(time), 0u);
            for (const uint32_t i : {0u, 1u, 3u, 4u}) {
                EXPECT_TRUE(same(shownBy(rated, i), shownBy(exact, i))) << i << " at " << time;
            }
            EXPECT_FALSE(same(shownBy(rated, 2), shownBy(exact, 2)));
        }
        // Without them, between poses again; a mask, morph weights, a place: at once.
        rated.modify(1, std::span<const SuppleModifier>());
        EXPECT_EQ(rated.run(0.84), 0u);
        std::vector<float> half(rated.character().skin.joints.size(), 0.5f);
        SuppleMaskDesc mask{};
        mask.structSize = sizeof mask;
        mask.mask = 1;
        mask.jointMask = half.data();
        mask.jointMaskCount = static_cast<uint32_t>(half.size());
        EXPECT_EQ(suppleSetMask(rated.handle(), rated.crowd.group(), &mask), SUPPLE_OK);
        SupplePlaybackLayer layers[] = {PlayedGroup::loops(1, 0.1), PlayedGroup::loops(2, 0.0)};
        layers[1].mask = 1;
        rated.play(2, layers, every(4));
        EXPECT_EQ(rated.run(0.845), 0u);
        std::fill(half.begin(), half.end(), 1.0f);
        EXPECT_EQ(suppleSetMask(rated.handle(), rated.crowd.group(), &mask), SUPPLE_OK);
        EXPECT_EQ(rated.run(0.846), 0u);
        const std::vector<float> weights(rated.character().morphs.targets.size(), 0.25f);
        const auto count = static_cast<uint32_t>(weights.size());
        EXPECT_EQ(suppleSetMorphWeights(rated.handle(), rated.instances[2], weights.data(), count), SUPPLE_OK);
        rated.place(2, glm::scale(glm::translate(glm::mat4(1.0f), {3.0f, 0.0f, 1.0f}), glm::vec3(2.0f)));
        EXPECT_EQ(rated.run(0.847), 0u);
        EXPECT_EQ(suppleSetMorphWeights(rated.handle(), rated.instances[2], nullptr, 0), SUPPLE_OK);
        EXPECT_EQ(rated.run(0.848), 0u);
        // Hidden, and back; a frame that never runs; another capacity; back in time.
        rated.crowd.setVisible(rated.instances[5], false);
        EXPECT_EQ(suppleSetTime(rated.handle(), rated.crowd.group(), 1.1), SUPPLE_OK);
        own.run(rated.crowd.group());
        rated.crowd.setVisible(rated.instances[5], true);
        EXPECT_EQ(rated.run(1.35), 0u);
        EXPECT_EQ(suppleSetTime(rated.handle(), rated.crowd.group(), 1.7), SUPPLE_OK);
        own.cancel(rated.crowd.group());
        EXPECT_EQ(rated.run(1.705), 0u);
        EXPECT_EQ(suppleSetCapacity(rated.handle(), rated.crowd.group(), 11), SUPPLE_OK);
        EXPECT_EQ(rated.run(1.71), 0u);
        EXPECT_EQ(own.reloadAsset(own.asset(kWren), exact.character()), SUPPLE_OK);
        EXPECT_EQ(rated.run(1.72), 0u);
        EXPECT_EQ(rated.group().poses().playback()->updateIntervalOf(rated.instances[2].slot), 4u);
        EXPECT_EQ(rated.run(0.2), 0u);
    }
}

TEST_F(UpdateRates, SocketsStandWhereTheyAreShown) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    PlayedGroup stage(own, ratedGroup(own.asset(kPip), 2));
    for (uint32_t i = 0; i < 2; ++i) {
        stage.place(i, glm::translate(glm::mat4(1.0f), {1.0f, 2.0f, 3.0f}));
        stage.play(i, 1, 0.2, every(8));
    }
    EXPECT_EQ(stage.run(0.43), 0u);
    const std::vector<glm::vec4> pose = shownBy(stage, 1);
    for (uint32_t j = 0; j < stage.character().skin.joints.size(); ++j) {
        const glm::dmat4 shown = stage.jointOf(1, j) * glm::dmat4(stage.character().skin.inverseBinds[j]);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                EXPECT_NEAR(shown[column][row], pose[3 * j + static_cast<uint32_t>(row)][column], 2e-5) << j;
            }
        }
    }
}

TEST_F(UpdateRates, ComeOutAlikeInWindowsAndSharedDispatches) {
    const ValidationGuard guard;
    constexpr uint32_t kMany = 200;
    WrappedVulkan& wrapped = wrappedVulkan();
    for (const SuppleMapping mapping : kMappings) {
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        wrapped.maxStorageBufferRange = 1u << 20;
        {
            CrowdContext small(*device, mapping);
            PlayedGroup stage(small, ratedGroup(small.asset(kPip), kMany));
            ASSERT_TRUE(stage.crowd.valid());
            EXPECT_GT(stage.group().windows().count(), 1u);
            for (uint32_t i = 0; i < kMany; ++i) {
                stage.play(i, 1, 0.05 * i, every(kEvery[i % 4]));
            }
            for (const double time : {0.2, 0.22, 0.3, 0.9}) {
                EXPECT_EQ(stage.run(time), 0u);
            }
        }
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        wrapped.maxStorageBufferRange = 0;
    }
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    PlayedGroup first(shared, ratedGroup(shared.asset(kPip), 5)), second(shared, ratedGroup(shared.asset(kWren), 3));
    for (uint32_t i = 0; i < 5; ++i) {
        first.play(i, 1, 0.05 * i, every(kEvery[i % 4]));
        second.play(i % 3, 2, 0.05 * i, every(kEvery[(i + 1) % 4]));
    }
    for (const double time : {0.2, 0.22, 0.3, 0.9}) {
        EXPECT_EQ(suppleSetTime(shared.handle(), second.crowd.group(), time), SUPPLE_OK);
        const SuppleGroup both[] = {first.crowd.group(), second.crowd.group()};
        shared.run(both);
        EXPECT_EQ(first.run(time), 0u);
        EXPECT_EQ(second.run(time), 0u);
    }
}

/// One instance in a view, whose interval follows from its size on the screen.
class RatedInView {
public:
    RatedInView(CrowdContext& context, SuppleAsset asset, uint32_t viewFlags = 0)
        : view_(context, 300'000, viewFlags), stage(context, inView(asset, view_.handle())),
          extent(skinning::measureUpdates(stage.character()).extent) {
        const glm::mat4 seen = glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 1e6f) *
                               glm::lookAt(glm::vec3(0.0f), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0));
        std::memcpy(view_.camera.viewProjection, &seen, sizeof seen);
    }
    /// The interval once it has that many pixels and the group this time. `shape`: its transform but for the place.
    uint32_t intervalAt(double pixels, double time = 0.2, const glm::mat3& shape = glm::mat3(1.0f)) {
        constexpr double kAway = 1e5; // so far off that the box hardly counts
        const bool orthographic = (view_.camera.flags & SUPPLE_CAMERA_ORTHOGRAPHIC) != 0;
        view_.camera.pixelsPerUnit = static_cast<float>(pixels / extent * (orthographic ? 1.0 : kAway));
        glm::mat4 placed(shape);
        placed[3] = glm::vec4(0.0f, 0.0f, static_cast<float>(kAway), 1.0f);
        stage.place(0, placed);
        view_.look({0, 0, 0});
        EXPECT_EQ(suppleSetTime(stage.handle(), stage.crowd.group(), time), SUPPLE_OK);
        stage.crowd.context().run(stage.crowd.group());
        return interval();
    }
    [[nodiscard]] uint32_t interval() const {
        return stage.group().poses().playback()->updateIntervalOf(stage.instances[0].slot);
    }
    void makeOrthographic() { view_.camera.flags = SUPPLE_CAMERA_ORTHOGRAPHIC; }

private:
    static SuppleGroupDesc inView(SuppleAsset asset, SuppleView view) {
        SuppleGroupDesc desc = ratedGroup(asset, 1);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view;
        return desc;
    }

    TestView view_;

public:
    PlayedGroup stage;
    double extent = 0.0;
};

TEST_F(UpdateRates, OfWhoHasNoBoxAreThoseOfEveryFrame) {
    const ValidationGuard guard;
    for (const bool orthographic : {false, true}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
        RatedInView rated(own, own.asset(kPip));
        if (orthographic) {
            rated.makeOrthographic();
        }
        rated.stage.play(0, 1, 0.3);
        EXPECT_EQ(rated.intervalAt(0.5), 8u) << orthographic;
        SupplePlaybackLayer layers[] = {PlayedGroup::loops(1, 0.3), PlayedGroup::loops(0, 0.0)};
        layers[1].mode = SUPPLE_LAYER_ADDITIVE;
        rated.stage.play(0, layers);
        EXPECT_EQ(rated.intervalAt(0.5), 1u) << orthographic;
    }
}

TEST_F(UpdateRates, ByTheSizeAreNotShorterThanFramesAskFor) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    RatedInView rated(own, own.asset(kPip));
    const auto errors = skinning::measureUpdates(rated.stage.character()).ofClips[1].every;
    const auto settledAt = [&](double pixels, double step) {
        rated.stage.play(0, 1, 0.3);
        for (int frame = 0; frame < 3; ++frame) {
            rated.intervalAt(pixels, 0.2 + frame * step);
        }
        return rated.interval();
    };
    EXPECT_EQ(settledAt(0.5 / errors[2], 1.0 / 60), 8u);
    EXPECT_EQ(settledAt(0.6 / errors[1], 1.0 / 60), 4u);
    EXPECT_EQ(settledAt(0.6 / errors[0], 1.0 / 60), 2u);
    EXPECT_EQ(settledAt(0.5 / errors[2], 1.0 / 24), 8u);
    EXPECT_EQ(settledAt(0.6 / errors[1], 1.0 / 24), 1u);
    EXPECT_EQ(settledAt(0.6 / errors[0], 1.0 / 30), 1u);
    EXPECT_EQ(settledAt(0.5 / errors[2], 0.1), 1u);
}

TEST_F(UpdateRates, ByTheSizeStayWhereTheSameIsPlayedAnew) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    RatedInView rated(own, own.asset(kPip));
    const auto errors = skinning::measureUpdates(rated.stage.character()).ofClips[1].every;
    rated.stage.play(0, 1, 0.3);
    EXPECT_EQ(rated.intervalAt(1.05 / errors[2]), 4u);
    rated.stage.play(0, 1, 0.4);
    EXPECT_EQ(rated.interval(), 4u) << "as getters see it before the next recording";
    EXPECT_EQ(rated.intervalAt(0.75 / errors[2]), 4u) << "hysteresis";
}

TEST_F(UpdateRates, ByTheSizeCountHowLongShearsMakeIt) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    RatedInView rated(own, own.asset(kPip));
    const auto errors = skinning::measureUpdates(rated.stage.character()).ofClips[1].every;
    rated.stage.play(0, 1, 0.3);
    const glm::mat3 turned(glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
    EXPECT_EQ(rated.intervalAt(0.95 / errors[2], 0.2, turned), 8u) << "as large as it is";
    EXPECT_EQ(rated.intervalAt(0.32 / errors[2], 0.2, 3.0f * turned), 8u);
    // Columns of length 1 that nearly fall together: along their middle it is longer by the root of two.
    const glm::mat3 sheared(glm::vec3(1, 0, 0), glm::normalize(glm::vec3(1, 0.05f, 0)), glm::vec3(0, 0, 1));
    EXPECT_EQ(rated.intervalAt(0.69 / errors[2], 0.2, sheared), 8u);
    EXPECT_EQ(rated.intervalAt(0.73 / errors[2], 0.2, sheared), 4u);
}

/// Weights are all that the clip has.
TEST_F(UpdateRates, ByTheSizeCountMorphTargets) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 1});
    cage::Channel weights = channel(0, ChannelPath::weights, {0, 0.1f, 0.2f, 1.0f}, {0, 1, 0, 0});
    tube.clips.push_back(clipOf({std::move(weights)}));
    RatedInView rated(own, own.createAsset(tube));
    rated.stage.play(0, 0, 0.3);
    EXPECT_EQ(rated.intervalAt(0.1), 8u);
    EXPECT_EQ(rated.intervalAt(1000.0), 1u);
}

/// Instances at rising distances from a camera.
TEST_F(UpdateRates, FollowTheSizeOnTheScreen) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    for (const uint32_t viewFlags : {0u, uint32_t{SUPPLE_VIEW_CULL}}) {
        TestView view(own, 300'000, viewFlags);
        SuppleGroupDesc desc = ratedGroup(own.asset(kPip), 6);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        PlayedGroup stage(own, desc);
        ASSERT_TRUE(stage.crowd.valid());
        const skinning::UpdateFacts facts = skinning::measureUpdates(stage.character());
        runtime::Playback& playback = *stage.group().poses().playback();
        // The last one asks for an interval itself.
        for (uint32_t i = 0; i < 6; ++i) {
            stage.play(i, 1, 0.3, every(i == 5 ? 2 : 0));
        }
        const glm::mat4 seen = glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 1e6f) *
                               glm::lookAt(glm::vec3(0.0f), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0));
        std::memcpy(view.camera.viewProjection, &seen, sizeof seen);
        const auto errors = facts.ofClips[1].every;
        const auto intervalAt = [&](double pixels) { // of all
            view.camera.pixelsPerUnit = 1e4f;        // so far off that the box hardly counts
            const auto away = static_cast<float>(1e4 * facts.extent / pixels);
            for (uint32_t i = 0; i < 6; ++i) {
                stage.place(i, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, away}));
            }
            view.look({0, 0, 0});
            EXPECT_EQ(suppleSetTime(own.handle(), stage.crowd.group(), 0.2), SUPPLE_OK);
            own.run(stage.crowd.group());
            EXPECT_EQ(playback.updateIntervalOf(stage.instances[5].slot), 2u);
            for (uint32_t i = 1; i < 5; ++i) {
                EXPECT_EQ(playback.updateIntervalOf(stage.instances[i].slot),
                          playback.updateIntervalOf(stage.instances[0].slot));
            }
            return playback.updateIntervalOf(stage.instances[0].slot);
        };
        EXPECT_EQ(intervalAt(0.5 / errors[2]), 8u);
        EXPECT_EQ(intervalAt(1.05 / errors[2]), 4u);
        EXPECT_EQ(intervalAt(0.75 / errors[2]), 4u) << "hysteresis";
        EXPECT_EQ(intervalAt(0.6 / errors[2]), 8u);
        EXPECT_EQ(intervalAt(1.05 / errors[0]), 1u);
        EXPECT_EQ(intervalAt(0.6 / errors[0]), 2u);
        // Other groups draw the instances, wherever from.
        SuppleGroupDesc follower{};
        follower.asset = desc.asset;
        follower.scheme = SUPPLE_SCHEME_PM;
        follower.rate = 2;
        follower.instancesOf = stage.crowd.group();
        Crowd elsewhere(own, follower);
        ASSERT_TRUE(elsewhere.valid());
        EXPECT_EQ(intervalAt(0.5 / errors[2]), 1u);
    }
}

} // namespace
} // namespace supple::test
