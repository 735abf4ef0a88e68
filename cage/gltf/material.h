// Materials of a glTF file, with the textures they use. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <vector>

namespace supple::cage::gltf {

/// Textures that are missing or lie on a UV set that is not read are left out, numbers beyond their range are clamped,
/// extensions that are not read are named: all with a warning. `refusals` gathers what has the wrong type, indices out
/// of range, and trims that are not right.
[[nodiscard]] std::vector<Material> readMaterials(const Document& document, Refusals& refusals, Warnings& warnings);

} // namespace supple::cage::gltf
