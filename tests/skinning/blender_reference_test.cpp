// Animation sampling and skinning against vertex positions that Blender's own armature modifier evaluated.
#include "cage/gltf/reader.h"
#include "skinning/pose.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace supple::skinning {
namespace {

namespace fs = std::filesystem;
using namespace cage;

std::vector<glm::dvec3> readPoints(const fs::path& path) {
    std::ifstream stream(path);
    std::vector<glm::dvec3> points;
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream numbers(line);
        glm::dvec3 p;
        if (line.empty() || line[0] == '#' || !(numbers >> p.x >> p.y >> p.z))
            continue;
        points.push_back(p);
    }
    return points;
}

double largestExtent(const Cage& cage) {
    glm::vec3 low = cage.positions[0];
    glm::vec3 high = low;
    for (const glm::vec3& p : cage.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 extent = high - low;
    return std::max({extent.x, extent.y, extent.z});
}

std::vector<Affine> paletteAt(const Character& c, const Clip* clip, double time) {
    std::vector<glm::mat4> matrices(c.skeleton.nodes.size());
    if (clip == nullptr)
        restPose(c.skeleton, matrices);
    else
        sampleClip(c.skeleton, *clip, time, matrices);
    globalTransforms(c.skeleton, matrices, matrices);
    std::vector<Affine> palette(c.skin.joints.size());
    jointPalette(c.skin, matrices, glm::mat4(1.0f), palette);
    return palette;
}

std::string characters() {
    return test::sharedFolder() + "characters/";
}

TEST(BlenderReference, Skinning) {
    if (!fs::exists(characters() + "reference")) {
        GTEST_SKIP() << "56 poses left out: " << characters() << "reference is not present";
    }
    size_t cases = 0;
    std::map<std::string, double> worst;
    for (const fs::path file : test::filesBelow(characters() + "reference", {".xyz"})) {
        // NAME__animK_tT.xyz
        const std::string stem = file.stem().string();
        SCOPED_TRACE(stem);
        const size_t split = stem.find("__anim");
        ASSERT_NE(split, std::string::npos);
        const std::string name = stem.substr(0, split);
        unsigned animation = 0;
        double time = 0.0;
        ASSERT_EQ(std::sscanf(stem.c_str() + split, "__anim%u_t%lf", &animation, &time), 2);

        const Result<Character> c = readGltfFile(characters() + name + ".glb");
        ASSERT_TRUE(c.ok()) << c.error().message;
        ASSERT_LT(animation, c->clips.size());
        const Clip& clip = c->clips[animation];
        // The name gives the key's time with six digits; at the key itself nothing is interpolated.
        double key = clip.channels[0].times[0];
        for (const Channel& channel : clip.channels)
            for (const float t : channel.times)
                if (std::abs(t - time) < std::abs(key - time))
                    key = t;
        EXPECT_NEAR(key, time, 1e-6);

        const std::vector<glm::dvec3> wanted = readPoints(file);
        const std::vector<glm::dvec3> deformed = deformOnCpu(c->cage, c->weights, paletteAt(*c, &clip, key));
        // Repairs leave vertices out and add copies.
        const bool repaired = !c->damages.empty();
        ASSERT_EQ(repaired ? c->sourceVertexCount : deformed.size(), wanted.size());
        double largest = 0.0;
        for (size_t v = 0; v < deformed.size(); ++v)
            largest = std::max(largest, glm::length(deformed[v] - wanted[repaired ? c->cage.sourceVertices[v] : v]));
        const double relative = largest / largestExtent(c->cage);
        const bool eightBit = name == "horse" || name == "llama_nonmanifold" || name == "man_casual_quads";
        EXPECT_LT(relative, eightBit ? 1e-3 : 2e-5);
        worst[name] = std::max(worst[name], relative);
        ++cases;
    }
    EXPECT_EQ(cases, 56u);
    for (const auto& [name, error] : worst)
        std::printf("%-20s largest distance %.2e of the largest extent\n", name.c_str(), error);
}

TEST(BlenderReference, RestPoseIsTheBindPose) {
    if (!fs::exists(characters())) {
        GTEST_SKIP() << "19 characters left out: " << characters() << " is not present";
    }
    size_t cases = 0;
    for (const std::string& path : test::filesBelow(characters(), {".glb"})) {
        SCOPED_TRACE(path);
        const Result<Character> c = readGltfFile(path);
        ASSERT_TRUE(c.ok()) << c.error().message;
        const std::vector<glm::dvec3> deformed = deformOnCpu(c->cage, c->weights, paletteAt(*c, nullptr, 0.0));
        double largest = 0.0;
        for (size_t v = 0; v < deformed.size(); ++v)
            largest = std::max(largest, glm::length(deformed[v] - glm::dvec3(c->cage.positions[v])));
        EXPECT_LT(largest / largestExtent(c->cage), 2e-6);
        ++cases;
    }
    EXPECT_EQ(cases, 19u);
}

} // namespace
} // namespace supple::skinning
