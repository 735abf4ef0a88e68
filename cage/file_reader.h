// How readers get the files that an asset refers to.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace supple::cage {

/// Gives the bytes of a file that the asset refers to, or why it cannot, in a few words. `path` is percent-decoded and
/// relative, with forward slashes, no ".." and no scheme.
using FileReader = std::function<Result<std::vector<std::byte>>(const std::string& path)>;

} // namespace supple::cage
