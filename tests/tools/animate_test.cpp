// supple animate, and pictures with alpha: the command itself.
#include "host/picture.h"
#include "tests/tools/command_runner.h"

#include <filesystem>

namespace supple::test {
namespace {

namespace fs = std::filesystem;

class Animate : public CommandTest {
protected:
    void SetUp() override {
        CommandTest::SetUp();
        writeText(file("cube.obj"), kCubeObj);
    }
    host::Picture read(const std::string& name) {
        Result<host::Picture> picture = host::readPng(file(name).string());
        EXPECT_TRUE(picture.ok()) << picture.error().message;
        return picture ? *picture : host::Picture{};
    }
};

TEST_F(Animate, APictureAFrame) {
    const Outcome outcome =
        runOnDevice("animate cube.obj -o f_##.png --seconds 0.3 --fps 10 --turn 90 --size 40x40 --rate 2");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const host::Picture first = read("f_00.png");
    EXPECT_EQ(first.width, 40u);
    EXPECT_NE(first.rgba, read("f_01.png").rgba) << "the camera turns";
    EXPECT_TRUE(fs::exists(file("f_02.png")));
    EXPECT_FALSE(fs::exists(file("f_03.png")));
}

TEST_F(Animate, AnAnimatedWebp) {
    const Outcome outcome =
        runOnDevice("animate cube.obj -o a.webp --seconds 0.2 --fps 10 --turn 90 --size 40x40 --rate 2");
    if (outcome.err.find("built without libwebp") != std::string::npos) {
        GTEST_SKIP() << "left out: supple was built without libwebp";
    }
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::string bytes = readText(file("a.webp"));
    EXPECT_EQ(bytes.substr(0, 4), "RIFF");
    EXPECT_EQ(bytes.substr(8, 4), "WEBP");
    size_t frames = 0;
    for (size_t at = bytes.find("ANMF"); at != std::string::npos; at = bytes.find("ANMF", at + 4)) {
        ++frames;
    }
    EXPECT_EQ(frames, 2u);
}

TEST_F(Animate, NamesThatHoldNoAnimationAreRefused) {
    expectFailure(run("animate cube.obj -o one.png"), 2, "put #### where their numbers go");
    expectFailure(run("animate cube.obj -o one.gif"), 2, "neither .webp nor .png");
    expectFailure(run("animate cube.obj -o nowhere/f_##.png"), 1, "there is no folder nowhere");
}

/// Nothing behind the figure, the figure itself solid, its shadow in between.
TEST_F(Animate, AlphaIsWhatIsSeenThrough) {
    ASSERT_EQ(runOnDevice("render cube.obj -o a.png --alpha --size 80x80 --rate 2").exitCode, 0);
    ASSERT_EQ(runOnDevice("render cube.obj -o b.png --alpha --no-ground --size 80x80 --rate 2").exitCode, 0);
    ASSERT_EQ(runOnDevice("render cube.obj -o c.png --size 80x80 --rate 2").exitCode, 0);
    const host::Picture shadowed = read("a.png"), bare = read("b.png"), whole = read("c.png");
    EXPECT_EQ(bare.pixel(0, 0)[3], 0);
    EXPECT_EQ(bare.pixel(40, 40)[3], 255);
    EXPECT_EQ(whole.pixel(0, 0)[3], 255);
    size_t between = 0;
    for (size_t i = 3; i < shadowed.rgba.size(); i += 4) {
        between += shadowed.rgba[i] > 40 && bare.rgba[i] == 0 ? 1u : 0u;
    }
    EXPECT_GT(between, 100u) << "a shadow on the floor";
    for (size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(bare.pixel(40, 40)[channel], whole.pixel(40, 40)[channel], 2);
    }
}

/// How much a joint moves a vertex is the same picture however the joint is named; another joint makes another one.
TEST_F(Animate, WeightsOfAJoint) {
    const std::string pip = std::string("'") + SUPPLE_SAMPLE_ASSETS + "/pip.glb'";
    const std::string rest = " --view weights --size 60x60 --rate 2 --no-ground ";
    ASSERT_EQ(runOnDevice("render " + pip + rest + "-o first.png --joint 5").exitCode, 0);
    ASSERT_EQ(runOnDevice("render " + pip + rest + "-o other.png --joint 20").exitCode, 0);
    EXPECT_NE(read("first.png").rgba, read("other.png").rgba);
    expectFailure(run("render " + pip + rest + "-o none.png --joint nobody"), 1, "no joint \"nobody\"");
}

} // namespace
} // namespace supple::test
