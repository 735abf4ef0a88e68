#include "host/operating_system.h"

#include "base/utf8_path.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace supple::host {
namespace {

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
                         command + ": not done after " + std::to_string(timeout) + " s, the limit, and ended"};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

/// Others may have made the pipe that is stdout or stderr non-blocking, as some terminals and runtimes do to all that
/// share it. Then it refuses what its reader has left no room for: what is printed would end after 64 KiB. Returns the
/// flags to be restored, or -1 if it blocks already.
int makeBlocking(int stream) {
    const int flags = fcntl(stream, F_GETFL);
    if (flags == -1 || (flags & O_NONBLOCK) == 0) {
        return -1;
    }
    (void)fcntl(stream, F_SETFL, flags & ~O_NONBLOCK);
    return flags;
}

void restoreFlags(int stream, long flags) {
    if (flags != -1) {
        (void)fcntl(stream, F_SETFL, static_cast<int>(flags));
    }
}

} // namespace

std::vector<std::string> utf8Arguments(int argc, char** argv) {
    return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

StandardStreams::StandardStreams() {
    std::signal(SIGPIPE, SIG_IGN);
    outputState_ = makeBlocking(STDOUT_FILENO);
    errorState_ = makeBlocking(STDERR_FILENO);
}

StandardStreams::~StandardStreams() {
    restoreFlags(STDOUT_FILENO, outputState_);
    restoreFlags(STDERR_FILENO, errorState_);
}

bool isTerminal(std::FILE* stream) {
    return isatty(fileno(stream)) != 0;
}

unsigned long processId() {
    return static_cast<unsigned long>(getpid());
}

std::string whyNotWritable(const std::filesystem::path& path) {
    return access(path.c_str(), W_OK) == 0 ? "" : std::strerror(errno);
}

Result<std::string> ownExecutable() {
    std::error_code failed;
    const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", failed);
    if (failed) {
        return Error{ErrorCode::asset, "this command does not find its own file"};
    }
    return utf8Text(path);
}

Status runCommand(const std::string& command, const std::vector<std::string>& arguments, uint32_t timeout) {
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), command);
    std::vector<char*> pointers;
    for (std::string& argument : all) {
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

void setEnvironmentDefault(const char* name, const char* value) {
    setenv(name, value, 0);
}

std::filesystem::path stateFolder() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && std::filesystem::path(state).is_absolute())
        return state;
    const char* const home = std::getenv("HOME");
    return home != nullptr && *home != '\0' ? std::filesystem::path(home) / ".local" / "state"
                                            : std::filesystem::path();
}

std::string cpuName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

} // namespace supple::host
