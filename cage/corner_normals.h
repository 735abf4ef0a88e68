// Normals of the control polygons themselves, for viewers that know no surface.
#pragma once

#include "cage/character.h"

#include <vector>

namespace supple::cage {

/// One unit normal a corner: the cage's own, if it has one. Otherwise it is the mean of the face normals round the
/// corner's vertex, weighted by the corners' angles, over the faces of its smooth group (cage/smooth_groups.h). Takes
/// any cage, manifold or not.
[[nodiscard]] std::vector<glm::vec3> cornerNormals(const Cage& cage);

} // namespace supple::cage
