// supple inspect --compare: figures of known cages, a character in motion, and what it says where nothing can be done.
#include "tests/tools/command_runner.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace {

using Json = nlohmann::json;
using supple::test::kCubeObj;
using supple::test::Outcome;
using supple::test::writeText;

class Compare : public supple::test::CommandTest {
protected:
    Json comparisonOf(const std::string& arguments) {
        const Outcome outcome = runOnDevice("inspect --json --compare " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        const Json json = Json::parse(outcome.out, nullptr, false);
        EXPECT_TRUE(json.contains("comparison")) << outcome.out;
        return json.contains("comparison") ? json["comparison"] : Json();
    }
};

TEST_F(Compare, MemoryOfACubeByPurpose) {
    writeText(file("cube.obj"), kCubeObj);
    const Outcome outcome = runOnDevice("inspect --json --memory --rate 4 cube.obj");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false)["memory"];
    EXPECT_EQ(json["rate"], 4);
    EXPECT_GE(json["group"]["verticesBytes"], 6 * 25 * 16);
    EXPECT_EQ(json["asset"]["deviceLocalBytes"], json["asset"]["tablesBytes"]);
    EXPECT_EQ(json["asset"]["hostVisibleBytes"], 0) << "what tables were staged in is freed";
    uint64_t sum = 0;
    for (const auto& [name, value] : json["group"].items()) {
        sum += name == "allocations" || name.find("deviceLocal") == 0 || name.find("hostVisible") == 0
                   ? 0
                   : value.get<uint64_t>();
    }
    EXPECT_EQ(sum,
              json["group"]["deviceLocalBytes"].get<uint64_t>() + json["group"]["hostVisibleBytes"].get<uint64_t>());

    const Outcome text = runOnDevice("inspect --memory cube.obj");
    ASSERT_EQ(text.exitCode, 0) << text.err;
    EXPECT_NE(text.out.find("memory, asset      0."), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("one instance at rate 8"), std::string::npos) << text.out;
}

TEST_F(Compare, FiguresOfACube) {
    writeText(file("cube.obj"), kCubeObj);
    const Json json = comparisonOf("cube.obj");
    EXPECT_EQ(json["reference"], "catmull-clark");
    EXPECT_EQ(json["rate"], 8);
    EXPECT_TRUE(json["clip"].is_null());
    EXPECT_NEAR(json["extent"].get<double>(), 3.4641016, 1e-6);
    EXPECT_LT(json["measuringError"], 1e-5);
    ASSERT_EQ(json["schemes"].size(), 6u);
    // P_m as OpenSubdiv's limit surface gave it.
    const Json& pm = json["schemes"]["pm"];
    EXPECT_EQ(pm["samples"], 6 * 81);
    EXPECT_NEAR(pm["distance"]["max"].get<double>(), 3.3e-3, 0.15 * 3.3e-3);
    EXPECT_NEAR(pm["distance"]["mean"].get<double>(), 1.0e-3, 0.15 * 1.0e-3);
    EXPECT_NEAR(pm["normalDegrees"]["max"].get<double>(), 2.8, 0.15 * 2.8);
    EXPECT_NEAR(pm["normalDegrees"]["mean"].get<double>(), 1.3, 0.15 * 1.3);
    EXPECT_NEAR(pm["distanceInUnits"]["max"].get<double>(),
                pm["distance"]["max"].get<double>() * json["extent"].get<double>(), 1e-12);
    const Json& prep = json["schemes"]["prep"];
    EXPECT_GT(prep["distance"]["max"], 1e-3);
    EXPECT_LT(prep["distance"]["max"], 1e-2);
    for (const auto& [scheme, samples] : {std::pair("catmull-clark", 6 * 81), std::pair("fragments", 24 * 25)}) {
        const Json& same = json["schemes"][scheme];
        EXPECT_EQ(same["samples"], samples) << scheme;
        EXPECT_LT(same["distance"]["max"], 3e-7) << scheme;
        EXPECT_LT(same["normalDegrees"]["max"], 1e-3) << scheme;
    }
    const Json& loop = json["schemes"]["loop"];
    EXPECT_GT(loop["distance"]["max"], 1e-2) << "another surface";
    EXPECT_GT(json["schemes"]["blend"]["distance"]["max"], 5e-2) << "it passes through the cage's vertices";
    EXPECT_NE(loop["notes"].dump().find("6 faces"), std::string::npos);

    const Outcome text = runOnDevice("inspect --compare --rate 2 cube.obj");
    ASSERT_EQ(text.exitCode, 0) << text.err;
    EXPECT_NE(text.out.find("bind pose, rate 2"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("loop: another surface"), std::string::npos) << text.out;
}

TEST_F(Compare, ACharacterInMotion) {
    const std::string pip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb";
    const Json json = comparisonOf("--rate 4 --clip walk --time 0.55 '" + pip + "'");
    EXPECT_EQ(json["clip"], "walk");
    EXPECT_LT(json["measuringError"], 1e-5);
    const Json& schemes = json["schemes"];
    for (const char* scheme : {"pm", "prep"}) {
        EXPECT_GT(schemes[scheme]["distance"]["mean"], 1e-6) << scheme;
        EXPECT_LT(schemes[scheme]["distance"]["mean"], 1e-4) << scheme;
        EXPECT_LT(schemes[scheme]["distance"]["max"], 3e-3) << scheme;
        EXPECT_LT(schemes[scheme]["normalDegrees"]["mean"], 1.5) << scheme;
    }
    for (const char* scheme : {"catmull-clark", "fragments"}) {
        EXPECT_LT(schemes[scheme]["distance"]["max"], 5e-7) << scheme;
        EXPECT_LT(schemes[scheme]["normalDegrees"]["mean"], 1e-3) << scheme;
    }
    EXPECT_GT(schemes["loop"]["distance"]["mean"], schemes["pm"]["distance"]["mean"]);
    // The pose counts: another time gives other figures.
    const Json other = comparisonOf("--rate 4 --clip walk --time 1.1 '" + pip + "'");
    EXPECT_NE(other["schemes"]["pm"]["distance"], schemes["pm"]["distance"]);
}

TEST_F(Compare, RefusedSchemesSayWhy) {
    writeText(file("prism.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 0 1 2\n"
                                 "f 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n");
    const Json json = comparisonOf("prism.obj");
    EXPECT_EQ(json["schemes"]["prep"]["accepted"], false);
    EXPECT_NE(json["schemes"]["prep"]["reason"].get<std::string>().find("3 sides"), std::string::npos);
    EXPECT_LT(json["schemes"]["catmull-clark"]["distance"]["max"], 3e-7);
    EXPECT_LT(json["schemes"]["fragments"]["distance"]["max"], 3e-7);
    const Outcome text = runOnDevice("inspect --compare prism.obj");
    EXPECT_NE(text.out.find("refused: prism.obj: p-rep takes quads only: "), std::string::npos) << text.out;
}

TEST_F(Compare, WhatNoSchemeTakesIsAnError) {
    writeText(file("hole.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt hole 1/0/0 0\n");
    EXPECT_EQ(run("inspect hole.obj").exitCode, 0) << "without --compare it is looked into all the same";
    expectFailure(runOnDevice("inspect --compare hole.obj"), 1, "hole.obj: every face is a hole");
    expectFailure(runOnDevice("inspect --compare hole.obj"), 1, "no scheme takes it");
    writeText(file("cube.obj"), kCubeObj);
    expectFailure(run("inspect --compare --clip Run cube.obj"), 1, "no clip");
    expectFailure(run("inspect --compare --device none-such cube.obj"), 3, "none-such");
}

} // namespace
