// How a file cuts its faces into triangles survives the repair of others.
#include "cage/triangulation.h"
#include "tests/cage/repair/repaired.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::cage {
namespace {

using namespace test;

/// Every quad cut from its second corner, which clipping ears does not do.
Cage withOtherDiagonals(Cage quads) {
    for (uint32_t f = 0; f < quads.faceCount(); ++f) {
        const uint32_t start = quads.faceStarts[f];
        for (const uint32_t k : {1u, 2u, 3u, 1u, 3u, 0u}) {
            quads.faceTriangles.push_back(start + k);
        }
    }
    return quads;
}

/// By source vertices, the smallest first; so the winding counts and the first corner does not.
using Triangle = std::array<uint32_t, 3>;
std::vector<Triangle> trianglesOf(const Cage& cage, uint32_t face) {
    const std::vector<uint32_t> corners = triangulate(cage);
    std::vector<Triangle> triangles;
    for (size_t t = 3 * (cage.faceStarts[face] - size_t{2} * face);
         t < 3 * (cage.faceStarts[face + 1] - size_t{2} * (face + 1)); t += 3) {
        Triangle triangle{};
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = cage.faceVertices[corners[t + k]];
            triangle[k] = cage.sourceVertices.empty() ? v : cage.sourceVertices[v];
        }
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        triangles.push_back(triangle);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

TEST(RepairTriangles, FacesThatKeepTheirCornersKeepTheirCut) {
    const Cage torus = withOtherDiagonals(supple::test::torus(8, 6));
    Cage damaged = torus;
    damaged.positions.emplace_back(9.0f, 9.0f, 9.0f); // in no face
    const Repaired r = repaired(damaged);
    ASSERT_EQ(r.cage.faceCount(), torus.faceCount());
    for (uint32_t f = 0; f < torus.faceCount(); ++f) {
        EXPECT_EQ(trianglesOf(r.cage, f), trianglesOf(torus, f)) << f;
    }
}

TEST(RepairTriangles, TheyTurnWithTheirFace) {
    const Cage torus = withOtherDiagonals(supple::test::torus(8, 6));
    Cage damaged = torus;
    for (const uint32_t f : {3u, 17u}) {
        const auto first = damaged.faceVertices.begin() + damaged.faceStarts[f];
        std::swap(first[1], first[3]); // the cut stays: corners 1 and 3 have changed places
    }
    const Repaired r = repaired(damaged);
    EXPECT_EQ(r.repairs, Strings{"turned round"});
    for (uint32_t f = 0; f < torus.faceCount(); ++f) {
        EXPECT_EQ(trianglesOf(r.cage, f), trianglesOf(torus, f)) << f;
    }
}

TEST(RepairTriangles, SheetsKeepThem) {
    // Three quads on the edge (0, 1).
    const Cage book = withOtherDiagonals(supple::test::makeCage(
        {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 1, 1}, {0, 0, 1}},
        {{1, 0, 3, 2}, {0, 1, 5, 4}, {0, 1, 6, 7}}));
    const Repaired r = repaired(book);
    EXPECT_EQ(r.cage.vertexCount(), 10u);
    for (uint32_t f = 0; f < book.faceCount(); ++f) {
        EXPECT_EQ(trianglesOf(r.cage, f), trianglesOf(book, f)) << f;
    }
}

TEST(RepairTriangles, MergedFacesAreCutAnew) {
    // A cube, one of whose quads is two with a vertex between them that only they have.
    const Cage cube = supple::test::cube();
    supple::test::Faces polygons = facesOf(cube);
    const std::vector<uint32_t> first = polygons[0];
    polygons[0] = {first[0], first[1], first[2], 8};
    polygons.push_back({first[2], first[3], first[0], 8});
    std::vector<glm::vec3> positions = cube.positions;
    positions.push_back(0.5f * (positions[first[0]] + positions[first[2]]));
    const Cage fold = withOtherDiagonals(supple::test::makeCage(positions, polygons));
    const Repaired r = repaired(fold);
    ASSERT_EQ(r.cage.faceCount(), 6u);
    EXPECT_EQ(r.cage.faceTriangles.size(), 36u);
    EXPECT_EQ(trianglesOf(r.cage, 0).size(), 2u);
    for (uint32_t f = 1; f < 6; ++f) {
        EXPECT_EQ(trianglesOf(r.cage, f), trianglesOf(fold, f)) << f;
    }
}

} // namespace
} // namespace supple::cage
