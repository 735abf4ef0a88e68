// The subdivision kernel on the device: against the reference, both mappings, all depths, and the bits its patches
// share.
#include "cage/gltf_reader.h"
#include "surface/kernel/reference.h"
#include "tests/support/corner_weights.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/kernel_surface.h"
#include "tests/support/kernel_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using surface::kernel::Mesh;
using surface::kernel::Subdivision;

struct Param {
    SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
    Subdivision subdivision = Subdivision::catmullClark;

    friend std::ostream& operator<<(std::ostream& out, const Param& p) { return out << p.name(); }
    [[nodiscard]] std::string name() const {
        return std::string(mapping == SUPPLE_MAPPING_NARROW ? "Narrow" : "Wide") +
               (subdivision == Subdivision::loop ? "Loop" : "CatmullClark");
    }
};

class KernelOnGpu : public testing::TestWithParam<Param> {
protected:
    [[nodiscard]] GpuOptions options(uint32_t rate) const {
        GpuOptions options;
        options.mapping = GetParam().mapping;
        options.scheme = GetParam().subdivision == Subdivision::loop ? SUPPLE_SCHEME_LOOP : SUPPLE_SCHEME_CATMULL_CLARK;
        options.rate = rate;
        options.flags = SUPPLE_GROUP_ATTRIBUTES;
        return options;
    }
    /// Of a group of one material: the faces of the isolated level that its patches are.
    static std::vector<uint32_t> patchFaces(const Mesh& mesh) {
        std::vector<uint32_t> faces;
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            if (mesh.holes[f] == 0) {
                faces.push_back(f);
            }
        }
        return faces;
    }
};
INSTANTIATE_TEST_SUITE_P(Mappings, KernelOnGpu,
                         testing::Values(Param{SUPPLE_MAPPING_NARROW, Subdivision::catmullClark},
                                         Param{SUPPLE_MAPPING_WIDE, Subdivision::catmullClark},
                                         Param{SUPPLE_MAPPING_NARROW, Subdivision::loop},
                                         Param{SUPPLE_MAPPING_WIDE, Subdivision::loop}),
                         [](const auto& param) { return param.param.name(); });

bool sameBits(const glm::vec3& a, const glm::vec3& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// Against double for exactness, and against float, whose sums are the device's own, for the bits.
TEST_P(KernelOnGpu, SurfaceMatchesTheReference) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::vector<KernelCage>& zoo = kernelZoo();
    for (const uint32_t depth : {1u, 2u, 3u, 4u, 5u}) {
        double worstPosition = 0.0, worstNormal = 0.0;
        uint64_t samples = 0, steep = 0, differ = 0;
        for (size_t i = 0; i < zoo.size(); i += depth < 4 ? 1 : 7) {
            SCOPED_TRACE(zoo[i].name);
            const cage::Cage& cage = zoo[i].cage;
            GpuSurface gpu(*device, cage, options(1u << depth));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const Mesh mesh = kernelMesh(cage, GetParam().subdivision);
            const uint32_t steps = depth > mesh.isolationSteps ? depth - mesh.isolationSteps : 0;
            ASSERT_EQ(gpu.output().rate, 1u << steps);
            const std::vector<glm::dvec3> exact = doublePositions(cage);
            const auto expected =
                surface::kernel::evaluate<double>(mesh, surface::kernel::isolate<double>(mesh, exact), steps);
            const auto rounded =
                surface::kernel::evaluate<float>(mesh, surface::kernel::isolate<float>(mesh, cage.positions), steps);
            const std::vector<uint32_t> faces = patchFaces(mesh);
            ASSERT_EQ(faces.size(), gpu.patches().size());
            std::vector<uint32_t> patches(mesh.cage.faceCount(), cage::kNone);
            for (uint32_t p = 0; p < faces.size(); ++p) {
                patches[faces[p]] = p;
                EXPECT_EQ(gpu.patches()[p].face, mesh.sourceFaces[faces[p]]);
                EXPECT_EQ(gpu.patches()[p].coefficientCount, 0u);
            }
            for (size_t g = 0; g < expected.size(); ++g) {
                const uint32_t p = patches[expected[g].face];
                if (p == cage::kNone) {
                    continue;
                }
                ASSERT_EQ(gpu.sampleCount(p), expected[g].samples.size());
                for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                    const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                    raise(worstPosition,
                          glm::length(glm::dvec3(vertex.position) - expected[g].samples[s].position) / extent(exact));
                    ++samples;
                    differ += sameBits(vertex.position, rounded[g].samples[s].position + 0.0f) ? 0 : 1;
                    const double angle = angleDegrees(vertex.normal, expected[g].samples[s].normal);
                    steep += angle > 0.05 ? 1 : 0;
                    raise(worstNormal, angle);
                }
            }
        }
        std::printf(
            "depth %u: %llu samples, positions within %.1e of the extent, %llu differ from the float reference in "
            "some bit; normals within %.2e degrees, %llu of them above 0.05\n",
            depth, static_cast<unsigned long long>(samples), worstPosition, static_cast<unsigned long long>(differ),
            worstNormal, static_cast<unsigned long long>(steep));
        EXPECT_LE(worstPosition, 1e-6);
        EXPECT_EQ(differ, 0u);
        EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(samples));
    }
}

/// Every edge of the isolated level, inside fragments and between them.
TEST_P(KernelOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    uint64_t samples = 0, different = 0;
    const std::vector<KernelCage>& zoo = kernelZoo();
    for (size_t i = 0; i < zoo.size(); ++i) {
        const KernelCage& entry = zoo[i];
        const Mesh mesh = kernelMesh(entry.cage, GetParam().subdivision);
        const Result<cage::Topology> topology = cage::buildTopology(mesh.cage);
        ASSERT_TRUE(topology.ok());
        std::vector<uint32_t> patches(mesh.cage.faceCount(), cage::kNone);
        const std::vector<uint32_t> faces = patchFaces(mesh);
        for (uint32_t p = 0; p < faces.size(); ++p) {
            patches[faces[p]] = p;
        }
        for (const uint32_t depth : {1u, 2u, 3u, 4u, 5u}) {
            if (depth > 3 && i % 5 != 0) {
                continue; // the rules no longer change, the sizes do
            }
            GpuSurface gpu(*device, entry.cage, options(1u << depth));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const uint32_t rate = gpu.output().rate;
            const surface::Domain domain =
                GetParam().subdivision == Subdivision::loop ? surface::Domain::triangle : surface::Domain::quad;
            const auto onEdge = [&](uint32_t corner, uint32_t k) {
                const uint32_t f = topology->cornerFaces[corner];
                return gpu.vertex(0, patches[f], surface::edgeSample(domain, rate, corner - mesh.cage.faceStarts[f], k))
                    .position;
            };
            for (const cage::Topology::Edge& edge : topology->edges) {
                if (edge.twin == cage::kNone || patches[topology->cornerFaces[edge.corner]] == cage::kNone ||
                    patches[topology->cornerFaces[edge.twin]] == cage::kNone) {
                    continue;
                }
                for (uint32_t k = 0; k <= rate; ++k) {
                    ++samples;
                    different += sameBits(onEdge(edge.corner, k), onEdge(edge.twin, rate - k)) ? 0 : 1;
                }
            }
        }
    }
    std::printf("%llu border samples, %llu differ\n", static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(different));
    EXPECT_EQ(different, 0u);
    EXPECT_GT(samples, 0u);
}

/// A fragment that no shared memory holds, several instances, and the greatest depth.
TEST_P(KernelOnGpu, LargeFragmentsGoThroughTheScratchBuffer) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const cage::Cage cage = gyroBipyramid(40);
    GpuOptions wanted = options(64);
    wanted.instanceCount = 2;
    GpuSurface gpu(*device, cage, wanted);
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    const Mesh mesh = kernelMesh(cage, GetParam().subdivision);
    const std::vector<glm::vec3> isolated = surface::kernel::isolate<float>(mesh, cage.positions);
    uint64_t differ = 0;
    for (const auto& grid : surface::kernel::evaluate<float>(mesh, isolated, 6 - mesh.isolationSteps)) {
        for (uint32_t s = 0; s < grid.samples.size(); ++s) {
            for (uint32_t instance = 0; instance < 2; ++instance) {
                differ +=
                    sameBits(gpu.vertex(instance, grid.face, s).position, grid.samples[s].position + 0.0f) ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(differ, 0u);
}

TEST_P(KernelOnGpu, AttributesReachTheSurfaceVertices) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    cage::Cage cage = kernelZoo().front().cage;
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) { // a seam at every edge
        const auto x = static_cast<float>(c % 97) / 97.0f;
        cage.cornerUvs.emplace_back(x, 1.0f - x * x);
    }
    GpuSurface gpu(*device, cage, options(8));
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    const Mesh mesh = kernelMesh(cage, GetParam().subdivision);
    const Result<std::vector<std::byte>> bytes = device->readBuffer(gpu.output().attributes);
    ASSERT_TRUE(bytes.ok());
    double worst = 0.0;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        const auto domain = static_cast<surface::Domain>(gpu.rangeOf(p).domain);
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            const auto weights = cornerWeights(domain, gpu.output().rate, s);
            glm::vec2 uv(0.0f), read;
            for (uint32_t i = 0; i < mesh.cage.sides(p); ++i) {
                uv += weights[i] * mesh.cage.cornerUvs[mesh.cage.faceStarts[p] + i];
            }
            std::memcpy(&read, bytes->data() + size_t{16} * gpu.vertexIndex(p, s), sizeof(read));
            raise(worst, static_cast<double>(glm::length(read - uv)));
        }
    }
    EXPECT_LE(worst, 1e-6);
}

TEST(KernelMappings, GiveTheSamePositionBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    uint64_t different = 0, samples = 0;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
        for (const KernelCage& entry : kernelZoo()) {
            GpuOptions options;
            options.scheme = scheme;
            options.flags = 0;
            options.rate = 8;
            GpuSurface narrow(*device, entry.cage, options);
            options.mapping = SUPPLE_MAPPING_WIDE;
            GpuSurface wide(*device, entry.cage, options);
            ASSERT_TRUE(narrow.valid() && wide.valid());
            narrow.evaluate();
            wide.evaluate();
            for (uint32_t p = 0; p < narrow.output().patchCount; ++p) {
                for (uint32_t s = 0; s < narrow.sampleCount(p); ++s) {
                    ++samples;
                    different += sameBits(narrow.vertex(0, p, s).position, wide.vertex(0, p, s).position) ? 0 : 1;
                }
            }
        }
    }
    std::printf("%llu samples, %llu differ\n", static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(different));
    EXPECT_EQ(different, 0u);
}

/// Every character at depth 3 in a pose of its first clip, from the cage as the device deformed it.
TEST(KernelCharacters, HaveTheReferencesBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const std::string& path : allCharacters()) {
        SCOPED_TRACE(path);
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
            const Result<Mesh> mesh = surface::kernel::buildMesh(
                character->cage, scheme == SUPPLE_SCHEME_LOOP ? Subdivision::loop : Subdivision::catmullClark);
            if (!mesh.ok()) { // tests/runtime/assets_table_test.cpp says which these are
                std::printf("refused: %s\n", mesh.error().message.c_str());
                continue;
            }
            GpuOptions options;
            options.scheme = scheme;
            options.flags = 0;
            GpuSurface gpu(*device, path, options);
            ASSERT_TRUE(gpu.valid());
            if (!character->clips.empty()) {
                ASSERT_EQ(
                    suppleSetClipPose(gpu.context().handle(), gpu.group(), 0, 0, 0.4 * character->clips[0].duration),
                    SUPPLE_OK);
            }
            gpu.evaluate();
            std::vector<glm::vec3> deformed;
            for (uint32_t v = 0; v < character->cage.vertexCount(); ++v) {
                deformed.push_back(gpu.deformed(0, v));
            }
            // Patches stand by material.
            std::vector<uint32_t> faces, patches(mesh->cage.faceCount(), cage::kNone);
            for (uint32_t f = 0; f < mesh->cage.faceCount(); ++f) {
                if (mesh->holes[f] == 0) {
                    faces.push_back(f);
                }
            }
            if (!mesh->cage.faceMaterials.empty()) {
                std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) {
                    return mesh->cage.faceMaterials[a] < mesh->cage.faceMaterials[b];
                });
            }
            for (uint32_t p = 0; p < faces.size(); ++p) {
                patches[faces[p]] = p;
            }
            const std::vector<glm::vec3> isolated = surface::kernel::isolate<float>(*mesh, deformed);
            uint64_t samples = 0, differ = 0;
            surface::kernel::forEachSector<float>(
                *mesh, isolated, 3 - mesh->isolationSteps, [&](const surface::kernel::SectorGrid<float>& grid) {
                    const uint32_t p = patches[grid.face];
                    for (uint32_t s = 0; p != cage::kNone && s < grid.samples.size(); ++s) {
                        ++samples;
                        differ += sameBits(gpu.vertex(0, p, s).position, grid.samples[s].position + 0.0f) ? 0 : 1;
                    }
                });
            std::printf("%-24s %-13s %8llu samples, %llu differ from the float reference\n",
                        std::filesystem::path(path).filename().c_str(),
                        scheme == SUPPLE_SCHEME_LOOP ? "Loop" : "Catmull-Clark",
                        static_cast<unsigned long long>(samples), static_cast<unsigned long long>(differ));
            EXPECT_EQ(differ, 0u);
        }
    }
}

/// Rates are rounded up to 2^depth, and to what isolation takes.
TEST(KernelRates, AreRoundedUp) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    struct Case {
        cage::Cage cage;
        uint32_t asked, patchRate;
    };
    for (const Case& c : {Case{cube(), 1, 1}, Case{cube(), 2, 1}, Case{cube(), 3, 2}, Case{cube(), 8, 4},
                          Case{cube(), 9, 8}, Case{dodecahedron(), 1, 1}, Case{dodecahedron(), 8, 2}}) {
        GpuOptions options;
        options.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        options.flags = 0;
        options.rate = c.asked;
        GpuSurface gpu(*device, c.cage, options);
        ASSERT_TRUE(gpu.valid());
        EXPECT_EQ(gpu.output().rate, c.patchRate) << c.asked;
    }
}

} // namespace
} // namespace supple::test
