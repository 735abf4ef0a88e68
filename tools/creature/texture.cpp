#include "texture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace supple::creature {

namespace {

uint8_t encoded(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    const double s = c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(s * 255));
}

uint8_t plain(double value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

std::vector<std::byte> png(int width, int height, const std::vector<uint8_t>& pixels) {
    std::vector<std::byte> bytes;
    stbi_write_png_compression_level = 16;
    stbi_write_png_to_func(
        [](void* out, void* data, int size) {
            const std::byte* first = static_cast<const std::byte*>(data);
            static_cast<std::vector<std::byte>*>(out)->assign(first, first + size);
        },
        &bytes, width, height, 3, pixels.data(), width * 3);
    return bytes;
}

uint32_t hash(int x, int y, unsigned seed) {
    uint32_t h = static_cast<uint32_t>(x) * 0x9E3779B1u ^ static_cast<uint32_t>(y) * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return h ^ h >> 15;
}

double chance(int x, int y, int across, int down, unsigned seed) {
    const auto wrapped = [](int i, int period) { return (i % period + period) % period; };
    return hash(wrapped(x, across), wrapped(y, down), seed) / 4294967295.0;
}

} // namespace

std::vector<std::byte> paintPng(int width, int height, bool srgb, const Painting& painting) {
    std::vector<uint8_t> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 c = painting((x + 0.5) / width, (y + 0.5) / height);
            for (int i = 0; i < 3; ++i) {
                pixels.push_back(srgb ? encoded(c[i]) : plain(c[i]));
            }
        }
    }
    return png(width, height, pixels);
}

std::vector<std::byte> normalPng(int width, int height, double steep, const Field& heights) {
    std::vector<double> field;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            field.push_back(heights((x + 0.5) / width, (y + 0.5) / height));
        }
    }
    const auto at = [&](int x, int y) {
        return field[static_cast<size_t>((y + height) % height * width + (x + width) % width)] * steep;
    };
    std::vector<uint8_t> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // Rows run down, the map's +Y runs up.
            const Vec3 n = glm::normalize(Vec3{at(x - 1, y) - at(x + 1, y), at(x, y + 1) - at(x, y - 1), 2});
            for (int i = 0; i < 3; ++i) {
                pixels.push_back(plain(0.5 + n[i] * 127.0 / 255.0));
            }
        }
    }
    return png(width, height, pixels);
}

double tiledNoise(double x, double y, int across, int down, unsigned seed) {
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    const double fx = x - cx, fy = y - cy;
    const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    const auto corner = [&](int i, int j) { return chance(cx + i, cy + j, across, down, seed); };
    const double low = corner(0, 0) * (1 - sx) + corner(1, 0) * sx;
    const double high = corner(0, 1) * (1 - sx) + corner(1, 1) * sx;
    return (low * (1 - sy) + high * sy) * 2 - 1;
}

Vec2 tiledCells(double x, double y, int period, unsigned seed) {
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    Vec2 nearest{9, 9};
    for (int j = cy - 1; j <= cy + 1; ++j) {
        for (int i = cx - 1; i <= cx + 1; ++i) {
            const double d =
                std::hypot(i + chance(i, j, period, period, seed) - x, j + chance(i, j, period, period, seed + 1) - y);
            if (d < nearest.x) {
                nearest = {d, nearest.x};
            } else if (d < nearest.y) {
                nearest.y = d;
            }
        }
    }
    return nearest;
}

} // namespace supple::creature
