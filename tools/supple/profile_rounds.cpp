#include "tools/supple/profile_rounds.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

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

/// Waits for a child; one that takes longer is killed. What waitpid tells of its end.
Result<int> endOf(pid_t child, const std::string& command, uint32_t timeout) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(timeout);
    int status = 0;
    for (;;) {
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) {
            return status;
        }
        if (ended < 0 && errno != EINTR) {
            return Error{ErrorCode::asset, command + ": its end was not seen"};
        }
        if (std::chrono::steady_clock::now() >= last) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return Error{ErrorCode::asset,
                         command + ": not done after " + std::to_string(timeout) + " s (--timeout), and ended"};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

Status runCommand(const std::string& command, std::vector<std::string> arguments, uint32_t timeout) {
    std::vector<char*> pointers;
    arguments.insert(arguments.begin(), command);
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = posix_spawnp(&child, command.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        return Error{ErrorCode::asset, command + ": cannot be run"};
    }
    const Result<int> status = endOf(child, command, timeout);
    if (!status) {
        return status.error();
    }
    if (WIFSIGNALED(*status)) {
        return Error{ErrorCode::asset, command + ": ended by signal " + std::to_string(WTERMSIG(*status))};
    }
    if (WEXITSTATUS(*status) != 0) {
        return Error{ErrorCode::asset,
                     command + ": failed with these arguments, exit code " + std::to_string(WEXITSTATUS(*status))};
    }
    return success();
}

/// A folder of this process, removed with it.
class Scratch {
public:
    Scratch() : path_(std::filesystem::temp_directory_path() / ("supple_rounds_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string file() const { return (path_ / "round.json").string(); }

private:
    std::filesystem::path path_;
};

Status measure(const std::string& command, const std::vector<std::string>& arguments, uint32_t timeout,
               const Scratch& scratch, std::vector<MeasuredRun>& runs) {
    if (Status status = runCommand(command, arguments, timeout); !status) {
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
    arguments.insert(arguments.end(), {"--frames", std::to_string(options.frames), "--json", scratch.file()});
    std::error_code failed;
    const std::string own = std::filesystem::read_symlink("/proc/self/exe", failed).string();
    if (failed) {
        return Error{ErrorCode::asset, "--against: this command does not find its own file"};
    }
    const auto endLine = [] {
        if (isatty(STDERR_FILENO) != 0) {
            std::fprintf(stderr, "\n");
        }
    };
    MeasuredPair pair;
    for (uint32_t round = 0; round < options.rounds; ++round) {
        if (isatty(STDERR_FILENO) != 0) {
            std::fprintf(stderr, "\rround %u of %u", round + 1, options.rounds);
        }
        for (const bool second : {false, true}) {
            const bool before = (round % 2 == 0) != second;
            const Status status = before ? measure(options.against, arguments, options.timeout, scratch, pair.before)
                                         : measure(own, arguments, options.timeout, scratch, pair.after);
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
