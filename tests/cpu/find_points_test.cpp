// Points by where they are: nearest to places, at texture coordinates, spread by area.
#include "tests/support/found_points.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

constexpr SuppleScheme kFindSchemes[] = {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP,
                                         SUPPLE_SCHEME_POLYGONS, SUPPLE_SCHEME_CAGE};

/// A point is the nearest to itself, and to places straight above it.
TEST(FindPoints, TheNearestToAPointIsThePoint) {
    for (const cage::Cage& cage : {perturbed(cage::makeSplitTorus(8, 6), 0.02f, 3), fanOverPentagons(6)}) {
        for (const SuppleScheme scheme : kFindSchemes) {
            const Surfaces surfaces = surfacesOf(cage, scheme);
            ASSERT_NE(surfaces, nullptr);
            const std::vector<SuppleSurfacePoint> points = found(surfaces, queryOf(SUPPLE_FIND_SCATTER, 300));
            const At own = at(surfaces, points);
            const At nearest = at(surfaces, found(surfaces, queryOf(SUPPLE_FIND_NEAREST, 300, &own.positions[0].x)));
            std::vector<glm::vec3> above;
            for (size_t k = 0; k < points.size(); ++k) {
                above.push_back(own.positions[k] + 0.02f * own.normals[k]);
            }
            const At below = at(surfaces, found(surfaces, queryOf(SUPPLE_FIND_NEAREST, 300, &above[0].x)));
            const double size = extent(doublePositions(cage));
            double itself = 0.0, farther = 0.0;
            for (size_t k = 0; k < points.size(); ++k) {
                raise(itself, glm::distance(own.positions[k], nearest.positions[k]) / size);
                raise(farther, (glm::distance(above[k], below.positions[k]) - 0.02) / size);
            }
            std::printf("scheme %u: %.1e of the extent from itself; above it at most %.1e farther\n", scheme, itself,
                        farther);
            // Polygons fold along the diagonals of quads, where Newton's method may end beside the fold.
            const double most = scheme == SUPPLE_SCHEME_POLYGONS ? 1e-3 : 1e-5;
            EXPECT_LE(itself, most) << "scheme " << scheme;
            EXPECT_LE(farther, most) << "scheme " << scheme;
        }
    }
}

/// As many points on a part of the surface as its area asks for.
TEST(FindPoints, ScatterGoesByArea) {
    cage::Cage strip; // two squares and one of four times their size
    strip.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}, {4, 2, 0}};
    strip.faceStarts = {0, 4, 8};
    strip.faceVertices = {0, 1, 5, 4, 2, 3, 7, 6};
    const Surfaces surfaces = surfacesOf(strip, SUPPLE_SCHEME_CAGE);
    SupplePointQuery query = queryOf(SUPPLE_FIND_SCATTER, 1000);
    const std::vector<SuppleSurfacePoint> points = found(surfaces, query);
    const auto small = std::count_if(points.begin(), points.end(), [](const auto& p) { return p.face == 0; });
    EXPECT_EQ(small, 200);
    query.seed = 5;
    EXPECT_NE(found(surfaces, query)[0].a, points[0].a);
    query.seed = 0;
    EXPECT_EQ(found(surfaces, query)[0].a, points[0].a);
}

/// The point with a point's texture coordinates is the point.
TEST(FindPoints, TextureCoordinatesNameThePoint) {
    cage::Cage cage;
    cage.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    cage.faceStarts = {0, 4, 7};
    cage.faceVertices = {0, 1, 2, 3, 1, 4, 2};
    cage.cornerUvs = {{0.1f, 0.1f}, {0.4f, 0.2f}, {0.5f, 0.6f}, {0.0f, 0.5f}, {0.6f, 0.1f}, {0.9f, 0.1f}, {0.7f, 0.8f}};
    const Surfaces surfaces = surfacesOf(cage, SUPPLE_SCHEME_CAGE);
    std::vector<glm::vec2> uvs;
    std::vector<SuppleSurfacePoint> points;
    for (const auto& [a, b] : {std::pair(0.25f, 0.5f), std::pair(0.0f, 0.0f), std::pair(0.7f, 0.2f)}) {
        const auto& c = cage.cornerUvs;
        points.push_back({0, 0, a, b});
        uvs.push_back((1 - a) * (1 - b) * c[0] + a * (1 - b) * c[1] + a * b * c[2] + (1 - a) * b * c[3]);
        points.push_back({1, 0, a, b});
        uvs.push_back((1 - a - b) * c[4] + a * c[5] + b * c[6]);
    }
    uvs.emplace_back(0.95f, 0.95f);
    const std::vector<SuppleSurfacePoint> back = found(surfaces, queryOf(SUPPLE_FIND_UV, uvs.size(), &uvs[0].x));
    for (size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(back[k].face, points[k].face);
        EXPECT_NEAR(back[k].a, points[k].a, 1e-5f);
        EXPECT_NEAR(back[k].b, points[k].b, 1e-5f);
    }
    EXPECT_EQ(back.back().face, SUPPLE_NO_FACE);
    SupplePointQuery other = queryOf(SUPPLE_FIND_UV, uvs.size(), &uvs[0].x);
    other.uvSet = 1;
    std::shared_ptr<runtime::PointFinder> kept;
    EXPECT_FALSE(runtime::findPoints(surfaces, kept, other, points));
}

/// Faces that meet at a place are equally near to it: the lowest is taken, whatever rounding says.
TEST(FindPoints, OfFacesThatMeetTheLowestIsTaken) {
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_CAGE}) {
        const cage::Cage cage = perturbed(cage::makeCubeSphere(4), 0.01f, 3);
        const Surfaces surfaces = surfacesOf(cage, scheme);
        constexpr float kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        std::vector<SuppleSurfacePoint> corners;
        std::vector<uint32_t> lowest, of(cage.vertexCount(), SUPPLE_NO_FACE);
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            for (uint32_t k = 0; k < 4; ++k) {
                const uint32_t vertex = cage.faceVertices[cage.faceStarts[face] + k];
                of[vertex] = std::min(of[vertex], face);
                corners.push_back({face, 0, kCorners[k][0], kCorners[k][1]});
                lowest.push_back(of[vertex]);
            }
        }
        const At own = at(surfaces, corners);
        const auto nearest = found(surfaces, queryOf(SUPPLE_FIND_NEAREST, corners.size(), &own.positions[0].x));
        for (size_t k = 0; k < corners.size(); ++k) {
            EXPECT_EQ(nearest[k].face, lowest[k]) << "scheme " << scheme << ", corner " << k;
        }
    }
}

/// A search is no square of a face's sides.
TEST(FindPoints, AFaceOfManySidesIsSearched) {
    constexpr uint32_t kSides = 20'000;
    cage::Cage disc;
    disc.faceStarts = {0, kSides};
    for (uint32_t k = 0; k < kSides; ++k) {
        const float angle = 6.2831853f * static_cast<float>(k) / kSides;
        disc.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
        disc.faceVertices.push_back(k);
    }
    const Surfaces surfaces = surfacesOf(disc, SUPPLE_SCHEME_CAGE);
    const At spread = at(surfaces, found(surfaces, queryOf(SUPPLE_FIND_SCATTER, 1000)));
    double inside = 0.0;
    for (const glm::vec3& p : spread.positions) {
        EXPECT_LE(glm::length(p), 1.0f);
        inside += glm::length(p) < std::sqrt(0.5f) ? 1.0 : 0.0;
    }
    EXPECT_NEAR(inside / 1000.0, 0.5, 0.06);
    const glm::vec3 place(0.3f, -0.4f, 1.0f);
    const At nearest = at(surfaces, found(surfaces, queryOf(SUPPLE_FIND_NEAREST, 1, &place.x)));
    EXPECT_LE(glm::distance(nearest.positions[0], glm::vec3(0.3f, -0.4f, 0.0f)), 1e-3f);
}

/// Coordinates that several faces cover, of many faces: the lowest has them.
TEST(FindPoints, TheLowestOfTheFacesThatCoverACoordinate) {
    constexpr uint32_t kSide = 40;
    cage::Cage cage;
    cage.faceStarts = {0};
    std::mt19937 random(3);
    const auto number = [&](float most) { return most * static_cast<float>(random() % 4096) / 4096.0f; };
    std::vector<glm::vec2> lows;
    std::vector<float> sizes;
    for (uint32_t face = 0; face < kSide * kSide; ++face) {
        lows.emplace_back(number(0.9f), number(0.9f));
        sizes.push_back(0.002f + number(0.05f));
        for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            cage.faceVertices.push_back(static_cast<uint32_t>(cage.positions.size()));
            cage.positions.emplace_back(corner, static_cast<float>(face));
            cage.cornerUvs.push_back(lows.back() + sizes.back() * corner);
        }
        cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
    }
    const Surfaces surfaces = surfacesOf(cage, SUPPLE_SCHEME_CAGE);
    std::vector<glm::vec2> uvs;
    for (uint32_t k = 0; k < 2000; ++k) {
        uvs.emplace_back(number(1.0f), number(1.0f));
    }
    const auto points = found(surfaces, queryOf(SUPPLE_FIND_UV, uvs.size(), &uvs[0].x));
    size_t covered = 0;
    for (size_t k = 0; k < uvs.size(); ++k) {
        uint32_t expected = SUPPLE_NO_FACE;
        for (uint32_t face = 0; face < lows.size() && expected == SUPPLE_NO_FACE; ++face) {
            const glm::vec2 in = (uvs[k] - lows[face]) / sizes[face];
            expected = in.x >= 0.0f && in.y >= 0.0f && in.x <= 1.0f && in.y <= 1.0f ? face : expected;
        }
        EXPECT_EQ(points[k].face, expected) << k;
        covered += expected != SUPPLE_NO_FACE ? 1 : 0;
    }
    EXPECT_GT(covered, 500u);
    // All of them, in rising order, as far as there is room.
    SupplePointQuery query = queryOf(SUPPLE_FIND_UV, uvs.size(), &uvs[0].x);
    query.pointsEach = 3;
    const auto several = found(surfaces, query);
    ASSERT_EQ(several.size(), 3 * uvs.size());
    size_t full = 0;
    for (size_t k = 0; k < uvs.size(); ++k) {
        size_t place = 0;
        for (uint32_t face = 0; face < lows.size() && place < 3; ++face) {
            const glm::vec2 in = (uvs[k] - lows[face]) / sizes[face];
            if (in.x >= 0.0f && in.y >= 0.0f && in.x <= 1.0f && in.y <= 1.0f) {
                EXPECT_EQ(several[3 * k + place++].face, face) << k;
            }
        }
        full += place == 3 ? 1 : 0;
        for (; place < 3; ++place) {
            EXPECT_EQ(several[3 * k + place].face, SUPPLE_NO_FACE) << k;
        }
    }
    EXPECT_GT(full, 100u);
}

/// What a search of the bind pose has made stays for the next one, and not for another cage.
TEST(FindPoints, SearchesOfTheBindPoseShareWhatTheyBeginFrom) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(3), 0.02f, 3);
    const Surfaces surfaces = surfacesOf(cage, SUPPLE_SCHEME_PM);
    std::shared_ptr<runtime::PointFinder> kept;
    std::vector<SuppleSurfacePoint> first(1), second(1), moved(1);
    const glm::vec3 place(0.4f, 0.9f, 0.3f);
    SupplePointQuery query = queryOf(SUPPLE_FIND_NEAREST, 1, &place.x);
    ASSERT_TRUE(runtime::findPoints(surfaces, kept, query, first));
    ASSERT_NE(kept, nullptr);
    const auto* const before = kept.get();
    std::vector<glm::vec3> shifted = cage.positions;
    for (glm::vec3& p : shifted) {
        p.x += 1.5f;
    }
    query.cage = &shifted[0].x;
    query.cageVertexCount = static_cast<uint32_t>(shifted.size());
    ASSERT_TRUE(runtime::findPoints(surfaces, kept, query, moved));
    EXPECT_EQ(kept.get(), before);
    query.cage = nullptr;
    query.cageVertexCount = 0;
    ASSERT_TRUE(runtime::findPoints(surfaces, kept, query, second));
    EXPECT_EQ(kept.get(), before);
    EXPECT_EQ(std::memcmp(first.data(), second.data(), sizeof(first[0])), 0);
    EXPECT_NE(std::memcmp(first.data(), moved.data(), sizeof(first[0])), 0);
}

} // namespace
} // namespace supple::test
