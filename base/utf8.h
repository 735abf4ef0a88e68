// UTF-8 as Unicode defines it: no surrogates, nothing longer than need be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace supple {

struct CodePoint {
    uint32_t code;
    size_t bytes;
};

/// `text` is not empty. 0xFFFD and one byte for what is no UTF-8.
[[nodiscard]] constexpr CodePoint firstCodePoint(std::string_view text) {
    constexpr CodePoint kNone{0xFFFD, 1};
    const auto at = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = at(0);
    if (first < 0x80) {
        return {first, 1};
    }
    const size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < bytes) {
        return kNone;
    }
    uint32_t code = first & (0x7Fu >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((at(i) & 0xC0) != 0x80) {
            return kNone;
        }
        code = code << 6 | (at(i) & 0x3Fu);
    }
    constexpr uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    return code < kSmallest[bytes] || surrogate || code > 0x10FFFF ? kNone : CodePoint{code, bytes};
}

[[nodiscard]] constexpr bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const CodePoint first = firstCodePoint(text);
        if (first.code == 0xFFFD && first.bytes == 1) {
            return false;
        }
        text.remove_prefix(first.bytes);
    }
    return true;
}

} // namespace supple
