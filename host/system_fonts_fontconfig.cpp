#include "host/system_fonts.h"

#include <fontconfig/fontconfig.h>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace supple::host {
namespace {

/// What fontconfig made and wants back.
template <class T, class Destroy>
std::unique_ptr<T, Destroy> owned(T* object, Destroy destroy) {
    return {object, destroy};
}

/// Its file, if stb_truetype may read it.
std::optional<FontFile> fileOf(FcPattern* font) {
    FcChar8* path = nullptr;
    FcChar8* format = nullptr;
    int index = 0;
    if (FcPatternGetString(font, FC_FILE, 0, &path) != FcResultMatch ||
        FcPatternGetString(font, FC_FONTFORMAT, 0, &format) != FcResultMatch)
        return std::nullopt;
    FcPatternGetInteger(font, FC_INDEX, 0, &index);
    const std::string_view outlines = reinterpret_cast<const char*>(format);
    if (outlines != "TrueType" && outlines != "CFF")
        return std::nullopt;
    return FontFile{reinterpret_cast<const char*>(path), index & 0xFFFF}; // above: which instance of a variable font
}

} // namespace

std::vector<FontFile> systemFonts(const std::u32string& characters) {
    const auto config = owned(FcInitLoadConfigAndFonts(), &FcConfigDestroy);
    const auto wanted = owned(FcCharSetCreate(), &FcCharSetDestroy);
    const auto pattern = owned(FcPatternCreate(), &FcPatternDestroy);
    for (const char32_t character : characters)
        FcCharSetAddChar(wanted.get(), character);
    FcPatternAddCharSet(pattern.get(), FC_CHARSET, wanted.get());
    FcPatternAddString(pattern.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcConfigSubstitute(config.get(), pattern.get(), FcMatchPattern);
    FcDefaultSubstitute(pattern.get());
    FcResult result = FcResultMatch;
    const auto sorted = owned(FcFontSort(config.get(), pattern.get(), FcFalse, nullptr, &result), &FcFontSetDestroy);
    std::vector<FontFile> fonts;
    for (int i = 0; sorted && i < sorted->nfont; ++i) {
        FcCharSet* has = nullptr;
        if (FcPatternGetCharSet(sorted->fonts[i], FC_CHARSET, 0, &has) != FcResultMatch ||
            FcCharSetIntersectCount(has, wanted.get()) == 0)
            continue;
        if (std::optional<FontFile> file = fileOf(sorted->fonts[i]))
            fonts.push_back(std::move(*file));
    }
    return fonts;
}

} // namespace supple::host
