#pragma once

#include <cstdint>
#include <string>

namespace sample {

/// Writes RGBA of 8 bits as PNG, without the alpha; ends the program where that fails.
void writePng(const std::string& path, uint32_t width, uint32_t height, const void* rgba);

} // namespace sample
