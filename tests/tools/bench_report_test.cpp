// What supple bench makes of a result, on results made up here; and its yardsticks.
#include "tools/bench/avx2_evaluation.h"
#include "tools/bench/check.h"
#include "tools/bench/plain_evaluation.h"
#include "tools/bench/plot.h"
#include "tools/bench/report.h"
#include "tools/bench/targets.h"
#include "tools/bench/write_bandwidth.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace {

using namespace supple::bench;
using Json = nlohmann::ordered_json;

/// Two rates of one cage, two ratios each.
Json madeUp() {
    Json result = Json::parse(R"({
        "version": "0.1.0", "cpuDevice": true, "rounds": 3,
        "machine": {"device": "d", "driver": "r", "driverInfo": "i", "mapping": "auto", "cpu": "c", "threads": 2},
        "peers": {"AVX2": "by hand"}, "agreement": [{"what": "a & b", "difference": 1e-7, "bound": 1e-5}],
        "rows": [], "loading": [], "pipelines": [], "targets": []})");
    for (const int rate : {4, 8}) {
        Json row{{"cage", "sphere"}, {"faces", 1350}, {"rate", rate}, {"refused", Json::array()}};
        for (const char* name : {"prep evaluate", "prep frame", "AVX2 bi-3"}) {
            row["contestants"].push_back({{"name", name},
                                          {"points", 100},
                                          {"cpuNanosecondsPerPoint", 20.0},
                                          {"wallNanosecondsPerPoint", 10.0},
                                          {"gpuNanosecondsPerPoint", nullptr}});
        }
        const auto ratio = [&](const char* of, const char* over, bool yardstick, double median) {
            row["ratios"].push_back({{"name", std::string(of) + " / " + over},
                                     {"of", of},
                                     {"over", over},
                                     {"yardstick", yardstick},
                                     {"median", median},
                                     {"least", 0.9 * median},
                                     {"largest", 2.0 * median}});
        };
        ratio("prep evaluate", "AVX2 bi-3", true, 4.0);
        ratio("prep evaluate", "plain C++ bi-3", true, 1.0);
        ratio("prep frame", "prep evaluate", false, 1.3);
        result["rows"].push_back(row);
    }
    return result;
}

TEST(BenchCheck, TheSameResultPasses) {
    EXPECT_TRUE(findRegressions(madeUp(), madeUp()).empty());
}

TEST(BenchCheck, FifteenPercentIsTheLine) {
    Json now = madeUp();
    Json& ratios = now["rows"][1]["ratios"];
    ratios[0]["median"] = 4.0 * 1.16;
    ratios[1]["median"] = 1.0 * 1.149;
    EXPECT_TRUE(findRegressions(madeUp(), now).empty()) << "one yardstick alone had a good day";
    ratios[1]["median"] = 1.0 * 1.151;
    const std::vector<std::string> lines = findRegressions(madeUp(), now);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "sphere, rate 8: prep evaluate / plain C++ bi-3: 1.15, was 1 (+15 %)");
}

TEST(BenchCheck, AnImprovementPassesAndSoDoesWhatIsNew) {
    Json now = madeUp();
    Json& ratios = now["rows"][0]["ratios"];
    ratios[0]["median"] = 2.0;
    ratios[1]["median"] = 0.5;
    ratios[2]["median"] = 2.6; // the frame is what it was
    Json added = ratios[0];
    added["name"] = "loop evaluate / AVX2 bi-3";
    added["of"] = "loop evaluate";
    added["median"] = 90.0;
    ratios.push_back(added);
    EXPECT_TRUE(findRegressions(madeUp(), now).empty());
}

TEST(BenchCheck, WhatIsGoneIsNamed) {
    Json now = madeUp();
    now["rows"].erase(0);
    const std::vector<std::string> lines = findRegressions(madeUp(), now);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "sphere, rate 4: prep evaluate / AVX2 bi-3: not measured");
    EXPECT_EQ(lines[1], "sphere, rate 4: prep evaluate / plain C++ bi-3: not measured");
}

TEST(BenchCheck, ComparingNothingFails) {
    const std::string nothing = "nothing was compared";
    Json without = madeUp();
    without["rows"] = Json::array();
    const std::vector<std::string> empty = findRegressions(without, madeUp());
    ASSERT_EQ(empty.size(), 1u);
    EXPECT_EQ(empty[0].rfind(nothing, 0), 0u) << empty[0];
    without = madeUp();
    for (Json& row : without["rows"]) {
        for (Json& ratio : row["ratios"]) {
            ratio["yardstick"] = false;
        }
    }
    const std::vector<std::string> none = findRegressions(without, madeUp());
    ASSERT_EQ(none.size(), 1u);
    EXPECT_EQ(none[0], empty[0]);
    EXPECT_EQ(whyNoCheck(without, "d", "auto"), empty[0]);
}

TEST(BenchCheck, StoredResultsAreOfThisMachineAndComplete) {
    EXPECT_EQ(whyNoCheck(madeUp(), "d", "auto"), "");
    EXPECT_EQ(whyNoCheck(madeUp(), "e", "auto"), "it is of another device: d, not e");
    EXPECT_EQ(whyNoCheck(madeUp(), "d", "wide"), "it is of another mapping: auto, not wide");
    Json stored = madeUp();
    stored["complete"] = false;
    EXPECT_EQ(whyNoCheck(stored, "d", "auto"), "it is not complete: the run ended early");
}

TEST(BenchCheck, OtherSettingsAreSaid) {
    Json now = madeUp();
    now["quick"] = true;
    EXPECT_TRUE(otherSettings(madeUp(), now).empty()) << "an earlier version did not say";
    Json stored = madeUp();
    stored["quick"] = false;
    stored["rounds"] = 7;
    const std::vector<std::string> lines = otherSettings(stored, now);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "rounds: 7 in the stored result, 3 in this one");
    EXPECT_EQ(lines[1], "quick: false in the stored result, true in this one");
}

TEST(BenchCheck, FirstFramesAreForInformation) {
    const auto with = [](const char* use, double cold, double prepared) {
        Json result = madeUp();
        result["pipelines"].push_back({{"scheme", "pm"}, {"use", use}, {"coldFirstFrameMs", cold}});
        if (prepared > 0.0) { // an earlier version had none
            result["pipelines"][0]["preparedFirstFrameMs"] = prepared;
        }
        return result;
    };
    const std::vector<std::string> lines = firstFrames(with("", 700.0, 0.0), with("", 2000.0, 12.4));
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "pm: first frame: 2000 ms, was 700");
    EXPECT_EQ(lines[1], "pm: first frame after a warm-up: 12 ms");
    EXPECT_EQ(firstFrames(with("", 1.0, 2.0), with("in a view", 3.0, 0.0)),
              std::vector<std::string>{"pm, in a view: first frame: 3 ms"});
    EXPECT_TRUE(firstFrames(madeUp(), madeUp()).empty());
    EXPECT_TRUE(findRegressions(with("", 700.0, 1.0), with("", 2000.0, 9.0)).empty()) << "not judged";
}

TEST(BenchCheck, StaticDataMayGrowByFifteenPercent) {
    const auto with = [](double bytes) {
        Json result = madeUp();
        result["loading"].push_back({{"cage", "pip"}, {"scheme", "pm"}, {"staticBytesPerFace", bytes}});
        return result;
    };
    EXPECT_TRUE(findRegressions(with(100.0), with(114.0)).empty());
    EXPECT_TRUE(findRegressions(with(100.0), with(10.0)).empty());
    EXPECT_TRUE(findRegressions(with(100.0), madeUp()).empty()) << "not measured";
    const std::vector<std::string> lines = findRegressions(with(100.0), with(116.0));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "pip, pm: static device data, bytes a face: 116, was 100 (+16 %)");
}

TEST(BenchTargets, LimitsFollowTheRate) {
    Json result = madeUp();
    for (Json& row : result["rows"]) {
        const bool coarse = row["rate"] == 4;
        const auto add = [&](const char* name, double median) {
            Json ratio = row["ratios"][0];
            ratio["name"] = name;
            ratio["median"] = median;
            row["ratios"].push_back(ratio);
        };
        add("prep shared evaluate / AVX2 bi-3", coarse ? 3.9 : 4.1);
        add("pm shared evaluate / AVX2 bi-3", coarse ? 4.1 : 3.9);
        add("pm evaluate / OpenSubdiv CPU, limit stencils", coarse ? 0.11 : 0.09);
        add("pm evaluate / OpenSubdiv GLSL, limit stencils", coarse ? 0.03 : 0.05);
    }
    const Json targets = judge(result);
    const auto met = [&](const std::string& what, const std::string& where) {
        for (const Json& target : targets) {
            if (target["what"] == what && target["where"] == where) {
                return target["met"];
            }
        }
        return Json("absent");
    };
    EXPECT_EQ(met("prep evaluate / AVX2 bi-3", "sphere, rate 4"), true);
    EXPECT_EQ(met("prep evaluate / AVX2 bi-3, worst round", "sphere, rate 4"), false);
    EXPECT_EQ(met("prep frame / prep evaluate", "sphere, rate 4"), true);       // at most 1.6
    EXPECT_EQ(met("prep frame / prep evaluate", "sphere, rate 8"), false);      // at most 1.25
    EXPECT_EQ(met("prep shared evaluate / AVX2 bi-3", "sphere, rate 4"), true); // at most 4
    EXPECT_EQ(met("prep shared evaluate / AVX2 bi-3", "sphere, rate 8"), false);
    EXPECT_EQ(met("pm shared evaluate / AVX2 bi-3", "sphere, rate 4"), false);
    EXPECT_EQ(met("pm shared evaluate / AVX2 bi-3", "sphere, rate 8"), true);
    EXPECT_EQ(met("pm evaluate / OpenSubdiv CPU, limit stencils", "sphere, rate 4"), false); // at most 0.10
    EXPECT_EQ(met("pm evaluate / OpenSubdiv CPU, limit stencils", "sphere, rate 8"), true);
    EXPECT_EQ(met("pm evaluate / OpenSubdiv GLSL, limit stencils", "sphere, rate 4"), true); // at most 0.04
    EXPECT_EQ(met("pm evaluate / OpenSubdiv GLSL, limit stencils", "sphere, rate 8"), false);
    EXPECT_EQ(met("loop frame / loop evaluate", "sphere, rate 8"), "absent");
}

TEST(BenchTargets, LoadingAndPipelines) {
    Json result = madeUp();
    const auto load = [&](const char* scheme, double recorded, double done) {
        result["loading"].push_back({{"cage", "pip"},
                                     {"scheme", scheme},
                                     {"untilRecordedUsPerFace", recorded},
                                     {"untilDoneUsPerFace", done},
                                     {"staticBytesPerFace", 200.0}});
    };
    load("pm", 4.0, 4.9);
    load("loop", 6.0, 7.0);
    load("blend", 4.0, 5.1);
    const auto create = [&](const char* use, double cold, double warm, int late) {
        result["pipelines"].push_back({{"scheme", "pm"},
                                       {"use", use},
                                       {"coldMs", 9 * cold},
                                       {"warmMs", 9 * warm},
                                       {"coldCpuMs", cold},
                                       {"warmCpuMs", warm},
                                       {"createdWhileRecording", late}});
    };
    create("", 400.0, 40.0, 1);
    create("in a view", 600.0, 20.0, 0);
    std::vector<std::string> missed;
    for (const Json& target : judge(result)) {
        if (target["met"] == false && target["where"].get<std::string>().find("rate") == std::string::npos) {
            missed.push_back(target["what"].get<std::string>() + " | " + target["where"].get<std::string>());
        }
    }
    const std::vector<std::string> expected{"static device data, bytes a face | pip, pm",
                                            "load until the first frame is recorded, us a face | pip, loop",
                                            "load until the first frame is done, us a face | pip, loop",
                                            "load until the first frame is done, us a face | pip, blend",
                                            "pipelines created with a warm cache, CPU ms | pm",
                                            "pipelines created while recording | pm",
                                            "pipelines created cold, CPU ms | pm in a view"};
    EXPECT_EQ(missed, expected);
}

TEST(BenchTargets, RatiosOfGpusHaveNone) {
    Json result = madeUp();
    result["cpuDevice"] = false;
    EXPECT_TRUE(judge(result).empty());
}

/// A crowd of `characters` at rate 4, and one character at rate 8.
Json madeUpCrowd(uint32_t characters, double share, double crowdMs, double oneMs) {
    Json crowd{{"character", "sphere"}, {"faces", 1350}, {"joints", 64}, {"influences", 4}};
    const Json row{{"scheme", "pm"},
                   {"rate", 4},
                   {"characters", characters},
                   {"patches", 1350},
                   {"vertices", 33750},
                   {"clock", "device timestamps"},
                   {"evaluateMs", crowdMs / 2},
                   {"frameMs", crowdMs}};
    Json many = row, one = row;
    many["evaluateGigabytesPerSecond"] = 700.0;
    many["fillGigabytesPerSecond"] = 1000.0;
    many["storeGigabytesPerSecond"] = 900.0;
    many["bandwidthShare"] = {{"median", share}, {"least", share}, {"largest", share}};
    one["rate"] = 8;
    one["characters"] = 1;
    one["evaluateMs"] = oneMs / 2;
    one["frameMs"] = oneMs;
    crowd["rows"] = {many, one};
    return crowd;
}

TEST(BenchTargets, CrowdsAreJudgedOnGpus) {
    Json result = madeUp();
    result["crowd"] = madeUpCrowd(1000, 0.71, 0.49, 0.039);
    const Json onCpu = judge(result);
    EXPECT_TRUE(std::none_of(onCpu.begin(), onCpu.end(), [](const Json& target) {
        return target["what"].get<std::string>().find("character") != std::string::npos;
    }));
    result["cpuDevice"] = false;
    const Json good = judge(result);
    ASSERT_EQ(good.size(), 3u);
    EXPECT_TRUE(std::all_of(good.begin(), good.end(), [](const Json& target) { return target["met"] == true; }))
        << good;
    result["crowd"] = madeUpCrowd(1000, 0.69, 0.51, 0.041);
    const Json bad = judge(result);
    ASSERT_EQ(bad.size(), 3u);
    EXPECT_TRUE(std::all_of(bad.begin(), bad.end(), [](const Json& target) { return target["met"] == false; })) << bad;
    EXPECT_EQ(bad[0]["where"], "pm, rate 4, 1000 characters");
    EXPECT_EQ(bad[1]["limit"], 0.5);
    EXPECT_EQ(bad[2]["value"], 41.0);
    result["crowd"] = madeUpCrowd(400, 0.69, 0.1, 0.041);
    EXPECT_EQ(judge(result).size(), 2u) << "400 are not 1,000";
}

TEST(BenchCheck, SharesOfCrowdsCountOnGpus) {
    const auto with = [](bool cpu, uint32_t characters, double share) {
        Json result = madeUp();
        result["cpuDevice"] = cpu;
        result["crowd"] = madeUpCrowd(characters, share, 0.4, 0.03);
        return result;
    };
    const Json stored = with(false, 1000, 0.8);
    EXPECT_TRUE(findRegressions(stored, with(false, 1000, 0.69)).empty());
    const std::vector<std::string> lines = findRegressions(stored, with(false, 1000, 0.67));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "crowd, pm, rate 4, characters 1000: share of the write bandwidth: 0.67, was 0.8 (-16 %)");
    EXPECT_TRUE(findRegressions(stored, with(false, 400, 0.1)).empty()) << "another crowd";
    EXPECT_TRUE(findRegressions(with(true, 16, 0.8), with(true, 16, 0.1)).empty()) << "judged on GPUs alone";
    Json crowdAlone = stored;
    crowdAlone["rows"] = Json::array();
    EXPECT_TRUE(findRegressions(crowdAlone, stored).empty());
    EXPECT_EQ(findRegressions(crowdAlone, madeUp()).size(), 1u) << "nothing was compared";
}

TEST(BenchReport, PassesOfAViewAreShownAndJudged) {
    Json result = madeUp();
    const auto row = [](const char* scheme, const char* pass, double around) {
        Json passes = {{{"pass", "evaluate"}, {"ms", 20.0}}, {{"pass", pass}, {"ms", 8.5}}};
        return Json{{"scheme", scheme}, {"characters", 100},       {"vertices", 5000}, {"frames", 21},
                    {"frameMs", 30.0},  {"unseenMs", 0.25},        {"aloneMs", 20.0},  {"besideCulledMs", 20.5},
                    {"passes", passes}, {"aroundEvaluate", around}};
    };
    result["views"] = {row("pm", "level", 0.7), row("prep", "place", 0.5)};
    result["targets"] = judge(result);
    const std::string text = toTables(result);
    for (const char* piece : {"## The crowd in a view",
                              "| scheme | characters | vertices | frame, ms | all unseen, ms | as many more unseen "
                              "add, % | evaluate | level "
                              "| place | (level + place + attributes) / evaluate |",
                              "| pm     |        100 |     5000 |      30.0 |           0.25 |                       "
                              "2.50 |     20.0 |  8.50 |",
                              "| prep   |        100 |     5000 |      30.0 |           0.25 |                       "
                              "2.50 |     20.0 |       "
                              "|  8.50 |"}) {
        EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
    }
    std::vector<bool> met;
    for (const Json& target : result["targets"]) {
        if (target["what"] == "level, place and attributes / evaluate, in a view") {
            met.push_back(target["met"]);
        }
    }
    EXPECT_EQ(met, (std::vector<bool>{false, true}));
}

/// A row of a scene as far as tables and targets look.
Json sceneRow(const char* use, const char* poses, uint32_t characters, uint32_t dispatches) {
    return {{"characters", characters},
            {"use", use},
            {"poses", poses},
            {"dispatches", dispatches},
            {"barriers", 20},
            {"copies", 3},
            {"setUs", 1.0},
            {"recordUs", 161.0},
            {"recordAloneUs", 17.0},
            {"recordBehindWorkUs", 61.0},
            {"recordColdUs", 120.0},
            {"frameMs", 10.0},
            {"vertices", 1000},
            {"memoryBytes", 1 << 20},
            {"coefficientBytes", 1 << 19},
            {"vertexBytes", 1 << 18},
            {"allocations", 13}};
}

const Json* targetCalled(const Json& targets, const std::string& what, const std::string& where) {
    const auto found = std::find_if(targets.begin(), targets.end(), [&](const Json& target) {
        return target["what"] == what && target["where"] == where;
    });
    return found == targets.end() ? nullptr : &*found;
}

TEST(BenchTargets, ScenesAreJudgedBySixtyCharacters) {
    Json result = madeUp();
    Json posed = sceneRow("rate 4", "posed", kSceneCharacters, 40);
    Json viewed = sceneRow("view", "played", 30, 79);
    viewed["unseenMs"] = 0.1;
    result["scene"] = {{"instances", 3},
                       {"rows", {posed, sceneRow("rate 4", "played", kSceneCharacters, 41), viewed}},
                       {"views", Json::array()}};
    const Json few = judge(result);
    EXPECT_EQ(targetCalled(few, "different characters in a view", "scene"), nullptr) << "none was asked for 60";
    const Json* const most = targetCalled(few, "60 characters: dispatches", "rate 4, posed");
    const Json* const more = targetCalled(few, "60 characters: dispatches", "rate 4, played");
    ASSERT_TRUE(most != nullptr && more != nullptr);
    EXPECT_EQ((*most)["met"], true);
    EXPECT_EQ((*more)["met"], false);
    EXPECT_EQ(targetCalled(few, "60 characters: recording behind other work, CPU us", "rate 4, posed"), nullptr)
        << "it samples poses";
    EXPECT_EQ((*targetCalled(few, "60 characters: recording behind other work, CPU us", "rate 4, played"))["met"],
              false);
    EXPECT_EQ((*targetCalled(few, "60 characters: allocations", "rate 4, played"))["met"], false);
    EXPECT_EQ(targetCalled(few, "60 characters: dispatches", "view, played"), nullptr) << "they are 30";

    result["scene"]["rows"].push_back(
        {{"characters", kSceneCharacters}, {"use", "view"}, {"poses", "played"}, {"refused", "the view is full"}});
    const Json refused = judge(result);
    const Json* const room = targetCalled(refused, "different characters in a view", "scene");
    ASSERT_NE(room, nullptr);
    EXPECT_EQ((*room)["value"], 30);
    EXPECT_EQ((*room)["met"], false);
    EXPECT_NE(toTables(result).find("60 characters in a view, played: refused: the view is full"), std::string::npos);

    viewed["characters"] = kSceneCharacters;
    result["scene"]["rows"].back() = viewed;
    Json views = sceneRow("", "", 10, 100);
    views["views"] = 2;
    views["ownMs"] = 4.0;
    views["repeatedMs"] = 1.0;
    result["scene"]["views"] = {views};
    const Json whole = judge(result);
    EXPECT_EQ((*targetCalled(whole, "different characters in a view", "scene"))["met"], true);
    EXPECT_EQ((*targetCalled(whole, "60 characters: dispatches", "view, played"))["met"], true);
    EXPECT_NEAR((*targetCalled(whole, "60 characters: all unseen / all seen", "view, played"))["value"].get<double>(),
                0.01, 1e-9);
    const Json* const further =
        targetCalled(whole, "further views: passes beside levels and vertices / these", "2 views");
    ASSERT_NE(further, nullptr);
    EXPECT_EQ((*further)["value"], 0.25);
    EXPECT_EQ((*further)["met"], false);
}

TEST(BenchReport, ScenesAreShown) {
    Json result = madeUp();
    Json viewed = sceneRow("view", "played", 3, 79), views = viewed;
    viewed["unseenMs"] = 0.25;
    views["views"] = 2;
    views["ownMs"] = 4.0;
    views["repeatedMs"] = 1.5;
    result["scene"] = {{"instances", 3}, {"rows", {sceneRow("rate 4", "posed", 1, 11), viewed}}, {"views", {views}}};
    const std::string text = toTables(result);
    EXPECT_NE(text.find("## A scene of different characters, 3 of each"), std::string::npos) << text;
    EXPECT_NE(text.find("| rate 4 | posed  |          1 |         11 |       20 |"), std::string::npos) << text;
    EXPECT_NE(text.find("|           0.25 |"), std::string::npos) << text;
    EXPECT_NE(text.find("levels and vertices of further views, ms"), std::string::npos) << text;
}

TEST(BenchReport, CrowdAndWorstShareAreShown) {
    Json result = madeUp();
    result["cpuDevice"] = false;
    result["crowd"] = madeUpCrowd(1000, 0.65, 0.4, 0.02);
    Json finer = result["crowd"]["rows"][0];
    finer["rate"] = 8;
    finer["bandwidthShare"]["median"] = 0.8;
    result["crowd"]["rows"].push_back(finer);
    result["targets"] = judge(result);
    result["leftOut"] = {{{"what", "man_casual_quads"}, {"reason", "not there"}}};
    result["complete"] = false;
    const std::string text = toTables(result);
    for (const char* piece : {"## Crowd: the sphere of 1350 faces with 64 joints, 4 influences a vertex",
                              "| 1000       | pm, rate 4   |", "left out: man_casual_quads: not there", "not complete",
                              ("| crowd's evaluation / write bandwidth       | pm, rate 4, 1000 characters |  0.65 | "
                               "at least 0.70 | 1 of 2 |")}) {
        EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
    }
}

TEST(BenchReport, TheClassicalPathIsShown) {
    const auto way = [](const char* name, double ms, uint64_t loaded) {
        return Json{{"name", name},         {"frameMs", ms},        {"frameCpuMs", 2 * ms},
                    {"vertices", 100},      {"skinnedVertices", 9}, {"loadedBytes", loaded},
                    {"characterBytes", 50}, {"poseBytes", 3072},    {"fileBytes", 7000}};
    };
    const auto ratio = [](const char* name, double median) {
        return Json{{"name", name}, {"median", median}, {"least", 0.5 * median}, {"largest", 2 * median}};
    };
    Json result = madeUp();
    result["classical"] = {{{"cage", "pip"},
                            {"faces", 8},
                            {"joints", 3},
                            {"rate", 4},
                            {"characters", 5},
                            {"triangles", 256},
                            {"skinAloneMs", 0.25},
                            {"skinAloneCpuMs", 0.5},
                            {"contestants", {way("polygons", 4.0, 90000), way("pm", 2.0, 5000)}},
                            {"ratios", {ratio("pm / polygons", 0.5), ratio("pm / polygons, skin alone", 8.0)}},
                            {"refused", {{{"scheme", "prep"}, {"reason", "no quads"}}}}}};
    const std::string text = toTables(result);
    for (const char* piece :
         {"## The classical path", "pip, rate 4: 5 characters of 256 triangles, 8 faces, 3 joints",
          "prep refuses it: no quads", "| pip, rate 4 | polygons             |      4.00 |   8.00 |",
          "| pip, rate 4 | polygons, skin alone |      0.25 |   0.50 |",
          "| pip, rate 4 | pm                   |      2.00 |   4.00 | 0.50 (0.25-1.00) | 8.00 (4.00-16.0) |"}) {
        EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
    }
    EXPECT_EQ(toTables(madeUp()).find("classical"), std::string::npos);
}

TEST(BenchReport, TablesNameWhatWasMeasured) {
    const std::string text = toTables(madeUp());
    for (const char* piece : {"device  d, r i, auto mapping", "peer    AVX2: by hand", "## sphere, 1350 faces",
                              "| CPU ns a point | rate 4 | rate 8 |", "| prep frame     |   20.0 |   20.0 |",
                              "| prep frame / prep evaluate     |   1.30 |   1.30 |"}) {
        EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
    }
    EXPECT_EQ(text.find("device timestamps"), std::string::npos) << "nothing has any";
}

TEST(BenchReport, WhatIsNoResultIsRefused) {
    EXPECT_EQ(whyNoResult(madeUp()), "");
    EXPECT_EQ(whyNoResult(Json::parse("[1]")), "has no \"machine\"");
    Json result = madeUp();
    result["rows"][0]["ratios"][0].erase("median");
    EXPECT_EQ(whyNoResult(result), "has a ratio without name, of, over or median");
    result["rows"][0].erase("cage");
    EXPECT_EQ(whyNoResult(result), "has a row without cage, rate or ratios");
}

TEST(BenchPlot, TwoPicturesACageOfSeveralRates) {
    Json result = madeUp();
    const std::vector<Picture> pictures = plotsOf(result);
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(pictures[0].fileName, "bench_sphere_points.svg");
    EXPECT_NE(pictures[0].svg.find(">AVX2 bi-3</text>"), std::string::npos);
    EXPECT_EQ(pictures[0].svg.find(">prep frame</text>"), std::string::npos);
    EXPECT_NE(pictures[1].svg.find(">prep</text>"), std::string::npos);
    EXPECT_EQ(pictures[0].svg.rfind("<svg xmlns", 0), 0u) << "a file of its own";
    result["rows"].erase(1);
    EXPECT_TRUE(plotsOf(result).empty());
}

/// Patches like those of a surface: a sheet with a little noise, so that no normal degenerates.
std::vector<float> coefficients(size_t patches) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.1f, 0.1f);
    std::vector<float> result;
    for (size_t p = 0; p < patches; ++p) {
        for (int k = 0; k < 16; ++k) {
            const auto row = k / 4;
            const float x = static_cast<float>(k % 4) + noise(random), y = static_cast<float>(row) + noise(random);
            result.insert(result.end(), {x, y, noise(random), 1.0f});
        }
    }
    return result;
}

TEST(BenchYardsticks, PlainEvaluationMeetsItsCorners) {
    const std::vector<float> g = coefficients(3);
    for (const uint32_t rate : {1u, 2u, 7u, 64u}) {
        const uint32_t side = rate + 1;
        std::vector<float> samples(size_t{3} * side * side * 6);
        evaluatePlain(g, rate, samples);
        const std::pair<uint32_t, uint32_t> corners[] = {
            {0, 0}, {rate, 3}, {side * rate, 12}, {side * side - 1, 15}}; // sample and coefficient
        for (size_t p = 0; p < 3; ++p) {
            for (const auto& [sample, coefficient] : corners) {
                for (size_t axis = 0; axis < 3; ++axis) {
                    EXPECT_EQ(samples[6 * (p * side * side + sample) + axis], g[64 * p + 4 * coefficient + axis]);
                }
            }
        }
    }
}

TEST(BenchYardsticks, Avx2IsThePlainEvaluation) {
    if (!hasAvx2Evaluation()) {
        GTEST_SKIP() << "no AVX2 and FMA on this CPU";
    }
    for (const size_t patches : {1u, 7u, 8u, 19u}) { // also counts that do not fill the lanes
        const std::vector<float> g = coefficients(patches);
        for (const uint32_t rate : {1u, 4u, 8u, 15u, 64u}) {
            const size_t floats = patches * (rate + 1) * (rate + 1) * 6;
            std::vector<float> plain(floats), avx2(floats + 1, -7.0f);
            evaluatePlain(g, rate, plain);
            BicubicWeights weights;
            fillBicubicWeights(weights, rate);
            evaluateAvx2(g.data(), patches, rate, weights, avx2.data());
            double largest = 0.0;
            for (size_t i = 0; i < floats; ++i) {
                largest = std::max(largest, std::abs(static_cast<double>(plain[i]) - static_cast<double>(avx2[i])));
            }
            EXPECT_LT(largest, 1e-5) << patches << " patches at rate " << rate;
            EXPECT_EQ(avx2[floats], -7.0f) << "written past the end";
        }
    }
}

TEST(BenchYardsticks, WritingReachesEveryFloat) {
    std::vector<float> samples(1001, -1.0f);
    writeAll(samples, 3);
    EXPECT_TRUE(std::all_of(samples.begin(), samples.end(), [](float x) { return x == 3.0f; }));
}

} // namespace
