// The URIs of a glTF file: data: URIs and files of the asset's own folder, nothing else. For the readers of
// cage/ alone.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace supple::cage::gltf {

[[nodiscard]] bool isDataUri(std::string_view uri);

struct DataUri {
    std::vector<std::byte> bytes;
    std::string mimeType;
};

/// "data:[media type][;base64],..." with any media type; white space inside base64 is skipped.
[[nodiscard]] Result<DataUri> decodeDataUri(std::string_view uri);

/// The path a URI means, percent-decoded, without "." and empty names; refuses schemes, absolute paths, "..",
/// backslashes, and the names of cage/path_name.h.
[[nodiscard]] Result<std::string> relativePath(std::string_view uri);

/// Reads a path from relativePath() below `baseDirectory`; refuses symbolic links that lead outside, and anything but
/// regular files. An empty baseDirectory allows no file.
[[nodiscard]] Result<std::vector<std::byte>> readBelow(const std::string& baseDirectory, const std::string& path);

/// A whole regular file.
[[nodiscard]] Result<std::vector<std::byte>> readRegularFile(const std::filesystem::path& path);

} // namespace supple::cage::gltf
