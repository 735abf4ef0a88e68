// What a view drew of a group: its triangles as the draws' index buffers and indirect commands make them.
#pragma once

#include "host/group_output.h"
#include "surface/scheme.h"
#include "tests/support/crowd.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::test {

struct LodSurface {
    PositionBits positions, previous; ///< by surface vertex of the view
    std::vector<glm::vec3> normals;
    std::vector<uint32_t> tangents;                 ///< their words, where a view writes them
    std::vector<std::array<uint32_t, 3>> triangles; ///< surface vertices, those of zero area too
    /// A record of the view's patches, and where its samples lie.
    struct Patch {
        uint32_t patch = 0, slot = 0, firstVertex = 0, capacity = 0;
        SuppleGrid grid = SUPPLE_GRID_QUAD;
        std::array<float, 12> levels{}; ///< pairs (a, 1 / L): u, v, edges 0..3; rings: inside, edges 0..4
    };
    std::vector<Patch> patches; ///< without the empty records
};
[[nodiscard]] LodSurface readLodSurface(host::Device& device, const host::GroupOutput& output);
[[nodiscard]] LodSurface readLodSurface(const Crowd& crowd);
/// The records alone: the vertices of many instances take long to read.
[[nodiscard]] std::vector<LodSurface::Patch> readLodPatches(const Crowd& crowd);

/// (u, 1 - u) and (v, 1 - v) of a sample of a grid of rows.
[[nodiscard]] std::array<glm::vec2, 2> parametersOf(const LodSurface::Patch& patch, uint32_t sample);

/// Weights of the corners at a sample of a grid of three sides, in rings.
[[nodiscard]] glm::dvec3 ringWeightsOf(const LodSurface::Patch& patch, uint32_t sample);

/// Directed sides of triangles of some area that no other triangle has the other way round, by position bits. 0 on a
/// closed surface without cracks.
struct Sides {
    size_t triangles = 0; ///< of some area
    size_t unmatched = 0;
    size_t loops = 0;     ///< closed curves that the unmatched sides form
    size_t looseEnds = 0; ///< vertices where as many do not begin as end
};
[[nodiscard]] Sides matchSides(const LodSurface& surface);

/// As suppleGetPatches tells them.
[[nodiscard]] std::vector<surface::PatchInfo> patchesOf(const Crowd& crowd);

/// The sides of a view's patches of one instance, by the edges of a cage.
struct Borders {
    size_t edges = 0;     ///< between two patches
    size_t samples = 0;   ///< of those, on one side
    size_t different = 0; ///< that the other side has in other bits
    size_t lengths = 0;   ///< edges whose sides have not as many samples
    size_t open = 0;      ///< segments of sides that have no other side
};
/// `patches` in device order; corners may be any cage's, and unknown ones are left out.
[[nodiscard]] Borders bordersOf(const LodSurface& surface, const std::vector<surface::PatchInfo>& patches);
/// Fails the test where two sides of an edge differ, or a surface has cracks. Adds edges and samples to `all`.
Sides expectClosed(const LodSurface& surface, const std::vector<surface::PatchInfo>& patches, Borders& all);

} // namespace supple::test
