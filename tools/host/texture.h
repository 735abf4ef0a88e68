// Pictures as textures.
#pragma once

#include "tools/host/device.h"
#include "tools/host/picture.h"

namespace supple::host {

/// An sRGB texture with its mip levels, in SHADER_READ_ONLY_OPTIMAL. Waits for the device.
[[nodiscard]] Result<Image> uploadTexture(Device& device, const Picture& picture);

} // namespace supple::host
