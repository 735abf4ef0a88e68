// The grids of all patches of an instance as one mesh (surface/indexed_mesh.h), which is what rays hit.
#include "surface/grid.h"
#include "surface/indexed_mesh.h"
#include "surface/patch_class.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace supple::surface {
namespace {

struct GridMeshCase {
    SchemeId scheme;
    uint32_t rate;
};
constexpr GridMeshCase kGridMeshCases[] = {{SchemeId::prep, 3},     {SchemeId::pm, 1},    {SchemeId::pm, 4},
                                           {SchemeId::loop, 2},     {SchemeId::blend, 4}, {SchemeId::catmullClark, 2},
                                           {SchemeId::fragments, 4}};

/// Where the samples of a patch begin, as the ranges of evaluation have it.
uint32_t firstVertexOf(const Tables& tables, const Evaluation& evaluation, uint32_t patch, uint32_t samples) {
    const PatchRange& range = tables.rangeOf(patch);
    return evaluation.firstVertices[static_cast<size_t>(&range - tables.ranges.data())] +
           (patch - range.firstPatch) * samples;
}

void expectGrids(const Tables& tables, const Evaluation& evaluation, uint64_t vertices) {
    const IndexedMesh mesh = gridMesh(tables, evaluation);
    ASSERT_EQ(mesh.ranges.size(), tables.drawRanges.size());
    std::vector<bool> used(vertices);
    size_t next = 0;
    for (size_t r = 0; r < mesh.ranges.size(); ++r) {
        const DrawRange& draw = tables.drawRanges[r];
        EXPECT_EQ(mesh.ranges[r].part, draw.part);
        EXPECT_EQ(mesh.ranges[r].material, draw.material);
        EXPECT_EQ(mesh.ranges[r].firstIndex, next);
        const std::vector<uint16_t> grid = gridIndices(draw.domain, evaluation.rate);
        EXPECT_EQ(mesh.ranges[r].indexCount, grid.size() * draw.patchCount);
        const uint32_t samples = sampleCount(draw.domain, evaluation.rate);
        for (uint32_t patch = draw.firstPatch; patch < draw.firstPatch + draw.patchCount; ++patch) {
            const uint32_t first = firstVertexOf(tables, evaluation, patch, samples);
            for (const uint16_t sample : grid) {
                ASSERT_EQ(mesh.indices[next++], first + sample);
                used[first + sample] = true;
            }
        }
    }
    EXPECT_EQ(next, mesh.indices.size());
    uint32_t apexes = 0; // of polar patches: a row of samples in one place, of which triangles take a part
    for (const DrawRange& draw : tables.drawRanges) {
        apexes += draw.domain == Domain::polar ? draw.patchCount * (evaluation.rate + 1) : 0;
    }
    EXPECT_LE(static_cast<size_t>(std::count(used.begin(), used.end(), false)), apexes);
}

TEST(GridMesh, HasTheGridOfEveryPatchInTheOrderOfDraws) {
    for (const GridMeshCase& c : kGridMeshCases) {
        for (const test::NamedCage& own :
             {test::NamedCage{"torus", test::torus(6, 5)}, test::NamedCage{"polar", test::cappedCylinder(7, 3)}}) {
            Result<Tables> tables = schemeOf(c.scheme).build({.scheme = c.scheme, .rate = c.rate}, own.cage, nullptr);
            if (!tables) { // p-rep takes quads alone
                EXPECT_EQ(c.scheme, SchemeId::prep);
                continue;
            }
            SCOPED_TRACE(std::string(schemeOf(c.scheme).name) + ", " + own.name);
            Evaluation evaluation;
            evaluation.rate = tables->rate != 0 ? tables->rate : c.rate;
            const uint64_t vertices = evaluation.layOut(*tables);
            ASSERT_GT(vertices, 0u);
            expectGrids(*tables, evaluation, vertices);
        }
    }
}

} // namespace
} // namespace supple::surface
