// What is known of cages before they are posed holds them in every pose that layers make.
#include "skinning/reach.h"

#include "cage/gltf/reader.h"
#include "skinning/centers.h"
#include "skinning/delta_mush.h"
#include "skinning/played_pose.h"
#include "skinning/skinned_bounds.h"
#include "tests/support/boxes.h"
#include "tests/support/centers_reference.h"
#include "tests/support/dual_quaternion_reference.h"
#include "tests/support/meshes.h"
#include "tests/support/mush_reference.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using cage::Character;
using test::boxAround;
using test::diagonal;
using test::holds;

/// A pose of one to three layers at random times and weights, with masks that let some joints through.
void mixedPose(const Character& character, const Rig& rig, test::Noise& noise, PoseMemory& memory) {
    const auto share = [&] { return 0.5 + 0.5 * static_cast<double>(noise()); };
    restPose(character, memory.pose);
    std::vector<float> mask(character.skin.joints.size());
    const int layers = 1 + static_cast<int>(share() * 2.999);
    for (int i = 0; i < layers && !character.clips.empty(); ++i) {
        Layer layer;
        layer.clip =
            &character.clips[static_cast<size_t>(share() * 0.999 * static_cast<double>(character.clips.size()))];
        layer.time = share() * layer.clip->duration;
        layer.weight = i == 0 ? 1.0 : share();
        if (noise() > 0.5f) {
            std::ranges::generate(mask, [&] { return static_cast<float>(share()); });
            layer.jointMask = mask;
        }
        applyLayer(character, rig, layer, {}, memory.scratch, memory.pose);
    }
}

TEST(Reach, HoldsEveryMixOfClips) {
    double ratios = 0.0, slowest = 0.0;
    size_t poses = 0, characters = 0, anchored = 0;
    for (const std::string& path : test::allCharacters()) {
        const Result<Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const auto start = std::chrono::steady_clock::now();
        const Reach reach = reachOf(*character);
        slowest = std::max(slowest,
                           std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        const Rig rig = makeRig(*character);
        const bool small = character->cage.positions.size() < 1500; // references of other skinnings are slow
        const Centers centers = small ? findCenters(*character) : Centers();
        const SkinnedBounds about({SkinningMode::centersOfRotation, &centers, nullptr});
        test::Noise noise(static_cast<uint32_t>(characters));
        PoseMemory memory(*character);
        std::vector<Affine> palette(character->skin.joints.size());
        const size_t count = std::clamp<size_t>(40'000 / character->cage.positions.size(), 3, 12);
        Box seen = boxAround(deformOnCpu(*character, memory.pose));
        for (size_t k = 0; k < count; ++k) {
            mixedPose(*character, rig, noise, memory);
            const Box own = boxAround(deformOnCpu(*character, memory.pose));
            ASSERT_TRUE(holds(reach.blended, own)) << path;
            seen = {glm::min(seen.low, own.low), glm::max(seen.high, own.high)};
            posePalette(*character, memory.pose, memory.nodes, palette);
            const std::vector<float> weights(memory.pose.morphWeights.begin(), memory.pose.morphWeights.end());
            ASSERT_TRUE(holds(paletteBounds(reach, palette, weights), own)) << path;
            if (k == 0 && small) {
                const std::vector<glm::dvec3> morphed = morphOnCpu(character->cage, character->morphs, weights);
                const Box turned = boxAround(test::skinWithDualQuaternions(morphed, character->weights, palette));
                const Box centered =
                    boxAround(test::skinAboutCenters(morphed, test::centersOf(centers), character->weights, palette));
                ASSERT_TRUE(holds(about.reached(reach, reach.blended), centered)) << path;
                ASSERT_TRUE(holds(about.posed(reach, palette, weights), centered));
                ASSERT_TRUE(holds(dualQuaternionBounds(reach, reach.blended), turned)) << path;
                ASSERT_TRUE(holds(dualQuaternionBounds(reach, paletteBounds(reach, palette, weights)), turned));
            }
            ++poses;
        }
        ratios += diagonal(reach.blended) / diagonal(seen);
        anchored += reach.anchor != cage::kNone ? 1 : 0;
        ++characters;
    }
    std::printf("%zu characters (%zu with one anchor), %zu poses; boxes have %.2f times the diagonals of what was "
                "seen; the slowest took %.2f ms\n",
                characters, anchored, poses, ratios / static_cast<double>(characters), slowest);
    EXPECT_GT(anchored, 0u);
}

/// A root that walks, turns and is moved by splines; limbs that move, scale and are morphed.
Character walker(uint32_t seed) {
    Character tube =
        test::riggedTube({.segments = 6, .sides = 5, .joints = 3, .origin = {0.0f, 2.0f, 0.0f}, .morphTargets = 2});
    test::Noise noise(seed);
    const auto numbers = [&](size_t count, float size) {
        std::vector<float> values(count);
        std::ranges::generate(values, [&] { return size * noise(); });
        return values;
    };
    for (int clip = 0; clip < 3; ++clip) {
        const bool spline = clip == 1;
        const auto kind = spline ? cage::Interpolation::cubicSpline : cage::Interpolation::linear;
        std::vector<cage::Channel> channels{
            test::channel(1, ChannelPath::translation, {0, 1, 2}, numbers(spline ? 27 : 9, 4.0f), kind),
            test::channel(2, ChannelPath::translation, {0, 1, 2}, numbers(spline ? 27 : 9, 1.0f), kind),
            test::channel(2, ChannelPath::scale, {0, 1, 2}, numbers(spline ? 27 : 9, 1.5f), kind),
            test::channel(tube.parts[0].node, ChannelPath::weights, {0, 1}, numbers(spline ? 12 : 4, 2.0f), kind)};
        for (const uint32_t node : {1u, 2u, 3u}) {
            std::vector<float> turns;
            for (int k = 0; k < 3; ++k) {
                const glm::vec4 q = glm::normalize(glm::vec4(noise(), noise(), noise(), 1.2f * noise()));
                turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
            }
            channels.push_back(test::channel(node, ChannelPath::rotation, {0, 1, 2}, turns));
        }
        tube.clips.push_back(test::clipOf(std::move(channels)));
    }
    return tube;
}

TEST(Reach, HoldsWhatRandomClipsMix) {
    double ratios = 0.0;
    constexpr uint32_t kRuns = 40;
    for (uint32_t run = 0; run < kRuns; ++run) {
        SCOPED_TRACE(run);
        const Character tube = walker(run);
        const Reach reach = reachOf(tube);
        EXPECT_EQ(reach.anchor, 1u);
        const Rig rig = makeRig(tube);
        const Centers centers = findCenters(tube);
        const SkinnedBounds about({SkinningMode::centersOfRotation, &centers, nullptr});
        const Result<DeltaMush> mush = findDeltaMush(tube);
        ASSERT_TRUE(mush.ok()) << mush.error().message;
        const SkinnedBounds mushed({SkinningMode::deltaMush, nullptr, &*mush});
        test::Noise noise(run);
        PoseMemory memory(tube);
        std::vector<Affine> palette(tube.skin.joints.size());
        Box seen{glm::dvec3(0.0), glm::dvec3(0.0)};
        for (int k = 0; k < 60; ++k) {
            mixedPose(tube, rig, noise, memory);
            const Box own = boxAround(deformOnCpu(tube, memory.pose));
            ASSERT_TRUE(holds(reach.blended, own));
            seen = {glm::min(seen.low, own.low), glm::max(seen.high, own.high)};
            posePalette(tube, memory.pose, memory.nodes, palette);
            const std::vector<float> weights(memory.pose.morphWeights.begin(), memory.pose.morphWeights.end());
            ASSERT_TRUE(holds(paletteBounds(reach, palette, weights), own));
            const Box centered = boxAround(test::skinAboutCenters(morphOnCpu(tube.cage, tube.morphs, weights),
                                                                  test::centersOf(centers), tube.weights, palette));
            ASSERT_TRUE(holds(about.reached(reach, reach.blended), centered));
            ASSERT_TRUE(holds(about.posed(reach, palette, weights), centered));
            const Box smoothed = boxAround(test::skinByMush(morphOnCpu(tube.cage, tube.morphs, weights),
                                                            test::mushOf(*mush), palette, k % 2 == 0));
            ASSERT_TRUE(holds(mushed.reached(reach, reach.blended), smoothed));
            ASSERT_TRUE(holds(mushed.posed(reach, palette, weights), smoothed));
        }
        ratios += diagonal(reach.blended) / diagonal(seen);
    }
    std::printf("random clips: boxes have %.2f times the diagonals of what was seen\n", ratios / kRuns);
    EXPECT_LT(ratios / kRuns, 6.0);
}

TEST(Reach, AnAnchorIsWhatMovesFirst) {
    Character tube = test::riggedTube({.segments = 4, .sides = 4, .joints = 3});
    EXPECT_EQ(reachOf(tube).anchor, cage::kNone) << "nothing moves";
    const Box rest = boxAround(deformOnCpu(tube, PoseMemory(tube).pose));
    EXPECT_NEAR(diagonal(reachOf(tube).blended), diagonal(rest), 1e-2 * diagonal(rest)) << "so that it is exact";
    const glm::vec3 still = tube.skeleton.nodes[1].translation;
    tube.clips.push_back(test::clipOf(
        {test::channel(1, ChannelPath::translation, {0, 1}, {still.x, still.y, still.z, still.x, still.y, still.z}),
         test::channel(2, ChannelPath::translation, {0, 1}, {1, 0, 0, 1, 3, 0})}));
    EXPECT_EQ(reachOf(tube).anchor, cage::kNone) << "the first joint's vertices stand still, the others hang on node 2";
    tube.clips[0].channels[0].values[0] += 1.0f;
    EXPECT_EQ(reachOf(tube).anchor, 1u);
    EXPECT_EQ(reachOf(tube).anchorPath, glm::dvec3(1, 0, 0));
}

} // namespace
} // namespace supple::skinning
