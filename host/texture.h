// Pictures as textures.
#pragma once

#include "host/device.h"
#include "host/picture.h"

namespace supple::host {

enum class TextureKind {
    color, ///< sRGB, with mip levels
    data,  ///< numbers as they are, with mip levels
    tiles  ///< as data, without mip levels, which would mix tiles
};

/// A texture in SHADER_READ_ONLY_OPTIMAL. Waits for the device.
[[nodiscard]] Result<Image> uploadTexture(Device& device, const Picture& picture,
                                          TextureKind kind = TextureKind::color);

} // namespace supple::host
