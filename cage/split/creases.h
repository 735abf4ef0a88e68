// Creases and sharp vertices of a mesh with split vertices. Private to cage/split/.
#pragma once

#include "cage/character.h"
#include "cage/leniency.h"
#include "cage/message.h"
#include "cage/split/mesh.h"

#include <cstdint>
#include <span>

namespace supple::cage::split {

/// Fills the cage's creases, their sets, sharp vertices and crease scalars: of creases and sharp vertices those of the
/// primitives, or else of the mesh. A list of a primitive that names what is not there is left out by `leniency`; of
/// the mesh's own lists there are warnings alone. `cageVertices` gives the cage vertex of each of the mesh's vertices,
/// kNone where it is left out.
void addCreases(const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage, Leniency& leniency,
                Warnings& warnings);

} // namespace supple::cage::split
