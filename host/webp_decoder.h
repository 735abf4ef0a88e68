// WebP into pictures, by libwebp where it is installed.
#pragma once

#include "host/picture.h"

namespace supple::host {

/// By its first bytes.
[[nodiscard]] bool isWebp(std::span<const std::byte> bytes);
/// A still picture of no more than `mostPixels`; `name` begins the message.
[[nodiscard]] Result<Picture> decodeWebp(std::span<const std::byte> bytes, uint64_t mostPixels,
                                         const std::string& name);

} // namespace supple::host
