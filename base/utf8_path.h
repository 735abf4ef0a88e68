// Paths as the whole of Supple hands them round: UTF-8 text. std::filesystem::path takes a std::string for text of the
// system's own code page, which on Windows may be another; a path made here names the same file everywhere.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace supple {

/// Throws where the system's paths cannot spell the text: on Windows if it is not UTF-8.
[[nodiscard]] inline std::filesystem::path utf8Path(std::string_view text) {
    return {std::u8string(text.begin(), text.end())};
}

/// The other way round. Throws where a path is no text: on Windows if half of a UTF-16 pair is missing.
[[nodiscard]] inline std::string utf8Text(const std::filesystem::path& path) {
    const std::u8string text = path.u8string();
    return {text.begin(), text.end()};
}

} // namespace supple
