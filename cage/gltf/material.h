// Materials of a glTF file, with the textures they use. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <vector>

namespace supple::cage::gltf {

struct WrapModes {
    Wrap u = Wrap::repeat;
    Wrap v = Wrap::repeat;
};
/// Of a texture of the file.
[[nodiscard]] WrapModes wrapModesOf(const Document& document, size_t texture);

/// What a material has beyond cage::Material is left out, some of it with a warning. Throws Refusal for a trim that is
/// not right.
[[nodiscard]] std::vector<Material> readMaterials(const Document& document, Warnings& warnings);

} // namespace supple::cage::gltf
