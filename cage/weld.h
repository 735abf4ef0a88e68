// Welding: glTF splits a vertex wherever UVs, colors or normals differ from corner to corner, and often everywhere; a
// cage needs it whole. Vertices are candidates when their positions (bit by bit, with -0 = 0), skin
// and morph targets agree.
//
// Agreement is not enough: two surfaces may touch in a vertex or along an edge, and merging what merely touches turns a
// fine mesh into a non-manifold one. So vertices are merged by sewing edges: two candidates become one where an edge
// between candidate vertices runs once each way over two faces that share no other partner there and do not lie back to
// back. A seam is sewn completely, for the fans on its sides meet edge by edge; what meets four faces at an edge, or
// meets only in a point, stays as the file has it. Vertices the file shares stay shared. Attributes do not decide:
// exporters leave behind vertices that agree in all of them (two in a 24-vertex cube, all of a triangle soup), so that
// is no sign of intent.
#pragma once

#include "cage/polygons.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage {

struct Welding {
    std::vector<uint32_t> roots; ///< per vertex: the smallest vertex of its cage vertex
};

/// Whether two faces may become neighbors.
using MayJoin = std::function<bool(uint32_t face, uint32_t other)>;

/// `candidates` numbers the sets of vertices that may become one; `faces` are in vertices. Edges are sewn whose two
/// faces `mayJoin` allows.
[[nodiscard]] Welding weld(std::span<const uint32_t> candidates, const Polygons& faces, const MayJoin& mayJoin);

/// Whether two faces that run against each other along an edge would lie back to back if they were sewn there: their
/// normals are opposite, but for a degree. So are the two sides of a cape without thickness, whose rim has to stay
/// open.
[[nodiscard]] bool lieBackToBack(std::span<const glm::vec3> positions, const Polygons& faces, uint32_t face,
                                 uint32_t other);

/// Merges pairs of vertices, whatever the faces: for files that say themselves which vertices are one.
[[nodiscard]] Welding weldPairs(size_t vertexCount, std::span<const std::pair<uint32_t, uint32_t>> pairs);

/// Takes merges back that the faces do not bear: an edge that would run twice in one direction, a face with a repeated
/// vertex, an interior vertex of valence two (the corner of a two-sided sheet), each only where the file's own vertices
/// do not already have it. Returns the number of cage vertices taken apart.
uint32_t unweldDefects(const Polygons& polygons, Welding& welding);

} // namespace supple::cage
