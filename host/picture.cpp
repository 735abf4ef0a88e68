#include "host/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

// The one place where stb is compiled; static, so that it never meets another copy (imgui, tinygltf) in the linker.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
// Declared by no standard header the font includes itself.
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace supple::host {

namespace {

constexpr uint32_t kMaxSide = 16384;

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

} // namespace

Picture Picture::blank(uint32_t width, uint32_t height) {
    Picture picture{width, height, std::vector<uint8_t>(size_t{width} * height * 4)};
    for (size_t i = 3; i < picture.rgba.size(); i += 4)
        picture.rgba[i] = 255;
    return picture;
}

void Picture::paste(const Picture& other, uint32_t x, uint32_t y) {
    if (x >= width || y >= height)
        return;
    const uint32_t columns = std::min(other.width, width - x);
    const uint32_t rows = std::min(other.height, height - y);
    for (uint32_t row = 0; row < rows; ++row)
        std::memcpy(pixel(x, y + row), other.pixel(0, row), size_t{columns} * 4);
}

void Picture::drawText(uint32_t x, uint32_t y, const std::string& text, uint32_t scale, const uint8_t (&color)[3]) {
    struct FontVertex {
        float x, y, z;
        uint8_t color[4];
    };
    std::string copy = text;
    std::vector<FontVertex> vertices(copy.size() * 68 +
                                     4); // stb: about 270 bytes a letter, at most 4 vertices a stroke
    const int quads = stb_easy_font_print(0.0f, 0.0f, copy.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(FontVertex)));
    for (int quad = 0; quad < quads; ++quad) {
        const FontVertex& low = vertices[static_cast<size_t>(quad) * 4];
        const FontVertex& high = vertices[static_cast<size_t>(quad) * 4 + 2];
        const auto left = x + static_cast<uint32_t>(low.x) * scale;
        const auto top = y + static_cast<uint32_t>(low.y) * scale;
        const auto right = std::min(width, x + static_cast<uint32_t>(high.x) * scale);
        const auto bottom = std::min(height, y + static_cast<uint32_t>(high.y) * scale);
        for (uint32_t row = top; row < bottom; ++row) {
            for (uint32_t column = left; column < right; ++column)
                std::memcpy(pixel(column, row), color, 3);
        }
    }
}

PictureAverage::PictureAverage(uint32_t width, uint32_t height)
    : width_(width), height_(height), sum_(size_t{width} * height * 3) {}

void PictureAverage::add(const Picture& picture) {
    static const std::array<float, 256> kLinear = [] {
        std::array<float, 256> table{};
        for (size_t i = 0; i < table.size(); ++i) {
            const float x = static_cast<float>(i) / 255.0f;
            table[i] = x < 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
        }
        return table;
    }();
    for (size_t pixel = 0; pixel < sum_.size() / 3; ++pixel) {
        for (size_t channel = 0; channel < 3; ++channel)
            sum_[pixel * 3 + channel] += kLinear[picture.rgba[pixel * 4 + channel]];
    }
    ++count_;
}

Picture PictureAverage::picture() const {
    // 4096 steps are finer than 8 bits of sRGB anywhere but in the darkest twelve, which stay in order.
    constexpr size_t kSteps = 4096;
    static const std::vector<uint8_t> kSrgb = [] {
        std::vector<uint8_t> table(kSteps + 1);
        for (size_t i = 0; i <= kSteps; ++i) {
            const float x = static_cast<float>(i) / kSteps;
            const float y = x < 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
            table[i] = static_cast<uint8_t>(std::lround(y * 255.0f));
        }
        return table;
    }();
    Picture mean = Picture::blank(width_, height_);
    const float scale = count_ > 0 ? static_cast<float>(kSteps) / static_cast<float>(count_) : 0.0f;
    for (size_t pixel = 0; pixel < sum_.size() / 3; ++pixel) {
        for (size_t channel = 0; channel < 3; ++channel)
            mean.rgba[pixel * 4 + channel] = kSrgb[static_cast<size_t>(sum_[pixel * 3 + channel] * scale + 0.5f)];
    }
    return mean;
}

Picture pictureWithAlpha(const Picture& overBlack, const Picture& overWhite) {
    Picture picture = overBlack;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        int seen = 0; // of the white, in the channel where the most is
        for (size_t channel = 0; channel < 3; ++channel)
            seen = std::max(seen, overWhite.rgba[i + channel] - overBlack.rgba[i + channel]);
        const int alpha = 255 - seen;
        for (size_t channel = 0; channel < 3 && alpha > 0; ++channel)
            picture.rgba[i + channel] =
                static_cast<uint8_t>(std::min(255, (overBlack.rgba[i + channel] * 255 + alpha / 2) / alpha));
        picture.rgba[i + 3] = static_cast<uint8_t>(alpha);
    }
    return picture;
}

Status writePng(const Picture& picture, const std::string& path) {
    std::vector<uint8_t> encoded;
    const auto append = [](void* context, void* data, int size) {
        auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
        const auto* begin = static_cast<const uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + size);
    };
    const int stride = static_cast<int>(picture.width * 4);
    if (stbi_write_png_to_func(append, &encoded, static_cast<int>(picture.width), static_cast<int>(picture.height), 4,
                               picture.rgba.data(), stride) == 0)
        return Error{ErrorCode::io, path + ": cannot encode the picture"};
    File file(std::fopen(path.c_str(), "wb"));
    if (!file || std::fwrite(encoded.data(), 1, encoded.size(), file.get()) != encoded.size() ||
        std::fflush(file.get()) != 0)
        return Error{ErrorCode::io, path + ": " + std::strerror(errno)};
    return success();
}

Result<Picture> readPng(const std::string& path) {
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        return Error{ErrorCode::io, path + ": " + std::strerror(errno)};
    std::vector<std::byte> bytes;
    std::byte chunk[65536];
    for (size_t count = 0; (count = std::fread(chunk, 1, sizeof chunk, file.get())) > 0;)
        bytes.insert(bytes.end(), chunk, chunk + count);
    return decodePicture(bytes, path);
}

Result<Picture> decodePicture(std::span<const std::byte> bytes, const std::string& name) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(std::min<size_t>(bytes.size(), INT32_MAX));
    int width = 0;
    int height = 0;
    int channels = 0;
    // The header first: a few bytes may claim a picture of gigabytes.
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0)
        return Error{ErrorCode::asset, name + ": not a PNG or JPEG"};
    if (static_cast<uint32_t>(width) > kMaxSide || static_cast<uint32_t>(height) > kMaxSide)
        return Error{ErrorCode::limit, name + ": larger than 16384 pixels"};
    stbi_uc* pixels = stbi_load_from_memory(data, size, &width, &height, &channels, 4);
    if (pixels == nullptr)
        return Error{ErrorCode::asset, name + ": " + stbi_failure_reason()};
    Picture picture{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    picture.rgba.assign(pixels, pixels + picture.width * size_t{picture.height} * 4);
    stbi_image_free(pixels);
    return picture;
}

} // namespace supple::host
