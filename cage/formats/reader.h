// Reads a character from any format that cage/ knows.
#pragma once

#include "cage/gltf/reader.h"

namespace supple::cage {

/// Takes a file for OBJ if `name` ends in ".obj" and the bytes do not begin as glTF does. Takes every other file for
/// glTF. Options, folders and errors are those of readGltf().
[[nodiscard]] Result<Character> readCharacter(std::span<const std::byte> bytes, const std::string& name,
                                              const std::string& baseDirectory, const GltfOptions& options = {});

} // namespace supple::cage
