// The blending surface at random levels, over cages of all kinds, against the reference: bits, borders, normals.
#include "runtime/arrays/character_arrays.h"
#include "tests/support/blend_surface.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/cage_arrays.h"

#include <cstdio>
#include <set>

namespace supple::test {
namespace {

using surface::blend::CreaseMode;

class LodBlend : public testing::TestWithParam<std::tuple<SuppleMapping, CreaseMode>> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodBlend,
                         testing::Combine(testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                                          testing::ValuesIn(kCreaseModes)),
                         [](const auto& param) {
                             return mappingName(std::get<0>(param.param)) +
                                    (std::get<1>(param.param) == CreaseMode::cut ? "Cut" : "Curve");
                         });

/// A part of the zoo, another one for each case: all of it takes minutes a case.
std::vector<SubdivisionCage> cagesOf(const std::tuple<SuppleMapping, CreaseMode>& which) {
    constexpr size_t kStep = 19; // every cage has five variants: not a multiple of that
    const auto [mapping, mode] = which;
    std::vector<SubdivisionCage> cages;
    for (size_t z = (mapping == SUPPLE_MAPPING_WIDE ? 10 : 0) + (mode == CreaseMode::curve ? 5 : 0);
         z < subdivisionZoo().size(); z += kStep) {
        cages.push_back(subdivisionZoo()[z]);
    }
    return cages;
}

TEST_P(LodBlend, RandomLevelsAreTheReferences) {
    const ValidationGuard guard;
    const auto [mapping, mode] = GetParam();
    RandomLevels random(mapping);
    ASSERT_TRUE(random.valid());
    ComparedBits bits;
    Borders all;
    double worst = 0.0;
    uint64_t steep = 0, notUnit = 0, triangles = 0, sharp = 0;
    for (const SubdivisionCage& entry : cagesOf(GetParam())) {
        SCOPED_TRACE(entry.name);
        const surface::blend::Mesh mesh = blendMesh(entry.cage, {mode, 1.0f});
        const host::CageArrays arrays(entry.cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, entry.name);
        ASSERT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.scheme = SUPPLE_SCHEME_BLEND;
        const SuppleBlendOptions blend{sizeof(blend),
                                       mode == CreaseMode::curve ? SUPPLE_CREASES_CURVE : SUPPLE_CREASES_CUT, 0.0f};
        desc.blend = &blend;
        std::optional<RandomLevels::Drawn> drawn = random.draw(std::move(*character), desc);
        ASSERT_TRUE(drawn.has_value());
        nameCorners(mesh, drawn->patches);
        const std::vector<uint32_t> faces = facesOfPatches(mesh);
        const std::vector<glm::dvec3> positions = doublePositions(entry.cage);
        const double size = extent(positions);
        const BlendSurface<double> exact(mesh, positions);
        const BlendSurface<float> rounded(mesh, entry.cage.positions);
        const surface::blend::Evaluator<double> reference = exact.at(1);
        const surface::blend::Evaluator<float> floats = rounded.at(1);
        for (const LodSurface::Patch& patch : drawn->surface.patches) {
            const uint32_t face = faces[patch.patch];
            sharp += isSharpPatch(mesh, face) ? 1 : 0;
            for (uint32_t s = 0; s < (patch.capacity + 1) * (patch.capacity + 1); ++s) {
                const auto [u, v] = parametersOf(patch, s);
                const auto expected = reference.at(face, glm::dvec2(u), glm::dvec2(v));
                const std::array<uint32_t, 3>& own = drawn->surface.positions[patch.firstVertex + s];
                glm::vec3 position;
                std::memcpy(&position, own.data(), sizeof(position));
                const glm::vec3 normal = drawn->surface.normals[patch.firstVertex + s];
                bits.compare(position, floats.at(face, u, v).position + 0.0f);
                raise(worst, glm::length(glm::dvec3(position) - expected.position) / size);
                notUnit += std::abs(glm::length(normal) - 1.0f) < 1e-5f ? 0 : 1;
                steep += angleDegrees(normal, expected.normal) > 0.05 ? 1 : 0;
            }
        }
        triangles += expectClosed(drawn->surface, drawn->patches, all).triangles;
    }
    std::printf(
        "%llu samples, %llu differ from the float reference in some bit, positions within %.1e of the extent, %llu "
        "normals off by more than 0.05 degrees; %zu edges with %zu samples of a side, %llu triangles\n",
        static_cast<unsigned long long>(bits.samples), static_cast<unsigned long long>(bits.different), worst,
        static_cast<unsigned long long>(steep), all.edges, all.samples, static_cast<unsigned long long>(triangles));
    EXPECT_GT(all.samples, 0u);
    EXPECT_GT(sharp, 100u);
    if (testDevice()->isCpu()) { // GPUs round divisions and roots otherwise
        EXPECT_EQ(bits.different, 0u);
    }
    EXPECT_LE(worst, 1e-6);
    EXPECT_EQ(notUnit, 0u);
    EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(bits.samples));
}

// What the levels of edges are made of is the same on both sides, across creases too, where each side has its own
// chart.
TEST_P(LodBlend, BothSidesOfAnEdgeAskForTheSame) {
    const ValidationGuard guard;
    const auto [mapping, mode] = GetParam();
    RandomLevels random(mapping, RandomLevels::Edges::own);
    ASSERT_TRUE(random.valid());
    Borders all;
    std::set<float> levels;
    for (const SubdivisionCage& entry : cagesOf(GetParam())) {
        SCOPED_TRACE(entry.name);
        const host::CageArrays arrays(entry.cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, entry.name);
        ASSERT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.scheme = SUPPLE_SCHEME_BLEND;
        const SuppleBlendOptions blend{sizeof(blend),
                                       mode == CreaseMode::curve ? SUPPLE_CREASES_CURVE : SUPPLE_CREASES_CUT, 0.0f};
        desc.blend = &blend;
        std::optional<RandomLevels::Drawn> drawn = random.draw(std::move(*character), desc);
        ASSERT_TRUE(drawn.has_value());
        nameCorners(blendMesh(entry.cage, {mode, 1.0f}), drawn->patches);
        expectClosed(drawn->surface, drawn->patches, all);
        for (const LodSurface::Patch& patch : drawn->surface.patches) {
            levels.insert({patch.levels[4], patch.levels[6], patch.levels[8], patch.levels[10]});
        }
    }
    std::printf("%zu edges with %zu samples of a side, %zu levels\n", all.edges, all.samples, levels.size());
    EXPECT_GT(all.edges, 500u);
    EXPECT_GT(levels.size(), 500u);
}

} // namespace
} // namespace supple::test
