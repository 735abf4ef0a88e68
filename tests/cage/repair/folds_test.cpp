// Inner vertices of two faces.
#include "tests/cage/repair/repaired.h"

#include <map>

namespace supple::cage {
namespace {

using namespace test;

/// A cube whose first face is two: (0, v, 2, 1) and (2, v, 0, 3) as numbered by that face's corners, with v vertex 8.
Cage cubeWithFold() {
    const Cage cube = supple::test::cube();
    std::vector<glm::vec3> positions = cube.positions;
    Faces polygons = facesOf(cube);
    const std::vector<uint32_t> q = polygons[0];
    positions.push_back(0.5f * (positions[q[0]] + positions[q[2]]));
    polygons[0] = {q[0], q[1], q[2], 8};
    polygons.push_back({q[2], q[3], q[0], 8});
    return supple::test::makeCage(positions, polygons);
}

std::map<uint32_t, uint32_t> bySides(const Cage& cage) {
    std::map<uint32_t, uint32_t> counts;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        ++counts[cage.sides(f)];
    }
    return counts;
}

TEST(RepairFolds, TheTwoFacesAreMerged) {
    const Cage fold = cubeWithFold();
    const Repaired r = repaired(fold);
    EXPECT_EQ(r.found, Strings{"cage: 1 inner vertex has two faces only: vertex 8 between faces 0 and 6"});
    EXPECT_EQ(r.repairs, Strings{"dissolved"});
    EXPECT_EQ(r.cage.vertexCount(), 8u);
    EXPECT_EQ(bySides(r.cage), (std::map<uint32_t, uint32_t>{{4, 6}}));
    for (uint32_t f = 1; f < 6; ++f) {
        EXPECT_EQ(facesOf(r.cage)[f], facesOf(fold)[f]);
    }
}

TEST(RepairFolds, DifferentMaterialsKeepTheirBorder) {
    Cage fold = cubeWithFold();
    fold.faceMaterials.assign(7, 0);
    fold.faceMaterials[6] = 1;
    const Repaired r = repaired(fold);
    EXPECT_EQ(r.repairs, Strings{"dissolved"});
    EXPECT_EQ(r.cage.vertexCount(), 8u);
    EXPECT_EQ(bySides(r.cage), (std::map<uint32_t, uint32_t>{{3, 2}, {4, 5}}));
    EXPECT_EQ(r.cage.faceMaterials, (Indices{0, 0, 0, 0, 0, 0, 1}));
    fold.faceMaterials.clear();
    fold.faceTrimTiles.assign(7, 2);
    fold.faceTrimTiles[0] = kNone;
    EXPECT_EQ(repaired(fold).cage.faceCount(), 7u);
    fold.faceTrimTiles.clear();
    fold.holes = {6};
    EXPECT_EQ(repaired(fold).cage.holes, Indices{6});
}

TEST(RepairFolds, AVertexInAnEdgeLeavesIt) {
    // A cube with a vertex in the middle of an edge: merging its two faces would fold the ends of the edge in turn.
    const Cage cube = supple::test::cube();
    std::vector<glm::vec3> positions = cube.positions;
    Faces polygons = facesOf(cube);
    const uint32_t a = polygons[0][0];
    const uint32_t b = polygons[0][1];
    positions.push_back(0.5f * (positions[a] + positions[b]));
    for (std::vector<uint32_t>& face : polygons) {
        for (size_t k = 0; k < 4; ++k) {
            if (std::minmax(face[k], face[(k + 1) % 4]) == std::minmax(a, b)) {
                face.insert(face.begin() + static_cast<ptrdiff_t>(k) + 1, 8);
                break;
            }
        }
    }
    Cage fold = supple::test::makeCage(positions, polygons);
    ASSERT_EQ(bySides(fold), (std::map<uint32_t, uint32_t>{{4, 4}, {5, 2}}));
    EXPECT_EQ(bySides(repaired(fold).cage), (std::map<uint32_t, uint32_t>{{4, 6}}));
    // A crease along both halves runs along the whole edge.
    fold.creases = {{a, 8, 2.0f}, {8, b, 3.0f}};
    const Repaired creased = repaired(fold);
    EXPECT_EQ(creased.cage.faceCount(), 6u);
    ASSERT_EQ(creased.cage.creases.size(), 1u);
    EXPECT_EQ(std::minmax(creased.cage.creases[0].a, creased.cage.creases[0].b), std::minmax(a, b));
    EXPECT_EQ(creased.cage.creases[0].sharpness, 3.0f);
}

const char* const kKept = "kept, and a face cut by an edge to it";

TEST(RepairFolds, SharpOnesStay) {
    Cage fold = cubeWithFold();
    fold.creases = {{8, fold.faceVertices[0], kHardSharpness}};
    const Repaired r = repaired(fold);
    EXPECT_EQ(r.repairs, Strings{kKept});
    EXPECT_EQ(r.cage.vertexCount(), 9u);
    EXPECT_EQ(bySides(r.cage), (std::map<uint32_t, uint32_t>{{3, 2}, {4, 6}}));
    EXPECT_EQ(r.cage.creases.size(), 1u);
    fold.creases.clear();
    fold.sharpVertices = {{8, 1.0f}};
    EXPECT_EQ(repaired(fold).cage.sharpVertices.size(), 1u);
}

TEST(RepairFolds, WhatShapesTheSurfaceStays) {
    Cage fold = cubeWithFold();
    const glm::vec3 inwards = -fold.positions[8]; // the cube's middle is the origin
    fold.positions[8] += 0.1f * inwards;
    EXPECT_EQ(repaired(fold).repairs, Strings{"dissolved"}) << "this hardly bends the edge";
    fold.positions[8] += 0.7f * inwards;
    const glm::vec3 dent = fold.positions[8];
    fold.faceMaterials = {1, 0, 0, 0, 0, 0, 2};
    const Repaired r = repaired(fold);
    EXPECT_EQ(r.repairs, Strings{kKept});
    ASSERT_EQ(r.cage.vertexCount(), 9u);
    EXPECT_EQ(r.cage.positions[8], dent);
    EXPECT_EQ(bySides(r.cage), (std::map<uint32_t, uint32_t>{{3, 2}, {4, 6}}));
    EXPECT_EQ(r.cage.faceMaterials, (Indices{1, 1, 0, 0, 0, 0, 0, 2})) << "the two of the cut face stand together";
    const Result<Topology> topology = buildTopology(r.cage);
    ASSERT_TRUE(topology.ok());
    EXPECT_EQ(topology->spokeCount(8), 3u);
    EXPECT_EQ(topology->boundary[8], 0);
}

TEST(RepairFolds, AChainOfThem) {
    // Two faces that share a path of three edges.
    const Cage cube = supple::test::cube();
    std::vector<glm::vec3> positions = cube.positions;
    Faces polygons = facesOf(cube);
    const std::vector<uint32_t> q = polygons[0];
    positions.push_back(0.7f * positions[q[0]] + 0.3f * positions[q[2]]);
    positions.push_back(0.3f * positions[q[0]] + 0.7f * positions[q[2]]);
    polygons[0] = {q[0], q[1], q[2], 9, 8};
    polygons.push_back({8, 9, q[2], q[3], q[0]});
    const Repaired r = repaired(positions, polygons);
    EXPECT_EQ(r.found,
              Strings{"cage: 2 inner vertices have two faces only, the first is vertex 8 between faces 0 and 6"});
    EXPECT_EQ(r.cage.vertexCount(), 8u);
    EXPECT_EQ(r.cage.faceCount(), 6u);
}

TEST(RepairFolds, MergingMayLeaveAnother) {
    // A pillow of two triangles, one of which is three: merging two leaves two on each other's backs.
    const Repaired r = repaired(points(5), {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}, {4, 0, 1}});
    EXPECT_TRUE(r.refusal.empty());
    // A double wedge: valence 2 at 3, then at 2.
    const Repaired wedge = repaired(points(5), {{0, 1, 3, 2}, {0, 2, 3, 4}, {0, 4, 3, 1}});
    EXPECT_EQ(wedge.found.size(), 1u);
    EXPECT_GE(wedge.cage.faceCount(), 1u);
}

} // namespace
} // namespace supple::cage
