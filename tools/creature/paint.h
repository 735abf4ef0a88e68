// Vertex colors, painted from the part, the place and the way the surface faces.
#pragma once

#include "modeller.h"

#include <vector>

namespace supple::creature {

// Linear RGB, one a point.
std::vector<Vec3> paint(const Cage& cage);

} // namespace supple::creature
