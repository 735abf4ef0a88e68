// Characters of files: cooked ones, and parts with schemes of their own.
#include "tests/support/cpu_group.h"

#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

SupplePrepared preparedOf(const void* bytes, size_t count, const SuppleGroupDesc& group) {
    SuppleAssetDesc asset{};
    asset.structSize = sizeof(asset);
    asset.name = "pip_quads.glb";
    asset.bytes = bytes;
    asset.byteCount = count;
    const SupplePlannedGroup planned{&group, 0, 0};
    SupplePrepareDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = &asset;
    desc.groups = &planned;
    desc.groupCount = 1;
    SupplePrepared prepared = nullptr;
    EXPECT_EQ(supplePrepare(&desc, &prepared), SUPPLE_OK);
    return prepared;
}

/// The grid of a prepared character in a pose that moves every vertex a little.
std::vector<glm::vec3> gridOf(SupplePrepared prepared, const SuppleGroupDesc& group) {
    SuppleCpuGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.prepared = prepared;
    desc.group = &group;
    SuppleCpuGroup surfaces = nullptr;
    SuppleCpuPose pose = nullptr;
    EXPECT_EQ(suppleCpuCreateGroup(&desc, &surfaces), SUPPLE_OK);
    EXPECT_EQ(suppleCpuCreatePose(surfaces, &pose), SUPPLE_OK);
    SuppleCpuGroupInfo info{};
    info.structSize = sizeof(info);
    EXPECT_EQ(suppleCpuGetGroupInfo(surfaces, &info), SUPPLE_OK);
    SuppleCpuGridInfo grid{};
    grid.structSize = sizeof(grid);
    EXPECT_EQ(suppleCpuGetGridInfo(surfaces, 0, 4, &grid), SUPPLE_OK);
    std::vector<glm::vec3> cage;
    for (uint32_t v = 0; v < info.cageVertexCount; ++v) {
        cage.emplace_back(static_cast<float>(v % 17), static_cast<float>(v % 5), static_cast<float>(v % 11));
    }
    EXPECT_EQ(suppleCpuBuildPose(pose, &cage[0].x, sizeof(cage[0]), info.cageVertexCount, nullptr), SUPPLE_OK);
    suppleCpuDestroyGroup(surfaces); // the pose stays
    std::vector<glm::vec3> positions(grid.vertexCount);
    EXPECT_EQ(suppleCpuEvaluateGrid(pose, 0, 4, &positions[0].x, nullptr, grid.vertexCount, nullptr), SUPPLE_OK);
    suppleCpuDestroyPose(pose);
    return positions;
}

TEST(CpuCharacters, CookedOnesHaveTheSameSurface) {
    std::ifstream file(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb", std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
        SuppleGroupDesc group{};
        group.structSize = sizeof(group);
        group.scheme = scheme;
        const SupplePrepared read = preparedOf(bytes.data(), bytes.size(), group);
        size_t size = 0;
        ASSERT_EQ(suppleSavePrepared(read, nullptr, nullptr, &size), SUPPLE_OK);
        std::vector<char> cooked(size);
        ASSERT_EQ(suppleSavePrepared(read, nullptr, cooked.data(), &size), SUPPLE_OK);
        const SupplePrepared again = preparedOf(cooked.data(), size, group);
        const std::vector<glm::vec3> one = gridOf(read, group), other = gridOf(again, group);
        EXPECT_TRUE(one.size() > 1000 && one == other);
        suppleDestroyPrepared(read);
        suppleDestroyPrepared(again);
    }
}

/// Each part's surface is that of a group of one scheme: points are named by the whole cage's faces.
TEST(CpuCharacters, PartsHaveSchemesOfTheirOwn) {
    const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb";
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    CpuGroup whole(path, options);
    options.partSchemes = {SUPPLE_SCHEME_PM};
    CpuGroup mixed(path, options);
    ASSERT_TRUE(whole.valid() && mixed.valid());
    EXPECT_EQ(whole.info().surfaceCount, 1u);
    ASSERT_EQ(mixed.info().surfaceCount, 2u);
    options.scheme = SUPPLE_SCHEME_PM;
    options.partSchemes.clear();
    CpuGroup other(path, options);
    std::vector<glm::vec3> cage;
    for (uint32_t v = 0; v < whole.info().cageVertexCount; ++v) {
        cage.emplace_back(static_cast<float>(v % 17), static_cast<float>(v % 5), static_cast<float>(v % 11));
    }
    for (CpuGroup* group : {&whole, &mixed, &other}) {
        ASSERT_EQ(group->build(cage), SUPPLE_OK);
    }
    uint32_t evaluated = 0, ofWhole = 0, ofOther = 0, neither = 0;
    for (uint32_t face = 0; face < whole.info().faceCount; ++face) {
        SuppleSurfaceJet jets[3];
        const SuppleSurfacePoint point{face, 0, 0.25f, 0.375f};
        const CpuGroup* groups[3] = {&whole, &mixed, &other};
        bool all = true;
        for (int g = 0; g < 3; ++g) {
            all = suppleCpuEvaluatePoints(groups[g]->pose(), &point, 1, &jets[g], nullptr) == SUPPLE_OK && all;
        }
        const auto near = [&](int g) {
            return glm::distance(glm::vec3(jets[g].position[0], jets[g].position[1], jets[g].position[2]),
                                 glm::vec3(jets[1].position[0], jets[1].position[1], jets[1].position[2])) < 1e-5f;
        };
        if (all) {
            ++evaluated;
            ofWhole += near(0) ? 1 : 0;
            ofOther += near(2) ? 1 : 0;
            neither += near(0) || near(2) ? 0 : 1;
        }
    }
    EXPECT_EQ(evaluated, whole.info().faceCount);
    EXPECT_GT(ofWhole, 0u);
    EXPECT_GT(ofOther, 0u);
    EXPECT_EQ(neither, 0u);
    for (const uint32_t surface : {0u, 1u}) {
        EXPECT_GT(mixed.evaluate(surface, 3).positions.size(), 0u);
    }
}

/// Eyes and buckles are polygons, which AUTO takes for them too: the rest of the character has its surface.
TEST(CpuCharacters, PartsMayBePolygons) {
    const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb";
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    options.partSchemes = {SUPPLE_SCHEME_POLYGONS};
    CpuGroup mixed(path, options);
    ASSERT_TRUE(mixed.valid());
    ASSERT_EQ(mixed.info().surfaceCount, 2u);
    std::vector<glm::vec3> cage;
    for (uint32_t v = 0; v < mixed.info().cageVertexCount; ++v) {
        cage.emplace_back(static_cast<float>(v % 17), static_cast<float>(v % 5), static_cast<float>(v % 11));
    }
    ASSERT_EQ(mixed.build(cage), SUPPLE_OK);
    uint32_t flat = 0, curved = 0;
    for (uint32_t face = 0; face < mixed.info().faceCount; ++face) {
        const SuppleSurfaceJet jet = mixed.at({{face, 0, 0.25f, 0.375f}})[0];
        const glm::vec3 bend(jet.duu[0], jet.duu[1], jet.duu[2]);
        (bend == glm::vec3(0.0f) ? flat : curved) += 1;
    }
    EXPECT_GT(flat, 0u);
    EXPECT_GT(curved, 0u);
    uint32_t patches = 0;
    for (const uint32_t surface : {0u, 1u}) {
        const std::vector<SupplePatchInfo> own = mixed.patches(surface);
        patches += static_cast<uint32_t>(own.size());
        for (const SupplePatchInfo& patch : own) { // numbers of the whole cage
            EXPECT_LT(patch.face, mixed.info().faceCount);
            for (uint32_t k = 0; k < patch.cornerCount; ++k) {
                EXPECT_LT(patch.corners[k], mixed.info().cageVertexCount);
            }
        }
    }
    EXPECT_GE(patches, mixed.info().faceCount);
}

} // namespace
} // namespace supple::test
