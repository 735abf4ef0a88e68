// Normals of the control polygons themselves: of a file, or for viewers that know no surface.
#pragma once

#include "cage/character.h"

#include <vector>

namespace supple::cage {

/// One unit normal a corner: the cage's own, if it has one. Otherwise it is the mean of the face normals round the
/// corner's vertex, weighted by the corners' angles, over the faces of its smooth group (cage/smooth_groups.h). Takes
/// any cage, manifold or not.
[[nodiscard]] std::vector<glm::vec3> cornerNormals(const Cage& cage);

/// A file's normal as Cage::cornerNormals keeps it: of unit length, to the bit as it is if it is of that length
/// already; zero if it is no direction.
[[nodiscard]] glm::vec3 unitNormal(const glm::dvec3& given);

} // namespace supple::cage
