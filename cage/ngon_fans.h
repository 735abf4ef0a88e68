// From polygons to triangles that other viewers show and from which the polygons can be read again: the inverse of
// decodeNgons() (cage/polygons.h).
#pragma once

#include "cage/polygons.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cage {

/// Cuts every polygon into a fan, in the order of FB_ngon_encoding: all triangles of a polygon begin with one vertex,
/// and the next polygon's begin with another. Among the fans that leaves open, those that fold the fewest triangles
/// over concave polygons are taken, all polygons considered together, and among these the ones that begin where the
/// polygon does. `positions` holds one a vertex; polygons have at least three corners and repeat no vertex.
[[nodiscard]] std::vector<uint32_t> encodeNgons(const Polygons& polygons, std::span<const glm::vec3> positions);

} // namespace supple::cage
