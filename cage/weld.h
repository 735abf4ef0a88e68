// Welding: glTF splits a vertex wherever UVs, colors or normals differ from corner to corner, and often everywhere; a
// cage needs it whole. Vertices are candidates when their positions (bit by bit, with -0 = 0), skin
// and morph targets agree.
//
// Agreement is not enough: two surfaces may touch in a vertex or along an edge, and merging what merely touches turns a
// fine mesh into a non-manifold one. So vertices are merged by sewing edges: two candidates become one where an edge
// between candidate vertices runs once each way over two faces that share no other partner there. A seam is
// sewn completely, for the fans on its sides meet edge by edge; what meets four faces at an edge, or meets only in
// a point, stays as the file has it. Vertices the file shares stay shared. Attributes do not decide: exporters leave
// behind vertices that agree in all of them (two in a 24-vertex cube, all of a triangle soup), so that is no sign of
// intent.
#pragma once

#include "cage/polygons.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage {

struct Welding {
    std::vector<uint32_t> roots; ///< per vertex: the smallest vertex of its cage vertex
};

/// `candidates` numbers the sets of vertices that may become one; `faces` are in vertices.
[[nodiscard]] Welding weld(std::span<const uint32_t> candidates, const Polygons& faces);

/// Merges pairs of vertices, whatever the faces: for files that say themselves which vertices are one.
[[nodiscard]] Welding weldPairs(size_t vertexCount, std::span<const std::pair<uint32_t, uint32_t>> pairs);

/// Takes merges back that the faces do not bear: an edge that would run twice in one direction, a face with a repeated
/// vertex, an interior vertex of valence two (the corner of a two-sided sheet), each only where the file's own vertices
/// do not already have it. Returns the number of cage vertices taken apart.
uint32_t unweldDefects(const Polygons& polygons, Welding& welding);

} // namespace supple::cage
