// Which fonts the operating system has. A file for Windows, one for fontconfig, one for neither.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace supple::host {

struct FontFile {
    std::string path; ///< UTF-8
    int index = 0;    ///< in a file of several fonts
};

/// Files of TrueType or OpenType outlines that may have some of these characters, the best first.
[[nodiscard]] std::vector<FontFile> systemFonts(const std::u32string& characters);

} // namespace supple::host
