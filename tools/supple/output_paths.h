// Whether what a command is to write can be written: asked before the work, which may take minutes.
#pragma once

#include "base/result.h"

#include <span>
#include <string>

namespace supple::tools {

struct OutputPath {
    const char* option; ///< "--json"
    std::string path;   ///< empty: not asked for
};

/// Options that name the same file; empty: none do.
[[nodiscard]] std::string sameOutputs(std::span<const OutputPath> outputs);
/// The error names every path that cannot be written, and why, each on a line of its own.
[[nodiscard]] Status canWrite(std::span<const OutputPath> outputs);

} // namespace supple::tools
