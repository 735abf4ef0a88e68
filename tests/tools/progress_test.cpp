// What supple tells a person at a terminal while it works, and nobody else.
#include "tests/tools/command_runner.h"

#include <array>
#include <pty.h>

namespace supple::test {
namespace {

class Progress : public CommandTest {
protected:
    /// What a terminal gets, stdout and stderr.
    std::string runAtTerminal(const std::string& arguments) {
        const std::string command =
            "cd '" + file("").string() + "' && '" + std::string(SUPPLE_COMMAND) + "' " + arguments;
        int terminal = -1;
        const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
        if (child == 0) {
            execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            _exit(127);
        }
        EXPECT_GT(child, 0);
        std::string told;
        std::array<char, 4096> bytes{};
        for (ssize_t count = 0; (count = read(terminal, bytes.data(), bytes.size())) > 0;) {
            told.append(bytes.data(), static_cast<size_t>(count));
        }
        int status = -1;
        EXPECT_EQ(waitpid(child, &status, 0), child);
        EXPECT_EQ(status, 0) << told;
        close(terminal);
        return told;
    }
};

TEST_F(Progress, IsOneLineOfTheTerminalAndThenWhatWasWritten) {
    writeText(file("cube.obj"), kCubeObj);
    const std::string told = runAtTerminal("bake cube.obj -o cube.ply --rate 2");
    size_t at = 0;
    for (const char* const said : {"reading cube.obj", "evaluating", "writing", "supple: wrote cube.ply, "}) {
        at = told.find(said, at);
        ASSERT_NE(at, std::string::npos) << said << " in " << told;
    }
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << "each takes the place of the one before: " << told;
    EXPECT_NE(told.find(" kB", at), std::string::npos) << told;
}

TEST_F(Progress, CountsFrames) {
    writeText(file("cube.obj"), kCubeObj);
    const std::string told = runAtTerminal("animate cube.obj -o f_##.png --size 32x32 --seconds 0.2 --fps 10 --rate 2");
    EXPECT_NE(told.find("drawing frames, 1 of 2"), std::string::npos) << told;
    EXPECT_NE(told.find("drawing frames, 2 of 2"), std::string::npos) << told;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
}

TEST_F(Progress, IsNotThereWithoutATerminal) {
    writeText(file("cube.obj"), kCubeObj);
    const Outcome outcome = runOnDevice("bake cube.obj -o cube.ply --rate 2");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
}

} // namespace
} // namespace supple::test
