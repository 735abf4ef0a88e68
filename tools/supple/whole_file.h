// A file written all or nothing.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::tools {

/// A file beside the target takes its place when it is complete.
[[nodiscard]] Status writeWhole(const std::string& path, std::span<const std::byte> bytes);

} // namespace supple::tools
