// std::from_chars, where a standard library has it for floating point. libc++ had it for integers alone before version
// 20: there fast_float parses the rest.
#pragma once

#include <charconv>

#ifdef __cpp_lib_to_chars
namespace supple {
using std::from_chars;
} // namespace supple
#else
#include <fast_float/fast_float.h>
#include <type_traits>

namespace supple {
template <class T>
[[nodiscard]] auto from_chars(const char* first, const char* last, T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        return fast_float::from_chars(first, last, value);
    } else {
        return std::from_chars(first, last, value);
    }
}
} // namespace supple
#endif
