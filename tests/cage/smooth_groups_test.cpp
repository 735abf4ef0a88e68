// Which corners are shaded as one: by creases, and by the normals of a file.
#include "cage/smooth_groups.h"

#include "cage/corner_normals.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace supple::cage {
namespace {

size_t groupCount(const Cage& cage) {
    const std::vector<uint32_t> groups = smoothGroups(cage);
    EXPECT_EQ(groups.size(), cage.cornerCount());
    for (uint32_t corner = 0; corner < groups.size(); ++corner) {
        EXPECT_EQ(cage.faceVertices[groups[corner]], cage.faceVertices[corner]) << "a group is of one vertex";
        EXPECT_LE(groups[corner], corner);
        EXPECT_EQ(groups[groups[corner]], groups[corner]);
    }
    return std::set<uint32_t>(groups.begin(), groups.end()).size();
}

TEST(SmoothGroups, InfinitelySharpCreasesCut) {
    Cage cage = test::cube();
    EXPECT_EQ(groupCount(cage), 8u);
    // One edge cuts nothing apart: there is a way round. A loop does.
    cage.creases = {{cage.faceVertices[0], cage.faceVertices[1], 10.0f}};
    EXPECT_EQ(groupCount(cage), 8u);
    for (uint32_t k = 1; k < 4; ++k) {
        cage.creases.push_back({cage.faceVertices[k], cage.faceVertices[(k + 1) % 4], 12.0f});
    }
    EXPECT_EQ(groupCount(cage), 12u);
    for (Crease& crease : cage.creases) {
        crease.sharpness = 9.9f;
    }
    EXPECT_EQ(groupCount(cage), 8u);
}

TEST(SmoothGroups, NormalsThatDisagreeCut) {
    Cage cage = test::cube();
    cage.cornerNormals = cornerNormals(cage);
    EXPECT_EQ(groupCount(cage), 8u);
    // Creases do not matter where there are normals.
    cage.creases = {{cage.faceVertices[0], cage.faceVertices[1], 10.0f}};
    EXPECT_EQ(groupCount(cage), 8u);
    // Half a degree is rounding, two degrees are an edge.
    const glm::vec3 normal = cage.cornerNormals[0], across = glm::normalize(glm::cross(normal, glm::vec3(1, 0, 0)));
    cage.cornerNormals[0] = glm::normalize(normal + 0.009f * across);
    EXPECT_EQ(groupCount(cage), 8u);
    cage.cornerNormals[0] = glm::normalize(normal + 0.035f * across);
    EXPECT_EQ(groupCount(cage), 9u);
    // Corners without a normal are alone, and flat.
    cage.cornerNormals.assign(cage.cornerCount(), glm::vec3(0.0f));
    EXPECT_EQ(groupCount(cage), 24u);
    const std::vector<glm::vec3> flat = cornerNormals(cage);
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        EXPECT_FLOAT_EQ(std::abs(flat[c].x) + std::abs(flat[c].y) + std::abs(flat[c].z), 1.0f);
    }
}

/// A cube with its own normals, flat on some faces, turned by a quarter: the normals turn with it.
TEST(SmoothGroups, NormalsOfADeformedCageKeepItsGroups) {
    Cage cage = test::cube();
    cage.cornerNormals = cornerNormals(cage);
    std::fill(cage.cornerNormals.begin(), cage.cornerNormals.begin() + 8, glm::vec3(0.0f));
    const auto turned = [](const glm::vec3& v) { return glm::vec3(-v.y, v.x, v.z); };
    std::vector<glm::vec3> positions;
    for (const glm::vec3& position : cage.positions) {
        positions.push_back(turned(position));
    }
    const std::vector<glm::vec3> still = deformedCornerNormals(cage, cage.positions);
    const std::vector<glm::vec3> moved = deformedCornerNormals(cage, positions);
    ASSERT_EQ(moved.size(), cage.cornerCount());
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        EXPECT_LT(glm::distance(moved[corner], turned(still[corner])), 1e-6f);
        const bool flat = std::abs(std::abs(moved[corner].x + moved[corner].y + moved[corner].z) - 1.0f) < 1e-6f;
        EXPECT_EQ(flat, corner < 8) << "corner " << corner;
    }
}

TEST(SmoothGroups, TakeAnyCage) {
    // Three faces round an edge; two that touch in a vertex; a face that repeats one.
    EXPECT_EQ(groupCount(test::makeCage({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                                        {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}})),
              5u);
    EXPECT_EQ(
        groupCount(test::makeCage({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}})),
        6u);
    EXPECT_GE(groupCount(test::makeCage({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 0}})), 3u);
}

} // namespace
} // namespace supple::cage
