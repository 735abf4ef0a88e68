// Materials of a glTF file, with the textures they use. Private to cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_document.h"
#include "cage/gltf_message.h"

#include <vector>

namespace supple::cage {

/// What a material has beyond cage::Material is left out, some of it with a warning.
[[nodiscard]] std::vector<Material> readMaterials(const GltfDocument& document, Warnings& warnings);

} // namespace supple::cage
