#include "runtime/queries/triangle_faces.h"

#include "shaders/shared/queries.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

bool isPolygons(const Tessellation& surface) {
    return !surface.tables().triangles.indices.empty();
}
bool hasTriangles(const Tessellation& surface) {
    return surface.kind() == SUPPLE_TESSELLATION_GRIDS || surface.kind() == SUPPLE_TESSELLATION_INDEXED_MESH;
}
SuppleGridOutput gridOf(const Tessellation& surface) {
    SuppleGridOutput grid{};
    surface.fillGrid(grid);
    return grid;
}

/// Segments along a patch edge of a surface whose cage takes so many steps, from those along an edge of the cage.
uint32_t patchRate(uint32_t rate, uint32_t steps) {
    return (rate + (1u << steps) - 1) >> steps;
}

/// How the shader finds the rate of a surface: from the group's, unless it is one that no group's rate gives.
uint32_t rateWord(const Tessellation& surface, uint32_t groupRate) {
    const uint32_t steps = surface.tables().isolationSteps, own = gridOf(surface).rate;
    return steps << kTriangleStepsShift | (own == patchRate(groupRate, steps) ? 0 : own << kTriangleRateShift);
}

/// Adds the runs of a surface's ranges, where `ranges` says that they begin. A mesh has all patches of one material and
/// one part in a range.
void addRuns(const Tessellation& surface, uint32_t groupRate, uint32_t firstFace, size_t ranges,
             std::vector<uint32_t>& words) {
    const SuppleGridOutput grid = gridOf(surface);
    const uint32_t rate = rateWord(surface, groupRate);
    const std::vector<surface::DrawRange>& patches = surface.tables().drawRanges;
    for (uint32_t g = 0; g < grid.drawRangeCount; ++g) {
        const SuppleDrawRange& range = grid.drawRanges[g];
        words[ranges + 2 * g] = static_cast<uint32_t>(words.size());
        for (size_t k = 0; k < patches.size(); ++k) {
            const surface::DrawRange& run = patches[k];
            const bool isOwn =
                range.domain == SUPPLE_DOMAIN_MESH ? run.part == range.part && run.material == range.material : k == g;
            if (isOwn) {
                words.insert(words.end(),
                             {isPolygons(surface) ? kSingleTriangles : static_cast<uint32_t>(run.domain) | rate,
                              run.patchCount, firstFace + run.firstPatch});
                ++words[ranges + 2 * g + 1];
            }
        }
    }
}

} // namespace

uint32_t rateOf(const Surfaces& surfaces) {
    uint32_t rate = 1, leastSteps = UINT32_MAX;
    for (const auto& surface : surfaces) {
        const uint32_t steps = surface->tables().isolationSteps;
        if (hasTriangles(*surface) && !isPolygons(*surface) && steps < leastSteps) {
            leastSteps = steps;
            rate = gridOf(*surface).rate << steps;
        }
    }
    return rate;
}

std::vector<uint32_t> triangleFaces(const Surfaces& surfaces, std::span<const FacePieces> pieces) {
    const uint32_t groupRate = rateOf(surfaces);
    std::vector<uint32_t> words(kTriangleHeaderWords + 2 * surfaces.size());
    words[kTriangleSurfaces] = static_cast<uint32_t>(surfaces.size());
    words[kTriangleFaces] = static_cast<uint32_t>(pieces.size());
    for (size_t s = 0; s < surfaces.size(); ++s) {
        const Tessellation& surface = surfaces[s];
        const auto ranges = static_cast<uint32_t>(words.size());
        const uint32_t count = hasTriangles(surface) ? gridOf(surface).drawRangeCount : 0;
        words[kTriangleHeaderWords + 2 * s] = ranges;
        words[kTriangleHeaderWords + 2 * s + 1] = count;
        words.resize(words.size() + size_t{2} * count);
        if (count > 0) {
            const auto firstFace = static_cast<uint32_t>(words.size());
            for (const surface::PatchInfo& patch : surface.tables().patches) {
                words.push_back(patch.face);
            }
            addRuns(surface, groupRate, firstFace, ranges, words);
        }
    }
    words[kTriangleFacePieces] = static_cast<uint32_t>(words.size());
    for (const FacePieces& own : pieces) {
        words.insert(words.end(), {own.first, own.count});
    }
    return words;
}

} // namespace supple::runtime
