// Cutting faces into triangles: ears, and finding a file's own triangles again.
#include "cage/triangulation.h"

#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace supple::cage {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

Triangles grouped(const std::vector<uint32_t>& corners) {
    Triangles triangles;
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    EXPECT_EQ(corners.size() % 3, 0u);
    return triangles;
}

Triangles earsOf(const std::vector<glm::vec3>& outline) {
    std::vector<uint32_t> corners;
    clipEars(outline, corners);
    return grouped(corners);
}

double areaAlongZ(const std::vector<glm::vec3>& outline, const std::array<uint32_t, 3>& t) {
    const glm::dvec3 a = outline[t[0]], b = outline[t[1]], c = outline[t[2]];
    return glm::cross(b - a, c - a).z;
}

/// Every triangle is wound as the polygon, and together they have its area: none lies outside or over another.
void expectInside(const std::vector<glm::vec3>& outline, double area) {
    const Triangles triangles = earsOf(outline);
    EXPECT_EQ(triangles.size(), outline.size() - 2);
    double sum = 0.0;
    for (const auto& triangle : triangles) {
        EXPECT_GE(areaAlongZ(outline, triangle), -1e-12);
        sum += areaAlongZ(outline, triangle);
    }
    EXPECT_NEAR(sum, 2.0 * area, 1e-6 * area);
}

TEST(Triangulation, ConvexPolygonsAreFans) {
    std::vector<glm::vec3> outline;
    for (int k = 0; k < 7; ++k) {
        const float angle = static_cast<float>(k) * 0.8975979f;
        outline.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
    }
    EXPECT_EQ(earsOf(outline), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}}));
}

TEST(Triangulation, ConcavePolygonsAreCutInside) {
    const std::vector<glm::vec3> l = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    // From every start: a fan is right from some of them alone.
    for (size_t start = 0; start < l.size(); ++start) {
        std::vector<glm::vec3> outline = l;
        std::rotate(outline.begin(), outline.begin() + static_cast<ptrdiff_t>(start), outline.end());
        expectInside(outline, 3.0);
    }
    // A dart with its tip at every corner.
    const std::vector<glm::vec3> dart = {{0, 0, 0}, {2, -1, 0}, {0.5f, 0, 0}, {2, 1, 0}};
    for (size_t start = 0; start < dart.size(); ++start) {
        std::vector<glm::vec3> outline = dart;
        std::rotate(outline.begin(), outline.begin() + static_cast<ptrdiff_t>(start), outline.end());
        expectInside(outline, 0.5 * std::abs(-2.0 + 1.0));
    }
    // A square with a square hole, joined by a bridge: corners lie twice in one place.
    expectInside(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}},
        8.0);
}

TEST(Triangulation, RandomStarsAreCutInside) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> radius(0.1f, 3.0f);
    for (uint32_t sides : {5u, 8u, 30u, 200u, kMostClippedSides}) {
        std::vector<glm::vec3> outline;
        double area = 0.0;
        for (uint32_t k = 0; k < sides; ++k) {
            const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(sides);
            const float r = radius(random);
            outline.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0f);
        }
        for (uint32_t k = 0; k < sides; ++k) {
            const glm::dvec3 a = outline[k], b = outline[(k + 1) % sides];
            area += 0.5 * (a.x * b.y - a.y * b.x);
        }
        SCOPED_TRACE(sides);
        expectInside(outline, area);
    }
}

TEST(Triangulation, WhatIsNoPolygonIsCutAllTheSame) {
    const std::vector<std::vector<glm::vec3>> outlines = {
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                       // crosses itself
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},            // a line
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, // a point
        std::vector<glm::vec3>(5000, glm::vec3(2.0f)),                      // too many sides to clip
    };
    for (const auto& outline : outlines) {
        const Triangles triangles = earsOf(outline);
        EXPECT_EQ(triangles.size(), outline.size() - 2);
        for (const auto& triangle : triangles) {
            EXPECT_TRUE(triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]);
            EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), outline.size());
        }
    }
}

TEST(Triangulation, FindsTheFilesTriangles) {
    // Vertices 6 and 7 are welded to 0 and 2: the two halves of the hexagon have them of their own.
    const std::vector<uint32_t> welded = {0, 1, 2, 3, 4, 5, 0, 2, 8, 9};
    const std::vector<uint32_t> triangles = {0, 1, 2, 7, 3, 6, 6, 3, 5, 5, 3, 4, /* another face */ 0, 8, 9};
    const FileTriangles known(triangles, welded);
    std::vector<uint32_t> corners = {77};
    ASSERT_TRUE(known.cut(std::vector<uint32_t>{0, 1, 2, 3, 4, 5}, corners));
    EXPECT_EQ(corners.front(), 77u);
    Triangles found = grouped({corners.begin() + 1, corners.end()});
    ASSERT_EQ(found.size(), 4u);
    const Triangles wanted = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}};
    for (auto& triangle : found) { // from the smallest corner on
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, wanted);
    // Another start corner, and other vertices of the same cage vertices.
    ASSERT_TRUE(known.cut(std::vector<uint32_t>{3, 4, 5, 6, 1, 7}, corners));
    EXPECT_EQ(corners.size(), 1u + 12u + 12u);
    // What the triangles do not fill is left alone.
    const std::vector<uint32_t> before = corners;
    EXPECT_FALSE(known.cut(std::vector<uint32_t>{0, 1, 2, 3, 4}, corners));
    EXPECT_FALSE(known.cut(std::vector<uint32_t>{0, 8, 9, 4}, corners));
    EXPECT_FALSE(known.cut(std::vector<uint32_t>{5, 4, 3, 2, 1, 0}, corners));
    EXPECT_EQ(corners, before);
}

TEST(Triangulation, OfACageTakesItsOwnIfItHasThem) {
    Cage cage = test::makeCage({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                               {{0, 1, 2, 3}, {3, 2, 5, 4}});
    EXPECT_EQ(triangulate(cage), (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}));
    cage.faceTriangles = {1, 2, 3, 1, 3, 0, 4, 5, 7, 5, 6, 7};
    EXPECT_EQ(triangulate(cage), cage.faceTriangles);
}

} // namespace
} // namespace supple::cage
