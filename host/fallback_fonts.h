// Fonts of the system for the characters that built-in ones lack: names in files are in any language.
#pragma once

#include "host/system_fonts.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace supple::host {

/// A font, and the characters that are drawn with it.
struct FallbackFont {
    FontFile file;
    std::vector<std::byte> bytes; ///< the whole file
    std::u32string characters;    ///< rising, each once
};

/// The characters of a text beyond ASCII, rising, each once. What is no UTF-8 counts as U+FFFD.
[[nodiscard]] std::u32string charactersBeyondAscii(std::string_view text);

/// Fonts that have these characters, each of which is in one of them at most. Those that no font has are left out.
[[nodiscard]] std::vector<FallbackFont> fallbackFonts(const std::u32string& characters);

} // namespace supple::host
