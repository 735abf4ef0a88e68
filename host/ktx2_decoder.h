// KTX2 with Basis Universal into pictures, by its transcoder where its source is at hand (tools/basisu.sh).
#pragma once

#include "host/picture.h"

namespace supple::host {

/// By its first bytes.
[[nodiscard]] bool isKtx2(std::span<const std::byte> bytes);
/// The largest level of a single picture of no more than `mostPixels`; `name` begins the message.
[[nodiscard]] Result<Picture> decodeKtx2(std::span<const std::byte> bytes, uint64_t mostPixels,
                                         const std::string& name);

} // namespace supple::host
