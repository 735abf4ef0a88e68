// A character without a skeleton of its own: OBJ files, the host's arrays.
#pragma once

#include "cage/character.h"

namespace supple::cage {

/// Gives the character one node, named after it, that carries the mesh and is the only joint; every cage vertex is
/// bound to it.
void bindToOneJoint(Character& character);

} // namespace supple::cage
