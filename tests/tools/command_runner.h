// Runs the built supple command as a user would, in a folder of the test's own.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace supple::test {

inline constexpr const char* kCubeObj =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

struct Outcome {
    int exitCode = -1;
    std::string out;
    std::string err;
};

inline std::string readText(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

inline bool validationWanted() {
    const char* value = std::getenv("SUPPLE_VALIDATION");
    return value != nullptr && std::string(value) != "0";
}

class CommandTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("supple_cli_" + std::string(test->name()) + "_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// Runs "supple arguments" in the test's own folder.
    Outcome run(const std::string& arguments) {
        return runProgram("'" + std::string(SUPPLE_COMMAND) + "' " + arguments);
    }
    /// The same with the validation layer where the environment asks for it.
    Outcome runOnDevice(const std::string& arguments) {
        return run(arguments + (validationWanted() ? " --validate" : ""));
    }
    Outcome runProgram(const std::string& commandLine) {
        const std::string command =
            "cd '" + folder_.string() + "' && " + commandLine + " >stdout.txt 2>stderr.txt </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(folder_ / "stdout.txt"),
                readText(folder_ / "stderr.txt")};
    }
    static void expectFailure(const Outcome& outcome, int exitCode, const std::string& said) {
        EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }

private:
    std::filesystem::path folder_;
};

} // namespace supple::test
