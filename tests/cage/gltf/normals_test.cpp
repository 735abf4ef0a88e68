// NORMAL, TANGENT, and the triangles of merged polygons.
#include "cage/triangulation.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

const std::vector<float> kSquareFloats = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

/// Two triangles of a square, with normals.
GltfBuilder square(const std::vector<float>& normals, const std::string& more = "") {
    GltfBuilder b;
    b.addFloats("VEC3", kSquareFloats);
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3});
    const std::string normal = normals.empty() ? "" : R"(,"NORMAL":)" + std::to_string(b.addFloats("VEC3", normals));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0)" + normal + R"(},"indices":1)" + more + "}]}]";
    return b;
}

TEST(GltfNormals, AreReadPerCorner) {
    const Character c = readWell(square({0, 0, 1, 0, 0.6f, 0.8f, 0, 0, 2, 1, 0, 0}));
    const std::vector<glm::vec3> wanted = {{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}};
    ASSERT_EQ(c.cage.cornerNormals.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_LT(glm::length(c.cage.cornerNormals[i] - wanted[i]), 1e-6f) << "corner " << i;
    }
    EXPECT_TRUE(c.warnings.empty());
}

TEST(GltfNormals, HostileOnesAreRepairedAndNamed) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), big = std::numeric_limits<float>::max();
    const Character c =
        readWell(square({0, 0, 0, nan, 0, 1, big, big, big, 0, std::numeric_limits<float>::infinity(), 0}));
    const std::vector<glm::vec3>& normals = c.cage.cornerNormals;
    ASSERT_EQ(normals.size(), 6u);
    EXPECT_TRUE(normals[0] == glm::vec3(0.0f) && normals[1] == glm::vec3(0.0f) && normals[5] == glm::vec3(0.0f));
    EXPECT_NEAR(glm::length(normals[2]), 1.0f, 1e-6f);
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_EQ(c.warnings[0], "mesh 0 primitive 0 NORMAL: 3 normals are zero or not finite; the faces' own instead");
    EXPECT_EQ(messageOf(square({0, 0, 1})), "t.glb: mesh 0 primitive 0 NORMAL: 1 element for 4 vertices");
}

/// The square with normals (unless `alone`), tangents and a node that places it.
GltfBuilder worn(const std::vector<float>& tangents, const std::string& place = "", bool alone = false) {
    GltfBuilder b;
    b.addFloats("VEC3", kSquareFloats);
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3});
    b.addFloats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    b.addFloats("VEC4", tangents);
    b.meshes = std::string(R"([{"primitives":[{"attributes":{"POSITION":0,"TANGENT":3)") +
               (alone ? "" : R"(,"NORMAL":2)") + R"(},"indices":1}]}])";
    b.nodes = R"([{"mesh":0)" + place + "}]";
    return b;
}

TEST(GltfTangents, AreReadPerCorner) {
    const Character c = readWell(worn({1, 0, 0, 1, 0, 2, 0, -1, 0.6f, 0.8f, 0, 1, 0, 0, 0, 1}));
    const std::vector<glm::vec4>& tangents = c.cage.cornerTangents;
    ASSERT_EQ(tangents.size(), 6u);
    EXPECT_EQ(tangents[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(tangents[1], glm::vec4(0, 1, 0, -1));
    EXPECT_LT(glm::length(tangents[2] - glm::vec4(0.6f, 0.8f, 0, 1)), 1e-6f);
    EXPECT_EQ(tangents[5], glm::vec4(0.0f));
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_EQ(c.warnings[0], "mesh 0 primitive 0 TANGENT: 1 tangent is zero or not finite; those of the texture "
                             "coordinates instead");
    EXPECT_TRUE(readWell(worn({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "", true)).cage.cornerTangents.empty())
        << "without normals they mean nothing";
    EXPECT_EQ(messageOf(worn({1, 0, 0, 1})), "t.glb: mesh 0 primitive 0 TANGENT: 1 element for 4 vertices");
}

/// A mirror turns faces round, and the hand of the frame.
TEST(GltfTangents, AreMirroredWithTheirNode) {
    const std::vector<float> tangents = {0.6f, 0.8f, 0, 1, 0.6f, 0.8f, 0, 1, 0.6f, 0.8f, 0, 1, 0.6f, 0.8f, 0, 1};
    const Character c = readWell(worn(tangents, R"(,"scale":[-1,1,1])"));
    ASSERT_EQ(c.cage.cornerTangents.size(), 6u);
    for (const glm::vec4& tangent : c.cage.cornerTangents) {
        EXPECT_LT(glm::length(tangent - glm::vec4(-0.6f, 0.8f, 0, -1)), 1e-6f);
    }
}

TEST(GltfNormals, WithoutThemTrianglesAreFlat) {
    const Character c = readWell(square({}));
    EXPECT_EQ(c.cage.cornerNormals, std::vector<glm::vec3>(6, glm::vec3(0.0f)));
}

TEST(GltfNormals, WithoutThemPolygonsAreLeftToCreases) {
    GltfBuilder b = square({}, R"(,"extensions":{"SUPPLE_mesh_cage":{"faceVertexCounts":2,"faceVertexIndices":3}})");
    b.addIntegers("SCALAR", 5123, {4});
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 3});
    const Character c = readWell(b);
    EXPECT_EQ(c.cage.faceCount(), 1u);
    EXPECT_TRUE(c.cage.cornerNormals.empty());
    EXPECT_EQ(c.cage.faceTriangles, (std::vector<uint32_t>{0, 2, 3, 0, 1, 2}));
}

/// An L in a fan from its first corner, which folds: other viewers show it so, but the polygon is known.
TEST(GltfNormals, ListedPolygonsAreNotCutByFansThatFold) {
    for (const bool listed : {true, false}) {
        GltfBuilder b;
        b.addFloats("VEC3", {2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0, 0, 0, 0});
        b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5});
        b.addIntegers("SCALAR", 5123, {6});
        b.addIntegers("SCALAR", 5123, {0, 1, 2, 3, 4, 5});
        b.meshes = std::string(R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{)") +
                   (listed ? R"("SUPPLE_mesh_cage":{"faceVertexCounts":2,"faceVertexIndices":3})"
                           : R"("FB_ngon_encoding":{})") +
                   "}}]}]";
        const Character c = readWell(b);
        ASSERT_EQ(c.cage.faceCount(), 1u);
        ASSERT_EQ(c.cage.faceTriangles.size(), 12u);
        EXPECT_EQ(foldsOver(c.cage.positions, c.cage.faceTriangles), !listed);
    }
}

/// The file cuts the square along its other diagonal.
TEST(GltfNormals, MergedPolygonsKeepTheFilesTriangles) {
    GltfBuilder b = plainMesh(kSquareFloats, {1, 2, 3, 1, 3, 0}, R"(,"extensions":{"FB_ngon_encoding":{}})");
    b.more = R"(,"extensionsUsed":["FB_ngon_encoding"])";
    const Character c = readWell(b);
    ASSERT_EQ(c.cage.faceCount(), 1u);
    std::vector<std::vector<uint32_t>> cut;
    const std::vector<uint32_t> triangles = triangulate(c.cage);
    ASSERT_EQ(triangles.size(), 6u);
    for (size_t t = 0; t < 6; t += 3) {
        std::vector<uint32_t> vertices;
        for (size_t k = 0; k < 3; ++k) {
            vertices.push_back(c.cage.faceVertices[triangles[t + k]]);
        }
        std::sort(vertices.begin(), vertices.end());
        cut.push_back(vertices);
    }
    std::sort(cut.begin(), cut.end());
    EXPECT_EQ(cut, (std::vector<std::vector<uint32_t>>{{0, 1, 3}, {1, 2, 3}}));
}

} // namespace
} // namespace supple::cage
