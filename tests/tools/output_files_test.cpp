// What the command writes to, and what it leaves alone.
#include "tests/tools/command_runner.h"

#include <array>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>

namespace supple::test {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public CommandTest {
protected:
    void SetUp() override {
        CommandTest::SetUp();
        writeText(file("cube.obj"), kCubeObj);
    }
};

TEST_F(OutputFiles, NoInputIsWrittenOver) {
    for (const char* arguments :
         {"render cube.obj -o ./cube.obj", "sheet cube.obj -o cube.obj", "profile cube.obj --json cube.obj",
          "profile cube.obj --csv ./cube.obj", "profile cube.obj --trace cube.obj", "profile cube.obj --html cube.obj",
          "bake cube.obj -o out.obj --patches cube.obj"}) {
        expectFailure(run(arguments), 2, "cube.obj is the input itself");
        EXPECT_EQ(readText(file("cube.obj")), kCubeObj) << arguments;
    }
}

TEST_F(OutputFiles, SymbolicLinksAreNotFollowed) {
    writeText(file("precious"), "precious");
    for (const char* name : {"link.obj", "link.ply", "link.glb", "link.png", "link.json"}) {
        fs::create_symlink("precious", file(name));
    }
    for (const char* arguments :
         {"bake cube.obj --rate 2 -o link.obj", "bake cube.obj --rate 2 -o link.ply",
          "bake cube.obj --rate 2 -o link.glb", "render cube.obj --size 64x64 -o link.png",
          "sheet cube.obj --columns 1 --cell 32x32 -o link.png", "profile cube.obj --frames 2 --json link.json",
          "bake cube.obj --rate 2 --scheme pm -o out.obj --patches link.json",
          "bake cube.obj --rate 2 -o out.obj --record link.json"}) {
        expectFailure(runOnDevice(arguments), 1, "is a symbolic link");
        EXPECT_EQ(readText(file("precious")), "precious") << arguments;
    }
    expectFailure(run("convert cube.obj -o link.glb"), 1, "is a symbolic link");
    EXPECT_EQ(readText(file("precious")), "precious");
}

TEST_F(OutputFiles, AFullDiskLeavesNothingBehind) {
    writeText(file("out.obj"), "before");
    // A limit on the size of files stands for a disk that is full.
    for (const char* ending : {"obj", "ply", "glb"}) {
        const std::string out = std::string("out.") + ending;
        const Outcome outcome =
            runProgram("(trap '' XFSZ; ulimit -f 1; '" SUPPLE_COMMAND "' bake cube.obj --rate 32 -o " + out + ")");
        expectFailure(outcome, 1, out + ": cannot be written");
    }
    EXPECT_EQ(readText(file("out.obj")), "before");
    EXPECT_FALSE(fs::exists(file("out.ply")));
    for (const auto& entry : fs::directory_iterator(file("."))) {
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
    }
}

TEST_F(OutputFiles, AFullDiskUnderStdoutIsSaid) {
    for (const char* arguments : {"inspect cube.obj", "inspect cube.obj --json", "--help", "--version"}) {
        const Outcome outcome = runProgram("('" SUPPLE_COMMAND "' " + std::string(arguments) + " >/dev/full)");
        expectFailure(outcome, 1, "stdout: cannot be written");
    }
}

TEST_F(OutputFiles, AReaderWhoHasGoneIsSaid) {
    // The pipe's reader ends before the first byte. What stands in files is whole, or not there.
    for (const char* arguments : {"inspect cube.obj", "sheet cube.obj --columns 1 --cell 32x32 -o out.png"}) {
        const Outcome outcome = runProgram("bash -c \"(sleep 1; exec '" SUPPLE_COMMAND "' " + std::string(arguments) +
                                           ") | true; exit \\${PIPESTATUS[0]}\"");
        expectFailure(outcome, 1, "stdout: cannot be written");
    }
    EXPECT_EQ(readText(file("out.png")).substr(1, 3), "PNG");
    for (const auto& entry : fs::directory_iterator(file("."))) {
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
    }
}

/// A process that shares the pipe may have made it non-blocking. Here it has room for a page, and its reader is slow.
TEST_F(OutputFiles, APipeThatDoesNotBlockIsWaitedFor) {
    constexpr const char* kWren = SUPPLE_SAMPLE_ASSETS "/wren.glb";
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    ASSERT_GT(fcntl(ends[1], F_SETPIPE_SZ, 4096), 0);
    ASSERT_EQ(fcntl(ends[1], F_SETFL, O_NONBLOCK), 0);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        execl(SUPPLE_COMMAND, "supple", "inspect", kWren, "--json", nullptr);
        _exit(127);
    }
    close(ends[1]);
    std::string out;
    for (char byte = 0; read(ends[0], &byte, 1) == 1;) {
        out.push_back(byte);
    }
    close(ends[0]);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_GT(out.size(), 3u * 4096);
    EXPECT_TRUE(out == run("inspect '" + std::string(kWren) + "' --json").out);
}

TEST_F(OutputFiles, DevicesAreWrittenToAsTheyAre) {
    const Outcome outcome = runOnDevice("profile cube.obj --frames 2 --json /dev/null");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFiles, APoseBeyondFloatsIsRefused) {
    // Five nodes, which a clip makes a billion times as large as the one above each.
    std::string nodes, channels;
    for (int i = 0; i < 5; ++i) {
        nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
        channels += (i == 0 ? "" : ",") + std::string(R"({"sampler":0,"target":{"path":"scale","node":)") +
                    std::to_string(i) + "}}";
    }
    writeText(file("huge.gltf"),
              R"({"asset":{"version":"2.0"},"nodes":[)" + nodes +
                  R"({"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"animations":[{"samplers":)"
                  R"([{"input":1,"output":2}],"channels":[)" +
                  channels +
                  R"(]}],"buffers":[{"byteLength":52,"uri":"huge.bin"}],"bufferViews":[{"buffer":0,"byteLength":52}],)"
                  R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                  R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":1,"type":"SCALAR"},)"
                  R"({"bufferView":0,"byteOffset":40,"componentType":5126,"count":1,"type":"VEC3"}]})");
    const float floats[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1e9f, 1e9f, 1e9f};
    writeText(file("huge.bin"), std::string(reinterpret_cast<const char*>(floats), sizeof floats));
    expectFailure(run("bake huge.gltf -o out.obj --rate 1 --scheme pm --clip 0"), 1,
                  "huge.gltf: the pose moves cage vertex 0: not finite");
    EXPECT_FALSE(fs::exists(file("out.obj")));
}

} // namespace
} // namespace supple::test
