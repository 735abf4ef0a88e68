// What a subcommand may not write to: the files that it reads.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {

/// Throws CLI::ValidationError, with the name of the option, if an output is one of the inputs, by whatever path. Empty
/// outputs are not asked for.
void checkOutputs(const std::vector<std::string>& inputs,
                  std::initializer_list<std::pair<const char*, std::string>> outputs);

/// `file` and the files of clips.
[[nodiscard]] std::vector<std::string> inputsOf(const std::string& file, const std::vector<std::string>& clipFiles);

} // namespace supple::tools
