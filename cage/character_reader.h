// Reads whatever format a character comes in.
#pragma once

#include "cage/gltf_reader.h"

namespace supple::cage {

/// glTF and GLB are known by their first bytes, OBJ by a `name` that ends in ".obj"; what is neither is refused as
/// glTF. Otherwise as readGltf().
[[nodiscard]] Result<Character> readCharacter(std::span<const std::byte> bytes, const std::string& name,
                                              const std::string& baseDirectory, const GltfOptions& options = {});

} // namespace supple::cage
