// Vertices of one place and different skins or displacements, along a seam of a glTF mesh.
#include "cage/topology.h"
#include "tests/cage/gltf/reading.h"

namespace supple::cage {
namespace {

using namespace test;

/// Two quads side by side, of four triangles. The right one has its own vertices at the border: 1 and 4 are 2 and 5.
/// Their second joint has the weights given.
GltfBuilder twoQuads(const std::vector<float>& secondWeights, const std::string& more = "") {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 2, 1, 0});
    std::vector<uint32_t> joints;
    std::vector<float> weights;
    for (const float second : secondWeights) {
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), {1.0f - second, second, 0, 0});
    }
    b.addIntegers("VEC4", 5121, joints);
    b.addFloats("VEC4", weights);
    b.addIntegers("SCALAR", 5123, {0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6});
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3)" + more + "}]}]";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    return b;
}

TEST(RepairSeams, ASeamOfSkinIsSewn) {
    const GltfBuilder b = twoQuads({0, 0.4375f, 0.5f, 1, 0, 0.4375f, 0.5f, 1});
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 2 vertices agree with another in position but not in skin (first: vertices "
                                   "1 and 2) along a seam; joined, as the first vertex of each has it"}));
    const Topology topology = *buildTopology(c.cage);
    EXPECT_EQ(topology.edges.size(), 9u) << "the border is one edge";
    // Cage vertex 1 is vertex 1 of the file.
    ASSERT_EQ(c.cage.sourceVertices[1], 1u);
    ASSERT_EQ(c.weights.starts[2] - c.weights.starts[1], 2u);
    EXPECT_EQ(c.weights.influences[c.weights.starts[1] + 1].weight, 0.4375f);

    const Result<Character> strict = readGltf(b.glb(), "t.glb", "", {.strict = true});
    ASSERT_FALSE(strict.ok());
    EXPECT_EQ(strict.error().message,
              "t.glb: mesh 0: 2 vertices agree with another in position but not in skin (first: "
              "vertices 1 and 2) along a seam");
}

TEST(RepairSeams, OneEndThatDiffersIsEnough) {
    const Character c = readWell(twoQuads({0, 0.5f, 0.5f, 1, 0, 0.4375f, 0.5f, 1}));
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.damages.size(), 1u);
}

TEST(RepairSeams, ASeamWithoutDifferenceIsNoDamage) {
    const Character c = readWell(twoQuads({0, 0.5f, 0.5f, 1, 0, 0.25f, 0.25f, 1}));
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.warnings, Strings());
}

TEST(RepairSeams, WhatMerelyTouchesStaysApart) {
    // The right quad is moved up: only vertices 5 and 2 are in one place.
    const GltfBuilder b = twoQuads({0, 0.25f, 0.75f, 1, 0, 0.25f, 0.75f, 1});
    GltfBuilder moved;
    moved.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 2, 0});
    moved.addIntegers("VEC4", 5121,
                      {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    moved.addFloats("VEC4", {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0, 0, 1, 0, 0, //
                             1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0, 0, 1, 0, 0});
    moved.addIntegers("SCALAR", 5123, {0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6});
    moved.nodes = b.nodes;
    moved.meshes = b.meshes;
    moved.more = b.more;
    const Character c = readWell(moved);
    EXPECT_EQ(c.cage.vertexCount(), 8u);
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0: 1 vertex agrees with another in position but not in skin (first: vertices 2 "
                       "and 5); kept apart"}));
}

TEST(RepairSeams, ASeamOfDisplacementsIsSewn) {
    GltfBuilder b = twoQuads(std::vector<float>(8, 0.5f), R"(,"targets":[{"POSITION":4}])");
    std::vector<float> deltas(24, 0.0f);
    deltas[3 * 1] = 1.0f;
    deltas[3 * 2] = 1.0625f;
    b.addFloats("VEC3", deltas);
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex agrees with another in position but not in morph targets (first: "
                                   "vertices 1 and 2) along a seam; joined, as the first vertex of each has it"}));
    ASSERT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{1}));
    EXPECT_EQ(c.morphs.targets[0].deltas[0].x, 1.0f);
}

TEST(RepairSeams, WhatOpensStaysOpen) {
    // Lips: in the rest pose they lie on each other, but the lower one follows another joint.
    const Character c = readWell(twoQuads({0, 0.0f, 1.0f, 1, 0, 0.0f, 1.0f, 1}));
    EXPECT_EQ(c.cage.vertexCount(), 8u);
    EXPECT_TRUE(c.damages.empty());
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 2 vertices agree with another in position but not in skin (first: vertices "
                                   "1 and 2); kept apart"}));
    // One pair that moves far apart keeps the whole run open.
    EXPECT_EQ(readWell(twoQuads({0, 0.0f, 1.0f, 1, 0, 0.4375f, 0.5f, 1})).cage.vertexCount(), 8u);
}

TEST(RepairSeams, WhatAMorphTargetOpensStaysOpen) {
    GltfBuilder b = twoQuads(std::vector<float>(8, 0.5f), R"(,"targets":[{"POSITION":4}])");
    std::vector<float> deltas(24, 0.0f);
    deltas[3 * 2 + 2] = deltas[3 * 6 + 2] = 0.5f; // of an edge that is 1 long
    b.addFloats("VEC3", deltas);
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.vertexCount(), 8u);
    EXPECT_TRUE(c.damages.empty());
}

TEST(RepairSeams, ASingleVertexIsNoOpening) {
    GltfBuilder b = twoQuads(std::vector<float>(8, 0.5f), R"(,"targets":[{"POSITION":4}])");
    std::vector<float> deltas(24, 0.0f);
    deltas[3 * 2 + 2] = 0.5f;
    b.addFloats("VEC3", deltas);
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.damages.size(), 1u);
}

} // namespace
} // namespace supple::cage
