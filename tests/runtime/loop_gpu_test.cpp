// Loop patches on the device: against the limit in double, both mappings, and the bits that patches share.
#include "cpu/loop.h"
#include "surface/build.h"
#include "tests/support/crowd.h"
#include "tests/support/large_pole.h"
#include "tests/support/loop_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>

namespace supple::test {
namespace {

GpuOptions loopOptions(SuppleMapping mapping, uint32_t rate) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_LOOP;
    options.mapping = mapping;
    options.flags = 0;
    options.rate = rate;
    return options;
}

class LoopOnGpu : public testing::TestWithParam<SuppleMapping> {
protected:
    struct Worst {
        double position = 0.0, normal = 0.0;
        uint64_t samples = 0, steep = 0;
    };
    /// Every `stride`-th sample.
    static void compare(host::Device& device, const cage::Cage& cage, uint32_t rate, uint32_t stride, Worst& worst) {
        const LoopTriangles triangles(cage);
        GpuSurface gpu(device, cage, loopOptions(GetParam(), rate));
        ASSERT_TRUE(gpu.valid());
        gpu.evaluate();
        ASSERT_EQ(gpu.output().grid.rate, rate);
        const std::vector<glm::dvec3> positions = doublePositions(cage);
        const surface::loop::LimitSurface limit(triangles.isolation.mesh, positions);
        const PatchFaces found = triangles.patches(gpu.patches());
        ASSERT_EQ(found.faces.size(), gpu.patches().size());
        const double size = extent(positions);
        uint32_t next = 0;
        for (uint32_t p = 0; p < found.faces.size(); ++p) {
            uint32_t s = 0;
            for (uint32_t j = 0; j <= rate; ++j) {
                for (uint32_t i = 0; i + j <= rate; ++i, ++s) {
                    if (next++ % stride != 0) {
                        continue;
                    }
                    const double segments = rate;
                    const glm::dvec3 at = LoopTriangles::inFace({(rate - i - j) / segments, i / segments, j / segments},
                                                                found.firstCorners[found.faces[p]]);
                    const auto expected = limit.at(found.faces[p], at.y, at.z);
                    const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                    raise(worst.position, glm::length(glm::dvec3(vertex.position) - expected.position) / size);
                    ++worst.samples;
                    const double angle = angleDegrees(vertex.normal, expected.normal);
                    worst.steep += angle > 0.05 ? 1 : 0;
                    raise(worst.normal, angle);
                }
            }
        }
    }
};
INSTANTIATE_TEST_SUITE_P(Mappings, LoopOnGpu, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LoopOnGpu, SurfaceIsTheLimit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (const uint32_t rate : {1u, 2u, 3u, 5u, 8u, 17u}) {
        Worst worst;
        for (size_t i = 0; i < zoo.size(); i += rate < 8 ? 1 : 3) {
            SCOPED_TRACE(zoo[i].name);
            Worst own;
            ASSERT_NO_FATAL_FAILURE(compare(*device, zoo[i].cage, rate, rate < 8 ? 1 : 7, own));
            EXPECT_LE(own.position, 1e-6);
            if (own.steep > 0) {
                std::printf("%s, rate %u: %llu of %llu normals above 0.05 degrees, at most %.2f\n", zoo[i].name.c_str(),
                            rate, static_cast<unsigned long long>(own.steep),
                            static_cast<unsigned long long>(own.samples), own.normal);
            }
            raise(worst.position, own.position);
            raise(worst.normal, own.normal);
            worst.samples += own.samples;
            worst.steep += own.steep;
        }
        std::printf("rate %u: %llu samples, positions within %.1e of the extent; %llu normals above 0.05 degrees, at "
                    "most %.2f\n",
                    rate, static_cast<unsigned long long>(worst.samples), worst.position,
                    static_cast<unsigned long long>(worst.steep), worst.normal);
        EXPECT_EQ(worst.steep, 0u);
    }
}

TEST_P(LoopOnGpu, CharactersAreTheLimit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    size_t characters = 0;
    // Each mapping takes one half of the shared ones.
    const std::vector<std::string> paths = sampledCharacters(2, GetParam() == SUPPLE_MAPPING_WIDE ? 1 : 0);
    forEachCharacter(paths, [&](const std::string& name, const cage::Character& character) {
        SCOPED_TRACE(name);
        cage::Cage cage = character.cage;
        cage.faceMaterials.clear(); // the group is made of arrays without them
        cage.faceParts.clear();
        Worst worst;
        ASSERT_NO_FATAL_FAILURE(compare(*device, cage, 4, 1 + cage.faceCount() / 40, worst));
        EXPECT_LE(worst.position, 1e-6);
        EXPECT_LE(static_cast<double>(worst.steep), 1e-3 * static_cast<double>(worst.samples) + 1.0);
        ++characters;
    });
    EXPECT_GE(characters, 3u);
}

TEST_P(LoopOnGpu, PointsOfLargeCagesComeAgain) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const cage::Cage cage = largePoleOfTriangles();
    surface::Recipe recipe;
    recipe.rate = 2;
    surface::PatchEdges edges;
    Result<surface::Tables> tables = surface::loop::build(recipe, cage, &edges);
    ASSERT_TRUE(tables);
    const LoopTriangles triangles(cage);
    expectCopies(std::move(*tables), edges, cage.faceCount(), triangles.isolation.parent.topology.edges.size());
    Worst worst;
    ASSERT_NO_FATAL_FAILURE(compare(*device, cage, 2, 17, worst));
    EXPECT_LE(worst.position, 1e-6);
    EXPECT_LE(static_cast<double>(worst.steep), 1e-3 * static_cast<double>(worst.samples));
}

TEST_P(LoopOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    std::map<uint32_t, ComparedBits> byRate;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t i = 0; i < zoo.size(); ++i) {
        SCOPED_TRACE(zoo[i].name);
        const LoopTriangles triangles(zoo[i].cage);
        for (const uint32_t rate : {1u, 2u, 3u, 5u, 7u, 8u, 17u, 64u}) {
            if (rate > 8 && i % 5 != 0) {
                continue;
            }
            GpuSurface gpu(*device, zoo[i].cage, loopOptions(GetParam(), rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const ComparedBits bits = borderBits(triangles.isolation.parent.cage, triangles.isolation.parent.topology,
                                                 triangles.patches(gpu.patches()), gpu);
            EXPECT_EQ(bits.different, 0u) << "rate " << rate;
            byRate[rate].add(bits);
        }
    }
    for (const auto& [rate, bits] : byRate) {
        bits.print(("border samples at rate " + std::to_string(rate)).c_str());
        EXPECT_GT(bits.samples, 0u);
    }
}

TEST(LoopMappings, GiveTheSamePositionBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits bits;
    for (const SubdivisionCage& zoo : subdivisionZoo()) {
        for (const uint32_t rate : {6u, 7u}) {
            ASSERT_NO_FATAL_FAILURE(compareMappings(*device, zoo.cage, loopOptions(SUPPLE_MAPPING_NARROW, rate), bits));
        }
    }
    bits.print("positions in both mappings");
    EXPECT_EQ(bits.different, 0u);
}

TEST_P(LoopOnGpu, LowerRatesAreThoseOfGroupsOfTheirOwn) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    CrowdContext own(*device, GetParam());
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(inTriangles(perturbed(biped(), 0.05f, 3)));
    const auto descOf = [&](uint32_t rate) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = SUPPLE_SCHEME_LOOP;
        desc.rate = rate;
        return desc;
    };
    const auto bits = [](Crowd& crowd) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
        crowd.run();
        return crowd.positions(0);
    };
    for (const uint32_t rate : {1u, 3u, 4u, 7u}) {
        Crowd lowered(own, descOf(12)), alone(own, descOf(rate));
        ASSERT_TRUE(lowered.valid() && alone.valid());
        lowered.setRate(rate);
        EXPECT_EQ(lowered.output().grid.rate, rate);
        EXPECT_EQ(differences(bits(lowered), bits(alone)), 0u) << rate;
    }
}

} // namespace
} // namespace supple::test
