// What a program asks of the operating system beyond what the standard library has. A file for POSIX and one for
// Windows; nothing else asks which of them it is. Text is UTF-8.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace supple::host {

/// The arguments of main behind the program's name.
[[nodiscard]] std::vector<std::string> utf8Arguments(int argc, char** argv);

/// As long as this lives, stdout and stderr behave alike everywhere: bytes go out as they are, a full pipe is waited
/// for, a closed one is an error of the write rather than the end of the program, and a terminal knows UTF-8 and escape
/// sequences.
class StandardStreams {
public:
    StandardStreams();
    ~StandardStreams();
    StandardStreams(const StandardStreams&) = delete;
    StandardStreams& operator=(const StandardStreams&) = delete;

private:
    long outputState_ = -1; ///< to be restored; -1: nothing
    long errorState_ = -1;
};

[[nodiscard]] bool isTerminal(std::FILE* stream);

[[nodiscard]] unsigned long processId();

/// Empty if the file or folder may be written to, else the reason.
[[nodiscard]] std::string whyNotWritable(const std::filesystem::path& path);

/// The file that this program runs from.
[[nodiscard]] Result<std::string> ownExecutable();

/// Runs a command, looked up as a shell would, with these arguments and without its stdout. An error if it cannot be
/// run, is not done after so many seconds (then it is ended), is ended by a signal, or ends with another exit code than
/// 0.
[[nodiscard]] Status runCommand(const std::string& command, const std::vector<std::string>& arguments,
                                uint32_t timeout);

/// Sets a variable of the environment for libraries that are loaded later, unless the user has.
void setEnvironmentDefault(const char* name, const char* value);

/// Where programs keep what may be lost, such as lists of recent files. Empty: the user has no such folder.
[[nodiscard]] std::filesystem::path stateFolder();

[[nodiscard]] std::string cpuName();

} // namespace supple::host
