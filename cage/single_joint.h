// A character without a skeleton of its own: OBJ files, a bare cage of the host's.
#pragma once

#include "cage/character.h"
#include "cage/parts.h"

#include <string>

namespace supple::cage {

/// Gives the character one node of that name, which carries the part and is the only joint; every vertex of the part is
/// bound to it.
void bindToOneJoint(PartCage& part, Character& character, const std::string& nodeName);
/// The same of a character that is its cage alone.
void bindToOneJoint(Character& character, const std::string& nodeName);

} // namespace supple::cage
