// A character without a skeleton of its own: OBJ files, a bare cage of the host's.
#pragma once

#include "cage/character.h"
#include "cage/parts.h"

#include <span>
#include <string>

namespace supple::cage {

/// Gives the character one node of that name, which is the only joint; every vertex of the parts is bound to it. It
/// carries a part that is alone, which is called as it if it has no name. Each of several is carried by a node of its
/// own below that one.
void bindToOneJoint(std::span<PartCage> parts, Character& character, const std::string& nodeName);
/// The same of a character that is its cage alone.
void bindToOneJoint(Character& character, const std::string& nodeName);

} // namespace supple::cage
