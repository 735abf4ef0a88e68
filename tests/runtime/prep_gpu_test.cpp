// What the GPU writes against the CPU: p-rep coefficients, positions, normals, border bits, both mappings.
#include "cage/topology.h"
#include "surface/grid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/prep_vectors.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"
#include "tools/reference/prep.h"

#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using surface::prep::Options;

GpuOptions gpuOptions(const Options& options, SuppleMapping mapping, uint32_t rate) {
    GpuOptions gpu;
    gpu.mapping = mapping;
    gpu.rate = rate;
    gpu.tangents =
        options.tangentMode == surface::prep::TangentMode::printed ? SUPPLE_TANGENTS_PRINTED : SUPPLE_TANGENTS_DEFAULT;
    gpu.corners =
        options.cornerRule == surface::prep::CornerRule::smooth ? SUPPLE_CORNERS_SMOOTH : SUPPLE_CORNERS_SHARP;
    return gpu;
}

class PrepOnGpu : public testing::TestWithParam<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, PrepOnGpu, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(PrepOnGpu, MatchesTheStoredVectors) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const PrepVectors& v : prepVectors()) {
        GpuSurface gpu(*device, v.cage, gpuOptions(v.options, GetParam(), 4));
        ASSERT_TRUE(gpu.valid());
        gpu.evaluate();
        const double size = extent(v.positions);
        double coefficients = 0.0, positions = 0.0, normals = 0.0;
        for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
            const PrepVectors::Face& face = v.faces[gpu.patches()[p].face];
            for (uint32_t k = 0; k < 16; ++k) {
                raise(coefficients, glm::length(glm::dvec3(gpu.coefficient(0, p, k)) - face.g[k]) / size);
                raise(coefficients, glm::length(glm::dvec3(gpu.coefficient(0, p, 16 + k)) - face.h[k]) / size);
            }
            for (uint32_t s = 0; s < 25; ++s) {
                raise(positions, glm::length(glm::dvec3(gpu.vertex(0, p, s).position) - face.positions[s]) / size);
                raise(normals, angleDegrees(gpu.vertex(0, p, s).normal, face.normals[s]));
            }
        }
        std::printf("%-28s coefficients %.1e, positions %.1e of the extent, normals %.1e degrees\n", v.name.c_str(),
                    coefficients, positions, normals);
        EXPECT_LE(coefficients, 1e-5) << v.name;
        EXPECT_LE(positions, 1e-5) << v.name;
        EXPECT_LE(normals, 0.05) << v.name;
    }
}

/// Border samples of the two sides of interior edges.
ComparedBits countBorderBits(const GpuSurface& gpu, const cage::Cage& cage, const cage::Topology& topology) {
    std::vector<uint32_t> patchOfFace(cage.faceCount());
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        patchOfFace[gpu.patches()[p].face] = p;
    }
    const uint32_t rate = gpu.output().grid.rate;
    ComparedBits bits;
    const auto position = [&](uint32_t corner, uint32_t k) {
        const uint32_t face = topology.cornerFaces[corner];
        const uint32_t edge = corner - cage.faceStarts[face];
        return gpu.vertex(0, patchOfFace[face], surface::edgeSample(surface::Domain::quad, rate, edge, k)).position;
    };
    for (const cage::Topology::Edge& edge : topology.edges) {
        if (edge.twin == cage::kNone) {
            continue;
        }
        for (uint32_t k = 0; k <= rate; ++k) {
            bits.compare(position(edge.corner, k), position(edge.twin, rate - k));
        }
    }
    return bits;
}

std::vector<NamedCage> borderCages() {
    std::vector<NamedCage> cages;
    cages.push_back({"cube", cube()});
    cages.push_back({"cube sphere", perturbed(cage::makeCubeSphere(4), 0.02f, 1)});
    cages.push_back({"split torus", perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2)});
    cages.push_back({"trapezohedron", perturbed(trapezohedron(7), 0.05f, 3)});
    cages.push_back({"open grid", perturbed(grid(4, 3), 0.1f, 4)});
    cages.push_back({"open fan", perturbed(fan(5, 3, 4.7, false), 0.02f, 5)});
    // Coordinates that are exactly zero on a mirror plane: the sign of zero must agree too.
    cages.push_back({"mirror-symmetric cube sphere", cage::makeCubeSphere(2)});
    return cages;
}

TEST_P(PrepOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits all;
    for (const NamedCage& named : borderCages()) {
        Result<cage::Topology> topology = cage::buildTopology(named.cage);
        ASSERT_TRUE(topology.ok()) << named.name << ": " << topology.error().message;
        for (const uint32_t rate : {1u, 2u, 3u, 5u, 7u, 8u, 11u, 17u, 64u}) {
            GpuSurface gpu(*device, named.cage, gpuOptions({}, GetParam(), rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const ComparedBits bits = countBorderBits(gpu, named.cage, *topology);
            EXPECT_EQ(bits.different, 0u) << named.name << " at rate " << rate << " of " << bits.samples;
            all.add(bits);
        }
    }
    all.print("border samples");
}

TEST(PrepMappings, GiveTheSamePositionBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const NamedCage& named : borderCages()) {
        for (const uint32_t rate : {1u, 2u, 3u, 6u, 8u, 13u, 33u, 64u}) {
            ComparedBits bits;
            const auto coefficients = [&](const GpuSurface& narrow, const GpuSurface& wide, uint32_t p) {
                for (uint32_t k = 0; k < 32; ++k) {
                    bits.compare(narrow.coefficient(0, p, k), wide.coefficient(0, p, k));
                }
            };
            ASSERT_NO_FATAL_FAILURE(
                compareMappings(*device, named.cage, gpuOptions({}, SUPPLE_MAPPING_NARROW, rate), bits, coefficients));
            EXPECT_EQ(bits.different, 0u) << named.name << " at rate " << rate;
        }
    }
}

TEST(PrepOnGpuFormats, SixteenBytesHoldTheSamePositionsAndCloseNormals) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const cage::Cage cage = perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2);
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        GpuOptions options = gpuOptions({}, mapping, 7);
        GpuSurface full(*device, cage, options);
        options.format = SUPPLE_VERTEX_16;
        GpuSurface packed(*device, cage, options);
        ASSERT_TRUE(full.valid() && packed.valid());
        full.evaluate();
        packed.evaluate();
        double worst = 0.0;
        for (uint32_t p = 0; p < full.output().surface.patchCount; ++p) {
            for (uint32_t s = 0; s < full.sampleCount(p); ++s) {
                EXPECT_EQ(std::memcmp(&full.vertex(0, p, s).position, &packed.vertex(0, p, s).position, 12), 0);
                raise(worst, angleDegrees(full.vertex(0, p, s).normal, packed.vertex(0, p, s).normal));
            }
        }
        std::printf("octahedral 2 x 16: largest error %.4f degrees\n", worst);
        EXPECT_LE(worst, 0.005);
    }
}

TEST(PrepOnGpuRegular, AllValencesFourHasNoPerturbation) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    GpuSurface gpu(*device, torus(7, 5), gpuOptions({}, SUPPLE_MAPPING_NARROW, 5));
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    for (uint32_t p = 0; p < gpu.output().surface.patchCount; ++p) {
        EXPECT_EQ(gpu.patches()[p].patchClass, SUPPLE_PATCH_REGULAR);
        for (uint32_t k = 16; k < 32; ++k) {
            EXPECT_EQ(gpu.coefficient(0, p, k), glm::vec3(0.0f));
        }
    }
}

} // namespace
} // namespace supple::test
