#include "cage/image_header.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace supple::cage {
namespace {

bool startsWith(std::span<const std::byte> bytes, std::initializer_list<unsigned> magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](unsigned a, std::byte b) { return a == std::to_integer<unsigned>(b); });
}

/// Big-endian, of `count` bytes, which must be there.
uint32_t numberAt(std::span<const std::byte> bytes, size_t at, size_t count) {
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) {
        value = value << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    }
    return value;
}

/// Goes from segment to segment up to the start of a frame, whichever kind of frame it is.
std::optional<ImageSize> jpegSize(std::span<const std::byte> bytes) {
    size_t at = 2;
    while (at + 4 <= bytes.size()) {
        if (numberAt(bytes, at, 1) != 0xFF) {
            return std::nullopt;
        }
        const uint32_t marker = numberAt(bytes, at + 1, 1);
        if (marker == 0xFF) { // fill
            ++at;
            continue;
        }
        if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) { // without a length
            at += 2;
            continue;
        }
        const uint32_t length = numberAt(bytes, at + 2, 2);
        const bool frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) {
            if (at + 9 > bytes.size()) {
                return std::nullopt;
            }
            return ImageSize{numberAt(bytes, at + 7, 2), numberAt(bytes, at + 5, 2)};
        }
        if (length < 2) {
            return std::nullopt;
        }
        at += 2 + size_t{length};
    }
    return std::nullopt;
}

} // namespace

const char* imageType(std::span<const std::byte> bytes) {
    if (startsWith(bytes, {0x89, 'P', 'N', 'G'})) {
        return "image/png";
    }
    if (startsWith(bytes, {0xFF, 0xD8, 0xFF})) {
        return "image/jpeg";
    }
    if (bytes.size() >= 12 && startsWith(bytes, {'R', 'I', 'F', 'F'}) &&
        startsWith(bytes.subspan(8), {'W', 'E', 'B', 'P'})) {
        return "image/webp";
    }
    return startsWith(bytes, {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB}) ? "image/ktx2" : nullptr;
}

bool isCoreImage(std::span<const std::byte> bytes) {
    const char* type = imageType(bytes);
    return type != nullptr && (std::string_view(type) == "image/png" || std::string_view(type) == "image/jpeg");
}

std::optional<ImageSize> imageSize(std::span<const std::byte> bytes) {
    if (!isCoreImage(bytes)) {
        return std::nullopt;
    }
    if (std::string_view(imageType(bytes)) == "image/jpeg") {
        return jpegSize(bytes);
    }
    // Eight bytes of signature, then the chunk IHDR: length, name, width, height.
    if (bytes.size() < 24) {
        return std::nullopt;
    }
    return ImageSize{numberAt(bytes, 16, 4), numberAt(bytes, 20, 4)};
}

} // namespace supple::cage
