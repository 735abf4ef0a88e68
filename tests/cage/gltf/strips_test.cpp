// Primitives of TRIANGLE_STRIP and TRIANGLE_FAN.
#include "cage/topology.h"
#include "tests/cage/face_lists.h"
#include "tests/cage/gltf/reading.h"

namespace supple::cage {
namespace {

using namespace test;

/// Two rows of five vertices, at y = 0 (even) and y = 1 (odd), in the xy plane.
const std::vector<float> kRows = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0,
                                  2, 1, 0, 3, 0, 0, 3, 1, 0, 4, 0, 0, 4, 1, 0};
TEST(GltfStrips, AStripTurnsEverySecondTriangle) {
    // Clockwise from above: (0, 1, 2), then (1, 3, 2) and not (1, 2, 3).
    const Character c = readWell(plainMesh(kRows, {0, 1, 2, 3, 4, 5}, R"(,"mode":5)"));
    EXPECT_EQ(facesOf(c.cage), (Faces{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 4 vertices have no face; left out"}));
    EXPECT_TRUE(buildTopology(c.cage).ok()) << "all are wound alike";
    for (uint32_t f = 0; f < c.cage.faceCount(); ++f) {
        const std::vector<uint32_t> t = face(c.cage, f);
        const auto& p = c.cage.positions;
        EXPECT_LT(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z, 0.0f) << "face " << f;
    }
}

TEST(GltfStrips, WithoutIndicesTheVerticesAreTheStrip) {
    GltfBuilder b;
    b.addFloats("VEC3", kRows);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"mode":5}]}])";
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.faceCount(), 8u);
    EXPECT_EQ(c.cage.vertexCount(), 10u);
    EXPECT_TRUE(buildTopology(c.cage).ok());
    EXPECT_EQ(readWell(b.glb(), {.pairing = Pairing::whereClean}).cage.faceCount(), 4u) << "they pair as others do";
}

TEST(GltfStrips, WhatJoinsTwoStripsIsNoDamage) {
    // Two quads, joined by triangles that repeat an index, which keep the parity.
    const auto b = plainMesh(kRows, {0, 1, 2, 3, 3, 6, 6, 7, 8, 9}, R"(,"mode":5)");
    const Character c = readWell(b);
    EXPECT_EQ(facesOf(c.cage), (Faces{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}, {5, 7, 6}}));
    EXPECT_TRUE(c.damages.empty());
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 2 vertices have no face; left out"}));
}

TEST(GltfStrips, AFanHasItsFirstVertexInEveryTriangle) {
    const Character c = readWell(plainMesh(kRing, {0, 1, 2, 3, 4, 1}, R"(,"mode":6)"));
    EXPECT_EQ(facesOf(c.cage), (Faces{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 1, 0}}));
    EXPECT_EQ(c.warnings, Strings());
    const Result<Topology> topology = buildTopology(c.cage);
    ASSERT_TRUE(topology.ok());
    EXPECT_EQ(topology->boundary[0], 0);
}

TEST(GltfStrips, StripsAndTrianglesAreOneMesh) {
    GltfBuilder b = plainMesh(kRows, {0, 2, 1, 1, 2, 3});
    const std::string strip = std::to_string(b.addIntegers("SCALAR", 5121, {2, 4, 3, 5}));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"indices":)" +
               strip + R"(,"mode":5}]}])";
    const Character c = readWell(b);
    EXPECT_EQ(facesOf(c.cage), (Faces{{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {4, 5, 3}}));
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

TEST(GltfStrips, RestartValuesNeedTheirExtension) {
    GltfBuilder b;
    b.addFloats("VEC3", kRows);
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 3, 255, 4, 5, 6});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}])";
    EXPECT_EQ(messageOf(b), "t.glb: mesh 0 primitive 0 indices[4]: 255 is the restart value, which glTF 2.0 forbids");
    b.more = R"(,"extensionsUsed":["KHR_mesh_primitive_restart"],"extensionsRequired":["KHR_mesh_primitive_restart"])";
    EXPECT_EQ(facesOf(readWell(b).cage), (Faces{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}}));
}

TEST(GltfStrips, Refusals) {
    EXPECT_EQ(messageOf(plainMesh(kRows, {0, 1}, R"(,"mode":5)")),
              "t.glb: mesh 0 primitive 0 indices: a TRIANGLE_STRIP of 2 vertices, at least 3 are needed");
    EXPECT_EQ(messageOf(plainMesh(kRows, {0}, R"(,"mode":6)")),
              "t.glb: mesh 0 primitive 0 indices: a TRIANGLE_FAN of 1 vertex, at least 3 are needed");
    EXPECT_EQ(messageOf(plainMesh(kRows, {0, 1, 12}, R"(,"mode":6)")),
              "t.glb: mesh 0 primitive 0 indices[2]: 12 is out of range: the primitive has 10 vertices");
}

TEST(GltfStrips, ExtensionsThatCountTrianglesAreNotUsed) {
    GltfBuilder b = plainMesh(kRows, {0, 1, 2, 3}, R"(,"mode":5,"extensions":{"FB_ngon_encoding":{}})");
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0 FB_ngon_encoding: TRIANGLE_STRIP instead of TRIANGLES; not used",
                                   "mesh 0: 6 vertices have no face; left out"}));
}

} // namespace
} // namespace supple::cage
