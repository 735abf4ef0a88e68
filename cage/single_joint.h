// A character without a skeleton of its own: OBJ files, the host's arrays.
#pragma once

#include "cage/character.h"

#include <string>

namespace supple::cage {

/// Gives the character one node of that name, which carries the mesh and is the only joint; every cage vertex is bound
/// to it.
void bindToOneJoint(Character& character, const std::string& nodeName);

} // namespace supple::cage
