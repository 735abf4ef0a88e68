// Boxes of clips hold the cage at every time, between keys too, and are not much larger than they must be.
#include "skinning/clip_bounds.h"

#include "cage/gltf/reader.h"
#include "skinning/centers.h"
#include "skinning/chord.h"
#include "skinning/delta_mush.h"
#include "skinning/pose.h"
#include "tests/support/boxes.h"
#include "tests/support/centers_reference.h"
#include "tests/support/dual_quaternion_reference.h"
#include "tests/support/mush_reference.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using cage::Character;
using cage::Clip;
using cage::Interpolation;
using test::boxAround;
using test::diagonal;
using test::holds;

/// A way of skinning, of a character.
struct Skinned {
    SkinningMode mode = SkinningMode::linear;
    Centers centers;
    DeltaMush mush;

    Skinned(const Character& character, SkinningMode own) : mode(own) {
        centers = skinningRow(own).extra == SkinExtra::centers ? findCenters(character) : Centers();
        if (skinningRow(own).extra == SkinExtra::mush) {
            Result<DeltaMush> found = findDeltaMush(character);
            EXPECT_TRUE(found.ok()) << found.error().message;
            mush = std::move(*found);
        }
    }
    [[nodiscard]] ClipBoundsDesc bounds(double tolerance = ClipBoundsDesc{}.tolerance) const {
        return {{mode, &centers, &mush}, 0.0, tolerance};
    }
};
constexpr SkinningMode kModes[] = {SkinningMode::linear, SkinningMode::dualQuaternion, SkinningMode::centersOfRotation,
                                   SkinningMode::deltaMush, SkinningMode::deltaMushLight};

std::vector<glm::dvec3> posed(const Character& character, const Pose& pose, const Skinned& skinned) {
    if (skinned.mode == SkinningMode::linear) {
        return deformOnCpu(character, pose);
    }
    std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
    std::vector<Affine> palette(character.skin.joints.size());
    posePalette(character, pose, nodes, palette);
    const std::vector<float> weights(pose.morphWeights.begin(), pose.morphWeights.end());
    const std::vector<glm::dvec3> morphed = morphOnCpu(character.cage, character.morphs, weights);
    if (skinned.mode == SkinningMode::dualQuaternion) {
        return test::skinWithDualQuaternions(morphed, character.weights, palette);
    }
    if (skinned.mode == SkinningMode::centersOfRotation) {
        return test::skinAboutCenters(morphed, test::centersOf(skinned.centers), character.weights, palette);
    }
    return test::skinByMush(morphed, test::mushOf(skinned.mush), palette, skinned.mode == SkinningMode::deltaMushLight);
}

/// The box of what the clip shows at `count` times and at its keys.
Box sampledBox(const Character& character, const Clip& clip, size_t count, const Skinned& skinned) {
    std::vector<double> times;
    for (size_t k = 0; k <= count; ++k) {
        times.push_back(clip.duration * static_cast<double>(k) / static_cast<double>(count));
    }
    for (const cage::Channel& channel : clip.channels) {
        const size_t step = std::max<size_t>(channel.times.size() / 16, 1);
        for (size_t k = 0; k < channel.times.size(); k += step) {
            times.push_back(static_cast<double>(channel.times[k]));
        }
        times.push_back(static_cast<double>(channel.times.back()));
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    Box box;
    Pose pose;
    for (size_t k = 0; k < times.size(); ++k) {
        sampleClip(character, clip, times[k], pose);
        const Box own = boxAround(posed(character, pose, skinned));
        box = k == 0 ? own : Box{glm::min(box.low, own.low), glm::max(box.high, own.high)};
    }
    return box;
}

/// Checks the box of a clip against samples; the ratio of the diagonals.
double checkedRatio(const Character& character, const Clip& clip, size_t samples, const Skinned& skinned) {
    const Box bound = clipBounds(character, &clip, skinned.bounds());
    const Box seen = sampledBox(character, clip, samples, skinned);
    EXPECT_TRUE(holds(bound, seen)) << character.name << ", " << clip.name;
    return diagonal(bound) / diagonal(seen);
}

TEST(ClipBounds, HoldEveryCharactersClips) {
    struct Worst {
        double ratio = 0.0, sum = 0.0;
        std::string of;
        size_t count = 0;
    } worst[std::size(kModes)];
    double slowest = 0.0;
    std::string slowestOf;
    for (const std::string& path : test::allCharacters()) {
        const Result<Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const size_t vertices = character->cage.positions.size();
        const size_t clips = character->clips.size(), step = std::max<size_t>(clips / 6, 1);
        for (size_t c = 0; c < clips; c += step) {
            const Clip& clip = character->clips[c];
            const auto start = std::chrono::steady_clock::now();
            (void)clipBounds(*character, &clip, {});
            const double ms =
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
            if (ms > slowest) {
                slowest = ms;
                slowestOf = path + ", " + clip.name + ", " + std::to_string(vertices) + " vertices, " +
                            std::to_string(clip.duration) + " s";
            }
            const size_t samples = std::clamp<size_t>(3'000'000 / vertices, 20, 700);
            for (const SkinningMode mode : kModes) {
                const bool linear = mode == SkinningMode::linear;
                if (!linear && (vertices > 3000 || c > 0)) {
                    continue; // the references are slow
                }
                const double ratio = checkedRatio(*character, clip, linear ? samples : 20, Skinned(*character, mode));
                Worst& most = worst[static_cast<size_t>(mode)];
                most.sum += ratio;
                ++most.count;
                if (ratio > most.ratio) {
                    most.ratio = ratio;
                    most.of = path + ", " + clip.name;
                }
            }
        }
    }
    for (const SkinningMode mode : kModes) {
        const Worst& most = worst[static_cast<size_t>(mode)];
        std::printf("%s: %zu clips, diagonals are %.4f of the sampled ones on average, at most %.4f (%s)\n",
                    cage::skinningModeName(mode), most.count, most.sum / static_cast<double>(most.count), most.ratio,
                    most.of.c_str());
    }
    std::printf("slowest: %.1f ms (%s)\n", slowest, slowestOf.c_str());
    EXPECT_GT(worst[0].count, 3u);
    EXPECT_LT(worst[0].ratio, 1.3);
}

/// Clips with everything that glTF allows, at random: few keys far apart, turns of nearly half a circle, splines with
/// large tangents, steps, scales, morph targets.
TEST(ClipBounds, HoldRandomClips) {
    double worst = 0.0, sum = 0.0;
    constexpr uint32_t kRuns = 48;
    for (uint32_t run = 0; run < kRuns; ++run) {
        SCOPED_TRACE(run);
        test::Noise noise(run);
        Character tube = test::riggedTube({.segments = 6,
                                           .sides = 6,
                                           .joints = 3,
                                           .origin = {0.0f, run % 4 == 0 ? 20.0f : 0.0f, 0.0f},
                                           .morphTargets = run % 3 == 0 ? 3u : 0u});
        Clip clip;
        clip.name = "random";
        const auto add = [&](uint32_t node, ChannelPath path, size_t width, bool positive) {
            cage::Channel channel;
            channel.node = node;
            channel.path = path;
            const float kind = noise();
            channel.interpolation = kind < -0.4f  ? Interpolation::step
                                    : kind < 0.3f ? Interpolation::linear
                                                  : Interpolation::cubicSpline;
            const size_t keys = 2 + (run + node) % 3;
            for (size_t k = 0; k < keys; ++k) {
                channel.times.push_back(static_cast<float>(k) * 0.7f + 0.1f * noise());
            }
            channel.times[0] = std::max(channel.times[0], 0.0f);
            const bool cubic = channel.interpolation == Interpolation::cubicSpline;
            for (size_t row = 0; row < keys * (cubic ? 3 : 1); ++row) {
                const bool tangent = cubic && row % 3 != 1;
                glm::vec4 q(noise(), noise(), noise(), noise());
                q = path == ChannelPath::rotation && !tangent ? glm::normalize(q + glm::vec4(0.0f, 0.0f, 0.0f, 0.3f))
                                                              : q;
                for (size_t c = 0; c < width; ++c) {
                    const float value = width == 4 ? q[static_cast<int>(c)] : noise();
                    channel.values.push_back(tangent ? 3.0f * value : positive ? 1.5f + value : value);
                }
            }
            clip.duration = std::max(clip.duration, static_cast<double>(channel.times.back()));
            clip.channels.push_back(std::move(channel));
        };
        for (const uint32_t node : {1u, 2u, 3u}) {
            add(node, ChannelPath::rotation, 4, false);
        }
        add(1, ChannelPath::translation, 3, false);
        add(2, ChannelPath::translation, 3, false);
        if (run % 2 == 0) {
            add(2, ChannelPath::scale, 3, true);
        }
        if (run % 3 == 0) {
            add(tube.parts[0].node, ChannelPath::weights, 3, false);
        }
        for (const SkinningMode mode : kModes) {
            const Skinned skinned(tube, mode);
            const Box seen = sampledBox(tube, clip, 1500, skinned);
            // Whole segments show that errors are what they say; the usual tolerance, how large boxes are.
            for (const double tolerance : {1e9, 0.2, ClipBoundsDesc{}.tolerance}) {
                const Box bound = clipBounds(tube, &clip, skinned.bounds(tolerance));
                EXPECT_TRUE(holds(bound, seen)) << tolerance;
                if (mode == SkinningMode::linear && tolerance == ClipBoundsDesc{}.tolerance) {
                    worst = std::max(worst, diagonal(bound) / diagonal(seen));
                    sum += diagonal(bound) / diagonal(seen);
                }
            }
        }
    }
    std::printf("random clips: diagonals are %.4f of the sampled ones on average, at most %.4f\n", sum / kRuns, worst);
    EXPECT_LT(worst, 1.1);
}

TEST(ClipBounds, HoldTheWholeArcOfATurn) {
    Character tube = test::riggedTube({.segments = 4, .sides = 6, .joints = 1});
    const glm::quat turned = glm::angleAxis(3.1f, glm::vec3(0.0f, 0.0f, 1.0f));
    Clip clip = test::clipOf(
        {test::channel(1, ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, turned.x, turned.y, turned.z, turned.w})});
    const Box box = clipBounds(tube, &clip, {});
    EXPECT_GT(box.high.y, 8.0) << "the tip is at the top half-way, where no key is";
    EXPECT_LT(box.high.y, 8.3);
}

TEST(ClipBounds, AStepShowsBothOfItsValues) {
    Character tube = test::riggedTube({.segments = 4, .sides = 6, .joints = 1});
    Clip clip = test::clipOf(
        {test::channel(1, ChannelPath::translation, {0, 1, 2}, {0, 0, 0, 0, 5, 0, 0, -9, 0}, Interpolation::step)});
    const Box box = clipBounds(tube, &clip, {});
    EXPECT_NEAR(box.high.y, 6.0, 0.01);
    EXPECT_NEAR(box.low.y, -10.0, 0.01) << "the last key is shown at the clip's end alone";
}

TEST(ClipBounds, RestBindAndMargin) {
    Character tube = test::riggedTube({.segments = 4, .sides = 6, .joints = 2});
    tube.skeleton.nodes[1].translation += glm::vec3(0.0f, 0.0f, 100.0f);
    const Box bind = bindBounds(tube, {}), rest = clipBounds(tube, nullptr, {});
    EXPECT_EQ(bind.high.x, 8.0);
    EXPECT_NEAR(rest.low.z, bind.low.z + 100.0, 1e-3);
    const Box larger = bindBounds(tube, {.margin = 0.25});
    EXPECT_DOUBLE_EQ(larger.high.x, 10.0);
    EXPECT_DOUBLE_EQ(larger.low.x, -2.0);
    const Box restLarger = clipBounds(tube, nullptr, {.margin = 0.25});
    EXPECT_NEAR(restLarger.high.x, 10.0, 1e-2);
}

TEST(ClipBounds, WhatLeavesTheDoublesIsEverything) {
    Character tube = test::riggedTube({.segments = 4, .sides = 6, .joints = 3});
    for (const uint32_t node : {1u, 2u, 3u}) {
        tube.skeleton.nodes[node].scale = glm::vec3(3e38f);
    }
    const Box box = clipBounds(tube, nullptr, {});
    EXPECT_GE(box.high.x, double{std::numeric_limits<float>::max()});
    EXPECT_FALSE(std::isnan(box.low.x));
}

} // namespace
} // namespace supple::skinning
