// Which seams of a skin are openings. Private to cage/split/.
#pragma once

#include "cage/split/weld_mesh.h"

namespace supple::cage::split {

/// Takes back what `seams` sews of edges whose vertices agree in position alone, if they are meant to open: the lips of
/// a mouth that the rest pose shows closed. A run of two pairs of vertices and more is one opening if any pair in it
/// moves far apart. `faces` are of the vertices that `welded` has.
void keepOpenings(const Mesh& mesh, const Polygons& faces, const MeshWelding& welded, Welding& seams);

} // namespace supple::cage::split
