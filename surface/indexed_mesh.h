// The indexed mesh: an instance is one mesh. The triangles of polygons are one as they are (Tables::triangles). Of
// other schemes it is a mesh in which patches share the samples on their borders. Its surface vertices then are the
// samples inside the patches, patch after patch; then those along edges, edge after edge; then those at corners.
//
// surface/mesh_tables.h says which samples are shared.
#pragma once

#include "surface/evaluation.h"
#include "surface/scheme.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

/// The number of samples that lie on no edge of the domain.
[[nodiscard]] uint32_t interiorCount(Domain domain, uint32_t rate);

/// The triangles of one instance, counter-clockwise seen from outside. They are sorted by material, then by part, then
/// by patch; within a patch they have the order of gridIndices().
struct IndexedMesh {
    struct Range {
        uint32_t part = 0;
        uint32_t material = cage::kNone;
        uint32_t firstIndex = 0;
        uint32_t indexCount = 0;
    };
    std::vector<uint32_t> indices;
    std::vector<Range> ranges; ///< in that order
};
[[nodiscard]] IndexedMesh indexedMesh(const Tables& tables, const Evaluation& evaluation);
/// Which surface vertices a patch has, by its samples at the rate; of polygons by the corners of the triangle.
[[nodiscard]] std::vector<uint32_t> meshVertices(const Tables& tables, const Evaluation& evaluation, uint32_t patch);
/// The grids of all patches of one instance as one mesh. It shares no sample. A range for each of Tables::drawRanges,
/// in their order; patch after patch, in the order of gridIndices().
[[nodiscard]] IndexedMesh gridMesh(const Tables& tables, const Evaluation& evaluation);
/// How many indices that has.
[[nodiscard]] uint64_t gridMeshIndices(const Tables& tables, const Evaluation& evaluation);

} // namespace supple::surface
