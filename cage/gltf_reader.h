// Reads .gltf and .glb into a Character.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::cage {

struct GltfOptions {
    /// Merge consecutive triangles that share an edge into quads where the file carries no polygons.
    bool pairQuads = false;
};

/// Parses a glTF or GLB held in memory. `name` begins every message. External buffers and images are looked up below
/// `baseDirectory` (no "..", no absolute paths, no URL schemes but data:); an empty baseDirectory allows none.
/// Never throws. Errors name file, element and reason.
[[nodiscard]] Result<Character> readGltf(std::span<const std::byte> bytes, const std::string& name,
                                         const std::string& baseDirectory, const GltfOptions& options = {});

/// Reads a file and parses it; external resources are looked up in its folder.
[[nodiscard]] Result<Character> readGltfFile(const std::string& path, const GltfOptions& options = {});

} // namespace supple::cage
