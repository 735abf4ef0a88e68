// The cage as P_m sees it: facets of three to five sides, sectors between sharp edges, facet classes.
// Connectivity, sharpness and (only for the choice of diagonals) rest positions; built once per asset.
// Paper: A. Myles, T. Ni, J. Peters, "Fast Parallel Construction of Smooth Surfaces from Meshes with Tri/Quad/Pent
// Facets", SGP 2008; numbers in parentheses are its equations, in the corrected form of docs/pm.md.
#pragma once

#include "base/result.h"
#include "cage/features.h"
#include "cage/topology.h"
#include "surface/grid.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::pm {

inline constexpr double kSmoothAlpha = 2.0 / 3.0;

/// alpha = (2/3) 2^-s for 0 <= s < cage::kHardSharpness; harder edges are cut and have no alpha.
[[nodiscard]] double alphaOfSharpness(double sharpness);

enum class SectorKind : uint8_t {
    interior, ///< closed: the whole ring of an interior vertex with none or one sharp edge (a dart's tip)
    crease,   ///< open, part of a smooth boundary or crease curve: two sharp edges meet at the vertex
    corner    ///< open, interpolates the vertex
};

/// One fan of facets around a vertex. Facet j (0 <= j < facets) lies between edges j and j + 1, counter-clockwise.
/// Edges and facets of all sectors are packed into slots: slot firstSlot + j holds edge j and, for j < facets, facet j.
struct Sector {
    uint32_t vertex = 0;
    uint32_t firstSlot = 0;
    uint32_t facets = 0; ///< q
    SectorKind kind = SectorKind::interior;
    bool creased = false; ///< some edge inside the sector has an alpha other than 2/3
    /// Closed, and the vertex is sharp (cage::SharpVertex): the sector's v, t and f are moved by p - v, so that the
    /// surface passes through the vertex. Open sectors become corners instead.
    bool pinned = false;

    [[nodiscard]] bool closed() const { return kind == SectorKind::interior; }
    [[nodiscard]] uint32_t edges() const { return closed() ? facets : facets + 1; }
    /// The valence N of cos(2 pi / N): q closed, 2 q on creases, 4 q at corners.
    [[nodiscard]] uint32_t valence() const {
        return kind == SectorKind::interior ? facets : kind == SectorKind::crease ? 2 * facets : 4 * facets;
    }
};

enum class FacetClass : uint8_t { ordinary, polar, p3, p4, p5 };

/// Per corner of Mesh::cage (corner c of facet f at vertex v; half-edge c runs to the next vertex of f).
struct FacetCorner {
    uint32_t sector = 0;
    uint32_t slot = 0;     ///< facet slot of f in the sector = edge slot of edge j, the half-edge c
    uint32_t slotBack = 0; ///< edge slot of edge j + 1, towards the previous vertex of f
    /// Facet slot across edge j (facet j - 1) and across edge j + 1 (facet j + 1) in the same sector; kNone where that
    /// edge ends the sector.
    uint32_t across = cage::kNone;
    uint32_t acrossBack = cage::kNone;
};

struct Mesh {
    cage::Cage cage; ///< what was given, with facets of six and more sides split; vertices are the same
    cage::Topology topology;
    cage::Features features;
    std::vector<uint32_t> sourceFaces; ///< per facet: the face it came from
    std::vector<Sector> sectors;       ///< grouped by vertex, in vertex order
    std::vector<uint32_t> slotSpokes;  ///< per slot: spoke slot of the topology (spokeVertices: far end of edge j)
    std::vector<double> slotAlphas;    ///< per slot: alpha of edge j at this vertex; 2/3 at the ends of open sectors
    std::vector<FacetCorner> corners;  ///< per corner
    std::vector<uint8_t> edgeCut;      ///< per edge of the topology: 1 on boundaries and hard edges
    std::vector<FacetClass> classes;   ///< per facet
    /// Per facet: the corner (0..sides-1) its patch begins at. 0 but for polar facets, whose last corner must be the
    /// apex: patch corner i is facet corner (first + i) % sides.
    std::vector<uint8_t> firstCorners;
    /// What was changed or left out on the way in, one line each ("face 12 has 7 sides: split into a quad and a
    /// pentagon").
    std::vector<std::string> notes;

    [[nodiscard]] uint32_t corner(uint32_t facet, uint32_t patchCorner) const {
        return cage.faceStarts[facet] + (firstCorners[facet] + patchCorner) % cage.sides(facet);
    }
};

/// Splits, builds topology and features, and sorts out sectors and classes. Refuses what P_m cannot take, by name: what
/// cage::buildTopology refuses, and a face of six or more sides none of whose zig-zag splits is free ("face 12 has 6
/// sides: ..."). O(corners) but for the sorting of neighbours and the choice of splits.
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage);

} // namespace supple::surface::pm
