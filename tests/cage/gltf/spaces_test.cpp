// Skinned meshes in spaces of their own stand side by side in the bind pose, are sewn there, and are seen from outside.
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// How positions are rounded to a grid of their own: the vertex p is at scale * (p - origin) there.
struct Grid {
    float scale;
    glm::vec3 origin;
};

/// Two plates in the xy plane that meet at x = 1, where both have vertices at y = 0, 0.3 and 1. Each is skinned to the
/// nodes 2 and 3 and given on a grid of its own, from which its inverse bind matrices lead back.
GltfBuilder twoPlates(const std::array<Grid, 2>& grids, const std::string& nodes) {
    GltfBuilder b;
    std::string meshes, skins;
    for (size_t p = 0; p < 2; ++p) {
        const float from = static_cast<float>(p), to = from + 1.0f;
        std::vector<uint32_t> positions, joints;
        std::vector<float> weights;
        for (const float y : {0.0f, 0.3f, 1.0f}) {
            for (const float x : {from, to}) {
                const glm::vec3 at = grids[p].scale * (glm::vec3(x, y, 0.0f) - grids[p].origin);
                for (int k = 0; k < 3; ++k) {
                    positions.push_back(static_cast<uint32_t>(std::lround(at[k])));
                }
                joints.insert(joints.end(), {0, 1, 0, 0});
                weights.insert(weights.end(), {0.75f, 0.25f, 0.0f, 0.0f});
            }
        }
        std::vector<float> binds;
        for (const float joint : {0.0f, 1.0f}) { // at (0, 0, 0) and (1, 0, 0)
            const float s = 1.0f / grids[p].scale;
            const glm::vec3 t = grids[p].origin - glm::vec3(joint, 0, 0);
            binds.insert(binds.end(), {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, t.x, t.y, t.z, 1});
        }
        const std::string comma = p == 0 ? "" : ",";
        meshes += comma + R"({"primitives":[{"attributes":{"POSITION":)" +
                  std::to_string(b.addIntegers("VEC3", 5123, positions)) + R"(,"JOINTS_0":)" +
                  std::to_string(b.addIntegers("VEC4", 5121, joints)) + R"(,"WEIGHTS_0":)" +
                  std::to_string(b.addFloats("VEC4", weights)) + R"(},"indices":)" +
                  std::to_string(b.addIntegers("SCALAR", 5123, {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4})) + "}]}";
        skins += comma + R"({"joints":[2,3],"inverseBindMatrices":)" + std::to_string(b.addFloats("MAT4", binds)) + "}";
    }
    b.meshes = "[" + meshes + "]";
    b.nodes = nodes;
    b.more = R"(,"skins":[)" + skins + R"(],"extensionsUsed":["KHR_mesh_quantization"])";
    return b;
}

const std::string kUpright = R"([{"mesh":0,"skin":0},{"mesh":1,"skin":1},{"children":[3]},{"translation":[1,0,0]}])";
constexpr std::array<Grid, 2> kGrids{Grid{32000.0f, {0, 0, 0}}, Grid{777.0f, {0.7f, -0.2f, -0.1f}}};

/// Where the pose of the nodes at rest puts the vertices.
std::vector<glm::vec3> atRest(const Character& c) {
    std::vector<glm::mat4> nodes(c.skeleton.nodes.size());
    for (const uint32_t n : c.skeleton.parentsFirst) {
        const Node& node = c.skeleton.nodes[n];
        glm::mat4 local(1.0f);
        for (int k = 0; k < 3; ++k) {
            local[k][k] = node.scale[k];
            local[3][k] = node.translation[k];
        }
        nodes[n] = node.parent == kNone ? local : nodes[node.parent] * local;
    }
    std::vector<glm::vec3> positions;
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        glm::vec3 sum(0.0f);
        for (uint32_t i = c.weights.starts[v]; i < c.weights.starts[v + 1]; ++i) {
            const Influence& influence = c.weights.influences[i];
            sum += influence.weight *
                   glm::vec3(nodes[c.skin.joints[influence.joint]] * c.skin.inverseBinds[influence.joint] *
                             glm::vec4(c.cage.positions[v], 1.0f));
        }
        positions.push_back(sum);
    }
    return positions;
}

/// Twice the area of a face, along its normal.
glm::vec3 areaOf(const Character& c, const std::vector<glm::vec3>& positions, uint32_t f) {
    const std::vector<uint32_t> corners = face(c.cage, f);
    return glm::cross(positions[corners[1]] - positions[corners[0]], positions[corners[2]] - positions[corners[0]]);
}

TEST(GltfSpaces, PartsOnGridsOfTheirOwnStandSideBySide) {
    const Character c = readWell(twoPlates(kGrids, kUpright).glb(), {.sewParts = false, .pairing = Pairing::never});
    ASSERT_EQ(c.cage.vertexCount(), 12u);
    EXPECT_EQ(c.cage.positions[1], glm::vec3(32000, 0, 0)) << "the first part says what the space is";
    for (uint32_t v = 0; v < 12; ++v) {
        const uint32_t part = v / 6, row = v % 6 / 2;
        const glm::vec3 wanted(static_cast<float>(part + v % 2), std::array{0.0f, 0.3f, 1.0f}[row], 0.0f);
        EXPECT_LE(glm::length(c.cage.positions[v] / 32000.0f - wanted), 1.0f / 777.0f) << v;
        EXPECT_LE(glm::length(atRest(c)[v] - wanted), 1.0f / 777.0f) << v;
    }
}

TEST(GltfSpaces, PartsOnGridsOfTheirOwnAreSewn) {
    const Character c = readWell(twoPlates(kGrids, kUpright));
    EXPECT_EQ(c.cage.vertexCount(), 9u);
    EXPECT_EQ(c.seamVertexCount, 3u);
    EXPECT_EQ(c.skin.joints.size(), 2u) << "joints that stand in one place are one";
    EXPECT_EQ(c.warnings,
              (Strings{"parts: 3 vertices are other parts' but for the rounding of their grids, the first is "
                       "part 1; sewn"}));
    EXPECT_EQ(readWell(twoPlates(kGrids, kUpright).glb(), {.sewParts = false}).cage.vertexCount(), 12u);
}

TEST(GltfSpaces, PartsOfOneSpaceAreLeftAlone) {
    const std::array<Grid, 2> same{Grid{100.0f, {0, 0, 0}}, Grid{100.0f, {0, 0, 0}}};
    const Character c = readWell(twoPlates(same, kUpright));
    EXPECT_EQ(c.cage.positions[8], glm::vec3(200, 100, 0));
    EXPECT_EQ(c.skin.inverseBinds[0][0][0], 0.01f);
    EXPECT_EQ(c.warnings, Strings());
}

TEST(GltfSpaces, APartOfANodeStandsBesideTheJointsOnAGrid) {
    GltfBuilder b = twoPlates(
        kGrids, R"([{"mesh":0,"skin":0},{"mesh":2,"translation":[0,4,0]},{"children":[3]},{"translation":[1,0,0]}])");
    b.meshes.back() = ',';
    b.meshes += R"({"primitives":[{"attributes":{"POSITION":)" +
                std::to_string(b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})) + R"(},"indices":)" +
                std::to_string(b.addIntegers("SCALAR", 5123, {0, 1, 2})) + "}]}]";
    const Character c = readWell(b.glb(), {.sewParts = false, .pairing = Pairing::never});
    ASSERT_EQ(c.cage.vertexCount(), 9u);
    for (const auto& [vertex, wanted] : {std::pair(6u, glm::vec3(0, 4, 0)), std::pair(7u, glm::vec3(1, 4, 0))}) {
        EXPECT_LE(glm::length(c.cage.positions[vertex] / 32000.0f - wanted), 1e-6f) << "no joint is above it";
        EXPECT_LE(glm::length(atRest(c)[vertex] - wanted), 1e-6f);
    }
}

/// glTF: what a negative determinant mirrors is wound the other way.
TEST(GltfSpaces, AMirroredSkeletonIsSeenFromOutside) {
    const std::string nodes = R"([{"mesh":0,"skin":0},{"mesh":1,"skin":1},{"children":[3]},{"translation":[1,0,0]},)"
                              R"({"scale":[-1,1,1],"children":[2]}])";
    const Character c = readWell(twoPlates(kGrids, nodes));
    EXPECT_EQ(c.cage.vertexCount(), 9u) << "sewn all the same";
    const std::vector<glm::vec3> posed = atRest(c);
    const Character upright = readWell(twoPlates(kGrids, kUpright));
    for (uint32_t f = 0; f < c.cage.faceCount(); ++f) {
        EXPECT_GT(areaOf(c, posed, f).z, 0.0f) << "as the file winds it, " << f;
        EXPECT_GT(areaOf(c, c.cage.positions, f).z, 0.0f) << "in the bind pose, too, " << f;
    }
    for (uint32_t v = 0; v < posed.size(); ++v) {
        EXPECT_NEAR(posed[v].x, -atRest(upright)[v].x, 1e-4f);
    }
}

/// One limb, a piece of its own, hangs on a joint that mirrors.
TEST(GltfSpaces, AMirroredLimbIsSeenFromOutside) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0, 3, 1, 0});
    b.addIntegers("VEC4", 5121, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    b.addFloats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"NORMAL":3}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{},{"scale":[-1,1,1]}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    const Character c = readWell(b);
    const std::vector<glm::vec3> posed = atRest(c);
    ASSERT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.cage.positions[1], glm::vec3(1, 0, 0)) << "the body is as it was";
    EXPECT_GT(areaOf(c, posed, 0).z, 0.0f);
    EXPECT_GT(areaOf(c, posed, 1).z, 0.0f);
    EXPECT_EQ(posed[face(c.cage, 1)[0]], glm::vec3(-3, 0, 0));
    EXPECT_EQ(c.cage.cornerNormals[3], glm::vec3(0, 0, 1));
}

/// Nothing is known of a piece that a scale of 0 hides: it is turned as its mesh is.
TEST(GltfSpaces, AHiddenPieceFollowsItsMesh) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0, 3, 1, 0});
    b.addIntegers("VEC4", 5121, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    b.addFloats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{"scale":[-1,1,1],"children":[2]},{"scale":[0,0,0]}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    const Character c = readWell(b);
    EXPECT_EQ(c.skin.joints.size(), 2u);
    EXPECT_EQ(c.cage.positions[1], glm::vec3(-1, 0, 0));
    EXPECT_EQ(c.cage.positions[4], glm::vec3(-4, 0, 0));
}

/// On a grid of many steps the linear part of a matrix is small beside its last element, but counts all the same.
TEST(GltfSpaces, JointsOfOtherScalesAreApart) {
    GltfBuilder b = twoPlates(kGrids, kUpright);
    b.setFloat(static_cast<QuadAccessor>(9), 16, 1.2f / 777.0f); // of the second plate's second joint, in x
    EXPECT_EQ(readWell(b.glb(), {.sewParts = false}).skin.joints.size(), 3u);
}

} // namespace
} // namespace supple::cage
