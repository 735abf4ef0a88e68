// Centers of rotation, and what they make of limbs: a tube whose answer is known, and rigs beside the other skinnings.
#include "skinning/centers.h"

#include "cage/gltf/reader.h"
#include "skinning/played_pose.h"
#include "skinning/skinned_bounds.h"
#include "tests/support/bend.h"
#include "tests/support/boxes.h"
#include "tests/support/centers_reference.h"
#include "tests/support/dual_quaternion_reference.h"
#include "tests/support/limb_tube.h"
#include "tests/support/meshes.h"
#include "tests/support/rig_bends.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::Character;

double millisecondsOf(const Character& character, Centers& centers) {
    const auto start = std::chrono::steady_clock::now();
    centers = findCenters(character);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// How far points are apart at most, and at 99 % of them.
struct Apart {
    double most = 0.0, usual = 0.0;
};
Apart apartOf(std::vector<double> distances, double extent) {
    std::sort(distances.begin(), distances.end());
    return {distances.back() / extent, distances[distances.size() * 99 / 100] / extent};
}

/// All joints turned at random.
std::vector<Affine> noisyPalette(const Character& character, uint32_t seed) {
    PoseMemory memory(character);
    test::Noise noise(seed);
    for (const uint32_t joint : character.skin.joints) {
        const glm::dquat turn(glm::quat(1.0f, 0.4f * noise(), 0.4f * noise(), 0.4f * noise()));
        memory.pose.locals[joint].rotation = memory.pose.locals[joint].rotation * glm::normalize(turn);
    }
    std::vector<Affine> palette(character.skin.joints.size());
    posePalette(character, memory.pose, memory.nodes, palette);
    return palette;
}

/// Triangle by triangle, and with those of like weights taken together: cages are a few times nearer to each other than
/// to those of triangles cut once more, which are 4e-5 to 1e-3 of the extent away.
TEST(Centers, AgreeWithTheFormula) {
    for (const std::string& path : test::sharedAssets(
             {"characters/mh_female1605.glb", "characters/man_casual_quads.glb", "characters/horse.glb"})) {
        const Result<Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        Centers found;
        const double milliseconds = millisecondsOf(*character, found);
        const auto own = test::centersOf(found), wanted = test::centersOneByOne(*character, 1);
        const std::vector<glm::dvec3> rest = test::doublePositions(character->cage);
        const std::vector<Affine> palette = noisyPalette(*character, 7);
        const auto here = test::skinAboutCenters(rest, own, character->weights, palette);
        const auto there = test::skinAboutCenters(rest, wanted, character->weights, palette);
        std::vector<double> centers, vertices;
        for (size_t v = 0; v < rest.size(); ++v) {
            ASSERT_EQ(own[v].has_value(), wanted[v].has_value()) << v;
            centers.push_back(own[v] ? glm::distance(*own[v], *wanted[v]) : 0.0);
            vertices.push_back(glm::distance(here[v], there[v]));
        }
        const double size = test::extent(rest);
        const Apart ofCenters = apartOf(centers, size), ofVertices = apartOf(vertices, size);
        std::printf(
            "%-24s %5zu vertices, %6.1f ms: centers at most %.1e of the extent off (99 %%: %.1e), vertices %.1e "
            "(%.1e)\n",
            std::filesystem::path(path).filename().c_str(), rest.size(), milliseconds, ofCenters.most, ofCenters.usual,
            ofVertices.most, ofVertices.usual);
        EXPECT_LT(ofCenters.usual, 2e-3);
        EXPECT_LT(ofVertices.usual, 1e-4);
    }
}

TEST(Centers, KeepTheVolumeOfATube) {
    const Character tube = test::limbTube();
    const auto centers = test::centersOf(findCenters(tube));
    const std::vector<glm::dvec3> rest = test::doublePositions(tube.cage);
    struct Case {
        const char* name;
        glm::vec3 axis;
        float degrees;
        double linear, dual, centers; ///< per cent
    };
    for (const Case& c :
         {Case{"bend 60", {1, 0, 0}, 60, 98.3, 99.9, 99.8}, Case{"bend 120", {1, 0, 0}, 120, 94.8, 99.5, 99.0},
          Case{"twist 90", {0, 0, 1}, 90, 93.1, 99.4, 99.4}, Case{"twist 180", {0, 0, 1}, 179.99f, 86.8, 98.3, 98.3}}) {
        const std::vector<Affine> palette{
            toAffine(glm::mat4(1.0f)),
            toAffine(glm::mat4(glm::mat3_cast(glm::angleAxis(glm::radians(c.degrees), c.axis))))};
        const auto kept = [&](const std::vector<glm::dvec3>& skinned) {
            return 100.0 * test::limbTubeVolume(skinned) / test::limbTubeVolume(rest);
        };
        const double linear = kept(deformOnCpu(rest, tube.weights, palette));
        const double dual = kept(test::skinWithDualQuaternions(rest, tube.weights, palette));
        const double about = kept(test::skinAboutCenters(rest, centers, tube.weights, palette));
        std::printf("tube, %-10s linear %.1f %%, dual quaternions %.1f %%, centers of rotation %.1f %%\n", c.name,
                    linear, dual, about);
        EXPECT_NEAR(linear, c.linear, 0.051) << c.name;
        EXPECT_NEAR(dual, c.dual, 0.051) << c.name;
        EXPECT_NEAR(about, c.centers, 0.051) << c.name;
    }
}

TEST(Centers, BesideTheOtherSkinningsOnRigs) {
    std::map<std::string, std::pair<Character, Centers>> rigs;
    for (const char* name : {"mh_female1605", "mh_body_13k_infl8", "man_casual_quads", "horse"}) {
        for (const std::string& path : test::sharedAssets({std::string("characters/") + name + ".glb"})) {
            Result<Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character.ok()) << character.error().message;
            Centers centers;
            const double milliseconds = millisecondsOf(*character, centers);
            std::printf("%-18s %5zu vertices: centers in %.1f ms\n", name, centers.points.size(), milliseconds);
            rigs[name] = {std::move(*character), std::move(centers)};
        }
    }
    for (const test::RigBend& c : test::rigBends()) {
        if (rigs.count(c.file) == 0) {
            continue;
        }
        const auto& [character, centers] = rigs[c.file];
        const test::Bend bend(character, c.turn);
        const std::vector<glm::dvec3> rest = test::doublePositions(character.cage);
        const test::LimbMeasure linear = test::measured(bend, deformOnCpu(rest, character.weights, bend.palette()));
        const test::LimbMeasure dual =
            test::measured(bend, test::skinWithDualQuaternions(rest, character.weights, bend.palette()));
        const test::LimbMeasure about = test::measured(
            bend, test::skinAboutCenters(rest, test::centersOf(centers), character.weights, bend.palette()));
        std::printf("%-18s %-20s", c.file, c.name);
        for (const auto& [own, wanted] : {std::pair(linear, c.linear), {dual, c.dual}, {about, c.centers}}) {
            test::expectMeasure(c, own, wanted, {1.0, 0.025, 2.0});
        }
        std::printf("\n");
    }
}

TEST(Centers, VerticesOfOneJointHaveNone) {
    const Character tube = test::riggedTube({.segments = 16, .joints = 3});
    const Centers centers = findCenters(tube);
    size_t none = 0;
    for (size_t v = 0; v < centers.points.size(); ++v) {
        const bool several = tube.weights.starts[v + 1] - tube.weights.starts[v] > 1;
        EXPECT_EQ(centers.points[v].w != 0.0f, several) << v;
        none += several ? 0 : 1;
    }
    EXPECT_GT(none, 50u);
    for (const double arm : centers.arms) {
        EXPECT_GE(arm, 0.99) << "the tube's radius is 1";
        EXPECT_LT(arm, 1.5);
    }
}

/// Vertices of more joints than count, faces without area, and joints that nobody follows.
TEST(Centers, TakeWhateverWeightsThereAre) {
    Character tube = test::riggedTube({.segments = 40, .sides = 20, .joints = 60});
    test::Noise noise(3);
    tube.weights = {{0}, {}};
    for (uint32_t v = 0; v < tube.cage.vertexCount(); ++v) {
        for (uint32_t j = 0; j < 50; ++j) {
            tube.weights.influences.push_back({(v + j) % 55, v % 7 == 0 ? 0.02f : 0.02f * (1.0f + 0.5f * noise())});
        }
        tube.weights.starts.push_back(static_cast<uint32_t>(tube.weights.influences.size()));
    }
    std::fill_n(tube.cage.positions.begin(), 60, glm::vec3(1e30f));
    Centers centers;
    const double milliseconds = millisecondsOf(tube, centers);
    std::printf("%zu vertices of 50 joints: %.0f ms\n", centers.points.size(), milliseconds);
    for (const glm::vec4& point : centers.points) {
        EXPECT_TRUE(std::isfinite(point.x + point.y + point.z));
    }
    std::fill(tube.cage.positions.begin(), tube.cage.positions.end(), glm::vec3(1.0f));
    for (const glm::vec4& point : findCenters(tube).points) {
        EXPECT_EQ(point, glm::vec4(0.0f)) << "a cage without area has none";
    }
}

/// Reach and palettes hold the cages, whatever the joints do.
TEST(Centers, CagesLieWithinTheirBounds) {
    double most = 0.0;
    size_t poses = 0;
    for (uint32_t run = 0; run < 60; ++run) {
        const Character tube = test::riggedTube({.segments = 12, .sides = 7, .joints = 4});
        const Centers centers = findCenters(tube);
        const SkinnedBounds bounds({SkinningMode::centersOfRotation, &centers, nullptr});
        const Reach reach = reachOf(tube);
        test::Noise noise(run);
        std::vector<Affine> palette;
        for (size_t j = 0; j < tube.skin.joints.size(); ++j) {
            glm::mat4 joint(glm::mat3_cast(glm::normalize(glm::quat(noise(), noise(), noise(), noise()))));
            joint = joint * glm::mat4(glm::mat3(1.0f + noise(), noise(), 0, 0, 1.0f + noise(), 0, noise(), 0, 1.0f));
            joint[3] = glm::vec4(3.0f * noise.vector(), 1.0f);
            palette.push_back(toAffine(joint));
        }
        const Box own = test::boxAround(
            test::skinAboutCenters(test::doublePositions(tube.cage), test::centersOf(centers), tube.weights, palette));
        const Box linear = paletteBounds(reach, palette, {});
        const Box held = bounds.posed(reach, palette, {});
        EXPECT_TRUE(test::holds(held, own)) << run;
        most = std::max(most, test::diagonal(held) / test::diagonal(linear));
        ++poses;
    }
    std::printf("%zu poses: boxes have at most %.2f times the diagonals of linear skinning's\n", poses, most);
}

} // namespace
} // namespace supple::skinning
