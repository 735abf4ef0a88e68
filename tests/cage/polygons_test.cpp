#include "cage/polygons.h"

#include "tests/cage/face_lists.h"

#include <gtest/gtest.h>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

/// The draft's writer: a fan anchored where the polygon before was not.
Indices encode(const Faces& faces) {
    Indices triangles;
    uint32_t anchor = 0xFFFFFFFFu;
    for (const Indices& face : faces) {
        const size_t n = face.size();
        const size_t start = face[0] == anchor ? 1 : 0;
        anchor = face[start];
        for (size_t k = 1; k + 1 < n; ++k)
            triangles.insert(triangles.end(), {anchor, face[(start + k) % n], face[(start + k + 1) % n]});
    }
    return triangles;
}

/// Rotated to begin with its smallest vertex.
Faces rotated(Faces faces) {
    for (Indices& face : faces)
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return faces;
}

TEST(Polygons, EncodingRoundTrips) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        Faces faces;
        for (int f = 0; f < 30; ++f) {
            Indices vertices = identity(40);
            std::shuffle(vertices.begin(), vertices.end(), random);
            vertices.resize(3 + random() % 8);
            // Every so often the next face begins where this one did, so that the writer has to turn it.
            if (!faces.empty() && random() % 3 == 0 &&
                std::find(vertices.begin(), vertices.end(), faces.back()[0]) == vertices.end())
                vertices[0] = faces.back()[0];
            faces.push_back(vertices);
        }
        const Polygons polygons = decodeNgons(encode(faces), identity(40));
        EXPECT_EQ(rotated(facesOf(polygons)), rotated(faces));
        EXPECT_EQ(polygons.recutRuns, 0u);
    }
}

TEST(Polygons, RunsEndWhereTheChainBreaks) {
    // Same first index, but the second triangle does not go on where the first ended.
    EXPECT_EQ(facesOf(decodeNgons(Indices{0, 1, 2, 0, 3, 4}, identity(5))), (Faces{{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(facesOf(decodeNgons(Indices{0, 1, 2, 0, 2, 3}, identity(5))), (Faces{{0, 1, 2, 3}}));
    EXPECT_EQ(facesOf(decodeNgons(Indices{0, 1, 2, 3, 2, 1}, identity(5))), (Faces{{0, 1, 2}, {3, 2, 1}}));
}

TEST(Polygons, DegenerateTrianglesBreakRunsAndGo) {
    const Polygons polygons = decodeNgons(Indices{0, 1, 2, 0, 2, 2, 0, 2, 3}, identity(4));
    EXPECT_EQ(facesOf(polygons), (Faces{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(polygons.degenerateTriangles, 1u);
    const Indices welded = {0, 1, 1, 3};
    EXPECT_EQ(facesOf(keepTriangles(Indices{0, 1, 2, 0, 2, 3}, welded)), (Faces{{0, 2, 3}}));
}

TEST(Polygons, RunThatClosesOnItselfIsCutAgain) {
    // Four quads round vertex 0, written by an exporter that anchors them all there: one run of eight triangles.
    Indices triangles;
    for (uint32_t k = 0; k < 8; ++k)
        triangles.insert(triangles.end(), {0u, 1 + k, 1 + (k + 1) % 8});
    const Polygons polygons = decodeNgons(triangles, identity(9));
    EXPECT_EQ(facesOf(polygons), (Faces{{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7}, {0, 7, 8, 1}}));
    EXPECT_EQ(polygons.recutRuns, 1u);
    // An odd number of triangles leaves one over.
    triangles.resize(3 * 7);
    triangles.back() = 1;
    EXPECT_EQ(facesOf(decodeNgons(triangles, identity(9))),
              (Faces{{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7}, {0, 7, 1}}));
}

TEST(Polygons, RepetitionCountsAfterWelding) {
    // Glued at a seam: 1 and 9 are one vertex.
    Indices triangles;
    for (uint32_t k = 0; k < 8; ++k)
        triangles.insert(triangles.end(), {0u, 1 + k, 2 + k});
    Indices welded = identity(10);
    EXPECT_EQ(decodeNgons(triangles, welded).faceCount(), 1u);
    welded[9] = 1;
    EXPECT_EQ(facesOf(decodeNgons(triangles, welded)), (Faces{{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7}, {0, 7, 8, 9}}));
    // A quad of the new cut that repeats a vertex itself stays two triangles.
    EXPECT_EQ(facesOf(decodeNgons(Indices{0, 1, 2, 0, 2, 3}, Indices{0, 1, 2, 1})), (Faces{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygons, HiddenEdgesMergeIntoSimplePolygonsOnly) {
    const auto merge = [](const Indices& triangles, const std::vector<std::pair<uint32_t, uint32_t>>& shown,
                          const Indices& welded) {
        std::vector<uint8_t> hidden;
        for (size_t e = 0; e < triangles.size(); ++e) {
            const std::pair<uint32_t, uint32_t> edge{triangles[e], triangles[e % 3 == 2 ? e - 2 : e + 1]};
            hidden.push_back(std::find(shown.begin(), shown.end(), edge) == shown.end() ? 1 : 0);
        }
        return mergeAcrossHiddenEdges(triangles, welded, hidden);
    };
    // A strip, in any order of its triangles: begins with the first triangle's first boundary edge.
    EXPECT_EQ(facesOf(merge({0, 1, 4, 2, 3, 4, 1, 2, 4}, {}, identity(5))), (Faces{{0, 1, 2, 3, 4}}));
    // Shown on one of its sides only, an edge stays.
    EXPECT_EQ(facesOf(merge({0, 1, 2, 0, 2, 3}, {{2, 0}}, identity(4))), (Faces{{0, 1, 2}, {0, 2, 3}}));
    // Two triangles that run along an edge in the same direction, and three at one edge.
    EXPECT_EQ(facesOf(merge({0, 1, 2, 0, 1, 3}, {}, identity(4))).size(), 2u);
    EXPECT_EQ(facesOf(merge({0, 1, 2, 1, 0, 3, 0, 1, 4}, {}, identity(5))).size(), 3u);
    // A fan round a vertex, and a ring whose boundary is two loops.
    Polygons polygons = merge({0, 1, 2, 0, 2, 3, 0, 3, 1}, {}, identity(4));
    EXPECT_EQ(facesOf(polygons), (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}));
    EXPECT_EQ(polygons.brokenRegions, 1u);
    EXPECT_EQ(merge({0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5}, {}, identity(6)).brokenRegions, 1u);
    // The same strip, welded at its ends so that the boundary passes a vertex twice.
    polygons = merge({0, 1, 2, 2, 1, 3, 2, 3, 4}, {}, {0, 1, 2, 3, 0});
    EXPECT_EQ(polygons.brokenRegions, 1u);
    EXPECT_EQ(polygons.faceCount(), 3u);
    // Degenerate triangles go.
    EXPECT_EQ(merge({0, 1, 2, 0, 2, 2, 0, 2, 3}, {}, identity(4)).degenerateTriangles, 1u);
}

} // namespace
} // namespace supple::cage
