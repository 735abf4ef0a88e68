// --record and supple replay as a user runs them.
#include "tests/tools/command_runner.h"

#include <cstring>

namespace {

using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

const std::string kToRecord = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";

class Replay : public supple::test::CommandTest {
protected:
    void record() {
        const Outcome outcome = runOnDevice("bake '" + kToRecord +
                                            "' --scheme pm --rate 2 --clip walk --time 0.40625 -o pip.obj "
                                            "--record pip.supprec");
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    /// Another time of the clip.
    void change() {
        std::string bytes = readText(file("pip.supprec"));
        const double time = 0.40625, later = 0.5;
        const size_t found = bytes.find(std::string(reinterpret_cast<const char*>(&time), sizeof(time)));
        ASSERT_NE(found, std::string::npos);
        std::memcpy(bytes.data() + found, &later, sizeof(later));
        writeText(file("pip.supprec"), bytes);
    }
};

TEST_F(Replay, ComparesWhatWasRecorded) {
    record();
    for (const std::string mapping : {"", " --mapping wide"}) {
        const Outcome outcome = runOnDevice("replay pip.supprec" + mapping);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("3 hashes were compared, 0 differ"), std::string::npos) << outcome.out;
    }
    const Outcome hashes = runOnDevice("replay pip.supprec --hash --until 1");
    EXPECT_EQ(hashes.exitCode, 0);
    EXPECT_EQ(hashes.err, "");
    for (const char* stage : {"joint palettes", "deformed cages", "surface vertices"}) {
        EXPECT_NE(hashes.out.find(stage), std::string::npos) << hashes.out;
    }
    // Those of bake's own.
    const Outcome baked =
        runOnDevice("bake '" + kToRecord + "' --scheme pm --rate 2 --clip walk --time 0.40625 --hash");
    const std::string palette = baked.out.substr(baked.out.find("palette ") + 8, 16);
    EXPECT_NE(hashes.out.find("frame 1: " + palette), std::string::npos) << hashes.out << baked.out;
}

TEST_F(Replay, NamesTheFirstStageThatDiffers) {
    record();
    change();
    const Outcome outcome = runOnDevice("replay pip.supprec");
    EXPECT_EQ(outcome.exitCode, 4);
    EXPECT_NE(outcome.out.find("3 hashes were compared, 3 differ"), std::string::npos) << outcome.out;
    EXPECT_TRUE(outcome.err.starts_with("supple: frame 1, group 0 (")) << outcome.err;
    EXPECT_NE(outcome.err.find("pip.glb): joint palettes are "), std::string::npos) << outcome.err;
}

TEST_F(Replay, ReadsWhatIsWhole) {
    record();
    const std::string bytes = readText(file("pip.supprec"));
    writeText(file("cut.supprec"), bytes.substr(0, bytes.size() - 20));
    const Outcome cut = runOnDevice("replay cut.supprec");
    EXPECT_EQ(cut.exitCode, 0);
    EXPECT_NE(cut.err.find("the recording has no end"), std::string::npos) << cut.err;
    EXPECT_NE(cut.out.find("3 hashes were compared, 0 differ"), std::string::npos) << cut.out;
    writeText(file("no.supprec"), "no recording at all");
    expectFailure(run("replay no.supprec"), 1, "no.supprec: no recording");
    expectFailure(run("replay absent.supprec"), 1, "absent.supprec");
    std::string other = bytes;
    other[16] = 9; // behind the chunk's head and the magic
    writeText(file("other.supprec"), other);
    expectFailure(run("replay other.supprec"), 1, "a recording of version 9; this library reads versions 2 to 4");
}

} // namespace
