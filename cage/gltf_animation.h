// Clips of a glTF file. Private to cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_document.h"
#include "cage/gltf_message.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::cage {

/// Channels of translation, rotation and scale, and of the weights of the mesh node's morph targets; others are left
/// out with a warning. Throws Refusal.
[[nodiscard]] std::vector<Clip> readClips(const GltfDocument& document, const Skeleton& skeleton, uint32_t meshNode,
                                          size_t targetCount, Warnings& warnings);

} // namespace supple::cage
