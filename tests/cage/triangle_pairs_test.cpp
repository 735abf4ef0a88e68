// Which triangles make a quad.
#include "cage/triangle_pairs.h"

#include "tests/cage/face_lists.h"

#include <gtest/gtest.h>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

using Points = std::vector<glm::vec3>;

bool always(uint32_t, uint32_t) {
    return true;
}

PairedTriangles pair(const Indices& triangles, const Points& points, PairShape shape = PairShape::clean) {
    const Indices welded = identity(points.size());
    Indices spare = spareEdges(triangles, welded);
    return pairTriangles(triangles, welded, points, always, shape, spare);
}

const Points kUnitSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(TrianglePairs, TwoTrianglesThatRunAgainstEachOther) {
    EXPECT_EQ(facesOf(pair({0, 1, 2, 0, 2, 3}, kUnitSquare).polygons), (Faces{{0, 1, 2, 3}}));
    EXPECT_EQ(facesOf(pair({1, 2, 0, 2, 3, 0}, kUnitSquare).polygons), (Faces{{1, 2, 3, 0}})) << "any shared edge";
    EXPECT_EQ(facesOf(pair({0, 1, 2, 0, 3, 2}, kUnitSquare).polygons), (Faces{{0, 1, 2}, {0, 3, 2}})) << "flipped";
    EXPECT_EQ(facesOf(pair({0, 1, 2, 2, 1, 0}, kUnitSquare).polygons).size(), 2u) << "two sides of one triangle";
    EXPECT_EQ(facesOf(pair({0, 1, 2, 0, 2, 3, 0, 2, 1}, kUnitSquare).polygons).size(), 3u) << "three on an edge";
    const PairedTriangles degenerate = pair({0, 1, 2, 1, 1, 2, 0, 2, 3}, kUnitSquare);
    EXPECT_EQ(facesOf(degenerate.polygons), (Faces{{0, 1, 2, 3}}));
    EXPECT_EQ(degenerate.polygons.degenerateTriangles, 1u);
}

TEST(TrianglePairs, CornersMustAgree) {
    const Indices triangles{0, 1, 2, 3, 4, 5};
    const Points points{kUnitSquare[0], kUnitSquare[1], kUnitSquare[2], kUnitSquare[0], kUnitSquare[2], kUnitSquare[3]};
    const Indices welded{0, 1, 2, 0, 2, 5};
    Indices asked;
    const auto pairWith = [&](bool same) {
        Indices spare = spareEdges(triangles, welded);
        return pairTriangles(
            triangles, welded, points,
            [&](uint32_t a, uint32_t b) {
                asked.insert(asked.end(), {a, b});
                return same;
            },
            PairShape::clean, spare);
    };
    EXPECT_EQ(facesOf(pairWith(true).polygons), (Faces{{0, 1, 2, 5}}));
    EXPECT_EQ(asked, (Indices{2, 4, 0, 3}));
    EXPECT_EQ(pairWith(false).quads, 0u);
}

TEST(TrianglePairs, CleanQuadsAreConvexAndNearlyFlat) {
    const auto quads = [](const Points& points, PairShape shape) {
        return pair({0, 1, 2, 0, 2, 3}, points, shape).quads;
    };
    // Bent by 50, 70 and 100 degrees about the diagonal.
    for (const auto& [degrees, clean, unfolded] : {std::tuple{50.0f, 1u, 1u}, {70.0f, 0u, 1u}, {100.0f, 0u, 0u}}) {
        Points points{{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
        points[3] = {-std::cos(glm::radians(degrees)), 0.0f, std::sin(glm::radians(degrees))};
        EXPECT_EQ(quads(points, PairShape::clean), clean) << degrees;
        EXPECT_EQ(quads(points, PairShape::unfolded), unfolded) << degrees;
    }
    // A corner of 180 degrees, and one of more.
    EXPECT_EQ(quads({{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {1, 1, 0}}, PairShape::clean), 1u);
    EXPECT_EQ(quads({{0, 0, 0}, {1, -1, 0}, {1, 0, 0}, {1, 1, 0}}, PairShape::clean), 0u);
    EXPECT_EQ(quads({{0, 0, 0}, {1, -1, 0}, {0.5f, 0, 0}, {1, 1, 0}}, PairShape::clean), 0u);
    EXPECT_EQ(quads({{0, 0, 0}, {1, -1, 0}, {0.5f, 0, 0}, {1, 1, 0}}, PairShape::unfolded), 1u);
}

TEST(TrianglePairs, SquarenessIsOneForRectangles) {
    EXPECT_NEAR(pair({0, 1, 2, 0, 2, 3}, kUnitSquare).squareness, 1.0, 1e-6);
    // Two equilateral triangles: corners of 60 and 120 degrees.
    const float h = std::sqrt(0.75f);
    EXPECT_NEAR(pair({0, 1, 2, 0, 2, 3}, {{0, 0, 0}, {1, 0, 0}, {0.5f, h, 0}, {-0.5f, h, 0}}).squareness, 2.0 / 3.0,
                1e-6);
}

/// A grid of quads, moved about a little, each cut along the diagonal from its first corner or along the other one.
struct Grid {
    static constexpr uint32_t kSide = 12;
    Points points;
    Indices triangles;
    Faces quads; ///< sorted corners, sorted

    explicit Grid(uint32_t seed) {
        std::mt19937 random(seed);
        const auto moved = [&](uint32_t at) { return float(at) + 0.2f * (float(random() % 1000) / 1000.0f - 0.5f); };
        for (uint32_t i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
            const float x = moved(i % (kSide + 1));
            points.push_back({x, moved(i / (kSide + 1)), moved(0)});
        }
        for (uint32_t i = 0; i < kSide * kSide; ++i) {
            const uint32_t a = i / kSide * (kSide + 1) + i % kSide, b = a + 1, c = b + kSide + 1, d = c - 1;
            const Indices cut = random() % 2 == 0 ? Indices{a, b, c, a, c, d} : Indices{b, c, d, b, d, a};
            triangles.insert(triangles.end(), cut.begin(), cut.end());
            quads.push_back({a, b, d, c});
        }
    }
    void shuffle(uint32_t seed) {
        Indices order = identity(triangles.size() / 3);
        std::shuffle(order.begin(), order.end(), std::mt19937(seed));
        Indices shuffled;
        for (const uint32_t t : order) {
            for (uint32_t k = 0; k < 3; ++k) {
                shuffled.push_back(triangles[3 * t + (k + t) % 3]);
            }
        }
        triangles = shuffled;
    }
};

TEST(TrianglePairs, QuadsAreFoundAgainInAnyOrder) {
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        Grid grid(seed);
        for (const bool shuffled : {false, true}) {
            if (shuffled) {
                grid.shuffle(seed);
            }
            Faces found = facesOf(pair(grid.triangles, grid.points).polygons);
            for (Indices& face : found) {
                std::sort(face.begin(), face.end());
            }
            std::sort(found.begin(), found.end());
            EXPECT_EQ(found, grid.quads) << seed << (shuffled ? ", shuffled" : "");
        }
    }
}

TEST(TrianglePairs, NoInnerVertexIsLeftWithTwoEdges) {
    // Four triangles round a vertex, in a square: two quads would leave it two edges.
    const Points points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}};
    const Indices triangles{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    EXPECT_EQ(spareEdges(triangles, identity(5)), (Indices{3, 3, 3, 3, 1}));
    EXPECT_LE(pair(triangles, points, PairShape::unfolded).quads, 1u);
    // What other triangles have taken from a vertex is gone.
    Indices spare{3, 3, 3, 3, 0};
    EXPECT_EQ(pairTriangles(triangles, identity(5), points, always, PairShape::unfolded, spare).quads, 0u);
}

} // namespace
} // namespace supple::cage
