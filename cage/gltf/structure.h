// The checks of a glTF file's JSON: what it must have, which indices and numbers are allowed. Private to cage/gltf/.
#pragma once

#include "cage/gltf/broken.h"
#include "cage/gltf/json.h"
#include "cage/leniency.h"

#include <cstddef>
#include <span>
#include <vector>

namespace supple::cage::gltf {

/// Version and extensions: whether this reader is meant to understand the file. Throws Refusal.
void checkHeader(const Json& root);

/// In the place of a buffer that a view was decoded into: its compressed bytes are damaged, and a warning says so.
inline constexpr int kNotDecoded = -2;

/// Everything else but buffers and images. Where decodedInto[view] is not -1, that buffer takes the place of what the
/// bufferView names. Returns what is left out. Throws Refusal if something is broken that nothing can do without: the
/// tree of nodes and where they stand.
[[nodiscard]] Broken checkStructure(const Json& root, std::span<const std::span<const std::byte>> buffers,
                                    const std::vector<int>& decodedInto, Leniency& leniency);

} // namespace supple::cage::gltf
