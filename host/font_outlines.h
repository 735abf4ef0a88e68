// The glyphs of a TrueType or OpenType font, by stb_truetype.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace supple::host {

/// A glyph as pixels, from 0 to 255.
struct GlyphPicture {
    int left = 0; ///< of its first column, from the pen
    int top = 0;  ///< of its first row, from the baseline; downwards
    int width = 0;
    int height = 0;
    float advance = 0.0f;
    std::vector<uint8_t> coverage;
};

class FontOutlines {
public:
    /// `bytes`: the whole file; they outlive this. What is no font has no characters.
    FontOutlines(std::span<const std::byte> bytes, int index);
    FontOutlines(const FontOutlines&) = delete;
    FontOutlines& operator=(const FontOutlines&) = delete;
    ~FontOutlines();

    [[nodiscard]] bool has(char32_t character) const;
    /// `size`: from the lowest descender to the highest ascender, in pixels.
    [[nodiscard]] GlyphPicture draw(char32_t character, float size) const;

private:
    struct Font;
    std::unique_ptr<Font> font_; ///< none: the bytes are no font
};

} // namespace supple::host
