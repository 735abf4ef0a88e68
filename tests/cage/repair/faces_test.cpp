// Faces that are damaged on their own: empty ones, those that pass a vertex twice, and duplicates.
#include "tests/cage/repair/repaired.h"

namespace supple::cage {
namespace {

using namespace test;

/// Per corner, UVs and colors that tell which corner it is.
Cage withMarkedCorners(Cage cage) {
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        const auto mark = static_cast<float>(c);
        cage.cornerUvs.emplace_back(mark, 0.0f);
        cage.cornerUvs1.emplace_back(0.0f, mark);
        cage.cornerColors.emplace_back(mark, mark, mark, 1.0f);
    }
    return cage;
}

Indices marksOf(const Cage& cage) {
    Indices marks;
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        marks.push_back(static_cast<uint32_t>(cage.cornerUvs[c].x));
        EXPECT_EQ(cage.cornerUvs1[c].y, cage.cornerUvs[c].x);
        EXPECT_EQ(cage.cornerColors[c].x, cage.cornerUvs[c].x);
    }
    return marks;
}

TEST(RepairFaces, EmptyOnesAreLeftOut) {
    // No corner at all, one vertex, two vertices, and a spike that bounds nothing.
    Cage cage = supple::test::makeCage(points(6), {{0, 1, 2}, {}, {3}, {3, 4}, {3, 4, 3, 4}, {2, 1, 5}});
    cage.faceMaterials = {0, 1, 2, 3, 4, 5};
    cage.faceTrimTiles = {9, 8, 7, 6, 5, 4};
    cage.holes = {1, 5};
    const Repaired r = repaired(withMarkedCorners(cage));
    EXPECT_EQ(r.found, (Strings{"cage: 4 faces have fewer than three different vertices or bound nothing, the first is "
                                "face 1"}));
    EXPECT_EQ(r.repairs, Strings{"left out"});
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(r.cage.sourceVertices, (Indices{0, 1, 2, 5})) << "vertices that lost their faces are gone";
    EXPECT_EQ(r.cage.faceMaterials, (Indices{0, 5}));
    EXPECT_EQ(r.cage.faceTrimTiles, (Indices{9, 4}));
    EXPECT_EQ(r.cage.holes, Indices{1});
    EXPECT_EQ(marksOf(r.cage), (Indices{0, 1, 2, 10, 11, 12}));
}

TEST(RepairFaces, ZeroAreaIsOrdinary) {
    // Three different vertices on one line, and three in one place.
    std::vector<glm::vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
    Cage cage = supple::test::makeCage(line, {{0, 1, 2}, {2, 1, 3}});
    const Cage before = cage;
    SkinWeights weights;
    Morphs morphs;
    std::vector<Damage> damages;
    ASSERT_TRUE(repairCage(cage, weights, morphs, CageNames{{"cage"}, {}}, damages).ok());
    EXPECT_TRUE(damages.empty());
    EXPECT_EQ(cage.faceVertices, before.faceVertices);
}

TEST(RepairFaces, NothingLeftIsRefused) {
    EXPECT_EQ(repaired(points(3), {{0, 1}, {2, 2, 2}}).refusal,
              "cage: no face is left: all have fewer than three different vertices or bound nothing");
}

TEST(RepairFaces, RepeatedVerticesCutAFace) {
    // A quad whose last two corners are one vertex; two triangles that meet in vertex 0 as one face; a triangle with a
    // spike; and an untouched one.
    Cage cage = supple::test::makeCage(points(13), {{0, 1, 2, 2}, {3, 4, 5, 3, 6, 7}, {8, 9, 10, 9, 11}, {2, 1, 12}});
    cage.faceMaterials = {0, 1, 2, 3};
    const Repaired r = repaired(withMarkedCorners(cage));
    EXPECT_EQ(r.found, (Strings{"cage: 3 faces pass a vertex twice, the first is face 0",
                                "cage: 1 vertex has faces that are no single fan: vertex 3 of 2 fans"}))
        << "vertex 10 was a spike's";
    EXPECT_EQ(r.repairs, (Strings{"cut into simple faces", "one vertex for each fan"}));
    // Vertex 10 is gone, 11 and 12 have become 10 and 11, and vertex 3 is repeated behind it.
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 2}, {3, 4, 5}, {12, 6, 7}, {8, 9, 10}, {2, 1, 11}}));
    EXPECT_EQ(r.cage.sourceVertices, (Indices{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 3}));
    EXPECT_EQ(r.cage.faceMaterials, (Indices{0, 1, 1, 2, 3}));
    EXPECT_EQ(marksOf(r.cage), (Indices{0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 13, 14, 15, 16, 17}));
}

/// Twice the area that the faces have in the xy plane.
double areaOf(const Cage& cage) {
    double area = 0.0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const glm::vec3 a = cage.positions[cage.faceVertices[c]];
            const glm::vec3 b =
                cage.positions[cage.faceVertices[c + 1 < cage.faceStarts[f + 1] ? c + 1 : cage.faceStarts[f]]];
            area += double{a.x} * b.y - double{a.y} * b.x;
        }
    }
    return area;
}

/// Two squares of side 4 beside each other, and a square of side 2 in the middle of the first.
const std::vector<glm::vec3> kSquares{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {3, 1, 0},
                                      {3, 3, 0}, {1, 3, 0}, {6, 0, 0}, {9, 0, 0}, {9, 4, 0}, {6, 4, 0}};

TEST(RepairFaces, AFaceThatGoesRoundAHoleBecomesARing) {
    // Along the square, over the bridge from 0 to 4, round the hole and back; once with a spike at 2.
    for (const std::vector<uint32_t>& face :
         Faces{{0, 1, 2, 3, 0, 4, 7, 6, 5, 4}, {5, 4, 0, 1, 2, 8, 2, 3, 0, 4, 7, 6}}) {
        Cage cage = supple::test::makeCage(kSquares, {face});
        const Repaired r = repaired(withMarkedCorners(cage));
        ASSERT_EQ(r.found.size(), 2u) << "and vertices without a face";
        EXPECT_EQ(r.found[1], "cage: 1 face goes round a hole over a bridge: face 0");
        EXPECT_EQ(r.repairs[1], "cut into quads and triangles round it");
        EXPECT_EQ(r.cage.faceCount(), 4u);
        EXPECT_EQ(r.cage.cornerCount(), 16u) << "quads";
        EXPECT_EQ(r.cage.vertexCount(), 8u);
        EXPECT_EQ(areaOf(r.cage), 2.0 * (16 - 4));
        const Result<Topology> topology = buildTopology(r.cage);
        ASSERT_TRUE(topology.ok());
        EXPECT_EQ(topology->edges.size(), 12u) << "one piece with one hole";
    }
}

TEST(RepairFaces, OnlyHolesMakeRings) {
    // Two squares with a bridge between them; a square whose hole would lie outside of it; a hole that turns as the
    // face.
    for (const std::vector<uint32_t>& face :
         Faces{{0, 1, 8, 9, 10, 11, 8, 1, 2, 3}, {0, 1, 8, 11, 10, 9, 8, 1, 2, 3}, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}) {
        Cage cage = supple::test::makeCage(kSquares, {face});
        const Repaired r = repaired(withMarkedCorners(cage));
        ASSERT_GE(r.found.size(), 2u) << "and vertices without a face";
        EXPECT_EQ(r.found[1], "cage: 1 face passes a vertex twice: face 0");
        EXPECT_EQ(r.cage.faceCount(), 2u);
    }
}

TEST(RepairFaces, DuplicatesAreLeftOut) {
    // Once more, begun elsewhere, and turned round; the same vertices in another order are another face.
    Faces polygons = facesOf(supple::test::cube());
    Faces damaged = polygons;
    std::vector<uint32_t> again = polygons[2];
    std::rotate(again.begin(), again.begin() + 1, again.end());
    damaged.push_back(again);
    std::vector<uint32_t> turned = polygons[4];
    std::reverse(turned.begin(), turned.end());
    damaged.insert(damaged.begin(), turned);
    const Repaired r = repaired(supple::test::cube().positions, damaged);
    EXPECT_EQ(r.found[0], "cage: 2 faces are there twice, the first is face 5 is face 0 again");
    EXPECT_EQ(r.repairs[0], "left out");
    EXPECT_EQ(r.cage.faceCount(), 6u);
    EXPECT_EQ(r.cage.vertexCount(), 8u);
    // The turned one came first, and was turned back.
    ASSERT_EQ(r.found.size(), 2u);
    EXPECT_EQ(r.found[1], "cage: 1 face is turned against its neighbours: face 0");
}

TEST(RepairFaces, ATwoSidedSheetIsOneFace) {
    const Repaired r = repaired(points(4), {{0, 1, 2, 3}, {3, 2, 1, 0}});
    EXPECT_EQ(r.found, Strings{"cage: 1 face is there twice: face 1 is face 0 again"});
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 2, 3}}));
}

} // namespace
} // namespace supple::cage
