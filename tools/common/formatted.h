// printf into a string.
#pragma once

#include <cstdio>
#include <string>

// The printf that compilers check patterns against. MinGW has two, and says which one it links.
#ifdef __MINGW_PRINTF_FORMAT
#define SUPPLE_PRINTF_FORMAT __MINGW_PRINTF_FORMAT
#else
#define SUPPLE_PRINTF_FORMAT printf
#endif

namespace supple::tools {

[[nodiscard, gnu::format(SUPPLE_PRINTF_FORMAT, 1, 2)]] std::string formatted(const char* pattern, ...);

} // namespace supple::tools
