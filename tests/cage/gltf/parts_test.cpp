// Files with several meshes: parts of one character, with one palette and one list of morph targets.
#include "cage/parts.h"
#include "cage/sew.h"
#include "cage/topology.h"
#include "tests/cage/face_lists.h"
#include "tests/cage/gltf/reading.h"
#include "tests/support/characters.h"
#include "tests/support/meshes.h"
#include "tools/gltf/writer.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;
/// Two skinned quads, and one without a skin at two nodes.
GltfBuilder fourParts() {
    GltfBuilder b = skinnedQuad();
    const std::string skinned =
        R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]})";
    b.meshes = "[" + skinned + R"(,{"name":"plate","primitives":[{"attributes":{"POSITION":0},"indices":3}]}])";
    b.nodes = R"([{"name":"body","mesh":0,"skin":0},{"name":"root","children":[2]},)"
              R"({"name":"tip","translation":[1,0,0],"children":[4]},{"mesh":0,"skin":0},{"mesh":1},)"
              R"({"name":"twin","mesh":1}])";
    b.more = replaced(b.more, R"("nodes":[0,1])", R"("nodes":[0,1,3,5])");
    return b;
}

TEST(GltfParts, EveryMeshNodeOfTheSceneIsAPart) {
    const Character c = readWell(fourParts().glb(), {.sewParts = false, .pairing = Pairing::never});
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.parts.size(), 4u);
    EXPECT_EQ(c.cage.faceCount(), 8u);
    EXPECT_EQ(c.cage.vertexCount(), 16u);
    EXPECT_EQ(c.sourceVertexCount, 16u);
    const char* names[] = {"body", "", "plate", "twin"};
    const uint32_t nodes[] = {0, 3, 4, 5};
    for (uint32_t p = 0; p < 4; ++p) {
        EXPECT_EQ(c.parts[p].name, names[p]);
        EXPECT_EQ(c.parts[p].node, nodes[p]);
        EXPECT_EQ(c.parts[p].rigid, p >= 2);
        EXPECT_EQ(c.parts[p].firstFace, 2 * p);
        EXPECT_EQ(endFace(c, p), 2 * p + 2);
    }
    // One palette: the skin once for both parts, and the two nodes.
    EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2, 4, 5}));
    EXPECT_EQ(c.skin.inverseBinds[1][3], glm::vec4(-1, 0, 0, 1));
    EXPECT_EQ(c.skin.inverseBinds[3], glm::mat4(1.0f));
    // The plate hangs below the second joint, which is bound at (1, 0, 0): there it stands in the bind pose.
    EXPECT_EQ(c.skin.inverseBinds[2][3], glm::vec4(-1, 0, 0, 1));
    EXPECT_EQ(c.cage.positions[8], glm::vec3(1, 0, 0));
    EXPECT_EQ(c.cage.positions[12], glm::vec3(0, 0, 0));
    for (uint32_t v = 0; v < 16; ++v) {
        const Influence& first = c.weights.influences[c.weights.starts[v]];
        EXPECT_EQ(first.joint, v < 8 ? (v % 4 == 3 ? 1u : 0u) : v < 12 ? 2u : 3u) << "vertex " << v;
    }
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

TEST(GltfParts, SkinsShareWhatIsEqual) {
    GltfBuilder b = fourParts();
    // A second skin: the same joints the other way round, one of them bound by another matrix.
    b.more = replaced(b.more, R"("inverseBindMatrices":4}])", R"("inverseBindMatrices":4},{"joints":[2,1]}])");
    b.nodes = replaced(b.nodes, R"({"mesh":0,"skin":0},{"mesh":1})", R"({"mesh":0,"skin":1},{"mesh":1})");
    const Character c = readWell(b.glb(), {.sewParts = false, .pairing = Pairing::never});
    EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2, 2, 4, 5})) << "joint 1 has the identity in both";
    EXPECT_EQ(c.parts[1].joints, (std::vector<uint32_t>{2, 0}));
}

TEST(GltfParts, ScenesAreChosen) {
    GltfBuilder b = fourParts();
    b.more = replaced(b.more, R"("scenes":[{"nodes":[0,1,3,5]}],"scene":0)",
                      R"("scenes":[{"nodes":[0,1]},{"nodes":[5]},{"nodes":[3]},{}],"scene":1)");
    EXPECT_EQ(readWell(b.glb()).parts[0].name, "twin");
    EXPECT_EQ(readWell(b.glb()).warnings, Strings{"scene 1: 3 nodes with meshes are not in this scene; left out"});
    EXPECT_EQ(readWell(b.glb(), {.scene = 2}).parts[0].node, 3u);
    EXPECT_EQ(readWell(b.glb(), {.scene = 0}).parts.size(), 2u) << "what hangs below its nodes is in the scene";
    EXPECT_EQ(messageOf(b.glb(), ErrorCode::asset, {.scene = 4}), "t.glb: scene 4: the file has 4 scenes");
    EXPECT_EQ(messageOf(b.glb(), ErrorCode::asset, {.scene = 3}), "t.glb: scene 3: no mesh");
    b.more = replaced(b.more, R"("scene":1)", R"("scene":3)");
    EXPECT_EQ(readWell(b.glb()).parts.size(), 4u);
    EXPECT_EQ(readWell(b.glb()).warnings, (Strings{"scene 3: no mesh; all nodes of the file with meshes are read"}));
}

TEST(GltfParts, AMirroredNodeTurnsItsFaces) {
    GltfBuilder b = fourParts();
    b.nodes = replaced(b.nodes, R"({"mesh":1},)", R"({"mesh":1,"scale":[-1,1,1]},)");
    const Character c = readWell(b.glb(), {.sewParts = false, .pairing = Pairing::never});
    EXPECT_EQ(face(c.cage, 4), (std::vector<uint32_t>{8, 10, 9})) << "glTF: a negative determinant turns the winding";
    EXPECT_EQ(face(c.cage, 6), (std::vector<uint32_t>{12, 13, 14}));
}

TEST(GltfParts, APlaceThatIsTooFarIsNotTaken) {
    const auto plate = [](const std::string& matrix) {
        GltfBuilder b = fourParts();
        b.nodes = replaced(b.nodes, R"("name":"twin",)", R"("matrix":)" + matrix + ",");
        const Character c = readWell(b.glb(), {.sewParts = false, .pairing = Pairing::never});
        const Result<GlbFile> written = writeGlb(c);
        EXPECT_TRUE(written.ok() && readGltf(written->bytes, "again.glb", "").ok()) << matrix;
        return c;
    };
    EXPECT_EQ(plate("[1,0,0,0,0,1,0,0,0,0,1,0,2,0,0,1]").cage.positions[12], glm::vec3(2, 0, 0));
    for (const char* matrix : {"[6e8,0,0,0,0,1,0,0,0,0,1,0,6e8,0,0,1]", "[1,1e6,0,0,0,1,1e6,0,0,0,1,0,0,0,0,1]",
                               "[1,0,0,0,0,1,0,0,3e8,0,1,0,0.5,0,2,1]"}) {
        const Character c = plate(matrix);
        EXPECT_EQ(c.warnings, (Strings{"node 5: float numbers do not reach its place in the bind pose; its mesh stays "
                                       "in the node's own space"}))
            << matrix;
        EXPECT_EQ(c.cage.positions[12], glm::vec3(0, 0, 0)) << matrix;
        EXPECT_EQ(c.skin.inverseBinds[3], glm::mat4(1.0f)) << matrix;
    }
}

TEST(GltfParts, PartsWithoutTrianglesAreNamed) {
    GltfBuilder b = fourParts();
    b.meshes = replaced(b.meshes, R"("name":"plate","primitives":[{)", R"("name":"plate","primitives":[{"mode":0,)");
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.parts.size(), 2u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 1 primitive 0: POINTS instead of TRIANGLES; left out",
                                   "mesh 1: nothing but points: no primitive of TRIANGLES, so there is no surface; "
                                   "left out"}))
        << "once";
    b.nodes = R"([{"mesh":1},{"children":[2]},{}])";
    b.more = "";
    EXPECT_EQ(messageOf(b.glb()),
              "t.glb: mesh 1: nothing but points: no primitive of TRIANGLES, so there is no surface");
}

TEST(GltfParts, AFaultInAnyPartIsTheFilesIfItIsReadStrictly) {
    GltfBuilder b = fourParts();
    b.meshes = replaced(b.meshes, R"({"attributes":{"POSITION":0},"indices":3})",
                        R"({"attributes":{"POSITION":99},"indices":3})");
    const std::string fault = "mesh 1 primitive 0 POSITION: accessor 99 is out of range: the file has ";
    EXPECT_TRUE(messageOf(b.glb()).starts_with("t.glb: " + fault)) << messageOf(b.glb());
    EXPECT_TRUE(saidOf(b.glb()).starts_with(fault)) << "the others are read";
    EXPECT_EQ(readWell(b.glb()).parts.size(), 2u);
}

TEST(GltfParts, ManyNodesWithOneMeshAreBounded) {
    GltfBuilder b = skinnedQuad();
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":3}]}])";
    b.nodes = "[";
    for (int i = 0; i < 17000; ++i) {
        b.nodes += i == 0 ? R"({"mesh":0})" : R"(,{"mesh":0})";
    }
    b.nodes += "]";
    b.more = "";
    EXPECT_EQ(messageOf(b.glb(), ErrorCode::limit, kMuchMemory),
              "t.glb: node 16384: with its mesh, there are more than 16384 meshes");
}

TEST(GltfParts, ClipsBeginAtTheirFirstKey) {
    GltfBuilder b = skinnedQuad();
    const std::string last = std::to_string(b.addFloats("SCALAR", {-0.5f, 0.25f, 1}));
    b.more = replaced(b.more, R"({"input":5,"output":6})", R"({"input":)" + last + R"(,"output":6})");
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings{"animation 0: keys before 0; its time begins at its first key, -0.5 s"});
    EXPECT_EQ(c.clips[0].channels[0].times, (std::vector<float>{0, 0.75f, 1.5f}));
    EXPECT_EQ(c.clips[0].channels[1].times, (std::vector<float>{0.5f, 1.5f, 2.5f}))
        << "the other channel stays beside it";
    EXPECT_EQ(c.clips[0].duration, 2.5);
}

// ---- sewing ----

/// A grid on two joints, with a morph target that a clip moves; cut into runs of faces.
Character cutGrid(const std::vector<uint32_t>& cuts) {
    Character c;
    c.cage = supple::test::grid(6, 4);
    c.skeleton.nodes.resize(2 + cuts.size());
    c.skeleton.nodes[1].parent = 0;
    c.skeleton.parentsFirst.resize(c.skeleton.nodes.size());
    c.parts.clear();
    for (uint32_t p = 0; p < cuts.size(); ++p) {
        c.skeleton.nodes[2 + p].name = "piece " + std::to_string(p);
        Part& part = c.parts.emplace_back();
        part.name = c.skeleton.nodes[2 + p].name;
        part.node = 2 + p;
        part.firstFace = cuts[p];
        part.targetCount = 1;
        part.joints = {0, 1};
    }
    for (uint32_t n = 0; n < c.skeleton.nodes.size(); ++n) {
        c.skeleton.parentsFirst[n] = n;
    }
    c.skin.joints = {0, 1};
    c.skin.inverseBinds.assign(2, glm::mat4(1.0f));
    c.weights.starts = {0};
    MorphTarget lift{"lift", {}, {}};
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        c.weights.influences.push_back({v % 2, 1.0f});
        c.weights.starts.push_back(v + 1);
        c.cage.sourceVertices.push_back(v);
        if (v % 3 == 0) {
            lift.vertices.push_back(v);
            lift.deltas.push_back({0, 0, 1.0f + static_cast<float>(v)});
        }
    }
    c.morphs.targets = {lift};
    c.morphs.weights = {0.5f};
    Channel weights;
    weights.node = 2;
    weights.path = ChannelPath::weights;
    weights.times = {0, 1};
    weights.values = {0, 1};
    c.clips.push_back({"up", 1.0, {weights}});
    return c;
}

TEST(GltfParts, ACutCharacterIsSewnTogether) {
    const Character whole = cutGrid({0});
    const Character cut = cutGrid({0, 5, 6, 17});
    const Result<GlbFile> file = writeGlb(cut);
    ASSERT_TRUE(file.ok()) << file.error().message;

    const Character apart = readWell(file->bytes, {.sewParts = false, .pairing = Pairing::never});
    EXPECT_EQ(apart.parts.size(), 4u);
    EXPECT_GT(apart.cage.vertexCount(), whole.cage.vertexCount());
    EXPECT_EQ(cornerPositions(apart.cage), cornerPositions(whole.cage));

    const Character sewn = readWell(file->bytes);
    EXPECT_EQ(sewn.warnings, Strings());
    EXPECT_EQ(sewn.cage.vertexCount(), whole.cage.vertexCount());
    EXPECT_EQ(sewn.seamVertexCount - apart.seamVertexCount, apart.cage.vertexCount() - whole.cage.vertexCount());
    EXPECT_EQ(sewn.cage.faceStarts, whole.cage.faceStarts);
    EXPECT_EQ(cornerPositions(sewn.cage), cornerPositions(whole.cage));
    const Result<Topology> a = buildTopology(whole.cage), b = buildTopology(sewn.cage);
    ASSERT_TRUE(b.ok()) << b.error().message;
    EXPECT_EQ(a->twins, b->twins);
    // The parts share the target, which one channel moves.
    ASSERT_EQ(sewn.morphs.targets.size(), 1u);
    EXPECT_EQ(sewn.morphs.targets[0].vertices.size(), whole.morphs.targets[0].vertices.size());
    EXPECT_EQ(sewn.morphs.weights, std::vector<float>{0.5f});
    ASSERT_EQ(sewn.clips[0].channels.size(), 1u);
    EXPECT_EQ(sewn.skin.joints, whole.skin.joints);
    // And so it is written and read again.
    const Result<GlbFile> again = writeGlb(sewn);
    ASSERT_TRUE(again.ok());
    expectSame(sewn, readWell(again->bytes));
}

TEST(GltfParts, WhatMovesApartIsNotSewn) {
    Character cut = cutGrid({0, 12});
    const auto verticesAfter = [&] {
        const Result<GlbFile> file = writeGlb(cut);
        EXPECT_TRUE(file.ok());
        return readWell(file->bytes).cage.vertexCount();
    };
    EXPECT_EQ(verticesAfter(), 35u);
    // Each part's targets have a name of their own: its displacements are not the other's.
    cut.morphs.targets.push_back({"other", cut.morphs.targets[0].vertices, cut.morphs.targets[0].deltas});
    cut.morphs.weights.push_back(0.5f);
    cut.parts[1].firstTarget = 1;
    const uint32_t border = 7, moved = 2; // of the row between them, every third vertex moves
    EXPECT_EQ(verticesAfter(), 35u + border - (border - moved - 1));
}

TEST(GltfParts, TargetsOfOnePartDoNotMoveAnother) {
    GltfBuilder b = fourParts();
    const std::string target = std::to_string(b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    const std::string values = std::to_string(b.addFloats("SCALAR", {0.25f, 0.5f, 0.75f}));
    b.meshes = replaced(b.meshes, R"({"attributes":{"POSITION":0},"indices":3})",
                        R"({"attributes":{"POSITION":0},"indices":3,"targets":[{"POSITION":)" + target + "}]}");
    b.more = replaced(b.more, R"({"input":5,"output":7}])",
                      R"({"input":5,"output":7},{"input":5,"output":)" + values + "}]");
    b.more = replaced(b.more, R"("path":"translation"}})",
                      R"("path":"translation"}},{"sampler":2,"target":{"node":5,"path":"weights"}})");
    const Character c = readWell(b.glb(), {.sewParts = false, .pairing = Pairing::never});
    ASSERT_EQ(c.morphs.targets.size(), 2u) << "without names the two nodes' targets are not one";
    EXPECT_EQ(c.parts[2].firstTarget, 0u);
    EXPECT_EQ(c.parts[3].firstTarget, 1u);
    EXPECT_EQ(c.parts[3].targetCount, 1u);
    EXPECT_EQ(c.morphs.targets[0].vertices, std::vector<uint32_t>{8});
    EXPECT_EQ(c.morphs.targets[1].vertices, std::vector<uint32_t>{12});
    EXPECT_EQ(c.clips[0].channels.back().firstTarget, 1u);
}

} // namespace
} // namespace supple::cage
