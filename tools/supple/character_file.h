// A character file in memory: read once, handed to Supple, looked into for what Supple does not tell.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/host/context.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

struct CharacterFile {
    std::string path;
    std::string directory; ///< where its external buffers and images lie
    bool pairQuads = false;
    std::vector<std::byte> bytes;
    cage::Character character;
};
[[nodiscard]] Result<CharacterFile> readCharacterFile(const std::string& path, bool pairQuads);

[[nodiscard]] Result<SuppleAsset> createAsset(host::Context& context, const CharacterFile& file);

/// The clip of that name, else of that index; empty is SUPPLE_BIND_POSE. The error lists the clips there are.
[[nodiscard]] Result<uint32_t> findClip(const CharacterFile& file, const std::string& clip);

} // namespace supple::tools
