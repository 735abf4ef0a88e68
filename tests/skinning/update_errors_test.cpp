// How far off it is to be posed every few steps: of movements that are known, and against the oracle's figures.
#include "skinning/update_errors.h"

#include "shaders/shared/pose.h"
#include "skinning/pose_distance.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::ChannelPath;

/// The root goes along x as `place` says, with a key at every step of the grid.
template <class Place>
cage::Character going(double seconds, Place&& place) {
    cage::Character tube = test::riggedTube({.segments = 6, .sides = 6, .joints = 3});
    std::vector<float> times, values;
    for (int k = 0; k <= static_cast<int>(std::lround(seconds * shared::kUpdateSteps)); ++k) {
        times.push_back(static_cast<float>(k) / shared::kUpdateSteps);
        values.insert(values.end(), {static_cast<float>(place(static_cast<double>(times.back()))), 0.0f, 0.0f});
    }
    tube.clips.push_back(test::clipOf({test::channel(1, ChannelPath::translation, times, values)}));
    return tube;
}

TEST(UpdateErrors, OfAConstantAccelerationGrowWithTheSquareOfTheInterval) {
    const cage::Character tube = going(1.0, [](double t) { return 8.0 * t - 4.0 * t * t; }); // at rest at its end
    const UpdateFacts facts = measureUpdates(tube);
    EXPECT_EQ(facts.extent, PoseDistance(tube).extent());
    const UpdateErrors& errors = facts.ofClips.back();
    EXPECT_FALSE(errors.closes);
    for (size_t n = 0; n < 3; ++n) {
        const double half = static_cast<double>(size_t{1} << n) / shared::kUpdateSteps;
        EXPECT_NEAR(errors.every[n] * facts.extent, 4.0 * half * half, 1e-5) << n;
    }
}

TEST(UpdateErrors, StraightMovementsHaveNone) {
    const UpdateErrors errors = measureUpdates(going(2.0, [](double t) { return t; })).ofClips.back();
    for (const double error : errors.every) { // at their ends, they are posed exactly
        EXPECT_NEAR(error, 0.0, 1e-6);
    }
    const UpdateErrors brief = measureUpdates(going(0.1, [](double t) { return t; })).ofClips.back();
    EXPECT_NEAR(brief.every[1], 0.0, 1e-6);
    EXPECT_EQ(brief.every[2], UpdateErrors::kUnknown);
    const UpdateErrors still = measureUpdates(going(0.1, [](double) { return 1.0; })).ofClips.back();
    EXPECT_TRUE(still.closes);
    EXPECT_EQ(still.every[2], 0.0);
}

TEST(UpdateErrors, MorphTargetsCount) {
    cage::Character tube = test::riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 1});
    tube.clips.push_back(test::clipOf({test::channel(0, ChannelPath::weights, {0, 0.5f, 1}, {0, 1, 0})}));
    tube.clips.push_back(test::clipOf({test::channel(0, ChannelPath::weights, {0, 1}, {0, 1})}));
    const PoseDistance distance(tube);
    const UpdateFacts facts = measureUpdates(tube);
    EXPECT_GT(distance.targetReaches()[0], 0.0);
    EXPECT_TRUE(facts.ofClips[0].closes);
    EXPECT_FALSE(facts.ofClips[1].closes) << "it jumps back";
    for (size_t n = 0; n < 3; ++n) {
        // At a turn of 4 a second, in the middle of an interval: half of it on either side.
        const double half = static_cast<double>(size_t{1} << n) / shared::kUpdateSteps;
        EXPECT_NEAR(facts.ofClips[0].every[n] * facts.extent, 2.0 * half * distance.targetReaches()[0], 1e-6) << n;
        EXPECT_NEAR(facts.ofClips[1].every[n], 0.0, 1e-6);
    }
}

TEST(UpdateErrors, ClipsMayCloseWithoutTheRoot) {
    const UpdateFacts facts = measureUpdates(going(1.0, [](double t) { return t + 0.1 * t * t; }));
    const auto clip = static_cast<uint32_t>(facts.ofClips.size()) - 1;
    EXPECT_FALSE(facts.ofClips[clip].closes);
    EXPECT_EQ(facts.root, 1u);
    EXPECT_FALSE(facts.closes(clip, {}));
    EXPECT_TRUE(facts.closes(clip, {1, kRootGround}));
    EXPECT_TRUE(facts.closes(clip, {1, kRootGround | kRootYaw}));
    EXPECT_FALSE(facts.closes(clip, {1, kRootHeight | kRootYaw})) << "it goes along x";
    EXPECT_FALSE(facts.closes(clip, {2, kRootGround}));
}

TEST(UpdateErrors, ClipsThatCloseAreLooped) {
    const auto wave = [](double t) { return 0.2 * std::cos(6.283185307179586 * t); };
    EXPECT_TRUE(measureUpdates(going(1.0, wave)).ofClips.back().closes);
    EXPECT_FALSE(measureUpdates(going(1.2, wave)).ofClips.back().closes);
    // Over the seam of a loop it turns back at once; the end of the clip alone would be a corner half as sharp.
    const UpdateErrors errors = measureUpdates(going(1.0, [](double t) { return std::abs(t - 0.5); })).ofClips.back();
    const double extent = PoseDistance(going(1.0, wave)).extent();
    EXPECT_TRUE(errors.closes);
    EXPECT_NEAR(errors.every[2] * extent, 4.0 / shared::kUpdateSteps, 1e-5);
}

TEST(UpdateErrors, OfSpeedsAreThoseOfTheNextInterval) {
    const UpdateErrors errors{{1.0, 2.0, 3.0}, true};
    EXPECT_EQ(errors.at(0.5), 1.0);
    EXPECT_EQ(errors.at(2.0), 1.0);
    EXPECT_EQ(errors.at(2.5), 2.0);
    EXPECT_EQ(errors.at(8.0), 3.0);
    EXPECT_EQ(errors.at(8.5), UpdateErrors::kUnknown);
}

TEST(UpdateErrors, OfVeryLongClipsAreNotKnown) {
    cage::Character tube = going(1.0, [](double t) { return t; });
    tube.clips.back().duration = 301.0;
    const UpdateErrors errors = measureUpdates(tube).ofClips.back();
    EXPECT_EQ(errors.every[0], UpdateErrors::kUnknown);
    EXPECT_FALSE(errors.closes);
}

TEST(UpdateErrors, AreThoseOfTheOracle) {
    // Largest of all clips: animation_oracle.py, part D, which looks at fewer vertices and at no morph targets.
    std::vector<double> largest(3, 0.0);
    for (const std::string& file : {test::kPip, test::kWren}) {
        cage::Character character = test::readCharacter(file);
        for (cage::Clip& clip : character.clips) {
            std::erase_if(clip.channels, [](const auto& channel) { return channel.path == ChannelPath::weights; });
        }
        for (const UpdateErrors& errors : measureUpdates(character).ofClips) {
            for (size_t n = 0; n < 3; ++n) {
                largest[n] = std::max(largest[n], errors.every[n]);
            }
        }
    }
    EXPECT_NEAR(largest[0], 0.0668, 2e-3);
    EXPECT_NEAR(largest[1], 0.1682, 2e-3);
    EXPECT_NEAR(largest[2], 0.3526, 2e-3);
}

} // namespace
} // namespace supple::skinning
