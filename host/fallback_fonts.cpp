#include "host/fallback_fonts.h"

#include "base/utf8.h"
#include "base/utf8_path.h"
#include "host/font_outlines.h"

#include <algorithm>
#include <fstream>
#include <utility>

namespace supple::host {
namespace {

/// Empty if the file cannot be read.
std::vector<std::byte> bytesOf(const std::string& path) {
    std::ifstream stream(utf8Path(path), std::ios::binary | std::ios::ate);
    std::vector<std::byte> bytes(stream ? static_cast<size_t>(stream.tellg()) : 0);
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return stream ? std::move(bytes) : std::vector<std::byte>();
}

} // namespace

std::u32string charactersBeyondAscii(std::string_view text) {
    std::u32string characters;
    while (!text.empty()) {
        const CodePoint first = firstCodePoint(text);
        if (first.code >= 0x80) {
            characters.push_back(first.code);
        }
        text.remove_prefix(first.bytes);
    }
    std::sort(characters.begin(), characters.end());
    characters.erase(std::unique(characters.begin(), characters.end()), characters.end());
    return characters;
}

std::vector<FallbackFont> fallbackFonts(const std::u32string& characters) {
    std::vector<FallbackFont> fonts;
    std::u32string left = characters;
    if (left.empty()) {
        return fonts;
    }
    for (const FontFile& file : systemFonts(characters)) {
        FallbackFont font{file, bytesOf(file.path), {}};
        const FontOutlines outlines(font.bytes, file.index);
        std::u32string others;
        for (const char32_t character : left) {
            (outlines.has(character) ? font.characters : others).push_back(character);
        }
        if (!font.characters.empty()) {
            fonts.push_back(std::move(font));
        }
        left = std::move(others);
        if (left.empty()) {
            break;
        }
    }
    return fonts;
}

} // namespace supple::host
