// The checks of a glTF file's JSON: what it must have, which indices and numbers are allowed. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json.h"

#include <cstddef>
#include <span>

namespace supple::cage::gltf {

/// Version and extensions: whether this reader is meant to understand the file. Throws Refusal.
void checkHeader(const json& root);

/// Everything else but buffers and images. Throws Refusal. Animation channels without a target node are given one, and
/// the path "pointer", so that they keep their place.
void checkStructure(json& root, std::span<const std::span<const std::byte>> buffers);

} // namespace supple::cage::gltf
