// Loop patches at random levels, over cages of all kinds, against the limit in double: positions, borders, normals.
#include "cpu/loop.h"
#include "runtime/arrays/character_arrays.h"
#include "surface/lod/grid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/loop_triangles.h"
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

class LodLoop : public testing::TestWithParam<SuppleMapping> {
protected:
    /// The zoo's cages in turn.
    static std::vector<SubdivisionCage> cages() {
        constexpr size_t kStep = 3;
        std::vector<SubdivisionCage> cages;
        size_t taken = GetParam() == SUPPLE_MAPPING_WIDE ? 1 : 0;
        for (const SubdivisionCage& zoo : subdivisionZoo()) {
            if (taken++ % kStep == 0) {
                cages.push_back(zoo);
            }
        }
        return cages;
    }
    static std::optional<RandomLevels::Drawn> draw(RandomLevels& random, const SubdivisionCage& entry) {
        const host::CageArrays arrays(entry.cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, entry.name);
        EXPECT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.scheme = SUPPLE_SCHEME_LOOP;
        return random.draw(std::move(*character), desc);
    }
};
INSTANTIATE_TEST_SUITE_P(Mappings, LodLoop, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodLoop, RandomLevelsAreTheLimit) {
    const ValidationGuard guard;
    RandomLevels random(GetParam());
    ASSERT_TRUE(random.valid());
    Borders all;
    double worst = 0.0, worstNormal = 0.0;
    uint64_t steep = 0, samples = 0, inCells = 0;
    for (const SubdivisionCage& entry : cages()) {
        SCOPED_TRACE(entry.name);
        const LoopTriangles triangles(entry.cage);
        const std::optional<RandomLevels::Drawn> drawn = draw(random, entry);
        ASSERT_TRUE(drawn.has_value());
        const std::vector<glm::dvec3> positions = doublePositions(entry.cage);
        const surface::loop::LimitSurface limit(triangles.isolation.mesh, positions);
        const PatchFaces found = triangles.patches(drawn->patches);
        const double size = extent(positions);
        const uint32_t depth =
            chainDepth(drawn->surface.patches, 0, [&](uint32_t patch) { return drawn->patches[patch].patchClass; });
        for (const LodSurface::Patch& patch : drawn->surface.patches) {
            const uint32_t face = found.faces[patch.patch];
            const uint32_t count = surface::lod::sampleCount(surface::lod::Form::triangleRings, patch.capacity);
            const uint32_t stride = lessInWide(GetParam(), 1, 3) * (1 + patch.capacity / 8);
            for (uint32_t s = 0; s < count; s += stride) {
                const glm::dvec3 given = LoopTriangles::inFace(ringWeightsOf(patch, s), found.firstCorners[face]);
                const ConePlace<glm::dvec3> place = triangles.atLevels(face, given, depth);
                inCells += place.share < 1.0 ? 1 : 0;
                const auto at = [&](const glm::dvec3& weights) { return limit.at(face, weights.y, weights.z); };
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
    EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(samples));
}

// An edge that the triangles on its sides know by different records has one level.
TEST_P(LodLoop, BothSidesOfAnEdgeAskForTheSame) {
    const ValidationGuard guard;
    RandomLevels random(GetParam(), RandomLevels::Edges::own);
    ASSERT_TRUE(random.valid());
    Borders all;
    std::set<float> levels;
    for (const SubdivisionCage& entry : cages()) {
        SCOPED_TRACE(entry.name);
        const std::optional<RandomLevels::Drawn> drawn = draw(random, entry);
        ASSERT_TRUE(drawn.has_value());
        expectClosed(drawn->surface, drawn->patches, all);
        for (const LodSurface::Patch& patch : drawn->surface.patches) {
            levels.insert({patch.levels[2], patch.levels[4], patch.levels[6]});
        }
    }
    std::printf("%zu edges with %zu samples of a side, %zu levels\n", all.edges, all.samples, levels.size());
    EXPECT_GT(all.edges, 500u);
    EXPECT_GT(levels.size(), 500u);
}

} // namespace
} // namespace supple::test
