#pragma once

#include "device.h"

#include <cstdint>
#include <string>

namespace sample {

/// Records the copy of a picture (4 bytes a pixel, TRANSFER_SRC_OPTIMAL) to memory that the host reads.
void copyPicture(VkCommandBuffer commands, const Image& picture, const Buffer& readback);

/// Writes RGBA of 8 bits as PNG, without the alpha; ends the program where that fails.
void writePng(const std::string& path, uint32_t width, uint32_t height, const void* rgba);

} // namespace sample
