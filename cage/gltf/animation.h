// Clips of a glTF file. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::cage::gltf {

/// Channels of translation, rotation and scale, and of the weights of the mesh node's morph targets; others are left
/// out with a warning. Throws Refusal.
[[nodiscard]] std::vector<Clip> readClips(const Document& document, const Skeleton& skeleton, uint32_t meshNode,
                                          size_t targetCount, Warnings& warnings);

} // namespace supple::cage::gltf
