// What a view drew of a group: its triangles as the draws' index buffers and indirect commands make them.
#pragma once

#include "tests/support/crowd.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::test {

struct LodSurface {
    PositionBits positions, previous;               ///< by surface vertex of the view
    std::vector<std::array<uint32_t, 3>> triangles; ///< surface vertices, those of zero area too
    /// A record of the view's patches, and where its samples lie.
    struct Patch {
        uint32_t patch = 0, slot = 0, firstVertex = 0, capacity = 0;
        SuppleGrid grid = SUPPLE_GRID_QUAD;
        std::array<float, 12> levels{}; ///< pairs (a, 1 / L): u, v, edges 0..3; rings: inside, edges 0..4
    };
    std::vector<Patch> patches; ///< without the empty records
};
[[nodiscard]] LodSurface readLodSurface(host::Device& device, const SuppleGroupOutput& output);
[[nodiscard]] LodSurface readLodSurface(const Crowd& crowd);

/// Directed sides of triangles of some area that no other triangle has the other way round, by position bits. 0 on a
/// closed surface without cracks.
struct Sides {
    size_t triangles = 0; ///< of some area
    size_t unmatched = 0;
    size_t loops = 0;     ///< closed curves that the unmatched sides form
    size_t looseEnds = 0; ///< vertices where as many do not begin as end
};
[[nodiscard]] Sides matchSides(const LodSurface& surface);

} // namespace supple::test
