// supple cook as a user runs it: what it writes is read by other commands, which then do the same as with the source.
#include "tests/tools/command_runner.h"

#include <nlohmann/json.hpp>

namespace {

using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

const std::string kToCook = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";

class Cook : public supple::test::CommandTest {};

TEST_F(Cook, OtherCommandsReadIt) {
    const Outcome outcome = run("cook '" + kToCook +
                                "' -o pip.supple --scheme catmull-clark,pm,blend,fragments --rate 4 --for grids "
                                "--clip-error 0");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("written pip.supple, ")) << outcome.out;
    EXPECT_EQ(outcome.err, "");
    for (const std::string scheme : {"catmull-clark", "pm", "blend", "fragments"}) {
        const std::string rest = " --scheme " + scheme + " --rate 4 --clip walk --time 0.4";
        ASSERT_EQ(runOnDevice("bake pip.supple -o cooked.obj" + rest).exitCode, 0);
        ASSERT_EQ(runOnDevice("bake '" + kToCook + "' -o own.obj" + rest).exitCode, 0);
        EXPECT_TRUE(readText(file("cooked.obj")) == readText(file("own.obj"))) << scheme;
    }
    // What is asked for is what is in it.
    const auto sizeOf = [&](const std::string& what) {
        EXPECT_EQ(run("cook '" + kToCook + "' -o one.supple --for grids --mapping wide " + what).exitCode, 0) << what;
        return std::filesystem::file_size(file("one.supple"));
    };
    const auto exact = sizeOf("--scheme catmull-clark --rate 4");
    EXPECT_LT(sizeOf("--scheme pm --rate 4"), exact);
    EXPECT_GT(sizeOf("--scheme catmull-clark --rate 16"), exact);
    EXPECT_GT(sizeOf("--scheme catmull-clark --rate 4,16"), 3 * exact / 2);
    // Once more, from itself.
    ASSERT_EQ(run("cook pip.supple -o again.supple --scheme polygons --for meshes").exitCode, 0);
    EXPECT_EQ(run("inspect again.supple").exitCode, 0);
}

TEST_F(Cook, AnotherVersionIsToldHowToMakeItAnew) {
    ASSERT_EQ(run("cook '" + kToCook + "' -o pip.supple --scheme pm --for grids --parts-apart --scene 0").exitCode, 0);
    std::string bytes = readText(file("pip.supple"));
    bytes[8] = 77;
    writeText(file("pip.supple"), bytes);
    const Outcome outcome = run("inspect pip.supple");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.err,
              "supple: pip.supple: a cooked file of version 77, and this is version 15: make it anew: supple cook "
              "pip.glb -o pip.supple --scheme pm --rate 8 --for grids --mapping both --clip-error 0.0001 --parts-apart "
              "--scene 0\n");
}

TEST_F(Cook, ClipsArePackedAsCloselyAsIsAsked) {
    const auto cook = [&](const std::string& arguments) {
        EXPECT_EQ(run("cook '" + kToCook + "' -o pip.supple --scheme polygons " + arguments).exitCode, 0);
        return nlohmann::json::parse(run("inspect pip.supple --json").out)["clips"];
    };
    for (const auto& [arguments, error] : {std::pair("", 1e-4), std::pair("--clip-error 1e-3", 1e-3)}) {
        for (const auto& clip : cook(arguments)) {
            ASSERT_TRUE(clip.contains("packed")) << clip["name"];
            EXPECT_LE(clip["packed"]["error"], error);
            EXPECT_GT(clip["packed"]["ratio"], 5.0) << clip["name"];
        }
    }
    for (const auto& clip : cook("--coarse-clip-error 1e-2")) {
        EXPECT_LE(clip["packed"]["error"], 1e-4);
        EXPECT_LE(clip["packed"]["twin"]["error"], 1e-2);
        EXPECT_LT(clip["packed"]["twin"]["bytes"], clip["packed"]["segmentBytes"]);
    }
    EXPECT_NE(run("inspect pip.supple").out.find("coarse twin: "), std::string::npos);
    for (const auto& clip : cook("--clip-error 0")) {
        EXPECT_FALSE(clip.contains("packed"));
    }
    // The same is told of a file that is not cooked.
    const Outcome told = run("inspect '" + kToCook + "' --clip-error 1e-3");
    EXPECT_NE(told.out.find("packed: "), std::string::npos) << told.out;
    EXPECT_EQ(run("inspect '" + kToCook + "'").out.find("packed: "), std::string::npos);
    EXPECT_NE(run("inspect '" + kToCook + "' --clip-error 1e-4 --coarse-clip-error 1e-2").out.find("coarse twin: "),
              std::string::npos);
    for (const char* without : {"--coarse-clip-error 1e-2", "--clip-error 1e-2 --coarse-clip-error 1e-2"}) {
        const Outcome refused = run("inspect '" + kToCook + "' " + without);
        EXPECT_EQ(refused.exitCode, 2) << without;
        EXPECT_EQ(refused.err, "supple: --coarse-clip-error needs a --clip-error, and must be more than that\n");
    }
    // Clips that are packed already get no twin, and somebody says so.
    (void)cook("--clip-error 1e-4");
    const Outcome again = run("cook pip.supple -o again.supple --scheme polygons --coarse-clip-error 1e-2");
    EXPECT_EQ(again.exitCode, 0);
    EXPECT_NE(again.err.find("has no coarse twin: it is packed already"), std::string::npos) << again.err;
}

TEST_F(Cook, BadInputIsOneAndBadUsageTwo) {
    ASSERT_EQ(run("cook '" + kToCook + "' -o pip.supple --scheme pm --for grids").exitCode, 0);
    Outcome outcome = run("inspect pip.supple --pair-quads");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.err,
              "supple: pip.supple: it is cooked: its polygons, parts, scene, variant and clips were chosen then\n");
    writeText(file("half.supple"), readText(file("pip.supple")).substr(0, 4000));
    outcome = run("inspect half.supple");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(outcome.err.starts_with("supple: half.supple: a cooked file of ")) << outcome.err;
    EXPECT_EQ(run("cook '" + kToCook + "' -o none.supple --scheme prep").exitCode, 1); // it has triangles
    EXPECT_FALSE(std::filesystem::exists(file("none.supple")));
    for (const char* usage : {"cook", "cook x.glb", "cook x.glb -o y --scheme all", "cook x.glb -o y --rate 0",
                              "cook x.glb -o y --for crowds", "cook x.glb -o y --mapping auto",
                              "cook x.glb -o y --clip-error 1", "cook x.glb -o y --clip-error -1"}) {
        EXPECT_EQ(run(usage).exitCode, 2) << usage;
    }
}

} // namespace
