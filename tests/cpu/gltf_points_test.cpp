// Points of a glTF file's triangles: whatever a triangle has become, its corners are where the file has them.
#include "tests/cage/gltf/reading.h"
#include "tests/support/found_points.h"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace supple::test {
namespace {

/// Two quads and a pentagon of a flat patch of eight vertices.
///
///   6---7
///   | 2  `.
///   3---4---5
///   | 0 | 1 |
///   0---1---2
const std::vector<float> kFlatPositions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0};
const std::vector<uint32_t> kFlatTriangles = {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 3, 4, 6, 4, 7, 6, 4, 5, 7};

GltfBuilder flatPatch(const std::string& nodes = R"([{"mesh":0}])") {
    GltfBuilder b = plainMesh(kFlatPositions, kFlatTriangles);
    const std::string counts = std::to_string(b.addIntegers("SCALAR", 5123, {4, 4, 5}));
    const std::string corners = std::to_string(b.addIntegers("SCALAR", 5123, {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 5, 7, 6}));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{"SUPPLE_mesh_cage":)"
               R"({"faceVertexCounts":)" +
               counts + R"(,"faceVertexIndices":)" + corners + "}}}]}]";
    b.nodes = nodes;
    return b;
}

Surfaces surfacesOfFile(const GltfBuilder& b, SuppleScheme scheme, const cage::GltfOptions& options = kKeepTriangles) {
    return surfacesOf(readWell(b, options), scheme);
}

std::vector<SuppleSurfacePoint> foundOfFile(const Surfaces& surfaces, const std::vector<SuppleGltfPoint>& asked) {
    SupplePointQuery query = queryOf(SUPPLE_FIND_GLTF, asked.size());
    query.gltf = asked.data();
    return found(surfaces, query);
}

std::string refusalOf(const Surfaces& surfaces, const SuppleGltfPoint& asked) {
    SupplePointQuery query = queryOf(SUPPLE_FIND_GLTF, 1);
    query.gltf = &asked;
    SuppleSurfacePoint out{};
    std::shared_ptr<runtime::PointFinder> kept;
    const Status status = runtime::findPoints(surfaces, kept, query, {&out, 1});
    return status ? "accepted" : status.error().message;
}

/// Weights of the second and the third vertex of a triangle.
constexpr std::array<std::array<float, 2>, 7> kWeights = {
    {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {0.5f, 0.5f}, {0.0f, 0.5f}, {0.25f, 0.0f}, {0.25f, 0.5f}}};

/// Where the file has such a point, in the space of its mesh.
glm::vec3 placeInFile(uint32_t triangle, const std::array<float, 2>& weights) {
    glm::vec3 at(0.0f);
    const float all[] = {1.0f - weights[0] - weights[1], weights[0], weights[1]};
    for (size_t k = 0; k < 3; ++k) {
        const float* const p = &kFlatPositions[3 * size_t{kFlatTriangles[3 * size_t{triangle} + k]}];
        at += all[k] * glm::vec3(p[0], p[1], p[2]);
    }
    return at;
}

TEST(GltfPoints, LieInTheFacesThatTheTrianglesHaveBecome) {
    for (const auto& [nodes, side] : {std::pair(R"([{"mesh":0}])", 1.0f),
                                      std::pair(R"([{"mesh":0,"scale":[-1,1,1]}])", -1.0f)}) { // turns faces round
        const Surfaces surfaces = surfacesOfFile(flatPatch(nodes), SUPPLE_SCHEME_CAGE);
        ASSERT_NE(surfaces, nullptr);
        for (uint32_t triangle = 0; triangle < 7; ++triangle) {
            for (const std::array<float, 2>& weights : kWeights) {
                const auto points = foundOfFile(surfaces, {{0, 0, triangle, weights[0], weights[1]}});
                ASSERT_EQ(points[0].face, triangle < 2 ? 0u : triangle < 4 ? 1u : 2u);
                // Squares are met exactly. A pentagon has its corners and its edges; it is no regular one inside.
                const glm::vec3 expected = placeInFile(triangle, weights) * glm::vec3(side, 1.0f, 1.0f);
                const bool isCorner = weights[0] + weights[1] == 0.0f || weights[0] == 1.0f || weights[1] == 1.0f;
                if (triangle < 4 || isCorner) {
                    EXPECT_LT(glm::distance(at(surfaces, points).positions[0], expected), 1e-5f)
                        << "triangle " << triangle << " at " << weights[0] << ", " << weights[1];
                }
            }
        }
    }
}

TEST(GltfPoints, OfBothTrianglesOfAQuadMeetOnItsDiagonal) {
    const Surfaces surfaces = surfacesOfFile(flatPatch(), SUPPLE_SCHEME_CATMULL_CLARK);
    for (const float t : {0.0f, 0.125f, 0.5f, 0.75f, 1.0f}) { // from vertex 1 to vertex 3
        const auto points = foundOfFile(surfaces, {{0, 0, 0, 1.0f - t, t}, {0, 0, 1, 0.0f, t}});
        EXPECT_EQ(points[0].face, points[1].face);
        EXPECT_EQ(points[0].a, points[1].a);
        EXPECT_EQ(points[0].b, points[1].b);
    }
}

TEST(GltfPoints, AreFoundInPairedTriangles) {
    const GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3});
    for (const cage::Pairing pairing : {cage::Pairing::never, cage::Pairing::always}) {
        const Surfaces surfaces = surfacesOfFile(b, SUPPLE_SCHEME_CAGE, {.pairing = pairing});
        EXPECT_EQ(surfaces->cage().faceCount(), pairing == cage::Pairing::never ? 2u : 1u);
        const At met = at(surfaces, foundOfFile(surfaces, {{0, 0, 0, 0.25f, 0.25f}, {0, 0, 1, 0.25f, 0.25f}}));
        EXPECT_LT(glm::distance(met.positions[0], glm::vec3(0.5f, 0.25f, 0.0f)), 1e-6f);
        EXPECT_LT(glm::distance(met.positions[1], glm::vec3(0.25f, 0.5f, 0.0f)), 1e-6f);
    }
}

/// A triangle that reading has left out is none of the surface; those behind it keep their numbers.
TEST(GltfPoints, HaveNoFaceWhereATriangleIsGone) {
    const GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 1, 0, 1, 2, 0, 2, 3});
    const Surfaces surfaces = surfacesOfFile(b, SUPPLE_SCHEME_CAGE);
    const auto points = foundOfFile(surfaces, {{0, 0, 0, 0.5f, 0.0f}, {0, 0, 2, 0.0f, 1.0f}});
    EXPECT_EQ(points[0].face, SUPPLE_NO_FACE);
    EXPECT_LT(glm::distance(at(surfaces, {points[1]}).positions[0], glm::vec3(0.0f, 1.0f, 0.0f)), 1e-6f);
}

TEST(GltfPoints, SayWhatTheFileLacks) {
    const Surfaces surfaces = surfacesOfFile(flatPatch(), SUPPLE_SCHEME_CAGE);
    EXPECT_EQ(refusalOf(surfaces, {0, 0, 6, 0.5f, 0.5f}), "accepted");
    EXPECT_EQ(refusalOf(surfaces, {0, 0, 7, 0.5f, 0.5f}),
              "point 0: the character has no mesh 0 primitive 0 triangle 7");
    EXPECT_EQ(refusalOf(surfaces, {1, 0, 0, 0.5f, 0.5f}),
              "point 0: the character has no mesh 1 primitive 0 triangle 0");
    EXPECT_EQ(refusalOf(surfaces, {0, 1, 0, 0.5f, 0.5f}),
              "point 0: the character has no mesh 0 primitive 1 triangle 0");
    for (const float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(refusalOf(surfaces, {0, 0, 1, bad, 0.0f}),
                  "point 0: weights outside of mesh 0 primitive 0 triangle 1");
    }
    cage::Cage quad;
    quad.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    quad.faceStarts = {0, 4};
    quad.faceVertices = {0, 1, 2, 3};
    EXPECT_EQ(refusalOf(surfacesOf(quad, SUPPLE_SCHEME_CAGE), {0, 0, 0, 0.0f, 0.0f}),
              "the character was read from no glTF file, so it has no triangles of one");
}

/// Points that are given get what the surface is there.
TEST(GltfPoints, AndGivenOnesHaveJets) {
    const Surfaces surfaces = surfacesOfFile(flatPatch(), SUPPLE_SCHEME_CAGE);
    std::vector<SuppleSurfacePoint> points = {{1, 0, 0.25f, 0.5f}, {SUPPLE_NO_FACE, 0, 0.0f, 0.0f}, {0, 0, 1.0f, 1.0f}};
    std::vector<SuppleSurfaceJet> jets(points.size());
    SupplePointQuery query = queryOf(SUPPLE_FIND_GIVEN, points.size());
    query.jets = jets.data();
    std::shared_ptr<runtime::PointFinder> kept;
    ASSERT_TRUE(runtime::findPoints(surfaces, kept, query, points));
    EXPECT_EQ(points[0].face, 1u);
    EXPECT_NEAR(jets[0].position[0], 1.25f, 1e-6f);
    EXPECT_NEAR(jets[0].position[1], 0.5f, 1e-6f);
    EXPECT_NEAR(jets[0].du[0], 1.0f, 1e-6f);
    EXPECT_EQ(jets[1].position[0], 0.0f);
    EXPECT_NEAR(jets[2].position[0], 1.0f, 1e-6f);
    points[2].face = 99;
    EXPECT_FALSE(runtime::findPoints(surfaces, kept, query, points));
}

} // namespace
} // namespace supple::test
