#include "tools/supple/profile_report.h"

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
                   .deviceBytes = 0,
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

TEST(ProfileReport, NoFramesGiveZeros) {
    ProfileRun run = sampleRun();
    run.frames.clear();
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
