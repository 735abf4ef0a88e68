// The blending surface on the device: against the reference, both mappings and crease modes, and the bits its patches
// share.
#include "tests/support/blend_surface.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"

#include <cstdio>

namespace supple::test {
namespace {

using surface::blend::CreaseMode;
using surface::blend::Mesh;

PatchFaces blendPatches(const Mesh& mesh, const GpuSurface& gpu) {
    return patchFaces(mesh, gpu, [&](uint32_t f) { return blendClass(mesh, f); });
}

class BlendOnGpu : public testing::TestWithParam<GpuCase> {
protected:
    [[nodiscard]] static Mesh meshOf(const cage::Cage& cage) {
        const bool curve = GetParam().options.creases == SUPPLE_CREASES_CURVE;
        return blendMesh(cage, {curve ? CreaseMode::curve : CreaseMode::cut, 1.0f});
    }
};
INSTANTIATE_TEST_SUITE_P(
    Mappings, BlendOnGpu,
    testing::ValuesIn(onBothMappings(
        {{"Cut", {.scheme = SUPPLE_SCHEME_BLEND, .flags = SUPPLE_GROUP_ATTRIBUTES}},
         {"Curve",
          {.scheme = SUPPLE_SCHEME_BLEND, .creases = SUPPLE_CREASES_CURVE, .flags = SUPPLE_GROUP_ATTRIBUTES}}})),
    [](const auto& param) { return param.param.name; });

TEST_P(BlendOnGpu, SurfaceMatchesTheReference) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
        double worstPosition = 0.0;
        uint64_t steep = 0;
        ComparedBits bits;
        const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
        for (size_t z = 0; z < zoo.size(); z += rate < 8 ? 1 : 4) {
            SCOPED_TRACE(zoo[z].name);
            const cage::Cage& cage = zoo[z].cage;
            const Mesh mesh = meshOf(cage);
            GpuSurface gpu(*device, cage, GetParam().at(rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const uint32_t patchRate = mesh.refined ? (rate + 1) / 2 : rate;
            ASSERT_EQ(gpu.output().grid.rate, patchRate);
            const std::vector<uint32_t> faces = blendPatches(mesh, gpu).faces;
            ASSERT_EQ(faces.size(), gpu.patches().size());
            const std::vector<glm::dvec3> positions = doublePositions(cage);
            const double size = extent(positions);
            const BlendSurface<double> exact(mesh, positions);
            const BlendSurface<float> rounded(mesh, cage.positions);
            const surface::blend::Evaluator<double> reference = exact.at(patchRate);
            const surface::blend::Evaluator<float> floats = rounded.at(patchRate);
            for (uint32_t p = 0; p < faces.size(); ++p) {
                for (uint32_t j = 0; j <= patchRate; ++j) {
                    for (uint32_t i = 0; i <= patchRate; ++i) {
                        const GpuSurface::Vertex& vertex = gpu.vertex(0, p, i, j);
                        const auto expected = reference.at(faces[p], i, j);
                        raise(worstPosition, glm::length(glm::dvec3(vertex.position) - expected.position) / size);
                        bits.compare(vertex.position, floats.at(faces[p], i, j).position + 0.0f);
                        steep += angleDegrees(vertex.normal, expected.normal) > 0.05 ? 1 : 0;
                    }
                }
            }
        }
        std::printf(
            "rate %2u: %7llu samples, positions within %.1e of the extent, %llu differ from the float reference in "
            "some bit; %llu normals off by more than 0.05 degrees\n",
            rate, static_cast<unsigned long long>(bits.samples), worstPosition,
            static_cast<unsigned long long>(bits.different), static_cast<unsigned long long>(steep));
        EXPECT_LE(worstPosition, 1e-6);
        EXPECT_EQ(bits.different, 0u);
        EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(bits.samples));
    }
}

TEST_P(BlendOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    ComparedBits bits;
    for (const SubdivisionCage& entry : subdivisionZoo()) {
        const Mesh mesh = meshOf(entry.cage);
        for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
            GpuSurface gpu(*device, entry.cage, GetParam().at(rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            bits.add(borderBits(mesh.cage, mesh.topology, blendPatches(mesh, gpu), gpu));
        }
    }
    bits.print("border samples");
    EXPECT_EQ(bits.different, 0u);
    EXPECT_GT(bits.samples, 0u);
}

void compareCharacter(host::Device& device, const std::string& path, const cage::Character& character) {
    const Result<Mesh> mesh = surface::blend::buildMesh(character.cage);
    if (!mesh.ok()) { // tests/runtime/assets_table_test.cpp says which these are
        std::printf("refused: %s: %s\n", std::filesystem::path(path).filename().c_str(), mesh.error().message.c_str());
        return;
    }
    GpuSurface gpu(device, path, {.scheme = SUPPLE_SCHEME_BLEND, .flags = 0});
    ASSERT_TRUE(gpu.valid());
    evaluateInAPose(gpu, character);
    const PatchFaces found = blendPatches(*mesh, gpu);
    ASSERT_EQ(found.faces.size(), gpu.patches().size());
    const uint32_t rate = gpu.output().grid.rate;
    const BlendSurface<float> surface(*mesh, gpu.deformedCage(0));
    const surface::blend::Evaluator<float> reference = surface.at(rate);
    ComparedBits bits;
    for (uint32_t p = 0; p < found.faces.size(); ++p) {
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            bits.compare(gpu.vertex(0, p, s).position,
                         reference.at(found.faces[p], s % (rate + 1), s / (rate + 1)).position + 0.0f);
        }
    }
    const ComparedBits borders = borderBits(mesh->cage, mesh->topology, found, gpu);
    std::printf("%-24s %8llu samples, %llu differ from the float reference; %llu on borders, %llu differ\n",
                std::filesystem::path(path).filename().c_str(), static_cast<unsigned long long>(bits.samples),
                static_cast<unsigned long long>(bits.different), static_cast<unsigned long long>(borders.samples),
                static_cast<unsigned long long>(borders.different));
    EXPECT_GT(borders.samples, 0u);
    EXPECT_EQ(bits.different, 0u);
    EXPECT_EQ(borders.different, 0u);
}

/// Every character in a pose of its first clip, from the cage as the device deformed it.
TEST(BlendCharacters, HaveTheReferencesBits) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    forEachCharacter(allCharacters(), [&](const std::string& path, const cage::Character& character) {
        compareCharacter(*device, path, character);
    });
}

} // namespace
} // namespace supple::test
