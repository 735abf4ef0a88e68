// Normals of the control polygons themselves, for viewers that know no surface.
#pragma once

#include "cage/character.h"

#include <vector>

namespace supple::cage {

/// One unit normal a corner: the mean of the face normals round its vertex, weighted by the corners' angles, over the
/// faces that are joined to the corner's own across edges that are not infinitely sharp. Takes any cage, manifold or
/// not.
[[nodiscard]] std::vector<glm::vec3> cornerNormals(const Cage& cage);

} // namespace supple::cage
