// Text in pictures: ASCII in the strokes of stb_easy_font, all else in fonts of the system.
#include "base/utf8.h"
#include "host/fallback_fonts.h"
#include "host/font_outlines.h"
#include "host/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#endif
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace supple::host {
namespace {

// In units of stb_easy_font, of which a line has 12: capitals stand on the eighth.
constexpr uint32_t kBaseline = 8;
constexpr float kFontSize = 11.0f;

/// Puts letters on a line.
class Pen {
public:
    Pen(Picture& picture, uint32_t x, uint32_t y, uint32_t scale, const uint8_t (&color)[3])
        : picture_(picture), x_(x), y_(y), scale_(scale), color_(color) {}

    void writeAscii(std::string text) {
        struct Corner {
            float x, y, z;
            uint8_t color[4];
        };
        std::vector<Corner> corners(text.size() * 68 + 4); // about 270 bytes a letter, at most 4 corners a stroke
        const int quads = stb_easy_font_print(0.0f, 0.0f, text.data(), nullptr, corners.data(),
                                              static_cast<int>(corners.size() * sizeof(Corner)));
        for (int quad = 0; quad < quads; ++quad) {
            const Corner& low = corners[static_cast<size_t>(quad) * 4];
            const Corner& high = corners[static_cast<size_t>(quad) * 4 + 2];
            const uint32_t right = std::min(picture_.width, x_ + static_cast<uint32_t>(high.x) * scale_);
            const uint32_t bottom = std::min(picture_.height, y_ + static_cast<uint32_t>(high.y) * scale_);
            for (uint32_t row = y_ + static_cast<uint32_t>(low.y) * scale_; row < bottom; ++row) {
                for (uint32_t column = x_ + static_cast<uint32_t>(low.x) * scale_; column < right; ++column)
                    std::memcpy(picture_.pixel(column, row), &color_[0], 3);
            }
        }
        x_ += static_cast<uint32_t>(stb_easy_font_width(text.data())) * scale_;
    }

    void writeGlyph(const GlyphPicture& glyph) {
        for (int row = 0; row < glyph.height; ++row) {
            for (int column = 0; column < glyph.width; ++column)
                blend(int64_t{x_} + glyph.left + column, int64_t{y_} + kBaseline * scale_ + glyph.top + row,
                      glyph.coverage[static_cast<size_t>(row) * static_cast<size_t>(glyph.width) +
                                     static_cast<size_t>(column)]);
        }
        x_ += static_cast<uint32_t>(std::lround(glyph.advance));
    }

private:
    void blend(int64_t x, int64_t y, uint32_t coverage) {
        if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height)
            return;
        uint8_t* const pixel = picture_.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
        for (size_t channel = 0; channel < 3; ++channel)
            pixel[channel] =
                static_cast<uint8_t>((pixel[channel] * (255 - coverage) + color_[channel] * coverage) / 255);
    }

    Picture& picture_;
    uint32_t x_;
    uint32_t y_;
    uint32_t scale_;
    const uint8_t (&color_)[3];
};

} // namespace

void Picture::drawText(uint32_t x, uint32_t y, const std::string& text, uint32_t scale, const uint8_t (&color)[3]) {
    const std::vector<FallbackFont> fonts = fallbackFonts(charactersBeyondAscii(text));
    Pen pen(*this, x, y, scale, color);
    std::string ascii; // not yet written
    for (std::string_view rest = text; !rest.empty();) {
        const CodePoint next = firstCodePoint(rest);
        rest.remove_prefix(next.bytes);
        const auto font = std::find_if(fonts.begin(), fonts.end(), [&](const FallbackFont& one) {
            return std::binary_search(one.characters.begin(), one.characters.end(), char32_t{next.code});
        });
        if (font == fonts.end()) {
            // stb_easy_font knows these alone.
            ascii.push_back(next.code >= 32 && next.code < 127 ? static_cast<char>(next.code) : '?');
            continue;
        }
        pen.writeAscii(std::exchange(ascii, {}));
        pen.writeGlyph(
            FontOutlines(font->bytes, font->file.index).draw(next.code, kFontSize * static_cast<float>(scale)));
    }
    pen.writeAscii(ascii);
}

} // namespace supple::host
