// Writes springs and colliders as VRMC_springBone has them. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "tools/gltf/written_json.h"

namespace supple::cage::gltf {

/// Behind the nodes of `root`. Nothing if the character has no springs and no colliders. A spring of VRM 0.x becomes a
/// chain for each of its branches. Its leaves get nodes for their tails, which VRM 0.x leaves to the program.
void writeSpringBones(const Character& character, json& root);

} // namespace supple::cage::gltf
