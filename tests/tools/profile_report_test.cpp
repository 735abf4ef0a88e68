#include "tools/supple/profile_report.h"

#include "tools/supple/profile_advice.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace supple::tools {
namespace {

constexpr double kMillisecond = 1e6; // in nanoseconds

/// Two passes a frame, three frames; the device's clock starts somewhere far from the host's.
ProfileRun sampleRun() {
    ProfileRun run{.file = "a \"b\".glb",
                   .scheme = "prep",
                   .rate = 8,
                   .patchRate = 8,
                   .instances = 2,
                   .patches = 10,
                   .memory = {},
                   .frames = {}};
    for (int i = 0; i < 3; ++i) {
        const double gpu = 9e15 + i * 16 * kMillisecond;
        FrameSample frame;
        frame.frame = static_cast<uint64_t>(i) + 4;
        frame.passes.push_back({"deform", gpu, gpu + (i + 1) * kMillisecond, 0.1 * kMillisecond, 100, 1600});
        frame.passes.push_back(
            {"evaluate", gpu + 4 * kMillisecond, gpu + 6 * kMillisecond, 0.2 * kMillisecond, 4000, 64000});
        frame.recordBegin = i * 16 * kMillisecond;
        frame.recordTime = 0.5 * kMillisecond;
        frame.submitted = frame.recordBegin + kMillisecond;
        run.frames.push_back(frame);
    }
    return run;
}

TEST(ProfileReport, SummaryCountsEachPassAndTheWholeFrame) {
    const RunSummary summary = summarizeRun(sampleRun());
    ASSERT_EQ(summary.passes.size(), 2u);
    EXPECT_EQ(summary.passes[0].pass, "deform");
    EXPECT_DOUBLE_EQ(summary.passes[0].gpu.median, 2.0);
    EXPECT_DOUBLE_EQ(summary.passes[0].gpu.max, 3.0);
    EXPECT_DOUBLE_EQ(summary.passes[1].gpu.median, 2.0);
    EXPECT_DOUBLE_EQ(summary.passes[1].megapointsPerSecond(), 2.0);
    EXPECT_DOUBLE_EQ(summary.total.gpu.median, 6.0) << "gaps between passes belong to the frame";
    EXPECT_NEAR(summary.total.cpuRecord.median, 0.3, 1e-12);
    EXPECT_EQ(summary.total.points, 4000u) << "a frame's points are its surface vertices";
    EXPECT_EQ(summary.total.bytes, 65600u);
    EXPECT_DOUBLE_EQ(summary.record.median, 0.5);
}

TEST(ProfileReport, APassThatRunsOnceIsNotDilutedByTheOtherFrames) {
    ProfileRun run = sampleRun();
    run.frames[0].passes.push_back({"attributes", 9e15, 9e15 + 5 * kMillisecond, 0.0, 7, 112});
    const RunSummary summary = summarizeRun(run);
    ASSERT_EQ(summary.passes.size(), 3u);
    EXPECT_DOUBLE_EQ(summary.passes[2].gpu.median, 5.0);
}

TEST(ProfileReport, PartsOfAPassAreAddedUp) {
    ProfileRun run = sampleRun();
    for (FrameSample& frame : run.frames) {
        frame.passes.push_back({"deform", 0.0, 5 * kMillisecond, 0.1 * kMillisecond, 10, 160});
    }
    const RunSummary summary = summarizeRun(run);
    ASSERT_EQ(summary.passes.size(), 2u);
    EXPECT_DOUBLE_EQ(summary.passes[0].gpu.median, 7.0);
    EXPECT_NEAR(summary.passes[0].cpuRecord.median, 0.2, 1e-12);
    EXPECT_EQ(summary.passes[0].points, 110u);
    EXPECT_EQ(summary.passes[0].bytes, 1760u);
}

TEST(ProfileReport, AViewTellsWhatItDrew) {
    ProfileRun run = sampleRun();
    run.budget = 5000;
    for (size_t i = 0; i < run.frames.size(); ++i) {
        const auto number = static_cast<uint32_t>(i);
        run.frames[i].drawn = {4000 + number, 9000, 100, 2, number, 0.5f + 0.1f * static_cast<float>(i), i == 1};
    }
    const RunSummary summary = summarizeRun(run);
    EXPECT_EQ(summary.total.points, 4001u) << "what comes out of a frame is what the view drew";
    EXPECT_EQ(summary.drawn.mostDropped, 2u);
    EXPECT_EQ(summary.drawn.shortfallFrames, 1u);
    const std::string table = toTable(run, summary);
    EXPECT_NE(table.find("in a view of 5000 vertices"), std::string::npos) << table;
    EXPECT_NE(table.find("4001 vertices of 9000 wanted"), std::string::npos) << table;
    EXPECT_NE(table.find("shortfall in 1 of 3 frames"), std::string::npos) << table;
    const std::vector<ProfileRun> runs{run};
    const auto json = toJson({}, runs)["runs"][0]["view"];
    EXPECT_EQ(json["budget"], 5000);
    EXPECT_EQ(json["wantedVertices"], 9000);
    EXPECT_EQ(json["shortfallFrames"], 1);
    EXPECT_FLOAT_EQ(json["leastLevelScale"].get<float>(), 0.5f);
    const std::string csv = toCsv(runs);
    EXPECT_NE(csv.find(",view_budget,view_wanted_vertices,view_shortfall_frames\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",5000,9000,1\n"), std::string::npos) << csv;
    EXPECT_EQ(toCsv(std::vector{sampleRun()}).find("5000"), std::string::npos);
}

TEST(ProfileReport, MemoryIsToldByPurposeTheLargestFirst) {
    ProfileRun run = sampleRun();
    run.memory.allocationCount = 7;
    run.memory.tables = 512 << 10;
    run.memory.vertices = 3 << 20;
    run.memory.readback = 1 << 20;
    run.memory.deviceLocal = run.memory.tables + run.memory.vertices;
    run.memory.hostVisible = run.memory.readback;
    const std::string table = toTable(run, summarizeRun(run));
    EXPECT_NE(table.find("memory: 3.5 MiB on the device (vertices 3.0, tables 0.500), 1.0 MiB mapped (readback 1.0), "
                         "in 7 allocations\n"),
              std::string::npos)
        << table;
    const auto json = toJson({}, std::vector{run})["runs"][0]["memory"];
    EXPECT_EQ(json["deviceLocalBytes"], 7 << 19);
    EXPECT_EQ(json["hostVisibleBytes"], 1 << 20);
    EXPECT_EQ(json["verticesBytes"], 3 << 20);
    EXPECT_EQ(json["scratchBytes"], 0);
    EXPECT_EQ(json["allocations"], 7);
}

TEST(ProfileReport, WhoHoldsMemoryIsToldAndWhatOfItGoesBack) {
    ProfileRun run = sampleRun();
    run.holders.resize(2);
    run.holders[0].name = "asset pip.glb";
    run.holders[0].use.deviceLocal = run.holders[0].use.tables = 512 << 10;
    run.holders[1].name = "group pip.glb";
    run.holders[1].use.vertices = 3 << 20;
    run.holders[1].use.cages = 1 << 20;
    run.holders[1].use.deviceLocal = 4 << 20;
    const RunSummary summary = summarizeRun(run);
    EXPECT_NE(toTable(run, summary)
                  .find("    asset pip.glb: 0.500 MiB (tables 0.500)\n"
                        "    group pip.glb: 4.0 MiB (vertices 3.0, cages 1.0)\n"),
              std::string::npos)
        << toTable(run, summary);
    EXPECT_FALSE(toJson({}, std::vector{run})["runs"][0]["holders"][1].contains("givenBackBytes"));
    run.keptUnseen = 60;
    run.holders[1].use.givenBack = 3 << 20;
    EXPECT_NE(toTable(run, summary)
                  .find("(vertices 3.0, cages 1.0), 3.0 of it goes back\n"
                        "    What goes back does so when nobody is seen for 60 frames.\n"),
              std::string::npos)
        << toTable(run, summary);
    const auto holders = toJson({}, std::vector{run})["runs"][0]["holders"];
    EXPECT_EQ(holders[1]["name"], "group pip.glb");
    EXPECT_EQ(holders[1]["verticesBytes"], 3 << 20);
    EXPECT_EQ(holders[1]["givenBackBytes"], 3 << 20);
    EXPECT_EQ(holders[0]["givenBackBytes"], 0);
}

TEST(ProfileReport, SaysWhatCostsMostAndWhatWouldHelp) {
    ProfileRun run = sampleRun();
    for (FrameSample& frame : run.frames) { // 4 ms more of a frame that took 6
        frame.passes[1].gpuEnd += 4 * kMillisecond;
    }
    run.frames[0].passes.push_back({"upload", 9e15, 9e15 + 9 * kMillisecond, 0.0, 7, 112}); // once
    EXPECT_EQ(adviceOf(run).find("evaluate takes 60 % of the frame. Half of the --rate"), 0u) << adviceOf(run);
    run.budget = 1000;
    EXPECT_NE(adviceOf(run).find("--budget"), std::string::npos);
    EXPECT_NE(toTable(run, summarizeRun(run)).find(adviceOf(run)), std::string::npos);
    for (FrameSample& frame : run.frames) {
        frame.passes.resize(2);
        frame.passes[0].gpuEnd = frame.passes[0].gpuBegin + 0.1 * kMillisecond;
        frame.passes[1].gpuBegin = frame.passes[1].gpuEnd - 0.1 * kMillisecond;
    }
    EXPECT_EQ(adviceOf(run).find("98 % of the frame lies between passes."), 0u) << adviceOf(run);
}

TEST(ProfileReport, NoFramesGiveZeros) {
    ProfileRun run = sampleRun();
    run.frames.clear();
    EXPECT_EQ(adviceOf(run), "");
    EXPECT_DOUBLE_EQ(summarizeRun(run).total.gpu.median, 0.0);
    const std::vector<ProfileRun> runs{run};
    EXPECT_EQ(toJson({}, runs)["runs"][0]["frames"], 0);
    EXPECT_FALSE(toTrace({}, runs)["traceEvents"].empty());
}

TEST(ProfileReport, TraceHasOneTrackForEachClockLaidTogetherAtTheFirstFrame) {
    const std::vector<ProfileRun> runs{sampleRun()};
    const auto trace = toTrace({.device = "device", .driver = {}, .driverInfo = {}, .mapping = {}, .cpu = {}}, runs);
    int gpuSlices = 0;
    double firstGpu = -1.0;
    for (const auto& event : trace["traceEvents"]) {
        if (event["ph"] == "X" && event["tid"] == 1) {
            firstGpu = gpuSlices++ == 0 ? event["ts"].get<double>() : firstGpu;
            EXPECT_GT(event["dur"].get<double>(), 0.0);
        }
    }
    EXPECT_EQ(gpuSlices, 6);
    EXPECT_NEAR(firstGpu, 1000.0, 1e-6) << "microseconds: the first frame was submitted after 1 ms";
}

TEST(ProfileReport, CsvHasARowAPassAndQuotesNames) {
    const std::vector<ProfileRun> runs{sampleRun()};
    std::istringstream csv(toCsv(runs));
    std::string line;
    std::getline(csv, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    int rows = 0;
    while (std::getline(csv, line)) {
        ++rows;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
        EXPECT_EQ(line.rfind("\"a \"\"b\"\".glb\",prep,8,2,3,", 0), 0u) << line;
    }
    EXPECT_EQ(rows, 3);
}

} // namespace
} // namespace supple::tools
