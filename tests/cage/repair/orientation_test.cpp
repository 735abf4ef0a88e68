// Faces that are turned against their neighbours.
#include "tests/cage/repair/repaired.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

Cage withTurned(const Cage& cage, const Indices& faces) {
    Faces polygons = facesOf(cage);
    for (const uint32_t f : faces) {
        std::reverse(polygons[f].begin(), polygons[f].end());
    }
    return supple::test::makeCage(cage.positions, polygons);
}

/// Of a closed cage, times six: positive if its faces look outside.
double volume(const Cage& cage) {
    double sum = 0.0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f] + 1; c + 1 < cage.faceStarts[f + 1]; ++c) {
            const auto at = [&](uint32_t corner) { return glm::dvec3(cage.positions[cage.faceVertices[corner]]); };
            sum += glm::dot(at(cage.faceStarts[f]), glm::cross(at(c), at(c + 1)));
        }
    }
    return sum;
}

TEST(RepairOrientation, FewAreTurnedToMany) {
    const Cage torus = supple::test::torus(8, 6);
    Cage damaged = withTurned(torus, {3, 17, 18, 40});
    for (uint32_t c = 0; c < damaged.cornerCount(); ++c) {
        damaged.cornerUvs.emplace_back(static_cast<float>(damaged.faceVertices[c]), 0.0f);
    }
    const Repaired r = repaired(damaged);
    EXPECT_EQ(r.found, Strings{"cage: 4 faces are turned against their neighbours, the first is face 3"});
    EXPECT_EQ(r.repairs, Strings{"turned round"});
    EXPECT_EQ(r.cage.vertexCount(), torus.vertexCount());
    EXPECT_NEAR(volume(r.cage), volume(torus), 1e-3);
    for (uint32_t c = 0; c < r.cage.cornerCount(); ++c) {
        EXPECT_EQ(r.cage.cornerUvs[c].x, static_cast<float>(r.cage.faceVertices[c])) << "attributes turn with corners";
    }
    for (uint32_t f = 0; f < torus.faceCount(); ++f) {
        EXPECT_EQ(r.cage.faceVertices[r.cage.faceStarts[f]], damaged.faceVertices[damaged.faceStarts[f]])
            << "the first corner stays the first";
        if (f != 3 && f != 17 && f != 18 && f != 40) {
            EXPECT_TRUE(std::equal(r.cage.faceVertices.begin() + 4 * f, r.cage.faceVertices.begin() + 4 * f + 4,
                                   torus.faceVertices.begin() + 4 * f));
        }
    }
}

TEST(RepairOrientation, AreaDecidesAndNotNumber) {
    // A long box: its four sides outweigh all its small faces.
    Cage box = supple::test::cube();
    for (glm::vec3& p : box.positions) {
        p.z *= 100.0f;
    }
    const double outside = volume(box);
    Indices small;
    for (uint32_t f = 0; f < 6; ++f) {
        const float z0 = box.positions[box.faceVertices[4 * f]].z;
        const bool cap =
            z0 == box.positions[box.faceVertices[4 * f + 1]].z && z0 == box.positions[box.faceVertices[4 * f + 2]].z;
        if (!cap) {
            small.push_back(f);
        }
    }
    ASSERT_EQ(small.size(), 4u);
    small.pop_back();
    // Three of the four long sides are turned: they are most of the area, so the whole box turns inside out.
    EXPECT_DOUBLE_EQ(volume(repaired(withTurned(box, small)).cage), -outside);
    small.resize(1);
    EXPECT_DOUBLE_EQ(volume(repaired(withTurned(box, small)).cage), outside);
}

TEST(RepairOrientation, EqualAreasKeepTheFirstFace) {
    const Cage grid = supple::test::grid(2, 1);
    EXPECT_EQ(repaired(withTurned(grid, {1})).found, Strings{"cage: 1 face is turned against its neighbours: face 1"});
    EXPECT_EQ(repaired(withTurned(grid, {0})).found, Strings{"cage: 1 face is turned against its neighbours: face 1"});
}

TEST(RepairOrientation, AnyFacesOfAnyPiece) {
    const Cage jack = supple::test::jack();
    const double outside = volume(jack);
    std::mt19937 random(5);
    for (int round = 0; round < 50; ++round) {
        Indices turned;
        for (uint32_t f = 0; f < jack.faceCount(); ++f) {
            if (random() % 2 == 0) {
                turned.push_back(f);
            }
        }
        if (turned.empty()) {
            continue;
        }
        const Cage damaged = withTurned(jack, turned);
        if (buildTopology(damaged).ok()) {
            continue;
        }
        EXPECT_DOUBLE_EQ(std::abs(volume(repaired(damaged).cage)), outside);
    }
}

/// A closed strip of quads with so many half twists.
Cage strip(uint32_t quads, uint32_t twists) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    for (uint32_t i = 0; i < quads; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / quads;
        for (const double side : {-0.3, 0.3}) {
            const double out = 1.0 + side * std::cos(turn * twists / 2.0);
            positions.emplace_back(out * std::cos(turn), out * std::sin(turn), side * std::sin(turn * twists / 2.0));
        }
        const bool last = i + 1 == quads && twists % 2 != 0;
        const uint32_t next = (i + 1) % quads;
        polygons.push_back({2 * i, 2 * i + 1, 2 * next + (last ? 0 : 1), 2 * next + (last ? 1 : 0)});
    }
    return supple::test::makeCage(positions, polygons);
}

TEST(RepairOrientation, AMoebiusStripIsCutOnce) {
    const Repaired r = repaired(strip(12, 1));
    EXPECT_EQ(r.found, Strings{"cage: 1 edge joins two sides of one surface, as in a Moebius strip: edge (0, 1)"});
    EXPECT_EQ(r.repairs, Strings{"cut open, 2 vertices repeated"});
    EXPECT_EQ(r.cage.vertexCount(), 26u);
    EXPECT_EQ(r.cage.faceCount(), 12u);
    // Wherever the faces begin to be turned, there is one cut.
    EXPECT_EQ(repaired(withTurned(strip(12, 1), {4, 5, 6})).cage.vertexCount(), 26u);
    // Two half twists have two sides again.
    const Repaired two = repaired(withTurned(strip(12, 2), {4}));
    EXPECT_EQ(two.found, Strings{"cage: 1 face is turned against its neighbours: face 4"});
}

} // namespace
} // namespace supple::cage
