// Clips of a glTF file. Private to cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_document.h"
#include "cage/gltf_message.h"

#include <vector>

namespace supple::cage {

/// Channels of translation, rotation and scale; others are left out with a warning. Throws Refusal.
[[nodiscard]] std::vector<Clip> readClips(const GltfDocument& document, const Skeleton& skeleton, Warnings& warnings);

} // namespace supple::cage
