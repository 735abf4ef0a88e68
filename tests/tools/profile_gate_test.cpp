// supple profile as a gate of a build server, and the page it writes: the command itself.
#include "tests/tools/command_runner.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace supple::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class ProfileGate : public CommandTest {
protected:
    void SetUp() override {
        CommandTest::SetUp();
        writeText(file("cube.obj"), kCubeObj);
    }
    /// Another build: this one, whose first dispatch runs twice.
    std::string slowBuild() {
        const std::string path = file("slow.sh").string();
        writeText(path, "#!/bin/sh\nLD_PRELOAD='" SUPPLE_SLOW_DISPATCH "' exec '" SUPPLE_COMMAND "' \"$@\"\n");
        chmod(path.c_str(), 0700);
        return "'" + path + "'";
    }
};

TEST_F(ProfileGate, ResultsKeepTheTimesOfTheirFrames) {
    ASSERT_EQ(runOnDevice("profile cube.obj --frames 9 --json p.json").exitCode, 0);
    const Json run = Json::parse(readText(file("p.json")))["runs"][0];
    EXPECT_EQ(run["samples"]["frameMs"].size(), 9u);
    EXPECT_EQ(run["samples"]["coveredMs"].size(), 9u);
    for (const Json& pass : run["passes"]) {
        const Json& times = run["samples"]["passMs"][pass["pass"].get<std::string>()];
        ASSERT_EQ(times.size(), 9u) << pass;
        EXPECT_LE(pass["gpuMs"]["min"], pass["gpuMs"]["p05"]);
        EXPECT_LE(pass["gpuMs"]["p25"], pass["gpuMs"]["median"]);
        EXPECT_LE(pass["gpuMs"]["median"], pass["gpuMs"]["p75"]);
    }
    EXPECT_LE(run["coveredMs"]["median"], run["frame"]["gpuMs"]["median"]);
}

/// What cannot be written is known before anything is measured: the file that is read does not even exist.
TEST_F(ProfileGate, OutputsAreCheckedBeforeTheWork) {
    expectFailure(run("profile none.obj --json out.txt --html ./out.txt"), 2, "--json and --html are the same file");
    const Outcome several = run("profile none.obj --json nowhere/p.json --csv . --html fine.html");
    EXPECT_EQ(several.exitCode, 1);
    EXPECT_NE(several.err.find("nowhere/p.json: cannot be written: there is no folder nowhere"), std::string::npos)
        << several.err;
    EXPECT_NE(several.err.find(".: cannot be written: is a folder"), std::string::npos) << several.err;
    EXPECT_EQ(several.err.find("none.obj"), std::string::npos) << several.err;
    expectFailure(run("render none.obj -o nowhere/p.png"), 1, "there is no folder nowhere");
}

TEST_F(ProfileGate, WhatASweepOverridesIsSaid) {
    expectFailure(run("profile cube.obj --rate 4 --sweep rate=2,8"), 2, "--rate: every run has a rate of --sweep");
    expectFailure(run("profile cube.obj --instances 4 --sweep instances=2,8"), 2, "--instances: every run");
}

TEST_F(ProfileGate, ABuildThatHangsIsEnded) {
    const std::string hung = file("hung.sh").string();
    writeText(hung, "#!/bin/sh\nexec sleep 600\n");
    chmod(hung.c_str(), 0700);
    expectFailure(run("profile cube.obj --frames 2 --timeout 1 --against '" + hung + "'"), 1, "not done after 1 s");
}

TEST_F(ProfileGate, TheOldNameOfASchemeLeadsToTheNewOne) {
    expectFailure(run("profile cube.obj --scheme exact"), 2, "exact is called catmull-clark now");
    expectFailure(run("profile cube.obj --part-scheme 0=exact"), 2, "it is called catmull-clark now");
}

TEST_F(ProfileGate, SweepsAndTheirPage) {
    const Outcome outcome = runOnDevice(
        "profile cube.obj --frames 5 --sweep rate=2,4 --sweep instances=1,3 --html p.html --json p.json --scheme pm");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json runs = Json::parse(readText(file("p.json")))["runs"];
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[0]["rate"], 2);
    EXPECT_EQ(runs[1]["rate"], 4);
    EXPECT_EQ(runs[2]["rate"], 8);
    EXPECT_EQ(runs[3]["instances"], 3);
    const std::string page = readText(file("p.html"));
    for (const char* part : {"over rate", "over instances", "data:image/png;base64,iVBORw0KGgo", "--sweep rate=2,4"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    for (const std::string bad : {"rate=65", "rate=", "speed=3", "instances=1,x", "rate"}) {
        expectFailure(run("profile cube.obj --sweep " + bad), 2, "--sweep");
    }
}

TEST_F(ProfileGate, LimitsEndWithExitCodeFour) {
    const Outcome over = runOnDevice("profile cube.obj --frames 5 --budget-ms 0.000001");
    EXPECT_EQ(over.exitCode, 4);
    EXPECT_NE(over.err.find("the budget is 0.000"), std::string::npos) << over.err;
    EXPECT_EQ(runOnDevice("profile cube.obj --frames 5 --budget-ms 100000").exitCode, 0);
}

TEST_F(ProfileGate, AnEarlierResultIsCompared) {
    ASSERT_EQ(runOnDevice("profile cube.obj --frames 20 --json old.json").exitCode, 0);
    // As if it had taken a thousandth of the time.
    Json old = Json::parse(readText(file("old.json")));
    for (Json* times : {&old["runs"][0]["samples"]["frameMs"], &old["runs"][0]["samples"]["passMs"]["evaluate"]}) {
        for (Json& time : *times) {
            time = 0.001 * time.get<double>();
        }
    }
    writeText(file("fast.json"), old.dump());
    const Outcome slower =
        runOnDevice("profile cube.obj --frames 20 --compare fast.json --fail-above 10 --json new.json");
    EXPECT_EQ(slower.exitCode, 4) << slower.err;
    EXPECT_NE(slower.err.find("evaluate is"), std::string::npos) << slower.err;
    EXPECT_NE(slower.out.find("SLOWER"), std::string::npos) << slower.out;
    const Json comparison = Json::parse(readText(file("new.json")))["comparison"];
    ASSERT_EQ(comparison.size(), 1u);
    EXPECT_EQ(comparison[0]["passes"].back()["pass"], "frame");
    EXPECT_EQ(comparison[0]["passes"].back()["significant"], true);

    const Outcome other = runOnDevice("profile cube.obj --frames 5 --rate 3 --compare fast.json --fail-above 10");
    EXPECT_EQ(other.exitCode, 1) << "a gate that compares nothing would always be open";
    EXPECT_NE(other.err.find("--fail-above: fast.json has none of these runs"), std::string::npos) << other.err;
    EXPECT_EQ(runOnDevice("profile cube.obj --frames 5 --rate 3 --compare fast.json").exitCode, 0);
    writeText(file("none.json"), "{}");
    expectFailure(run("profile cube.obj --compare none.json"), 1, "none.json: is not a result of supple profile");
    expectFailure(run("profile cube.obj --compare missing.json"), 1, "missing.json: cannot be read");
    expectFailure(run("profile cube.obj --compare ."), 1, ".: cannot be read");
}

TEST_F(ProfileGate, GatesThatCannotCloseAreRefused) {
    expectFailure(run("profile cube.obj --fail-above 5"), 2, "--fail-above");
    expectFailure(run("profile cube.obj --compare a.json --against ./b"), 2, "--against");
    expectFailure(run("profile cube.obj --against ./b --html p.html"), 2, "--against");
    expectFailure(run("profile cube.obj --against ./b --budget-ms 5"), 2, "--budget-ms");
    expectFailure(run("profile cube.obj --against ''"), 2, "--against");
    for (const std::string bad : {"0", "-1", "nan", "inf", "5x", "''"}) {
        expectFailure(run("profile cube.obj --budget-ms " + bad), 2, "--budget-ms");
    }
}

TEST_F(ProfileGate, AnotherBuildIsMeasuredInTurns) {
    // The other build is slower in one pass, so this one is faster there.
    const Outcome outcome = run("profile '" + std::string(SUPPLE_SAMPLE_ASSETS) +
                                "/pip_quads.glb' --scheme prep --rate 2 "
                                "--instances 4 --frames 20 --rounds 11 --against " +
                                slowBuild() + " --json p.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("11 rounds"), std::string::npos) << outcome.out;
    const Json passes = Json::parse(readText(file("p.json")))["comparison"][0]["passes"];
    const auto deform = std::find_if(passes.begin(), passes.end(), [](const Json& p) { return p["pass"] == "deform"; });
    ASSERT_NE(deform, passes.end()) << passes;
    EXPECT_LT((*deform)["change"], -0.2) << passes;
    expectFailure(run("profile cube.obj --against ./missing"), 1, "./missing: cannot be run");
}

} // namespace
} // namespace supple::test
