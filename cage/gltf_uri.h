// The URIs of a glTF file: data: URIs and files of the asset's own folder, nothing else. Private to cage/.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace supple::cage {

[[nodiscard]] bool isDataUri(std::string_view uri);

struct UriBytes {
    std::vector<std::byte> bytes;
    std::string mimeType; ///< of a data: URI, else empty
    std::string problem;  ///< empty when the bytes were read; else the reason
    bool readable = true; ///< false: the URI is well-formed but the file cannot be read
};

/// "data:[media type][;base64],..." with any media type; white space inside base64 is skipped.
[[nodiscard]] UriBytes decodeDataUri(std::string_view uri);

/// Reads a percent-encoded relative path below `baseDirectory`. Refuses schemes, absolute paths, "..", backslashes,
/// symbolic links that lead outside, and anything but regular files. An empty baseDirectory allows no file.
[[nodiscard]] UriBytes readBelow(const std::string& baseDirectory, std::string_view uri);

/// A whole regular file.
[[nodiscard]] UriBytes readRegularFile(const std::string& path);

} // namespace supple::cage
