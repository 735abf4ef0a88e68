// Quads from triangles: what an artist drew, where a file has nothing but triangles.
#pragma once

#include "cage/polygons.h"

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cage {

/// What the two triangles of a quad must be, besides: they run against each other along an edge that no third one has,
/// corners agree there, and no two corners of the quad are one.
enum class PairShape {
    clean,   ///< the quad is convex and nearly flat
    unfolded ///< the triangles face the same side
};

struct PairedTriangles {
    Polygons polygons; ///< quads and the triangles that are left, in the order of their first triangles
    size_t quads = 0;
    double squareness = 0.0; ///< sum over the quads: 1 for a rectangle, 0 where a corner has no angle or a straight one
};

/// Pairs triangles into quads, the best pair first: by how near the corners are to right angles, how flat it is, and
/// whether one triangle follows the other, as exporters write quads. `positions` are those of the glTF vertices.
/// `sameCorner` of two glTF vertices says whether their attributes agree. `spare` is spareEdges() of the mesh; edges
/// that go are taken off. O(n log n).
[[nodiscard]] PairedTriangles pairTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded,
                                            std::span<const glm::vec3> positions,
                                            const std::function<bool(uint32_t, uint32_t)>& sameCorner, PairShape shape,
                                            std::vector<uint32_t>& spare);

/// For each welded vertex, how many of its edges may go, so that no inner vertex is left with two: on the boundary,
/// all. `triangles` are those of the whole mesh.
[[nodiscard]] std::vector<uint32_t> spareEdges(std::span<const uint32_t> triangles, std::span<const uint32_t> welded);

} // namespace supple::cage
