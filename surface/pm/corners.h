// The corners of P_m: how wide they are, and which of them a crease runs straight through. docs/pm.md has the rule.
#pragma once

#include "surface/pm/mesh.h"

namespace supple::surface::pm {

/// Finds the width of every corner with inner edges, and makes fans straight, from the positions of `mesh.cage`. Fans
/// of one facet stay right angles, unless both their edges belong to a straight fan. Needs the fans.
void shapeCorners(Mesh& mesh);

} // namespace supple::surface::pm
