// What wraps a glTF file's JSON: GLB chunks, or nothing. Private to cage/gltf/.
#pragma once

#include "cage/leniency.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace supple::cage::gltf {

/// Refers to the caller's bytes.
struct Container {
    std::string_view text;             ///< the JSON
    std::span<const std::byte> binary; ///< the first BIN chunk of a GLB; empty where there is none
    bool isBinary = false;             ///< a GLB
};

/// Throws Refusal.
[[nodiscard]] Container openContainer(std::span<const std::byte> bytes, Leniency& leniency);

/// Four bytes, little-endian.
[[nodiscard]] uint32_t readU32(std::span<const std::byte> bytes, size_t offset);

} // namespace supple::cage::gltf
