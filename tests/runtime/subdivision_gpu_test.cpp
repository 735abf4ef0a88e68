// The subdivision on the device: against the reference, both mappings, all depths, and the bits its patches
// share.
#include "tests/support/corner_weights.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/reference/fragments.h"

#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using surface::subdivision::Mesh;
using surface::subdivision::Subdivision;

/// Patches of one class.
PatchFaces subdivisionPatches(const Mesh& mesh, const GpuSurface& gpu) {
    return patchFaces(mesh, gpu, [](uint32_t /*face*/) { return 0; });
}

class SubdivisionOnGpu : public testing::TestWithParam<GpuCase> {
protected:
    [[nodiscard]] static Mesh meshOf(const cage::Cage& cage) {
        return subdivisionMesh(cage, GetParam().options.rules == SUPPLE_RULES_LOOP ? Subdivision::loop
                                                                                   : Subdivision::catmullClark);
    }
};
INSTANTIATE_TEST_SUITE_P(
    Mappings, SubdivisionOnGpu,
    testing::ValuesIn(onBothMappings(
        {{"Fragments", {.scheme = SUPPLE_SCHEME_FRAGMENTS, .flags = SUPPLE_GROUP_ATTRIBUTES}},
         {"ByLoopsRules",
          {.scheme = SUPPLE_SCHEME_FRAGMENTS, .rules = SUPPLE_RULES_LOOP, .flags = SUPPLE_GROUP_ATTRIBUTES}}})),
    [](const auto& param) { return param.param.name; });

/// Against double for exactness, and against float, whose sums are the device's own, for the bits.
TEST_P(SubdivisionOnGpu, SurfaceMatchesTheReference) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (const uint32_t depth : {1u, 2u, 3u, 4u, 5u}) {
        double worstPosition = 0.0, worstNormal = 0.0;
        uint64_t steep = 0;
        ComparedBits bits;
        for (size_t i = 0; i < zoo.size(); i += depth < 4 ? 1 : 7) {
            SCOPED_TRACE(zoo[i].name);
            const cage::Cage& cage = zoo[i].cage;
            GpuSurface gpu(*device, cage, GetParam().at(1u << depth));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const Mesh mesh = meshOf(cage);
            const uint32_t steps = depth > mesh.isolationSteps ? depth - mesh.isolationSteps : 0;
            ASSERT_EQ(gpu.output().grid.rate, 1u << steps);
            const std::vector<glm::dvec3> exact = doublePositions(cage);
            const auto expected =
                surface::subdivision::evaluate<double>(mesh, surface::subdivision::isolate<double>(mesh, exact), steps);
            const auto rounded = surface::subdivision::evaluate<float>(
                mesh, surface::subdivision::isolate<float>(mesh, cage.positions), steps);
            const double size = extent(exact);
            const PatchFaces found = subdivisionPatches(mesh, gpu);
            ASSERT_EQ(found.faces.size(), gpu.patches().size());
            for (const SupplePatchInfo& patch : gpu.patches()) {
                EXPECT_EQ(patch.coefficientCount, 0u);
            }
            for (size_t g = 0; g < expected.size(); ++g) {
                const uint32_t p = found.patches[expected[g].face];
                if (p == cage::kNone) {
                    continue;
                }
                ASSERT_EQ(gpu.sampleCount(p), expected[g].samples.size());
                for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                    const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                    raise(worstPosition,
                          glm::length(glm::dvec3(vertex.position) - expected[g].samples[s].position) / size);
                    bits.compare(vertex.position, rounded[g].samples[s].position + 0.0f);
                    const double angle = angleDegrees(vertex.normal, expected[g].samples[s].normal);
                    steep += angle > 0.05 ? 1 : 0;
                    raise(worstNormal, angle);
                }
            }
        }
        std::printf(
            "depth %u: %llu samples, positions within %.1e of the extent, %llu differ from the float reference in "
            "some bit; normals within %.2e degrees, %llu of them above 0.05\n",
            depth, static_cast<unsigned long long>(bits.samples), worstPosition,
            static_cast<unsigned long long>(bits.different), worstNormal, static_cast<unsigned long long>(steep));
        EXPECT_LE(worstPosition, 1e-6);
        EXPECT_EQ(bits.different, 0u);
        EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(bits.samples));
    }
}

/// Every edge of the isolated level, inside fragments and between them.
TEST_P(SubdivisionOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits bits;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t i = 0; i < zoo.size(); ++i) {
        const cage::Cage& cage = zoo[i].cage;
        const Mesh mesh = meshOf(cage);
        const Result<cage::Topology> topology = cage::buildTopology(mesh.cage);
        ASSERT_TRUE(topology.ok());
        for (const uint32_t depth : {1u, 2u, 3u, 4u, 5u}) {
            if (depth > 3 && i % 5 != 0) {
                continue; // the rules no longer change, the sizes do
            }
            GpuSurface gpu(*device, cage, GetParam().at(1u << depth));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            bits.add(borderBits(mesh.cage, *topology, subdivisionPatches(mesh, gpu), gpu));
        }
    }
    bits.print("border samples");
    EXPECT_EQ(bits.different, 0u);
    EXPECT_GT(bits.samples, 0u);
}

/// A fragment that no shared memory holds, several instances, and the greatest depth.
TEST_P(SubdivisionOnGpu, LargeFragmentsGoThroughTheScratchBuffer) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const cage::Cage cage = gyroBipyramid(40);
    GpuOptions wanted = GetParam().at(64);
    wanted.instanceCount = 2;
    GpuSurface gpu(*device, cage, wanted);
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    const Mesh mesh = meshOf(cage);
    const std::vector<glm::vec3> isolated = surface::subdivision::isolate<float>(mesh, cage.positions);
    ComparedBits bits;
    for (const auto& grid : surface::subdivision::evaluate<float>(mesh, isolated, 6 - mesh.isolationSteps)) {
        for (uint32_t s = 0; s < grid.samples.size(); ++s) {
            for (uint32_t instance = 0; instance < 2; ++instance) {
                bits.compare(gpu.vertex(instance, grid.face, s).position, grid.samples[s].position + 0.0f);
            }
        }
    }
    EXPECT_EQ(bits.different, 0u);
    EXPECT_GT(bits.samples, 0u);
}

TEST_P(SubdivisionOnGpu, AttributesReachTheSurfaceVertices) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    cage::Cage cage = subdivisionZoo().front().cage;
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) { // a seam at every edge
        const auto x = static_cast<float>(c % 97) / 97.0f;
        cage.cornerUvs.emplace_back(x, 1.0f - x * x);
    }
    GpuSurface gpu(*device, cage, GetParam().at(8));
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    const Mesh mesh = meshOf(cage);
    const Result<std::vector<std::byte>> bytes = device->readBuffer(gpu.output().streams.attributes);
    ASSERT_TRUE(bytes.ok());
    double worst = 0.0;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        const auto domain = static_cast<surface::Domain>(gpu.rangeOf(p).domain);
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            const auto weights = cornerWeights(domain, gpu.output().grid.rate, s);
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

TEST(SubdivisionMappings, GiveTheSamePositionBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits bits;
    for (const SubdivisionCage& entry : subdivisionZoo()) {
        ASSERT_NO_FATAL_FAILURE(
            compareMappings(*device, entry.cage, {.scheme = SUPPLE_SCHEME_FRAGMENTS, .flags = 0}, bits));
    }
    bits.print("samples");
    EXPECT_EQ(bits.different, 0u);
}

void compareCharacter(host::Device& device, const std::string& path, const cage::Character& character) {
    const Result<Mesh> mesh = surface::subdivision::buildMesh(character.cage, Subdivision::catmullClark);
    if (!mesh.ok()) { // tests/runtime/assets_table_test.cpp says which these are
        std::printf("refused: %s: %s\n", std::filesystem::path(path).filename().c_str(), mesh.error().message.c_str());
        return;
    }
    GpuSurface gpu(device, path, {.scheme = SUPPLE_SCHEME_FRAGMENTS, .flags = 0});
    ASSERT_TRUE(gpu.valid());
    evaluateInAPose(gpu, character);
    const PatchFaces found = subdivisionPatches(*mesh, gpu);
    const std::vector<glm::vec3> isolated = surface::subdivision::isolate<float>(*mesh, gpu.deformedCage(0));
    ComparedBits bits;
    surface::subdivision::forEachSector<float>(
        *mesh, isolated, 3 - mesh->isolationSteps, [&](const surface::subdivision::SectorGrid<float>& grid) {
            const uint32_t p = found.patches[grid.face];
            for (uint32_t s = 0; p != cage::kNone && s < grid.samples.size(); ++s) {
                bits.compare(gpu.vertex(0, p, s).position, grid.samples[s].position + 0.0f);
            }
        });
    std::printf("%-24s %8llu samples, %llu differ from the float reference\n",
                std::filesystem::path(path).filename().c_str(), static_cast<unsigned long long>(bits.samples),
                static_cast<unsigned long long>(bits.different));
    EXPECT_EQ(bits.different, 0u);
}

/// Every character at depth 3 in a pose of its first clip, from the cage as the device deformed it.
TEST(SubdivisionCharacters, HaveTheReferencesBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    forEachCharacter(allCharacters(), [&](const std::string& path, const cage::Character& character) {
        compareCharacter(*device, path, character);
    });
}

/// Rates are rounded up to 2^depth, and to what isolation takes.
TEST(SubdivisionRates, AreRoundedUp) {
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
        options.scheme = SUPPLE_SCHEME_FRAGMENTS;
        options.flags = 0;
        options.rate = c.asked;
        GpuSurface gpu(*device, c.cage, options);
        ASSERT_TRUE(gpu.valid());
        EXPECT_EQ(gpu.output().grid.rate, c.patchRate) << c.asked;
    }
}

} // namespace
} // namespace supple::test
