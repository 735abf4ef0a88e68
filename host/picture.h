// Pictures in host memory: PNG in and out, decoding of the images a glTF carries.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::host {

/// RGBA, 8 bits a channel, rows from the top.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;

    [[nodiscard]] static Picture blank(uint32_t width, uint32_t height);
    [[nodiscard]] uint8_t* pixel(uint32_t x, uint32_t y) { return &rgba[(size_t{y} * width + x) * 4]; }
    [[nodiscard]] const uint8_t* pixel(uint32_t x, uint32_t y) const { return &rgba[(size_t{y} * width + x) * 4]; }
    /// Copies `other` so that its corner comes to (x, y); what does not fit is left out.
    void paste(const Picture& other, uint32_t x, uint32_t y);
    /// Writes a line of UTF-8 with its upper left corner at (x, y); a letter is about 6 by 10 pixels times `scale`. ?
    /// stands for what no font of the system has.
    void drawText(uint32_t x, uint32_t y, const std::string& text, uint32_t scale, const uint8_t (&color)[3]);
};

/// The mean of pictures of one size, taken in linear light.
class PictureAverage {
public:
    PictureAverage(uint32_t width, uint32_t height);
    void add(const Picture& picture);
    [[nodiscard]] Picture picture() const;

private:
    uint32_t width_;
    uint32_t height_;
    uint32_t count_ = 0;
    std::vector<float> sum_; ///< linear RGB
};

/// What was drawn over black and over white, as one picture with alpha. It is exact over both, as programs blend that
/// do so without leaving sRGB.
[[nodiscard]] Picture pictureWithAlpha(const Picture& overBlack, const Picture& overWhite);

[[nodiscard]] Status writePng(const Picture& picture, const std::string& path);
[[nodiscard]] Result<Picture> readPng(const std::string& path);
/// PNG, JPEG, WebP or KTX2 bytes as a glTF holds them, of no more than 2^26 pixels; `name` begins the message.
[[nodiscard]] Result<Picture> decodePicture(std::span<const std::byte> bytes, const std::string& name);

} // namespace supple::host
