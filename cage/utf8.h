// UTF-8 as Unicode defines it: no surrogates, nothing longer than need be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace supple::cage {

struct CodePoint {
    uint32_t code;
    size_t bytes;
};

/// `text` is not empty. 0xFFFD and one byte for what is no UTF-8.
[[nodiscard]] CodePoint firstCodePoint(std::string_view text);

[[nodiscard]] bool isUtf8(std::string_view text);

} // namespace supple::cage
