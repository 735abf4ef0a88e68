// Samples that patches share, stored once: how they are numbered, the records of the edges that evaluate them, and the
// mesh of an instance. Its surface vertices are the samples inside the patches, patch by patch; those along edges, edge
// by edge; those at corners. An edge's belong to both patches that have its border curve from the same coefficients,
// and with corner attributes the same at both ends; likewise the sample at a corner. What merely lies in the same
// place, as the two sides of a crease, does not.
#pragma once

#include "surface/evaluation.h"
#include "surface/scheme.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

/// Samples of a domain that lie on none of its edges.
[[nodiscard]] uint32_t interiorCount(Domain domain, uint32_t rate);

/// Appends the edges to `tables` (Tables::shared); for the classes of borders.h. `attributes`:
/// the tables have corner attributes.
void appendSharedSamples(Tables& tables, bool attributes);

/// The surface vertex of each sample of a patch.
[[nodiscard]] std::vector<uint32_t> sharedVertices(const Tables& tables, const Evaluation& evaluation, uint32_t patch);

/// Triangles of one instance, counter-clockwise seen from outside; material by material, then patch by patch, in each
/// those of gridIndices().
struct SharedMesh {
    struct Range {
        uint32_t material = cage::kNone;
        uint32_t firstIndex = 0;
        uint32_t indexCount = 0;
    };
    std::vector<uint32_t> indices;
    std::vector<Range> ranges; ///< materials rise
};
[[nodiscard]] SharedMesh sharedMesh(const Tables& tables, const Evaluation& evaluation);

} // namespace supple::surface
