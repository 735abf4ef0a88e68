// What moves in a glTF file: clips and morph targets.
#include "tests/cage/gltf/reading.h"

#include <cmath>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

// ---- clips ----------------------------------------------------------------------------------------------------------

TEST(GltfMotion, IntegerRotationsAreDequantised) {
    GltfBuilder b = skinnedQuad();
    const int bytes = b.addIntegers("VEC4", 5120, {0, 0, 0, 127, 0, 0, 0x81, 0, 90, 90, 0x80, 0}, true);
    const int shorts = b.addIntegers("VEC4", 5122, {0, 0, 0, 32767, 0, 0, 0x8000, 0, 0, 32767, 0, 0}, true);
    b.more = replaced(b.more, R"({"input":5,"output":6},{"input":5,"output":7})",
                      R"({"input":5,"output":)" + std::to_string(bytes) + R"(},{"input":5,"output":)" +
                          std::to_string(shorts) + R"(,"interpolation":"STEP"})");
    b.more = replaced(b.more, R"({"sampler":1,"target":{"node":2,"path":"translation"}})",
                      R"({"sampler":1,"target":{"node":1,"path":"rotation"}})");
    const Character c = readWell(b.glb());
    const auto& first = c.clips[0].channels[0].values;
    EXPECT_EQ(std::vector<float>(first.begin(), first.begin() + 8), (std::vector<float>{0, 0, 0, 1, 0, 0, -1, 0}));
    const double length = std::sqrt(double(first[8]) * first[8] + double(first[9]) * first[9] +
                                    double(first[10]) * first[10] + double(first[11]) * first[11]);
    EXPECT_NEAR(length, 1.0, 1e-6) << "8-bit rotations are far from unit length";
    EXPECT_NEAR(first[8], 90.0 / std::sqrt(2 * 90.0 * 90.0 + 127.0 * 127.0), 1e-6);
    EXPECT_EQ(c.clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0}));
    EXPECT_EQ(c.clips[0].channels[1].interpolation, Interpolation::step);
}

TEST(GltfMotion, ForeignChannelsAreIgnoredByName) {
    GltfBuilder b = skinnedQuad();
    b.more =
        replaced(b.more, R"("channels":[)",
                 R"("channels":[{"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
                 R"({"pointer":"/cameras/0/perspective/yfov"}}}},{"sampler":9,"target":{"node":0,"path":"weights"}},)");
    b.more = replaced(b.more, R"("sampler":9)", R"("sampler":0)");
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.clips[0].channels.size(), 2u);
    EXPECT_EQ(c.warnings,
              (Strings{"animation 0: 1 channel of KHR_animation_pointer to \"/cameras/*/perspective/yfov\" ignored",
                       "animation 0: 1 channel of weights of nodes without morph targets ignored"}));
}

TEST(GltfMotion, ClipsKeepTheirNumbers) {
    GltfBuilder b = skinnedQuad();
    b.more = replaced(b.more, R"("animations":[)",
                      R"("animations":[{"name":"smile","samplers":[{"input":5,"output":5}],)"
                      R"("channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]},)");
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.clips.size(), 2u);
    EXPECT_EQ(c.clips[0].name, "smile");
    EXPECT_TRUE(c.clips[0].channels.empty());
    EXPECT_EQ(c.clips[0].duration, 0.0);
    EXPECT_EQ(c.clips[1].name, "clip_1");
}

TEST(GltfMotion, KeysOfWeights) {
    GltfBuilder b = skinnedQuad();
    const int dense = b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2});
    b.meshes = replaced(b.meshes, R"("mode":4)",
                        R"("targets":[{"POSITION":)" + std::to_string(dense) + R"(},{"POSITION":)" +
                            std::to_string(dense) + "}]");
    const int linear = b.addFloats("SCALAR", {0, 1, 0.5f, 0.25f, 1, 0});
    const int bytes = b.addIntegers("SCALAR", 5120, {0, 127, 0x81, 0x80, 0, 127}, true);
    const int cubic = b.addIntegers("SCALAR", 5123, std::vector<uint32_t>(18, 65535), true);
    const auto sampler = [](int output, const char* interpolation) {
        return R"({"input":5,"output":)" + std::to_string(output) + R"(,"interpolation":")" + interpolation + "\"}";
    };
    const std::string clip = R"(],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]})";
    b.more =
        replaced(b.more, R"("animations":[)",
                 R"("animations":[{"samplers":[)" + sampler(linear, "LINEAR") + clip + R"(,{"samplers":[)" +
                     sampler(bytes, "STEP") + clip + R"(,{"samplers":[)" + sampler(cubic, "CUBICSPLINE") + clip + ",");
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.clips.size(), 4u);
    for (size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(c.clips[i].channels.size(), 1u);
        EXPECT_EQ(c.clips[i].channels[0].path, ChannelPath::weights);
        EXPECT_EQ(c.clips[i].channels[0].node, c.parts[0].node);
        EXPECT_EQ(c.clips[i].duration, 2.0);
    }
    EXPECT_EQ(c.clips[0].channels[0].values, (std::vector<float>{0, 1, 0.5f, 0.25f, 1, 0}));
    EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{0, 1, -1, -1, 0, 1}));
    EXPECT_EQ(c.clips[1].channels[0].interpolation, Interpolation::step);
    EXPECT_EQ(c.clips[2].channels[0].values, std::vector<float>(18, 1.0f)) << "three values a key and target";
}

// ---- morph targets --------------------------------------------------------------------------------------------------

TEST(GltfMotion, MorphTargets) {
    GltfBuilder b = skinnedQuad();
    const std::string dense = std::to_string(b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0}));
    b.meshes =
        replaced(b.meshes, R"("mode":4)",
                 R"("targets":[{"POSITION":)" + dense + R"(},{"NORMAL":0,"TANGENT":0},{"POSITION":)" + dense + "}]");
    Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.parts[0].node, 0u);
    ASSERT_EQ(c.morphs.targets.size(), 3u);
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{0, 3})) << "only those that move";
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 1}, {0, 2, 0}}));
    EXPECT_EQ(c.morphs.targets[0].name, "");
    EXPECT_TRUE(c.morphs.targets[1].vertices.empty());
    EXPECT_EQ(c.morphs.targets[2].vertices, c.morphs.targets[0].vertices);
    EXPECT_EQ(c.morphs.weights, (std::vector<float>{0, 0, 0}));

    b.meshes = replaced(b.meshes, R"([{"primitives")",
                        R"([{"weights":[0.25,0.5,1],"extras":{"targetNames":["smile",7,"frown"]},"primitives")");
    c = readWell(b.glb());
    EXPECT_EQ(c.morphs.weights, (std::vector<float>{0.25f, 0.5f, 1}));
    EXPECT_EQ(c.morphs.targets[0].name, "smile");
    EXPECT_EQ(c.morphs.targets[1].name, "");
    EXPECT_EQ(c.morphs.targets[2].name, "frown");
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 extras targetNames[1]: not a string; ignored"}));
    b.nodes = replaced(b.nodes, R"("mesh":0)", R"("mesh":0,"weights":[1,0,-1])");
    EXPECT_EQ(readWell(b.glb()).morphs.weights, (std::vector<float>{1, 0, -1})) << "the node's come before the mesh's";
}

TEST(GltfMotion, SparseMorphTargets) {
    GltfBuilder b = skinnedQuad();
    const int base = b.addFloats("VEC3", {1, 1, 1, 2, 2, 2, 0, 0, 0, 3, 3, 3});
    const int indices = b.addIntegers("SCALAR", 5121, {1, 3});
    const int values = b.addFloats("VEC3", {5, 0, 0, 0, 0, 0});
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("targets":[{"POSITION":)" + std::to_string(base) + "}]");
    const std::string dense = R"({"bufferView":)" + std::to_string(base) + R"(,"componentType":5126,"count":4)";
    const std::string sparse = R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
                               R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}";
    Character c = readWell(packGlb(replaced(b.json(), dense, dense + sparse), b.binary()));
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{0, 1})) << "values replace, also by zero";
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{1, 1, 1}, {5, 0, 0}}));
    c = readWell(packGlb(replaced(b.json(), dense, R"({"componentType":5126,"count":4)" + sparse), b.binary()));
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{1}));
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{5, 0, 0}}));
}

TEST(GltfMotion, MorphTargetsOfSeveralPrimitives) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0});
    b.addFloats("VEC3", {1, 1, 0, 0, 1, 0, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 3});
    b.addFloats("VEC3", {0, 0, 3, 0, 0, 4, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 3.0625f, 0, 0, 4, 0, 0, 0});
    const auto meshes = [](int second) {
        return R"([{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":2}]},)"
               R"({"attributes":{"POSITION":1},"targets":[{"POSITION":)" +
               std::to_string(second) + "}]}]}]";
    };
    b.meshes = meshes(3);
    Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{2, 3}));
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 3}, {0, 0, 4}}));
    // A seam that would hardly move apart is sewn: its vertices move as the first one does.
    b.meshes = meshes(4);
    c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 3}, {0, 0, 4}}));
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex agrees with another in position but not in morph targets (first: "
                                   "vertices 2 and 3) along a seam; joined, as the first vertex of each has it"}));
}

} // namespace
} // namespace supple::cage
