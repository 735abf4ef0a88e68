#include "picture.h"
#include "device.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <vector>

namespace sample {

void writePng(const std::string& path, uint32_t width, uint32_t height, const void* rgba) {
    const auto* from = static_cast<const unsigned char*>(rgba);
    std::vector<unsigned char> rgb;
    rgb.reserve(std::size_t{3} * width * height);
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i)
        rgb.insert(rgb.end(), from + 4 * i, from + 4 * i + 3);
    if (stbi_write_png(path.c_str(), static_cast<int>(width), static_cast<int>(height), 3, rgb.data(),
                       static_cast<int>(3 * width)) == 0)
        fail(path + " cannot be written");
}

} // namespace sample
