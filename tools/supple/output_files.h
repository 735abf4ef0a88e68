// What a subcommand writes: not over what it reads, and where it can, asked before the work, which may take minutes.
#pragma once

#include "base/result.h"

#include <span>
#include <string>
#include <vector>

namespace supple::tools {

struct OutputPath {
    const char* option; ///< "--json"
    std::string path;   ///< empty: not asked for
};

/// Throws CLI::ValidationError, with the name of the option, if an output is one of the inputs, by whatever path.
void checkOutputs(const std::vector<std::string>& inputs, const std::vector<OutputPath>& outputs);
/// `file` and the files of clips.
[[nodiscard]] std::vector<std::string> inputsOf(const std::string& file, const std::vector<std::string>& clipFiles);

/// Options that name the same file; empty: none do.
[[nodiscard]] std::string sameOutputs(std::span<const OutputPath> outputs);
/// The error names every path that cannot be written, and why, each on a line of its own.
[[nodiscard]] Status canWrite(std::span<const OutputPath> outputs);

} // namespace supple::tools
