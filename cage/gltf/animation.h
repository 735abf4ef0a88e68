// Clips of a glTF file. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/clip_set.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage::gltf {

/// As a target count: as many as the channels themselves have weights for.
inline constexpr size_t kFromKeys = SIZE_MAX;

/// Channels of translation, rotation and scale, and of morph targets' weights; others are left out with a warning.
/// `targetCounts`: per node, how many morph targets the part has that it carries, or kFromKeys. If a clip has keys
/// before 0, it begins at its first key. Keys and channels that are faulty are left out. The matrix of a node that a
/// channel moves is taken apart.
[[nodiscard]] std::vector<Clip> readClips(const Document& document, Skeleton& skeleton,
                                          std::span<const size_t> targetCounts, Warnings& warnings);

/// What a file called `name` holds of motion, for a character of another file. Clips that have no name are called as
/// the file, and numbered if there are several. Throws Refusal.
[[nodiscard]] ClipSet readMotion(const Document& document, const std::string& name);

} // namespace supple::cage::gltf
