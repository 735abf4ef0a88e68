// P_m on the device: against the stored vectors, against the reference, and the bits its patches share.
#include "cage/procedural.h"
#include "surface/pm/reference.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_vectors.h"
#include "tests/support/pm_zoo.h"

#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace supple::test {
namespace {

using surface::Domain;
using surface::pm::FacetClass;

GpuOptions pmOptions(SuppleMapping mapping, uint32_t rate) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    options.mapping = mapping;
    options.rate = rate;
    return options;
}

/// The patch of every facet of the mesh: patches come by class, then by facet, as the mesh's own order within a class.
std::vector<uint32_t> facetsOf(const GpuSurface& gpu, const surface::pm::Mesh& mesh) {
    constexpr SupplePatchClass kClasses[] = {SUPPLE_PATCH_REGULAR, SUPPLE_PATCH_POLAR, SUPPLE_PATCH_P3, SUPPLE_PATCH_P4,
                                             SUPPLE_PATCH_P5};
    std::vector<uint32_t> facets;
    for (const SupplePatchClass patchClass : kClasses) {
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            if (kClasses[static_cast<size_t>(mesh.classes[f])] == patchClass) {
                facets.push_back(f);
            }
        }
    }
    EXPECT_EQ(facets.size(), gpu.patches().size());
    for (uint32_t p = 0; p < facets.size(); ++p) {
        EXPECT_EQ(gpu.patches()[p].face, mesh.sourceFaces[facets[p]]);
        EXPECT_EQ(gpu.patches()[p].cornerCount, mesh.cage.sides(facets[p]));
        for (uint32_t i = 0; i < gpu.patches()[p].cornerCount; ++i) {
            EXPECT_EQ(gpu.patches()[p].corners[i], mesh.cage.faceVertices[mesh.corner(facets[p], i)]);
        }
    }
    return facets;
}

class PmOnGpu : public testing::TestWithParam<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, PmOnGpu, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) {
                             return param.param == SUPPLE_MAPPING_NARROW ? std::string("Narrow") : std::string("Wide");
                         });

TEST_P(PmOnGpu, CoefficientsMatchTheStoredVectors) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const PmVectors& v : pmVectors()) {
        GpuSurface gpu(*device, v.cage, pmOptions(GetParam(), 4));
        ASSERT_TRUE(gpu.valid());
        gpu.evaluate();
        const std::vector<uint32_t> facets = facetsOf(gpu, v.mesh());
        double worst = 0.0;
        for (uint32_t p = 0; p < facets.size(); ++p) {
            const std::vector<glm::dvec3>& expected = v.patches[facets[p]].coefficients;
            ASSERT_EQ(gpu.patches()[p].coefficientCount, expected.size());
            for (uint32_t k = 0; k < expected.size(); ++k) {
                raise(worst, glm::length(glm::dvec3(gpu.coefficient(0, p, k)) - expected[k]) / extent(v.positions));
            }
        }
        std::printf("%-24s %3zu patches, coefficients within %.1e of the extent\n", v.name.c_str(), facets.size(),
                    worst);
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
            const std::vector<uint32_t> facets = facetsOf(gpu, *mesh);
            std::vector<glm::dvec3> positions(zoo.cage.positions.begin(), zoo.cage.positions.end());
            const auto coefficients = surface::pm::construct<double>(*mesh, positions);
            for (uint32_t p = 0; p < facets.size(); ++p) {
                const auto patch = surface::pm::gatherPatch<double>(*mesh, coefficients, facets[p]);
                for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                    const auto expected =
                        surface::pm::evaluate(patch, surface::pm::domainPoint<double>(patch.facetClass, rate, s));
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
    struct Bits {
        uint64_t samples = 0;
        uint64_t different = 0;
    };
    std::map<std::pair<FacetClass, FacetClass>, Bits> pairs;
    Bits hard;
    for (const PmCage& zoo : pmZoo()) {
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(zoo.cage);
        ASSERT_TRUE(mesh.ok());
        for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
            GpuSurface gpu(*device, zoo.cage, pmOptions(GetParam(), rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const std::vector<uint32_t> facets = facetsOf(gpu, *mesh);
            std::vector<uint32_t> patchOfFacet(facets.size());
            for (uint32_t p = 0; p < facets.size(); ++p) {
                patchOfFacet[facets[p]] = p;
            }
            const auto position = [&](uint32_t corner, uint32_t k) {
                const uint32_t f = mesh->topology.cornerFaces[corner], m = mesh->cage.sides(f);
                const uint32_t edge = (corner - mesh->cage.faceStarts[f] + m - mesh->firstCorners[f]) % m;
                const Domain domain = surface::pm::domainOf(mesh->classes[f]);
                return gpu.vertex(0, patchOfFacet[f], surface::edgeSample(domain, rate, edge, k)).position;
            };
            for (uint32_t e = 0; e < mesh->topology.edges.size(); ++e) {
                const cage::Topology::Edge& edge = mesh->topology.edges[e];
                if (edge.twin == cage::kNone) {
                    continue;
                }
                FacetClass a = mesh->classes[mesh->topology.cornerFaces[edge.corner]];
                FacetClass b = mesh->classes[mesh->topology.cornerFaces[edge.twin]];
                Bits& bits = mesh->edgeCut[e] != 0 ? hard : pairs[std::minmax(a, b)];
                for (uint32_t k = 0; k <= rate; ++k) {
                    const glm::vec3 x = position(edge.corner, k), y = position(edge.twin, rate - k);
                    ++bits.samples;
                    bits.different += std::memcmp(&x, &y, sizeof(x)) != 0 ? 1 : 0;
                }
            }
        }
    }
    constexpr const char* kNames[] = {"ordinary", "polar", "P3", "P4", "P5"};
    for (const auto& [classes, bits] : pairs) {
        std::printf("%-9s %-9s %8llu samples, %llu differ\n", kNames[static_cast<size_t>(classes.first)],
                    kNames[static_cast<size_t>(classes.second)], static_cast<unsigned long long>(bits.samples),
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
    uint64_t different = 0, samples = 0;
    for (const PmCage& zoo : pmZoo()) {
        for (const uint32_t rate : {1u, 3u, 4u, 7u}) {
            GpuSurface narrow(*device, zoo.cage, pmOptions(SUPPLE_MAPPING_NARROW, rate));
            GpuSurface wide(*device, zoo.cage, pmOptions(SUPPLE_MAPPING_WIDE, rate));
            ASSERT_TRUE(narrow.valid() && wide.valid());
            narrow.evaluate();
            wide.evaluate();
            for (uint32_t p = 0; p < narrow.output().patchCount; ++p) {
                for (uint32_t s = 0; s < narrow.sampleCount(p); ++s) {
                    ++samples;
                    different += std::memcmp(&narrow.vertex(0, p, s).position, &wide.vertex(0, p, s).position, 12) != 0;
                }
            }
        }
    }
    std::printf("%llu samples, %llu differ\n", static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(different));
    EXPECT_EQ(different, 0u);
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
