#include "cage/ngon_fans.h"

#include "tests/cage/face_lists.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

Polygons faces(const std::vector<std::vector<uint32_t>>& list) {
    Polygons polygons;
    for (const auto& face : list) {
        polygons.vertices.insert(polygons.vertices.end(), face.begin(), face.end());
        polygons.close();
    }
    return polygons;
}

std::vector<std::vector<uint32_t>> listOf(const Polygons& polygons) {
    std::vector<std::vector<uint32_t>> list;
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        list.emplace_back(polygons.vertices.begin() + polygons.starts[f],
                          polygons.vertices.begin() + polygons.starts[f + 1]);
        std::rotate(list.back().begin(), std::min_element(list.back().begin(), list.back().end()), list.back().end());
    }
    return list;
}

/// Triangles that turn clockwise: the polygons below lie in the plane and turn counter-clockwise.
size_t folds(const std::vector<uint32_t>& triangles, const std::vector<glm::vec3>& positions) {
    size_t count = 0;
    for (size_t t = 0; t < triangles.size(); t += 3) {
        const glm::vec3 a = positions[triangles[t]];
        count += glm::cross(positions[triangles[t + 1]] - a, positions[triangles[t + 2]] - a).z < 0.0f ? 1 : 0;
    }
    return count;
}

TEST(NgonFans, ConvexPolygonsBeginWhereTheyDoUnlessTheNeighborDid) {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}};
    EXPECT_EQ(encodeNgons(faces({{0, 1, 2, 3}, {3, 4, 5, 0}}), positions),
              (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 3, 4, 5, 3, 5, 0}));
    const std::vector<uint32_t> turned = encodeNgons(faces({{0, 1, 2, 3}, {0, 3, 4, 5}}), positions);
    EXPECT_NE(turned[0], turned[6]);
    EXPECT_EQ(listOf(decodeNgons(turned, identity(6))), listOf(faces({{0, 1, 2, 3}, {0, 3, 4, 5}})));
    EXPECT_TRUE(encodeNgons({}, {}).empty());
}

TEST(NgonFans, ConcavePolygonsDoNotFoldWhereTheyNeedNot) {
    // A dart with its notch at 2, in all rotations.
    const std::vector<glm::vec3> dart{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
    std::vector<uint32_t> corners{0, 1, 2, 3};
    for (int k = 0; k < 4; ++k) {
        const std::vector<uint32_t> triangles = encodeNgons(faces({corners}), dart);
        EXPECT_EQ(folds(triangles, dart), 0u);
        EXPECT_EQ(listOf(decodeNgons(triangles, identity(4))), listOf(faces({corners})));
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    // A pentagon that is seen whole from its notch alone (0), and a square before and behind it that begins there.
    const std::vector<glm::vec3> positions{{0, 2.5f, 0}, {3, -2, 0},  {1, 3, 0},  {-1, 3, 0},
                                           {-3, -2, 0},  {-1, -2, 0}, {0, -2, 0}, {1, -2, 0}};
    const Polygons three = faces({{0, 5, 6}, {0, 1, 2, 3, 4}, {0, 6, 7, 1}});
    const std::vector<uint32_t> triangles = encodeNgons(three, positions);
    EXPECT_EQ(triangles[3], 0u);
    EXPECT_EQ(folds(triangles, positions), 0u);
    EXPECT_EQ(listOf(decodeNgons(triangles, identity(8))), listOf(three));
}

TEST(NgonFans, WhatNoFanFillsStillComesBack) {
    // A comb: seen whole from no corner.
    const std::vector<glm::vec3> comb{{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {3, 1, 0},
                                      {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    const Polygons polygons = faces({identity(12)});
    const std::vector<uint32_t> triangles = encodeNgons(polygons, comb);
    EXPECT_GT(folds(triangles, comb), 0u);
    EXPECT_EQ(listOf(decodeNgons(triangles, identity(12))), listOf(polygons));
}

TEST(NgonFans, AnyRunOfPolygonsComesBack) {
    std::mt19937 random(7); // NOLINT: the same polygons every time
    for (int round = 0; round < 200; ++round) {
        std::vector<glm::vec3> positions(12);
        for (glm::vec3& p : positions) {
            p = {random() % 5, random() % 5, random() % 3};
        }
        std::vector<std::vector<uint32_t>> list;
        for (int f = 0; f < 20; ++f) {
            std::vector<uint32_t> face = identity(12);
            std::shuffle(face.begin(), face.end(), random);
            face.resize(3 + random() % 8);
            list.push_back(face);
        }
        const Polygons polygons = faces(list);
        ASSERT_EQ(listOf(decodeNgons(encodeNgons(polygons, positions), identity(12))), listOf(polygons));
    }
    // More corners than are tried as starts.
    std::vector<glm::vec3> ring;
    for (int k = 0; k < 500; ++k) {
        ring.emplace_back(std::cos(0.01f * static_cast<float>(k)), std::sin(0.01f * static_cast<float>(k)), 0);
    }
    const Polygons large = faces({identity(500), identity(500)});
    EXPECT_EQ(listOf(decodeNgons(encodeNgons(large, ring), identity(500))), listOf(large));
}

} // namespace
} // namespace supple::cage
