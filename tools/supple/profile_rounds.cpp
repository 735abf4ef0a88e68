#include "tools/supple/profile_rounds.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

namespace supple::tools {
namespace {

/// Options with a value that belong to this command alone.
constexpr std::string_view kOwn[] = {"--against",    "--rounds",    "--frames", "--json",  "--csv",
                                     "--trace",      "--html",      "--hashes", "--sweep", "--compare",
                                     "--fail-above", "--budget-ms", "--timeout"};

std::vector<std::string> sharedArguments(const std::vector<std::string>& arguments) {
    std::vector<std::string> shared;
    for (size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view argument = arguments[i];
        const std::string_view name = argument.substr(0, argument.find('='));
        if (std::find(std::begin(kOwn), std::end(kOwn), name) == std::end(kOwn)) {
            shared.push_back(arguments[i]);
        } else if (name == argument) {
            ++i; // its value
        }
    }
    return shared;
}

/// A folder of this process, removed with it.
class Scratch {
public:
    Scratch() : path_(std::filesystem::temp_directory_path() / ("supple_rounds_" + std::to_string(host::processId()))) {
        std::filesystem::create_directories(path_);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::filesystem::path file() const { return path_ / "round.json"; }

private:
    std::filesystem::path path_;
};

Status measure(const std::string& command, const std::vector<std::string>& arguments, uint32_t timeout,
               const Scratch& scratch, std::vector<MeasuredRun>& runs) {
    if (Status status = host::runCommand(command, arguments, timeout); !status) {
        return status;
    }
    std::ifstream file(scratch.file());
    const auto result = nlohmann::ordered_json::parse(file, nullptr, false);
    file.close();
    std::filesystem::remove(scratch.file()); // a command that writes nothing must not seem to have measured this
    Result<std::vector<MeasuredRun>> measured = measuredRuns(result, command);
    if (!measured) {
        return measured.error();
    }
    addRounds(runs, std::move(*measured));
    return success();
}

} // namespace

Result<MeasuredPair> measureInTurns(const RoundsOptions& options) {
    const Scratch scratch;
    std::vector<std::string> arguments = sharedArguments(options.arguments);
    arguments.insert(arguments.end(), {"--frames", std::to_string(options.frames), "--json", utf8Text(scratch.file())});
    const Result<std::string> own = host::ownExecutable();
    if (!own) {
        return Error{own.error().code, "--against: " + own.error().message};
    }
    const auto endLine = [] {
        if (host::isTerminal(stderr)) {
            std::fprintf(stderr, "\n");
        }
    };
    MeasuredPair pair;
    for (uint32_t round = 0; round < options.rounds; ++round) {
        if (host::isTerminal(stderr)) {
            std::fprintf(stderr, "\rround %u of %u", round + 1, options.rounds);
        }
        for (const bool second : {false, true}) {
            const bool before = (round % 2 == 0) != second;
            const Status status = before ? measure(options.against, arguments, options.timeout, scratch, pair.before)
                                         : measure(*own, arguments, options.timeout, scratch, pair.after);
            if (!status) {
                endLine();
                return status.error();
            }
        }
    }
    endLine();
    return pair;
}

} // namespace supple::tools
