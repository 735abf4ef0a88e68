// printf into a string.
#pragma once

#include <string>

namespace supple::tools {

[[nodiscard]] __attribute__((format(printf, 1, 2))) std::string formatted(const char* pattern, ...);

} // namespace supple::tools
