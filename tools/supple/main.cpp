// The supple command: binds the subcommands and turns every way out into one of the documented exit codes.
#include "tools/supple/command.h"

#include "host/operating_system.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <supple/supple.h>
#include <system_error>
#include <vector>

namespace {

/// The deepest subcommand that was named, for "see supple bake --help".
std::string helpCommand(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "supple --help" : "supple " + chosen.front()->get_name() + " --help";
}

/// `arguments`: behind the program's name.
int run(const std::vector<std::string>& arguments) {
    using namespace supple::tools;
    CLI::App app{"Animated control cages to smooth surfaces on Vulkan compute.", "supple"};
    app.require_subcommand(1);
    app.allow_windows_style_options(false); // "/hero.glb" is a path on Windows as well
    app.set_version_flag("--version", std::to_string(SUPPLE_VERSION_MAJOR) + "." +
                                          std::to_string(SUPPLE_VERSION_MINOR) + "." +
                                          std::to_string(SUPPLE_VERSION_PATCH));
    app.footer("Exit codes: 0 ok, 1 bad input, 2 bad usage, 3 no suitable device; 4 above a limit of "
               "profile --fail-above or --budget-ms, or replayed hashes differ.");

    int exitCode = kExitOk;
    bindInspect(app, exitCode);
    bindBake(app, exitCode);
    bindRender(app, exitCode);
    bindAnimate(app, exitCode);
    bindSheet(app, exitCode);
    bindGallery(app, exitCode);
    bindProfile(app, exitCode, arguments);
    bindBench(app, exitCode);
    bindView(app, exitCode);
    bindConvert(app, exitCode);
    bindCook(app, exitCode);
    bindPoints(app, exitCode);
    bindPick(app, exitCode);
    bindReplay(app, exitCode);

    try {
        // The last one first, as CLI11 wants them.
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            app.exit(error); // --help and --version end this way
            return kExitOk;
        }
        return fail(kExitUsage, std::string(error.what()) + " (see " + helpCommand(app) + ")");
    }
    return exitCode;
}

/// Flushes what was printed. A full disk or a reader that has gone is a failure, if there is no other.
int endOutput(int exitCode) {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
        return exitCode;
    const std::string why = errno != 0 ? ": " + std::generic_category().message(errno) : "";
    const int own = supple::tools::fail(supple::tools::kExitBadInput, "stdout: cannot be written" + why);
    return exitCode == supple::tools::kExitOk ? own : exitCode;
}

} // namespace

int main(int argc, char** argv) {
    // So that no file is left half written.
    const supple::host::StandardStreams streams;
    try {
        return endOutput(run(supple::host::utf8Arguments(argc, argv)));
    } catch (const std::bad_alloc&) {
        return supple::tools::fail(supple::tools::kExitBadInput, "out of memory");
    } catch (const std::exception& error) {
        return supple::tools::fail(supple::tools::kExitBadInput, error.what());
    }
}
