// Oriented manifold topology of a control cage: fans of spokes and sectors, half-edge twins, edges, boundaries.
// Depends on connectivity only; built once per asset.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::cage {

/// Corner c of face f at index j is both "vertex F[j] of f" and the half-edge F[j] -> F[j+1].
///
/// The fan of a vertex, counter-clockwise seen from outside: spoke k is an edge neighbor, sector k the face corner
/// between spokes k and k+1. Interior vertex of valence n: spokes and sectors 0..n-1, indices mod n, sector 0 at the
/// smallest corner. Boundary vertex with m faces: spokes 0..m, sectors 0..m-1, spoke 0 has no face on its clockwise
/// side. Spokes of all vertices are packed by start index; sector k has the slot of spoke k, so the last slot of a
/// boundary fan carries no sector.
struct Topology {
    std::vector<uint32_t> spokeStarts;   ///< vertexCount + 1
    std::vector<uint32_t> spokeVertices; ///< per spoke: the vertex at its far end
    std::vector<uint32_t> sectorCorners; ///< per spoke: the corner of its sector, kNone for a boundary fan's last spoke
    std::vector<uint8_t> boundary;       ///< per vertex: 1 on the boundary

    std::vector<uint32_t> cornerFaces;  ///< per corner: its face
    std::vector<uint32_t> cornerSpokes; ///< per corner: spoke towards the next vertex of the face (= its sector's slot)
    std::vector<uint32_t> cornerSpokesBack; ///< per corner: spoke towards the previous vertex of the face
    std::vector<uint32_t> twins;            ///< per corner (half-edge): the opposite half-edge, kNone on the boundary
    std::vector<uint32_t> cornerEdges;      ///< per corner (half-edge): its undirected edge

    /// An undirected edge: `corner` is the owning half-edge (the smaller corner index; the edge's own direction A ->
    /// B).
    struct Edge {
        uint32_t corner = kNone;
        uint32_t twin = kNone; ///< kNone on the boundary
    };
    std::vector<Edge> edges; ///< sorted by owning corner

    [[nodiscard]] uint32_t spokeCount(uint32_t vertex) const { return spokeStarts[vertex + 1] - spokeStarts[vertex]; }
    /// Faces round a vertex: n in the interior, m on the boundary.
    [[nodiscard]] uint32_t sectorCount(uint32_t vertex) const { return spokeCount(vertex) - boundary[vertex]; }
    /// n in the interior, 2m on the boundary; 4 means regular.
    [[nodiscard]] uint32_t effectiveValence(uint32_t vertex) const {
        return boundary[vertex] != 0 ? 2 * sectorCount(vertex) : sectorCount(vertex);
    }
};

/// Next and previous corner of the same face.
[[nodiscard]] uint32_t nextCorner(const Cage& cage, uint32_t face, uint32_t corner);
[[nodiscard]] uint32_t previousCorner(const Cage& cage, uint32_t face, uint32_t corner);

/// The undirected edge at a spoke slot.
[[nodiscard]] uint32_t spokeEdge(const Cage& cage, const Topology& topology, uint32_t spoke);
/// The edge between two vertices, kNone where there is none. Linear in the smaller of their valences.
[[nodiscard]] uint32_t findEdge(const Cage& cage, const Topology& topology, uint32_t a, uint32_t b);

/// Builds the topology, or names the first fault: no faces; a face with fewer than three corners, an index out of range
/// or a repeated vertex; an edge with more than two faces; two faces that run along an edge in the same direction
/// (flipped orientation or duplicate face); a vertex without faces; a vertex with several fans (bow tie); interior
/// valence 2. Message form: "edge (12, 40): three faces meet here: 3, 9, 17".
[[nodiscard]] Result<Topology> buildTopology(const Cage& cage);

} // namespace supple::cage
