// Clips of a glTF file. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage::gltf {

/// Channels of translation, rotation and scale, and of morph targets' weights; others are left out with a warning.
/// `targetCounts`: per node, how many morph targets the part has that it carries. If a clip has keys before 0, it
/// begins at its first key. Throws Refusal.
[[nodiscard]] std::vector<Clip> readClips(const Document& document, const Skeleton& skeleton,
                                          std::span<const size_t> targetCounts, Warnings& warnings);

} // namespace supple::cage::gltf
