// Exact Catmull-Clark patches at random levels, over cages of all kinds, against the limit in double: positions,
// borders, normals.
#include "cpu/catmull_clark.h"
#include "runtime/arrays/character_arrays.h"
#include "tests/support/exact_quads.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/cage_arrays.h"

#include <cstdio>
#include <cstring>
#include <set>

namespace supple::test {
namespace {

using surface::catmull_clark::LimitSurface;

/// A pair as one parameter, without what 1 - t has lost.
double exact(glm::vec2 pair) {
    return pair.x < pair.y ? static_cast<double>(pair.x) : 1.0 - static_cast<double>(pair.y);
}

class LodExact : public testing::TestWithParam<SuppleMapping> {
protected:
    /// The zoo's cages in turn: all of them take minutes a mapping.
    static std::vector<SubdivisionCage> cages() {
        constexpr size_t kStep = 3; // every cage has five variants: not a multiple of that
        std::vector<SubdivisionCage> cages;
        for (size_t z = GetParam() == SUPPLE_MAPPING_WIDE ? 1 : 0; z < subdivisionZoo().size(); z += kStep) {
            cages.push_back(subdivisionZoo()[z]);
        }
        return cages;
    }
    /// One instance, and its patches with their corners as the quads have them.
    static std::optional<RandomLevels::Drawn> draw(RandomLevels& random, const SubdivisionCage& entry,
                                                   const ExactQuads& quads) {
        const host::CageArrays arrays(entry.cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, entry.name);
        EXPECT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        std::optional<RandomLevels::Drawn> drawn = random.draw(std::move(*character), desc);
        if (drawn) {
            nameCorners(quads, drawn->patches);
        }
        return drawn;
    }
};
INSTANTIATE_TEST_SUITE_P(Mappings, LodExact, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodExact, RandomLevelsAreTheLimit) {
    const ValidationGuard guard;
    RandomLevels random(GetParam());
    ASSERT_TRUE(random.valid());
    Borders all;
    double worst = 0.0, worstNormal = 0.0;
    uint64_t steep = 0, samples = 0, inCells = 0;
    for (const SubdivisionCage& entry : cages()) {
        SCOPED_TRACE(entry.name);
        const ExactQuads quads(entry.cage);
        const std::optional<RandomLevels::Drawn> drawn = draw(random, entry, quads);
        ASSERT_TRUE(drawn.has_value());
        const std::vector<glm::dvec3> positions = doublePositions(entry.cage);
        const LimitSurface limit(quads.isolation.mesh, positions);
        const PatchFaces found = quads.patches(drawn->patches);
        const double size = extent(positions);
        const uint32_t depth =
            chainDepth(drawn->surface.patches, 0, [&](uint32_t patch) { return drawn->patches[patch].patchClass; });
        for (const LodSurface::Patch& patch : drawn->surface.patches) {
            const uint32_t face = found.faces[patch.patch];
            const uint32_t stride = lessInWide(GetParam(), 1, 3) * (1 + patch.capacity / 8);
            for (uint32_t s = 0; s < (patch.capacity + 1) * (patch.capacity + 1); s += stride) {
                const std::array<glm::vec2, 2> pairs = parametersOf(patch, s);
                const ConePlace<glm::dvec2> place = quads.atLevels(face, {exact(pairs[0]), exact(pairs[1])}, depth);
                inCells += place.share < 1.0 ? 1 : 0;
                const auto at = [&](const glm::dvec2& uv) {
                    const glm::dvec2 inFace = ExactQuads::inFace(uv.x, uv.y, found.firstCorners[face]);
                    return limit.at(face, inFace.x, inFace.y);
                };
                const auto expected = at(place.rim);
                glm::vec3 position;
                std::memcpy(&position, drawn->surface.positions[patch.firstVertex + s].data(), sizeof(position));
                raise(worst, glm::length(glm::dvec3(position) - place.position(at)) / size);
                const double angle = angleDegrees(drawn->surface.normals[patch.firstVertex + s], expected.normal);
                raise(worstNormal, angle);
                steep += angle > 0.05 ? 1 : 0;
                ++samples;
            }
        }
        expectClosed(drawn->surface, drawn->patches, all);
    }
    std::printf("%llu samples, %llu of them in a last cell; positions within %.1e of the extent, %llu normals "
                "off by more than 0.05 degrees, at most %.2f; %zu edges with %zu samples of a side\n",
                static_cast<unsigned long long>(samples), static_cast<unsigned long long>(inCells), worst,
                static_cast<unsigned long long>(steep), worstNormal, all.edges, all.samples);
    EXPECT_GT(all.samples, 0u);
    EXPECT_GT(inCells, 0u);
    EXPECT_LE(worst, 1e-6);
    EXPECT_EQ(steep, 0u);
}

// An edge that the quads on its sides know by different records has one level.
TEST_P(LodExact, BothSidesOfAnEdgeAskForTheSame) {
    const ValidationGuard guard;
    RandomLevels random(GetParam(), RandomLevels::Edges::own);
    ASSERT_TRUE(random.valid());
    Borders all;
    std::set<float> levels;
    for (const SubdivisionCage& entry : cages()) {
        SCOPED_TRACE(entry.name);
        const std::optional<RandomLevels::Drawn> drawn = draw(random, entry, ExactQuads(entry.cage));
        ASSERT_TRUE(drawn.has_value());
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
