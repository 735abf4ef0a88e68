// What the subcommands share: exit codes and the one way to report a failure.
#pragma once

#include "base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace supple::tools {

enum ExitCode : int {
    kExitOk = 0,
    kExitBadInput = 1, ///< a file, a character or a value inside one; also everything that fails while running
    kExitUsage = 2,    ///< the command line itself
    kExitNoDevice = 3, ///< no device, none of that name, or it lacks something Supple needs
    kExitGate = 4,     ///< a measurement is above what the command line allows
};

/// Prints "supple: reason" on stderr, once for each line of the reason, and returns `code`.
int fail(ExitCode code, std::string_view reason);

/// The same for an Error; ErrorCode::unsupported becomes kExitNoDevice.
int fail(const Error& error);

/// Prints "supple: text" as one line on stdout.
void note(std::string_view text);

/// Prints "supple: warning: text" as one line on stderr.
void warn(std::string_view text);

/// `text` as cage::oneLine() has it, so that names from files cannot break a line, turn it round or drive a terminal.
std::string printable(std::string_view text);

// One function a subcommand: adds it to the command line. When it is chosen it runs during parsing and leaves its exit
// code in `exitCode`.
void bindInspect(CLI::App& app, int& exitCode);
void bindBake(CLI::App& app, int& exitCode);
void bindRender(CLI::App& app, int& exitCode);
void bindAnimate(CLI::App& app, int& exitCode);
void bindSheet(CLI::App& app, int& exitCode);
void bindGallery(CLI::App& app, int& exitCode);
/// `arguments`: of the command line, which it hands on to another build.
void bindProfile(CLI::App& app, int& exitCode, const std::vector<std::string>& arguments);
void bindBench(CLI::App& app, int& exitCode);
void bindView(CLI::App& app, int& exitCode);
void bindConvert(CLI::App& app, int& exitCode);
void bindCook(CLI::App& app, int& exitCode);
void bindPoints(CLI::App& app, int& exitCode);
void bindPick(CLI::App& app, int& exitCode);
void bindReplay(CLI::App& app, int& exitCode);

} // namespace supple::tools
