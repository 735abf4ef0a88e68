#include "tools/supple/output_files.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

namespace supple::tools {

void checkOutputs(const std::vector<std::string>& inputs,
                  std::initializer_list<std::pair<const char*, std::string>> outputs) {
    for (const auto& [option, output] : outputs) {
        for (const std::string& input : inputs) {
            std::error_code ignored;
            if (!output.empty() && std::filesystem::equivalent(input, output, ignored)) {
                throw CLI::ValidationError(option, output + " is the input itself");
            }
        }
    }
}

std::vector<std::string> inputsOf(const std::string& file, const std::vector<std::string>& clipFiles) {
    std::vector<std::string> inputs = clipFiles;
    inputs.insert(inputs.begin(), file);
    return inputs;
}

} // namespace supple::tools
