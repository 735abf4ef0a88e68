#include "host/font_outlines.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#endif
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace supple::host {

struct FontOutlines::Font {
    stbtt_fontinfo info;
};

FontOutlines::FontOutlines(std::span<const std::byte> bytes, int index) {
    if (bytes.empty()) {
        return;
    }
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    const int offset = stbtt_GetFontOffsetForIndex(data, index);
    auto font = std::make_unique<Font>();
    if (offset >= 0 && stbtt_InitFont(&font->info, data, offset) != 0) {
        font_ = std::move(font);
    }
}

FontOutlines::~FontOutlines() = default;

bool FontOutlines::has(char32_t character) const {
    return font_ && stbtt_FindGlyphIndex(&font_->info, static_cast<int>(character)) != 0;
}

GlyphPicture FontOutlines::draw(char32_t character, float size) const {
    GlyphPicture glyph;
    if (!font_) {
        return glyph;
    }
    const float scale = stbtt_ScaleForPixelHeight(&font_->info, size);
    int advance = 0;
    int bearing = 0;
    stbtt_GetCodepointHMetrics(&font_->info, static_cast<int>(character), &advance, &bearing);
    glyph.advance = static_cast<float>(advance) * scale;
    unsigned char* const pixels = stbtt_GetCodepointBitmap(&font_->info, scale, scale, static_cast<int>(character),
                                                           &glyph.width, &glyph.height, &glyph.left, &glyph.top);
    if (pixels != nullptr) {
        glyph.coverage.assign(pixels, pixels + static_cast<size_t>(glyph.width) * static_cast<size_t>(glyph.height));
        stbtt_FreeBitmap(pixels, nullptr);
    }
    return glyph;
}

} // namespace supple::host
