// What the first bytes of an encoded image say; nothing is decoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace supple::cage {

/// "image/png", "image/jpeg", "image/webp" or "image/ktx2" by the signature, or null.
[[nodiscard]] const char* imageType(std::span<const std::byte> bytes);
/// Whether it is PNG or JPEG by the signature: a format of glTF's core.
[[nodiscard]] bool isCoreImage(std::span<const std::byte> bytes);

struct ImageSize {
    uint32_t width = 0;
    uint32_t height = 0;
};

/// In pixels, of PNG and JPEG; nothing where the headers end before they tell it.
[[nodiscard]] std::optional<ImageSize> imageSize(std::span<const std::byte> bytes);

} // namespace supple::cage
