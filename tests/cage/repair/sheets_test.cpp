// Edges of three and more faces are cut into sheets.
#include "tests/cage/repair/repaired.h"

#include <cmath>
#include <numbers>

namespace supple::cage {
namespace {

using namespace test;

/// Quads round the edge (0, 1), at these angles in degrees; every quad has two vertices of its own. Those of an angle
/// of 1000 and more run the other way, at the angle less 1000.
Cage book(const std::vector<double>& angles) {
    std::vector<glm::vec3> positions{{0, 0, 0}, {0, 0, 1}};
    Faces polygons;
    for (const double angle : angles) {
        const double turn = std::fmod(angle, 1000.0) * std::numbers::pi / 180.0;
        const auto a = static_cast<uint32_t>(positions.size());
        positions.emplace_back(std::cos(turn), std::sin(turn), 0.0f);
        positions.emplace_back(std::cos(turn), std::sin(turn), 1.0f);
        polygons.push_back(angle >= 1000.0 ? std::vector<uint32_t>{1, 0, a, a + 1}
                                           : std::vector<uint32_t>{0, 1, a + 1, a});
    }
    return supple::test::makeCage(positions, polygons);
}

/// Whether faces f and g of the repaired cage have an edge in common.
bool joined(const Cage& cage, uint32_t f, uint32_t g) {
    const Topology topology = *buildTopology(cage);
    for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
        if (topology.twins[c] != kNone && topology.cornerFaces[topology.twins[c]] == g) {
            return true;
        }
    }
    return false;
}

TEST(RepairSheets, AFinLeavesTheFlatPairJoined) {
    const Repaired r = repaired(book({0, 90, 1180}));
    EXPECT_EQ(r.found, Strings{"cage: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2"});
    EXPECT_EQ(r.repairs, Strings{"cut into sheets, 2 vertices repeated"});
    EXPECT_TRUE(joined(r.cage, 0, 2));
    EXPECT_FALSE(joined(r.cage, 0, 1));
    EXPECT_EQ(r.cage.sourceVertices, (Indices{0, 1, 2, 3, 4, 5, 6, 7, 0, 1})) << "copies come behind, in order";
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 3, 2}, {8, 9, 5, 4}, {1, 0, 6, 7}}));
    EXPECT_EQ(r.cage.positions[8], r.cage.positions[0]);
}

TEST(RepairSheets, SheetsStayTogetherAlongAHardCrease) {
    // Two quads flat, and a fin of two quads along the edges (0, 1) and (1, 2) between them: one vertex runs on.
    std::vector<glm::vec3> positions;
    for (const float x : {0.0f, 1.0f, -1.0f}) {
        for (uint32_t z = 0; z < 3; ++z) {
            positions.emplace_back(x, 0.0f, z);
        }
    }
    for (uint32_t z = 0; z < 3; ++z) {
        positions.emplace_back(0.0f, 1.0f, z);
    }
    const Repaired r =
        repaired(positions, {{0, 1, 4, 3}, {1, 2, 5, 4}, {1, 0, 6, 7}, {2, 1, 7, 8}, {0, 1, 10, 9}, {1, 2, 11, 10}});
    EXPECT_EQ(r.found, Strings{"cage: 2 edges have three or more faces, the first is edge (0, 1) of faces 0, 2, 4"});
    std::vector<std::pair<uint32_t, uint32_t>> hard;
    for (const Crease& crease : r.cage.creases) {
        EXPECT_EQ(crease.sharpness, kHardSharpness);
        hard.emplace_back(crease.a, crease.b);
    }
    EXPECT_EQ(hard, (std::vector<std::pair<uint32_t, uint32_t>>{{0, 1}, {12, 13}, {1, 2}, {13, 14}}));
    Indices pinned;
    for (const SharpVertex& vertex : r.cage.sharpVertices) {
        pinned.push_back(vertex.vertex);
    }
    EXPECT_EQ(pinned, (Indices{0, 12, 2, 14})) << "where the edges end; the curve runs through 1 and 13";
}

TEST(RepairSheets, WhatRunsTheRightWayComesFirst) {
    // The flat pair runs the same way: the bent one fits.
    EXPECT_TRUE(joined(repaired(book({0, 1090, 180})).cage, 0, 1));
}

TEST(RepairSheets, TheSmallerBendWins) {
    EXPECT_TRUE(joined(repaired(book({0, 1100, 1170})).cage, 0, 2));
    EXPECT_TRUE(joined(repaired(book({0, 1170, 1100})).cage, 0, 1));
}

TEST(RepairSheets, TheLowestFacesWinAmongEquals) {
    const Repaired r = repaired(book({0, 1090, 1270}));
    EXPECT_TRUE(joined(r.cage, 0, 1));
    EXPECT_FALSE(joined(r.cage, 0, 2));
}

TEST(RepairSheets, FourFacesMakeTwoSheets) {
    const Repaired r = repaired(book({0, 90, 1180, 1270}));
    EXPECT_TRUE(joined(r.cage, 0, 2));
    EXPECT_TRUE(joined(r.cage, 1, 3));
    EXPECT_EQ(r.cage.vertexCount(), 12u);
}

TEST(RepairSheets, WhatNothingFitsIsTurned) {
    // All run the same way: the flat pair is joined, and one of it turned.
    const Repaired r = repaired(book({0, 90, 180}));
    EXPECT_TRUE(joined(r.cage, 0, 2));
    ASSERT_EQ(r.found.size(), 2u);
    EXPECT_EQ(r.found[1], "cage: 1 face is turned against its neighbours: face 2");
}

/// Two cubes that have an edge in common: each stays closed.
TEST(RepairSheets, CubesThatTouchAlongAnEdge) {
    Cage cage = supple::test::cube();
    // The edge from (1, 1, -1) to (1, 1, 1) of one is the edge from (-1, -1, ..) of the other.
    const auto find = [&](glm::vec3 p) {
        return static_cast<uint32_t>(std::find(cage.positions.begin(), cage.positions.end(), p) -
                                     cage.positions.begin());
    };
    const Cage one = cage;
    Indices numbers(8);
    for (uint32_t v = 0; v < 8; ++v) {
        const glm::vec3 moved = one.positions[v] + glm::vec3(2, 2, 0);
        numbers[v] = find(moved);
        if (numbers[v] == cage.vertexCount()) {
            cage.positions.push_back(moved);
        }
    }
    for (const uint32_t v : one.faceVertices) {
        cage.faceVertices.push_back(numbers[v]);
        if (cage.faceVertices.size() % 4 == 0) {
            cage.faceStarts.push_back(cage.cornerCount());
        }
    }
    ASSERT_EQ(cage.vertexCount(), 14u);
    const Repaired r = repaired(cage);
    EXPECT_EQ(r.found.size(), 1u);
    EXPECT_EQ(r.cage.vertexCount(), 16u);
    const Topology topology = *buildTopology(r.cage);
    for (uint32_t v = 0; v < 16; ++v) {
        EXPECT_EQ(topology.boundary[v], 0);
        EXPECT_EQ(topology.sectorCount(v), 3u);
    }
}

/// A surface that is pinched along an edge in its middle, both ends of which are otherwise whole: no choice of pairs
/// leaves both ends one vertex.
TEST(RepairSheets, APinchedTubeIsCut) {
    // An octagonal tube along z, whose rings at z = 2 and z = 3 are pinched: two opposite corners are one vertex.
    std::vector<glm::vec3> positions;
    Faces polygons;
    Indices numbers;
    for (uint32_t ring = 0; ring < 6; ++ring) {
        for (uint32_t k = 0; k < 8; ++k) {
            const bool pinched = (ring == 2 || ring == 3) && k % 4 == 0;
            if (pinched && k == 4) {
                numbers.push_back(numbers[numbers.size() - 4]);
                continue;
            }
            numbers.push_back(static_cast<uint32_t>(positions.size()));
            const double turn = std::numbers::pi * k / 4.0;
            positions.emplace_back(pinched ? 0.0 : std::cos(turn), std::sin(turn), ring);
        }
    }
    for (uint32_t ring = 0; ring + 1 < 6; ++ring) {
        for (uint32_t k = 0; k < 8; ++k) {
            const auto at = [&](uint32_t r, uint32_t i) { return numbers[8 * r + i % 8]; };
            polygons.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
        }
    }
    const Repaired r = repaired(positions, polygons);
    EXPECT_EQ(r.found.size(), 1u);
    EXPECT_EQ(r.cage.faceCount(), 40u);
    EXPECT_GT(r.cage.vertexCount(), positions.size());
}

TEST(RepairSheets, EverythingFollowsTheCopies) {
    Cage cage = book({0, 90, 1180});
    cage.creases = {{1, 0, 3.0f}, {0, 2, 5.0f}, {4, 0, 2.0f}, {2, 7, 1.0f}};
    cage.sharpVertices = {{1, 4.0f}, {5, 6.0f}, {1, 2.0f}};
    cage.creaseScalars = {{0, 1, 0.5f}, {3, 2, 0.25f}};
    SkinWeights weights;
    for (uint32_t v = 0; v <= 8; ++v) {
        weights.starts.push_back(2 * v);
        for (uint32_t k = 0; k < 2 && v < 8; ++k) {
            weights.influences.push_back({v + k, 0.5f});
        }
    }
    Morphs morphs;
    morphs.targets.push_back({"smile", {1, 5}, {{1, 0, 0}, {5, 0, 0}}});
    morphs.targets.push_back({"frown", {7}, {{7, 0, 0}}});
    const Repaired r = repaired(cage, weights, morphs);
    // Vertices 8 and 9 repeat 0 and 1 for face 1.
    ASSERT_EQ(r.cage.vertexCount(), 10u);
    const auto creases = [&] {
        std::vector<std::array<float, 3>> list;
        for (const Crease& c : r.cage.creases) {
            list.push_back({static_cast<float>(c.a), static_cast<float>(c.b), c.sharpness});
        }
        return list;
    }();
    EXPECT_EQ(creases, (std::vector<std::array<float, 3>>{{1, 0, 10}, {9, 8, 10}, {0, 2, 5}, {4, 8, 2}, {2, 7, 1}}))
        << "(2, 7) is no edge and stays to be told so";
    Indices sharp;
    for (const SharpVertex& vertex : r.cage.sharpVertices) {
        sharp.push_back(vertex.vertex);
        EXPECT_EQ(vertex.sharpness, vertex.vertex == 5 ? 6.0f : kHardSharpness);
    }
    EXPECT_EQ(sharp, (Indices{1, 9, 5, 0, 8})) << "the ends of the cut edge are hard";
    ASSERT_EQ(r.cage.creaseScalars.size(), 3u);
    EXPECT_EQ(r.cage.creaseScalars[1].vertex, 8u);
    EXPECT_EQ(r.cage.creaseScalars[1].toward, 9u);
    ASSERT_EQ(r.weights.starts.size(), 11u);
    for (const uint32_t copy : {8u, 9u}) {
        ASSERT_EQ(r.weights.starts[copy + 1] - r.weights.starts[copy], 2u);
        EXPECT_EQ(r.weights.influences[r.weights.starts[copy]].joint, copy - 8);
    }
    EXPECT_EQ(r.morphs.targets[0].vertices, (Indices{1, 5, 9}));
    EXPECT_EQ(r.morphs.targets[0].deltas[2], glm::vec3(1, 0, 0));
    EXPECT_EQ(r.morphs.targets[1].vertices, Indices{7});
}

} // namespace
} // namespace supple::cage
