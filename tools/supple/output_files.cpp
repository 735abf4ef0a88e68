#include "tools/supple/output_files.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"
#include "host/whole_file.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

namespace supple::tools {

namespace {

namespace fs = std::filesystem;

/// Also of a file that is not there yet.
fs::path wholePath(const std::string& path, std::error_code& failed) {
    const fs::path absolute = fs::absolute(utf8Path(path), failed);
    return failed ? absolute : fs::weakly_canonical(absolute, failed);
}

std::string whyNotWritable(const std::string& text) {
    std::error_code unknown;
    const fs::path path = utf8Path(text);
    if (fs::is_directory(path, unknown))
        return "is a folder";
    if (host::isRefusedLink(text))
        return "is a symbolic link";
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::exists(folder, unknown))
        return "there is no folder " + utf8Text(folder);
    if (!fs::is_directory(folder, unknown))
        return utf8Text(folder) + " is no folder";
    // A file that is there is written over; one that is not is made.
    return host::whyNotWritable(fs::exists(path, unknown) ? path : folder);
}

} // namespace

void checkOutputs(const std::vector<std::string>& inputs, const std::vector<OutputPath>& outputs) {
    for (const auto& [option, output] : outputs) {
        for (const std::string& input : inputs) {
            std::error_code ignored;
            if (!output.empty() && fs::equivalent(utf8Path(input), utf8Path(output), ignored)) {
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

std::string sameOutputs(std::span<const OutputPath> outputs) {
    for (size_t i = 0; i < outputs.size(); ++i) {
        for (size_t k = i + 1; k < outputs.size(); ++k) {
            if (outputs[i].path.empty() || outputs[k].path.empty())
                continue;
            std::error_code failed;
            const fs::path first = wholePath(outputs[i].path, failed);
            const fs::path second = wholePath(outputs[k].path, failed);
            if (outputs[i].path == outputs[k].path || (!failed && first == second))
                return std::string(outputs[i].option) + " and " + outputs[k].option +
                       " are the same file: " + outputs[k].path;
        }
    }
    return {};
}

Status canWrite(std::span<const OutputPath> outputs) {
    std::string faults;
    for (const OutputPath& output : outputs) {
        const std::string why = output.path.empty() ? "" : whyNotWritable(output.path);
        if (!why.empty())
            faults += (faults.empty() ? "" : "\n") + (output.path + ": cannot be written: " + why);
    }
    return faults.empty() ? success() : Status(Error{ErrorCode::io, faults});
}

} // namespace supple::tools
