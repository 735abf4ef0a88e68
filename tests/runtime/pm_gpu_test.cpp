// P_m on the device: against the stored vectors, against the reference, and the bits its patches share.
#include "tests/support/corner_weights.h"
#include "tests/support/pm_gpu.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_vectors.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"
#include "tools/reference/pm.h"

#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace supple::test {
namespace {

using surface::PatchClass;

class PmOnGpu : public testing::TestWithParam<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, PmOnGpu, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(PmOnGpu, CoefficientsMatchTheStoredVectors) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const PmVectors& v : pmVectors()) {
        GpuSurface gpu(*device, v.cage, pmOptions(GetParam(), 4));
        ASSERT_TRUE(gpu.valid());
        gpu.evaluate();
        const surface::pm::Mesh mesh = v.mesh();
        const PmPatches patches(gpu, mesh);
        double worst = 0.0;
        for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
            const std::vector<glm::dvec3>& expected = v.patches[patches.facet(p)].coefficients;
            ASSERT_EQ(gpu.patches()[p].coefficientCount, expected.size());
            for (uint32_t k = 0; k < expected.size(); ++k) {
                raise(worst, glm::length(glm::dvec3(gpu.coefficient(0, p, k)) - expected[k]) / extent(v.positions));
            }
        }
        std::printf("%-24s %3zu patches, coefficients within %.1e of the extent\n", v.name.c_str(),
                    gpu.patches().size(), worst);
        EXPECT_LE(worst, 1e-5) << v.name;
    }
}

TEST_P(PmOnGpu, SurfaceMatchesTheReference) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const uint32_t rate : {1u, 2u, 3u, 7u}) {
        double worstPosition = 0.0, worstNormal = 0.0;
        uint64_t samples = 0, skipped = 0;
        for (const PmCage& zoo : pmZoo()) {
            GpuSurface gpu(*device, zoo.cage, pmOptions(GetParam(), rate));
            ASSERT_TRUE(gpu.valid()) << zoo.name;
            gpu.evaluate();
            const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(zoo.cage);
            ASSERT_TRUE(mesh.ok());
            const PmPatches patches(gpu, *mesh);
            std::vector<glm::dvec3> positions(zoo.cage.positions.begin(), zoo.cage.positions.end());
            const auto coefficients = surface::pm::construct<double>(*mesh, positions);
            for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
                const auto patch = surface::pm::gatherPatch<double>(*mesh, coefficients, patches.facet(p));
                for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                    const auto expected =
                        surface::pm::evaluate(patch, surface::pm::domainPoint<double>(patch.patchClass, rate, s));
                    const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                    raise(worstPosition,
                          glm::length(glm::dvec3(vertex.position) - expected.position) / extent(positions));
                    ++samples;
                    // Where the zoo's random scalars fold the surface there is no normal that float could tell.
                    const double angle = angleDegrees(vertex.normal, expected.normal);
                    if (angle > 0.05) {
                        ++skipped;
                    } else {
                        raise(worstNormal, angle);
                    }
                }
            }
        }
        std::printf("rate %u: %llu samples, positions within %.1e of the extent; normals: %.4f %% within 0.05 degrees, "
                    "those %.1e\n",
                    rate, static_cast<unsigned long long>(samples), worstPosition,
                    100.0 * static_cast<double>(samples - skipped) / static_cast<double>(samples), worstNormal);
        EXPECT_LE(worstPosition, 1e-5);
        EXPECT_LE(static_cast<double>(skipped), 1e-3 * static_cast<double>(samples));
    }
}

TEST_P(PmOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    std::map<std::pair<PatchClass, PatchClass>, ComparedBits> pairs;
    ComparedBits hard;
    for (const PmCage& zoo : pmZoo()) {
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(zoo.cage);
        ASSERT_TRUE(mesh.ok());
        for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
            GpuSurface gpu(*device, zoo.cage, pmOptions(GetParam(), rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const PmPatches patches(gpu, *mesh);
            for (uint32_t e = 0; e < mesh->topology.edges.size(); ++e) {
                const cage::Topology::Edge& edge = mesh->topology.edges[e];
                if (!patches.shared(edge)) {
                    continue;
                }
                const PatchClass a = mesh->classes[mesh->topology.cornerFaces[edge.corner]];
                const PatchClass b = mesh->classes[mesh->topology.cornerFaces[edge.twin]];
                ComparedBits& bits = mesh->features.hard(e) ? hard : pairs[std::minmax(a, b)];
                bits.add(patches.sharedBits(0, edge));
            }
        }
    }
    for (const auto& [classes, bits] : pairs) {
        std::printf("%-9s %-9s %8llu samples, %llu differ\n", surface::className(classes.first),
                    surface::className(classes.second), static_cast<unsigned long long>(bits.samples),
                    static_cast<unsigned long long>(bits.different));
        EXPECT_EQ(bits.different, 0u);
    }
    std::printf("hard edges          %8llu samples, %llu differ\n", static_cast<unsigned long long>(hard.samples),
                static_cast<unsigned long long>(hard.different));
    EXPECT_EQ(hard.different, 0u);
    EXPECT_EQ(pairs.size(), 15u) << "every pair of classes";
    EXPECT_GT(hard.samples, 0u);
}

TEST(PmMappings, GiveTheSamePositionBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits bits;
    for (const PmCage& zoo : pmZoo()) {
        for (const uint32_t rate : {1u, 3u, 4u, 7u}) {
            ASSERT_NO_FATAL_FAILURE(compareMappings(*device, zoo.cage, pmOptions(SUPPLE_MAPPING_NARROW, rate), bits));
        }
    }
    bits.print("samples");
    EXPECT_EQ(bits.different, 0u);
}

/// UV sets and colors of every class of patch, against weights computed from the grid's own numbers.
TEST_P(PmOnGpu, AttributesReachTheSurfaceVertices) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    std::map<SuppleDomain, uint64_t> domains;
    for (const PmCage& zoo : pmZoo()) {
        if (zoo.variant != PmVariant::plain) {
            continue;
        }
        cage::Cage cage = zoo.cage;
        for (uint32_t c = 0; c < cage.cornerCount(); ++c) { // a seam at every edge
            const auto x = static_cast<float>(c % 97) / 97.0f;
            cage.cornerUvs.emplace_back(x, 1.0f - x * x);
            cage.cornerUvs1.emplace_back(3.0f * x, -x);
        }
        for (const uint32_t rate : {1u, 3u, 8u}) {
            GpuSurface gpu(*device, cage, pmOptions(GetParam(), rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
            ASSERT_TRUE(mesh.ok());
            const PmPatches patches(gpu, *mesh);
            ASSERT_EQ(gpu.output().streams.uvs1.size, VkDeviceSize{gpu.output().grid.vertexCount} * 8);
            const Result<std::vector<std::byte>> bytes = device->readBuffer(gpu.output().streams.attributes);
            const Result<std::vector<std::byte>> bytes1 = device->readBuffer(gpu.output().streams.uvs1);
            ASSERT_TRUE(bytes.ok() && bytes1.ok());
            for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
                const SuppleDomain domain = gpu.rangeOf(p).domain;
                for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                    const auto weights = cornerWeights(static_cast<surface::Domain>(domain), rate, s);
                    glm::vec2 uv(0.0f), uv1(0.0f), read, read1;
                    for (uint32_t i = 0; i < gpu.patches()[p].cornerCount; ++i) {
                        const uint32_t corner = mesh->corner(patches.facet(p), i);
                        uv += weights[i] * mesh->cage.cornerUvs[corner];
                        uv1 += weights[i] * mesh->cage.cornerUvs1[corner];
                    }
                    std::memcpy(&read, bytes->data() + size_t{16} * gpu.vertexIndex(p, s), sizeof(read));
                    std::memcpy(&read1, bytes1->data() + size_t{8} * gpu.vertexIndex(p, s), sizeof(read1));
                    ASSERT_LE(glm::length(read - uv), 1e-5f) << zoo.name << " rate " << rate << " patch " << p;
                    ASSERT_LE(glm::length(read1 - uv1), 1e-5f) << zoo.name << " rate " << rate << " patch " << p;
                    ++domains[domain];
                }
            }
        }
    }
    EXPECT_EQ(domains.size(), 4u) << "every domain";
}

TEST(PmAndPrep, RegularQuadsHaveTheSameBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    uint64_t compared = 0, different = 0;
    for (const cage::Cage& cage : {perturbed(torus(7, 5), 0.05f, 1), perturbed(grid(6, 5), 0.1f, 2),
                                   perturbed(cage::makeSplitTorus(6, 5), 0.02f, 3)}) {
        for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
            GpuOptions options = pmOptions(mapping, 5);
            GpuSurface pm(*device, cage, options);
            options.scheme = SUPPLE_SCHEME_PREP;
            GpuSurface prep(*device, cage, options);
            ASSERT_TRUE(pm.valid() && prep.valid());
            pm.evaluate();
            prep.evaluate();
            std::map<uint32_t, uint32_t> regular;
            for (uint32_t p = 0; p < prep.patches().size(); ++p) {
                if (prep.patches()[p].patchClass == SUPPLE_PATCH_REGULAR) {
                    regular[prep.patches()[p].face] = p;
                }
            }
            for (uint32_t p = 0; p < pm.patches().size(); ++p) {
                const auto found = regular.find(pm.patches()[p].face);
                if (found == regular.end()) {
                    continue;
                }
                EXPECT_EQ(pm.patches()[p].patchClass, SUPPLE_PATCH_REGULAR);
                for (uint32_t s = 0; s < 36; ++s) {
                    ++compared;
                    different += std::memcmp(&pm.vertex(0, p, s), &prep.vertex(0, found->second, s), 24) != 0;
                }
            }
        }
    }
    std::printf("%llu samples compared, positions and normals of %llu differ\n",
                static_cast<unsigned long long>(compared), static_cast<unsigned long long>(different));
    EXPECT_GT(compared, 1000u);
    EXPECT_EQ(different, 0u);
}

} // namespace
} // namespace supple::test
