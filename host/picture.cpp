#include "host/picture.h"

#include "base/utf8_path.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

namespace supple::host {

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

Result<Picture> readPng(const std::string& path) {
    errno = 0;
    std::ifstream file(utf8Path(path), std::ios::binary);
    if (!file)
        return Error{ErrorCode::io, path + ": " + std::strerror(errno)};
    std::vector<std::byte> bytes;
    char chunk[65536];
    while (file.read(chunk, sizeof chunk), file.gcount() > 0) {
        const auto* first = reinterpret_cast<const std::byte*>(chunk);
        bytes.insert(bytes.end(), first, first + file.gcount());
    }
    return decodePicture(bytes, path);
}

} // namespace supple::host
