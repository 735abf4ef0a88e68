// SUPPLE_deformers of a glTF file: how a mesh is deformed. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/json.h"
#include "cage/message.h"

#include <optional>
#include <string>

namespace supple::cage::gltf {

/// `skinning`, if the mesh says it. Warns of ways of skinning that there are not here. Throws Refusal.
[[nodiscard]] std::optional<SkinningMode> readSkinningMode(const Json& mesh, const std::string& element,
                                                           Warnings& warnings);

} // namespace supple::cage::gltf
