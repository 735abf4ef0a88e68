// What a scheme's builder hands over beside its tables: which sides of which patches are one edge, which corners are
// one, and what the records of edges are made of. Levels of detail (surface/lod/tables.h) and indexed meshes
// (surface/mesh_tables.h) take their edges from it. It dies when the tables are built: neither they nor files keep it.
// Private to surface/.
#pragma once

#include "cage/topology.h"
#include "surface/patch_class.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface {

/// Pool indices of a cubic: one end, its tangent, the tangent of the other end, the other end.
using CubicIndices = std::array<uint32_t, 4>;

/// A side of a patch. It has the patch on its left, so the two sides of an edge run in opposite directions.
struct PatchSide {
    uint32_t edge = 0; ///< sides with the same number compute the same curve; there are two at most
    /// Where the side begins: corners with the same number have the same limit point and the same normal.
    uint32_t corner = 0;
    bool creased = false; ///< the normals on either side differ: levels have one edge, an indexed mesh has two
    bool isPoint = false; ///< the apex of a polar patch: levels have an edge for all patches round it, a mesh has none
    Borders borders = Borders::cubics;   ///< what the edge is at levels
    uint32_t kind = shared::kPlainEdges; ///< of its record in an indexed mesh
    /// What the records are made of. From kHalvesEdges on, and at levels if the edge is no cubic, that is the patch's
    /// own record instead.
    CubicIndices curve{};  ///< pool indices, as the side runs; of an edge between charts what is at one end
    CubicIndices across{}; ///< what beside the curve makes the derivative across it; and what is at the other end
    uint32_t flags = 0, extra = 0; ///< as the record has them (shaders/shared/surface.h)
};

struct PatchEdges {
    /// Patch by patch in device order, as the patch's grid has its sides. A polar patch has four.
    std::vector<PatchSide> sides;
    std::vector<uint32_t> firstSides; ///< by patch
    /// By corner of a patch, patch by patch: corners with the same number have the same attributes.
    std::vector<uint32_t> attributes;
    /// By patch, if the recipe asks for tangents: the sign of its area in the texture coordinates that they follow.
    std::vector<int8_t> hands;

    void beginPatch() { firstSides.push_back(static_cast<uint32_t>(sides.size())); }
    [[nodiscard]] std::span<const PatchSide> sidesOf(uint32_t patch) const {
        const size_t end = patch + size_t{1} < firstSides.size() ? firstSides[patch + 1] : sides.size();
        return std::span(sides).subspan(firstSides[patch], end - firstSides[patch]);
    }
    /// All numbers of edges are below.
    [[nodiscard]] uint32_t edgeBound() const;
};

/// PatchSide::edge of the edge behind a corner of the cage that the scheme works on. `isOne`: the faces at it compute
/// the same curve. If they do not, each has an edge of its own. All numbers are below twice the number of edges.
[[nodiscard]] uint32_t edgeNumber(const cage::Topology& topology, uint32_t corner, bool isOne);

/// The corners of a bicubic patch.
struct NetCorners {
    std::array<uint32_t, 4> points{}; ///< pool indices of limit points; of a polar patch the last has the net's inside
    std::array<uint32_t, 4> spokes{}; ///< numbers among the tangents: of the edge behind the corner
    std::array<uint32_t, 4> nextSpokes{}; ///< and of the one before it
};
/// Pool indices of the 16 coefficients of a bicubic patch, row by row in v.
class NetIndices {
public:
    /// `tangents` and `faces` begin there in the pool (Tables).
    NetIndices(const NetCorners& corners, uint32_t tangents, uint32_t faces, bool polar);

    /// By side of the grid.
    [[nodiscard]] CubicIndices curve(uint32_t side) const;
    /// The cubic one step inside, in the direction of the side.
    [[nodiscard]] CubicIndices inside(uint32_t side) const;

private:
    [[nodiscard]] uint32_t at(uint32_t i, uint32_t j) const { return indices_[4 * j + i]; }

    std::array<uint32_t, 16> indices_{};
};

} // namespace supple::surface
