// Materials of a glTF file, with the textures they use. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <vector>

namespace supple::cage::gltf {

/// Textures that are missing or lie on a UV set that is not read are left out, numbers beyond their range are clamped,
/// extensions that are not read are named: all with a warning. What has the wrong type, and indices out of range, are
/// left out as faults of the file. A trim that is not right is refused, as it is part of the shape.
[[nodiscard]] std::vector<Material> readMaterials(const Document& document, Warnings& warnings);

} // namespace supple::cage::gltf
