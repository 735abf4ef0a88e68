// What a host may get wrong, and what it is told.
#include "tests/support/cpu_group.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace supple::test {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

CpuOptions withScheme(SuppleScheme scheme) {
    CpuOptions options;
    options.scheme = scheme;
    return options;
}

TEST(CpuMistakes, PointsThatDoNotExist) {
    cage::Cage cage = fanOverPentagons(6);
    cage.holes = {1};
    CpuGroup group(cage, withScheme(SUPPLE_SCHEME_PM));
    ASSERT_TRUE(group.valid());
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    uint32_t pentagon = 0, quad = 0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        pentagon = cage.sides(face) == 5 ? face : pentagon;
        quad = cage.sides(face) == 4 ? face : quad;
    }
    const std::pair<SuppleSurfacePoint, const char*> mistakes[] = {
        {{cage.faceCount(), 0, 0.5f, 0.25f}, "there is no such face"},
        {{1, 0, 0.5f, 0.25f}, "the face is a hole"},
        {{0, 1, 0.5f, 0.25f}, "the face has no such side"},
        {{pentagon, 5, 0.5f, 0.25f}, "the face has no such side"},
        {{0, 0, kNotANumber, 0.25f}, "a or b is not finite"},
        {{0, 0, 0.25f, -std::numeric_limits<float>::infinity()}, "a or b is not finite"},
        {{0, 0, -0.1f, 0.25f}, "a and b do not lie in the face"},
        {{0, 0, 0.75f, 0.5f}, "a and b do not lie in the face"},
        {{quad, 0, 0.5f, 1.001f}, "a and b do not lie in the face"},
        {{pentagon, 0, 0.75f, 0.5f}, "a and b do not lie in the face"},
    };
    for (const auto& [mistake, reason] : mistakes) {
        std::vector<SuppleSurfacePoint> points(2000, SuppleSurfacePoint{quad, 0, 0.5f, 0.5f});
        points[1700] = points[1801] = mistake;
        std::vector<SuppleSurfaceJet> jets(points.size());
        EXPECT_EQ(suppleCpuEvaluatePoints(group.pose(), points.data(), 2000, jets.data(), nullptr),
                  SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(group.lines().back(),
                  "suppleCpuEvaluatePoints: points[1700], face " + std::to_string(mistake.face) + ": " + reason);
    }
    EXPECT_EQ(suppleCpuEvaluatePoints(group.pose(), nullptr, 0, nullptr, nullptr), SUPPLE_OK);
}

TEST(CpuMistakes, CagesThatDoNotFit) {
    const cage::Cage cage = cube();
    CpuGroup group(cage, withScheme(SUPPLE_SCHEME_CATMULL_CLARK));
    const float* first = &cage.positions[0].x;
    const auto build = [&](const float* positions, size_t stride, uint32_t count) {
        return suppleCpuBuildPose(group.pose(), positions, stride, count, nullptr);
    };
    EXPECT_EQ(build(nullptr, 12, 8), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuBuildPose: cage is null");
    EXPECT_EQ(build(first, 8, 8), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(build(first, 14, 8), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(build(first, 12, 7), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuBuildPose: 7 vertices for a cage of 8");
    EXPECT_EQ(build(first, 12, 8), SUPPLE_OK);
    for (const float bad : {kNotANumber, 2e9f, -std::numeric_limits<float>::infinity()}) {
        std::vector<glm::vec3> positions = cage.positions;
        positions[3].y = bad;
        EXPECT_EQ(group.build(positions), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(group.lines().back(), "suppleCpuBuildPose: vertex 3 is not finite or beyond SUPPLE_MAX_COORDINATE");
    }
    const CpuGroup::Vertices before = group.evaluate(0, 3); // the pose is as it was
    // Vertices with something behind them.
    std::vector<glm::vec4> wide;
    for (const glm::vec3& p : cage.positions) {
        wide.emplace_back(p, kNotANumber);
    }
    EXPECT_EQ(build(&wide[0].x, sizeof(glm::vec4), 8), SUPPLE_OK);
    EXPECT_EQ(group.evaluate(0, 3).positions, before.positions);
}

TEST(CpuMistakes, GridsThatDoNotExist) {
    const cage::Cage cage = cube();
    CpuGroup group(cage, withScheme(SUPPLE_SCHEME_CATMULL_CLARK));
    constexpr uint32_t kVertices = 6 * 81;
    std::vector<float> room(3 * kVertices);
    EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 0, 8, room.data(), nullptr, kVertices, nullptr),
              SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuEvaluateGrid: the pose is not built");
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 1, 8, room.data(), nullptr, kVertices, nullptr),
              SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuEvaluateGrid: surface 1 of 1");
    for (const uint32_t rate : {0u, 65u}) {
        EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 0, rate, room.data(), nullptr, kVertices, nullptr),
                  SUPPLE_ERROR_ARGUMENT);
        uint32_t index = 0;
        EXPECT_EQ(suppleCpuGetGridIndices(group.handle(), 0, rate, &index, 1), SUPPLE_ERROR_ARGUMENT);
    }
    EXPECT_EQ(group.lines().back(), "suppleCpuGetGridIndices: rate 65 leaves 1..64");
    EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 0, 8, nullptr, nullptr, 0, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuGetGridIndices(group.handle(), 0, 8, nullptr, 0), SUPPLE_ERROR_ARGUMENT);
    SuppleCpuGridInfo info{};
    EXPECT_EQ(suppleCpuGetGridInfo(group.handle(), 0, 8, &info), SUPPLE_ERROR_ARGUMENT);
    EXPECT_NE(group.lines().back().find("out.structSize is 0"), std::string::npos);
    EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 0, 8, room.data(), nullptr, kVertices, nullptr), SUPPLE_OK);
    for (const uint32_t other : {kVertices - 1, kVertices + 1, 0u}) {
        EXPECT_EQ(suppleCpuEvaluateGrid(group.pose(), 0, 8, room.data(), nullptr, other, nullptr),
                  SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(group.lines().back(),
                  "suppleCpuEvaluateGrid: room for " + std::to_string(other) + " vertices for a grid of 486");
    }
    std::vector<uint32_t> indices(6 * 6 * 64);
    const auto total = static_cast<uint32_t>(indices.size());
    EXPECT_EQ(suppleCpuGetGridIndices(group.handle(), 0, 8, indices.data(), total), SUPPLE_OK);
    EXPECT_EQ(suppleCpuGetGridIndices(group.handle(), 0, 8, indices.data(), total - 1), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuGetGridIndices: room for 2303 indices for a grid of 2304");
}

TEST(CpuMistakes, Patches) {
    CpuGroup group(cube(), withScheme(SUPPLE_SCHEME_CATMULL_CLARK));
    std::vector<SupplePatchInfo> patches(6);
    uint32_t count = 0;
    EXPECT_EQ(suppleCpuGetPatches(nullptr, 0, nullptr, &count), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuGetPatches(group.handle(), 0, nullptr, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuGetPatches: count is null");
    EXPECT_EQ(suppleCpuGetPatches(group.handle(), 1, nullptr, &count), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuGetPatches: surface 1 of 1");
    EXPECT_EQ(suppleCpuGetPatches(group.handle(), 0, nullptr, &count), SUPPLE_OK);
    EXPECT_EQ(count, 6u);
    count = 5;
    EXPECT_EQ(suppleCpuGetPatches(group.handle(), 0, patches.data(), &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, 6u);
    EXPECT_EQ(suppleCpuGetPatches(group.handle(), 0, patches.data(), &count), SUPPLE_OK);
    for (uint32_t p = 0; p < 6; ++p) {
        EXPECT_EQ(patches[p].face, p);
        EXPECT_EQ(patches[p].cornerCount, 4u);
        EXPECT_LT(patches[p].corners[3], 8u);
    }
}

TEST(CpuMistakes, TrianglesNameVerticesOfTheGrid) {
    const cage::Cage cage = fanOverPentagons(6);
    CpuGroup group(cage, withScheme(SUPPLE_SCHEME_PM));
    const SuppleCpuGridInfo info = group.grid(0, 5);
    std::vector<uint32_t> indices(info.indexCount);
    ASSERT_EQ(suppleCpuGetGridIndices(group.handle(), 0, 5, indices.data(), info.indexCount), SUPPLE_OK);
    EXPECT_EQ(*std::max_element(indices.begin(), indices.end()), info.vertexCount - 1);
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    const CpuGroup::Vertices vertices = group.evaluate(0, 5);
    for (size_t i = 0; i < indices.size(); i += 3) { // counter-clockwise, as the normals say
        const glm::vec3 &a = vertices.positions[indices[i]], &b = vertices.positions[indices[i + 1]];
        const glm::vec3& c = vertices.positions[indices[i + 2]];
        EXPECT_GT(glm::dot(glm::cross(b - a, c - a), vertices.normals[indices[i]]), 0.0f) << i / 3;
    }
}

TEST(CpuMistakes, GroupsThatCannotBe) {
    CpuGroup none(cube(), withScheme(SUPPLE_SCHEME_CAGE));
    EXPECT_EQ(none.result(), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(none.lines().back(), "suppleCpuCreateGroup: SUPPLE_SCHEME_CAGE has no surface");
    EXPECT_LT(CpuGroup(prism(5), withScheme(SUPPLE_SCHEME_PREP)).result(), 0); // no quads
    cage::Cage creased = cube();
    creased.creases = {{0, 1, 2.5f}};
    CpuGroup fragments(creased, withScheme(SUPPLE_SCHEME_FRAGMENTS));
    EXPECT_LT(fragments.result(), 0);
    EXPECT_NE(fragments.lines().back().find("test cage: fragments with semi-sharp creases"), std::string::npos);
    EXPECT_EQ(CpuGroup(cube(), withScheme(static_cast<SuppleScheme>(99))).result(), SUPPLE_ERROR_ARGUMENT);
}

TEST(CpuMistakes, NullAndSizes) {
    SuppleCpuGroup group = nullptr;
    SuppleCpuPose pose = nullptr;
    SuppleCpuGroupDesc desc{};
    EXPECT_EQ(suppleCpuCreateGroup(nullptr, &group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuCreateGroup(&desc, &group), SUPPLE_ERROR_ARGUMENT);
    desc.structSize = sizeof(desc);
    EXPECT_EQ(suppleCpuCreateGroup(&desc, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuCreateGroup(&desc, &group), SUPPLE_ERROR_ARGUMENT); // nothing prepared
    suppleCpuDestroyGroup(nullptr);
    suppleCpuDestroyPose(nullptr);
    SuppleCpuGroupInfo info{};
    info.structSize = sizeof(info);
    SuppleCpuGridInfo grid{};
    grid.structSize = sizeof(grid);
    EXPECT_EQ(suppleCpuGetGroupInfo(nullptr, &info), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuGetGridInfo(nullptr, 0, 8, &grid), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuGetGridIndices(nullptr, 0, 8, nullptr, 0), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuCreatePose(nullptr, &pose), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuBuildPose(nullptr, nullptr, 12, 0, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuEvaluatePoints(nullptr, nullptr, 0, nullptr, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuEvaluateGrid(nullptr, 0, 8, nullptr, nullptr, 0, nullptr), SUPPLE_ERROR_ARGUMENT);
    CpuGroup own(cube(), withScheme(SUPPLE_SCHEME_PM));
    EXPECT_EQ(suppleCpuGetGroupInfo(own.handle(), nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCpuGetGroupInfo(own.handle(), &info), SUPPLE_OK);
    EXPECT_EQ(info.cageVertexCount, 8u);
    EXPECT_EQ(info.faceCount, 6u);
    EXPECT_EQ(info.surfaceCount, 1u);
    EXPECT_EQ(suppleCpuCreatePose(own.handle(), nullptr), SUPPLE_ERROR_ARGUMENT);
}

} // namespace
} // namespace supple::test
