// Writes a character's materials into a glTF document. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "tools/gltf/packer.h"
#include "tools/gltf/written_json.h"

#include <span>

namespace supple::cage::gltf {

/// Adds materials, textures, samplers and the images that these use, and names the extensions among those used. Images
/// in no format that glTF knows are left out, with a warning.
void writeMaterials(std::span<const Material> materials, std::span<const Image> images, Packer& packer, json& root,
                    Warnings& warnings);

} // namespace supple::cage::gltf
