#include "cage/gltf/uri.h"

#include "base/utf8_path.h"
#include "cage/path_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace supple::cage::gltf {
namespace {

// A 32-bit GLB cannot be longer, and a buffer of that size is no character.
constexpr uintmax_t kMaxFileBytes = 0xFFFFFFFFu;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    return -1;
}

std::string percentDecode(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0) {
            decoded += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0 || std::isalpha(static_cast<unsigned char>(uri[0])) == 0) {
        return false;
    }
    for (const char c : uri.substr(0, colon)) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') {
            return false;
        }
    }
    return true;
}

Error malformed(std::string reason) {
    return Error{ErrorCode::asset, std::move(reason)};
}

Error unreadable(std::string reason) {
    return Error{ErrorCode::io, std::move(reason)};
}

constexpr std::array<int, 256> makeBase64Values() {
    std::array<int, 256> values{};
    for (auto& value : values) {
        value = -1;
    }
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
    }
    return values;
}
constexpr auto kBase64Values = makeBase64Values();

} // namespace

bool isDataUri(std::string_view uri) {
    constexpr std::string_view scheme = "data:";
    if (uri.size() < scheme.size()) {
        return false;
    }
    for (size_t i = 0; i < scheme.size(); ++i) {
        if (std::tolower(static_cast<unsigned char>(uri[i])) != scheme[i]) {
            return false;
        }
    }
    return true;
}

Result<DataUri> decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        return malformed("data URI without a comma");
    }
    std::string_view header = uri.substr(5, comma - 5);
    const std::string_view payload = uri.substr(comma + 1);
    constexpr std::string_view base64 = ";base64";
    DataUri result;
    // RFC 2397: names are the same in capitals.
    const bool isBase64 =
        header.size() >= base64.size() &&
        std::equal(base64.begin(), base64.end(), header.end() - base64.size(), [](char wanted, char c) {
            return wanted == static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        });
    if (!isBase64) {
        result.mimeType = std::string(header.substr(0, header.find(';')));
        const std::string text = percentDecode(payload);
        result.bytes.resize(text.size());
        if (!text.empty()) {
            std::memcpy(result.bytes.data(), text.data(), text.size());
        }
        return result;
    }
    header = header.substr(0, header.size() - base64.size());
    result.mimeType = std::string(header.substr(0, header.find(';')));
    result.bytes.reserve(payload.size() / 4 * 3 + 3);
    uint32_t bits = 0;
    int bitCount = 0;
    bool padded = false;
    for (size_t i = 0; i < payload.size(); ++i) {
        const unsigned char c = static_cast<unsigned char>(payload[i]);
        if (std::isspace(c) != 0) {
            continue;
        }
        if (c == '=') {
            padded = true;
            continue;
        }
        const int value = kBase64Values[c];
        if (value < 0 || padded) {
            return malformed("data URI: not base64 at character " + std::to_string(comma + 1 + i));
        }
        bits = (bits << 6) | static_cast<uint32_t>(value);
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            result.bytes.push_back(static_cast<std::byte>((bits >> bitCount) & 0xFFu));
        }
    }
    return result;
}

Result<std::vector<std::byte>> readRegularFile(const std::filesystem::path& path) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (status.type() == std::filesystem::file_type::not_found) {
        return unreadable("no such file");
    }
    if (code) {
        return unreadable(code.message());
    }
    if (status.type() != std::filesystem::file_type::regular) {
        return unreadable("not a regular file");
    }
    const uintmax_t size = std::filesystem::file_size(path, code);
    if (code) {
        return unreadable(code.message());
    }
    if (size > kMaxFileBytes) {
        return unreadable("larger than 4 GiB");
    }
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        return unreadable(errno != 0 ? std::generic_category().message(errno) : "cannot be opened");
    }
    std::vector<std::byte> bytes(static_cast<size_t>(size));
    if (size > 0) {
        stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    }
    if (!stream) {
        return unreadable("cannot be read");
    }
    return bytes;
}

Result<std::string> relativePath(std::string_view uri) {
    std::string path = percentDecode(uri);
    // Both spellings are judged: what is written, and what it decodes to.
    if (hasScheme(uri) || hasScheme(path)) {
        return malformed("only relative paths and data: URIs are allowed");
    }
    if (path.empty()) {
        return malformed("empty path");
    }
    if (path.front() == '/' || path.find('\\') != std::string::npos) {
        return malformed("only relative paths with forward slashes are allowed");
    }
    // A host that looks a path up as it stands must find the same file by every way of writing it.
    std::string plain;
    for (size_t begin = 0; begin <= path.size();) {
        const size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view name = std::string_view(path).substr(begin, end - begin);
        if (name == "..") {
            return malformed("path leaves the asset's folder");
        }
        if (const std::string why = whyRefusedName(name); !why.empty()) {
            return malformed(why);
        }
        if (!name.empty() && name != ".") {
            plain.append(plain.empty() ? "" : "/").append(name);
        }
        begin = end + 1;
    }
    if (plain.empty()) {
        return malformed("empty path");
    }
    return plain;
}

Result<std::vector<std::byte>> readBelow(const std::string& baseDirectory, const std::string& path) {
    if (baseDirectory.empty()) {
        return malformed("external files are not allowed for an asset read from memory");
    }
    std::error_code code;
    const auto base = std::filesystem::canonical(utf8Path(baseDirectory), code);
    if (code) {
        return unreadable("asset folder: " + code.message());
    }
    const auto whole = std::filesystem::canonical(base / utf8Path(path), code);
    if (code) {
        return unreadable(code == std::errc::no_such_file_or_directory ? "no such file" : code.message());
    }
    const auto [baseEnd, wholeMiddle] = std::mismatch(base.begin(), base.end(), whole.begin(), whole.end());
    if (baseEnd != base.end()) {
        return malformed("path leaves the asset's folder");
    }
    (void)wholeMiddle;
    return readRegularFile(whole);
}

} // namespace supple::cage::gltf
