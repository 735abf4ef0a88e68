// Cages that would take long, or much memory, if a repair looked at every pair of something. None of these judges a
// time: a repair that is not near-linear does not come to an end here.
#include "tests/cage/repair/repaired.h"

#include <cmath>

namespace supple::cage {
namespace {

using namespace test;

Cage fromTriangles(std::vector<glm::vec3> positions, std::vector<uint32_t> corners) {
    Cage cage;
    cage.positions = std::move(positions);
    cage.faceVertices = std::move(corners);
    for (uint32_t c = 0; c <= cage.faceVertices.size(); c += 3) {
        cage.faceStarts.push_back(c);
    }
    return cage;
}

TEST(RepairHostile, AFaceAMillionTimes) {
    std::vector<uint32_t> corners;
    for (uint32_t i = 0; i < 1000000; ++i) {
        corners.insert(corners.end(), {i % 3, (i + 1 + i % 2) % 3, (i + 2 - i % 2) % 3});
    }
    const Repaired r = repaired(fromTriangles(points(3), std::move(corners)));
    EXPECT_EQ(r.found, Strings{"cage: 999999 faces are there twice, the first is face 1 is face 0 again"});
    EXPECT_EQ(r.cage.faceCount(), 1u);
    EXPECT_EQ(r.cage.vertexCount(), 3u);
}

TEST(RepairHostile, AFaceOfAHundredThousandTCorners) {
    constexpr uint32_t kSides = 100000;
    constexpr double kTurn = 6.283185307179586;
    const auto at = [&](double side, double radius) {
        const double angle = kTurn * side / kSides;
        return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    };
    std::vector<glm::vec3> positions;
    Faces faces(1);
    for (uint32_t i = 0; i < kSides; ++i) { // a corner, the middle of a side, and a point outside
        positions.push_back(at(i, 1000.0));
        positions.push_back(0.5f * (at(i, 1000.0) + at(i + 1.0, 1000.0)));
        positions.push_back(at(i + 0.5, 1001.0));
    }
    for (uint32_t i = 0; i < kSides; ++i) {
        const uint32_t a = 3 * i, b = 3 * ((i + 1) % kSides);
        faces[0].push_back(a);
        faces.push_back({a + 1, a, a + 2});
        faces.push_back({b, a + 1, a + 2});
    }
    const Repaired r = afterRepair(makeCage(std::move(positions), faces));
    ASSERT_FALSE(r.found.empty());
    EXPECT_EQ(r.found[0].find("cage: 100000 T-corners, the first is vertex 1 on edge (0, 3) of face 0"), 0u)
        << r.found[0];
    EXPECT_EQ(r.cage.sides(0), 2 * kSides);
}

TEST(RepairHostile, AnEdgeOfAHundredThousandFaces) {
    constexpr uint32_t kFaces = 100000;
    std::vector<glm::vec3> positions{{0, 0, 0}, {0, 0, 1}};
    std::vector<uint32_t> corners;
    for (uint32_t f = 0; f < kFaces; ++f) {
        positions.emplace_back(std::cos(0.01 * f), std::sin(0.01 * f), 0.5f);
        corners.insert(corners.end(), {f % 2, 1 - f % 2, f + 2});
    }
    Cage cage = fromTriangles(std::move(positions), std::move(corners));
    cage.creases.assign(kFaces, {0, 1, 2.0f});
    cage.sharpVertices.assign(kFaces, {0, 2.0f});
    cage.creaseScalars.assign(kFaces, {0, 1, 0.5f});
    const Repaired r = repaired(cage);
    EXPECT_EQ(r.found, Strings{"cage: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2, 3, 4, 5, 6, 7, "
                               "..."});
    EXPECT_EQ(r.cage.faceCount(), kFaces);
    EXPECT_EQ(r.cage.vertexCount(), 2 * kFaces) << "sheets of two faces, with an edge of their own each";
    EXPECT_EQ(r.cage.creases.size(), kFaces / 2) << "once for each edge, however often the crease is given";
    EXPECT_EQ(r.cage.sharpVertices.size(), kFaces) << "both ends of each";
    EXPECT_EQ(r.cage.creaseScalars.size(), kFaces / 2);
}

TEST(RepairHostile, AVertexOfAHundredThousandFans) {
    constexpr uint32_t kFaces = 100000;
    std::vector<uint32_t> corners;
    for (uint32_t f = 0; f < kFaces; ++f) {
        corners.insert(corners.end(), {0, 2 * f + 1, 2 * f + 2});
    }
    Cage cage = fromTriangles(points(2 * kFaces + 1), std::move(corners));
    SkinWeights weights;
    weights.starts = {0, 2};
    weights.influences = {{0, 0.5f}, {1, 0.5f}};
    for (uint32_t v = 1; v <= 2 * kFaces; ++v) {
        weights.influences.push_back({0, 1.0f});
        weights.starts.push_back(static_cast<uint32_t>(weights.influences.size()));
    }
    const Repaired r = repaired(cage, weights);
    EXPECT_EQ(r.found, Strings{"cage: 1 vertex has faces that are no single fan: vertex 0 of 100000 fans"});
    EXPECT_EQ(r.cage.vertexCount(), 3 * kFaces);
    EXPECT_EQ(r.weights.influences.size(), 4 * kFaces);
}

TEST(RepairHostile, CopiesOfManyDisplacementsAreRefused) {
    // 100,000 fans at a vertex that 1,000 targets move.
    constexpr uint32_t kFaces = 100000;
    std::vector<uint32_t> corners;
    for (uint32_t f = 0; f < kFaces; ++f) {
        corners.insert(corners.end(), {0, 2 * f + 1, 2 * f + 2});
    }
    Morphs morphs;
    for (uint32_t t = 0; t < 1000; ++t) {
        morphs.targets.push_back({"", {0}, {{1, 0, 0}}});
    }
    EXPECT_EQ(repaired(fromTriangles(points(2 * kFaces + 1), std::move(corners)), {}, morphs).refusal,
              "cage: repairing it would copy more than 67108864 influences or displacements");
}

TEST(RepairHostile, AFaceThatPassesTheSameVerticesAgainAndAgain) {
    Cage cage;
    cage.positions = points(5);
    for (uint32_t c = 0; c < 1000000; ++c) {
        cage.faceVertices.push_back(c % 4);
    }
    cage.faceVertices.push_back(4);
    cage.faceStarts = {0, cage.cornerCount()};
    const Repaired r = repaired(cage);
    EXPECT_EQ(r.found[0], "cage: 1 face passes a vertex twice: face 0");
    EXPECT_LT(r.cage.faceCount(), 4u);
}

TEST(RepairHostile, FoldsAllRoundAFace) {
    // A wheel of triangles that share two edges each with one huge face, and more on their outside.
    constexpr uint32_t kSides = 30000;
    std::vector<std::vector<uint32_t>> polygons(1);
    for (uint32_t i = 0; i < kSides; ++i) {
        polygons[0].push_back(2 * i);
        polygons[0].push_back(2 * i + 1);
        polygons.push_back({2 * i + 1, 2 * i, (2 * i + 2) % (2 * kSides)});
    }
    const Repaired r = repaired(points(2 * kSides), polygons);
    EXPECT_EQ(r.found.size(), 1u);
    EXPECT_TRUE(r.refusal.empty());
}

} // namespace
} // namespace supple::cage
