// What supple profile takes for a change, on numbers that are known; and what it makes of them.
#include "tools/supple/profile_compare.h"
#include "tools/supple/profile_html.h"
#include "tools/supple/profile_report.h"
#include "tools/supple/time_history.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace supple::tools {
namespace {

/// Rounds in which the machine takes up to 1.8 times as long, for both alike, and two rounds in which one of them takes
/// twice as long as well.
struct BusyMachine {
    std::mt19937 random{7};

    double noise(double most) { return std::uniform_real_distribution<double>(1.0, most)(random); }
    MeasuredRound round(double deform, double evaluate, double slowness) {
        MeasuredRound round;
        for (int frame = 0; frame < 30; ++frame) {
            const double busy = slowness * noise(1.1);
            round.passes["deform"].push_back(deform * busy);
            round.passes["evaluate"].push_back(evaluate * busy);
            round.frame.push_back((deform + evaluate) * busy);
        }
        return round;
    }
    RunChange compare(double factor, size_t rounds) {
        MeasuredRun before{"pip", {"deform", "evaluate"}, {}}, after = before;
        for (size_t r = 0; r < rounds; ++r) {
            const double slowness = noise(1.8);
            before.rounds.push_back(round(0.2, 2.0, slowness * (r == 3 ? 2.0 : 1.0)));
            after.rounds.push_back(round(0.2 * factor, 2.0, slowness * (r == 9 ? 2.0 : 1.0)));
        }
        return compareRuns({before}, {after}).front();
    }
};

TEST(ProfileCompare, FindsASlowPassAmongDisturbedRounds) {
    BusyMachine machine;
    for (int time = 0; time < 50; ++time) {
        const RunChange change = machine.compare(1.5, 16);
        ASSERT_EQ(change.passes.size(), 3u);
        EXPECT_EQ(change.passes[0].pass, "deform");
        EXPECT_TRUE(change.passes[0].significant);
        EXPECT_NEAR(change.passes[0].change, 0.5, 0.1);
        EXPECT_LE(change.passes[0].low, change.passes[0].change);
        EXPECT_GE(change.passes[0].high, change.passes[0].change);
        EXPECT_FALSE(change.passes[1].significant) << "evaluate has not changed";
        const std::vector<std::string> slower = slowerThan({change}, 20.0);
        ASSERT_EQ(slower.size(), 1u);
        EXPECT_EQ(slower[0].rfind("pip: deform is ", 0), 0u) << slower[0];
        EXPECT_TRUE(slowerThan({change}, 90.0).empty());
    }
}

TEST(ProfileCompare, FindsNothingWhereNothingChanged) {
    BusyMachine machine;
    for (int time = 0; time < 200; ++time) {
        for (const PassChange& pass : machine.compare(1.0, 16).passes) {
            EXPECT_FALSE(pass.significant) << pass.pass << " " << pass.change;
        }
    }
}

TEST(ProfileCompare, FramesOfTwoRunsAreComparedInBlocks) {
    BusyMachine machine;
    MeasuredRun before{"pip", {"deform", "evaluate"}, {machine.round(0.2, 2.0, 1.0)}};
    MeasuredRun after{"pip", {"deform", "evaluate"}, {machine.round(0.3, 2.0, 1.0)}};
    const RunChange change = compareRuns({before}, {after}).front();
    EXPECT_TRUE(change.passes[0].significant);
    EXPECT_FALSE(change.passes[1].significant);
    CompareRules rough;
    rough.floorOfFrames = 0.6;
    EXPECT_FALSE(compareRuns({before}, {after}, rough).front().passes[0].significant) << "below the floor";
}

TEST(ProfileCompare, PassesThatCameAndWentAreNamed) {
    MeasuredRun before{"pip", {"edge"}, {{{1.0, 1.0}, {{"edge", {1.0, 1.0}}}}}};
    MeasuredRun after{"pip", {"assemble"}, {{{1.0, 1.0}, {{"assemble", {1.0, 0.0}}}}}};
    const RunChange change = compareRuns({before}, {after}).front();
    const std::string table = toTable(change);
    EXPECT_NE(table.find("new"), std::string::npos) << table;
    EXPECT_NE(table.find("gone"), std::string::npos) << table;
    EXPECT_TRUE(compareRuns({}, {after}).front().passes.empty());
}

TEST(ProfileCompare, OnlyResultsWithTimesOfFramesAreTaken) {
    using Json = nlohmann::ordered_json;
    for (const Json& result : {Json(), Json::array(), Json{{"runs", 3}}, Json{{"runs", {{{"file", "a.glb"}}}}}}) {
        const auto runs = measuredRuns(result, "old.json");
        ASSERT_FALSE(runs.ok()) << result;
        EXPECT_EQ(runs.error().message.rfind("old.json: ", 0), 0u) << runs.error().message;
    }
    const auto resultWith = [](const Json& frameMs, const Json& passMs) {
        return Json{{"runs",
                     {{{"file", "/there/a.glb"},
                       {"scheme", "pm"},
                       {"rate", 8},
                       {"instances", 2},
                       {"samples", {{"frameMs", frameMs}, {"passMs", {{"deform", passMs}}}}}}}}};
    };
    for (const Json& bad : {Json{0.5, "x"}, Json{0.5, -1.0}, Json{0.5, 1e300}, Json{0.5, nullptr}}) {
        EXPECT_FALSE(measuredRuns(resultWith({1.0, 2.0}, bad), "old.json").ok()) << bad;
        EXPECT_FALSE(measuredRuns(resultWith(bad, {0.5, 0.0}), "old.json").ok()) << bad;
    }
    EXPECT_FALSE(measuredRuns(resultWith(Json::array(), {0.5}), "old.json").ok()) << "no frames";
    const Json good = resultWith({1.0, 2.0}, {0.5, 0.0});
    const auto runs = measuredRuns(good, "old.json");
    ASSERT_TRUE(runs.ok());
    ASSERT_EQ(runs->size(), 1u);
    EXPECT_EQ(runs->front().name, "a.glb, pm, rate 8, 2 instances") << "wherever the file lies";
    EXPECT_EQ(runs->front().rounds[0].passes.at("deform"), (std::vector<double>{0.5, 0.0}));
}

ProfileRun runOf(uint32_t rate) {
    ProfileRun run;
    run.file = "a <b>.glb";
    run.scheme = "pm";
    run.clip = "walk";
    run.rate = run.patchRate = rate;
    run.instances = 1;
    for (int i = 0; i < 300; ++i) {
        FrameSample frame;
        const double begin = 1e7 * i;
        frame.passes = {{"deform", begin, begin + 1e6, 1e3, 10, 100},
                        {"evaluate", begin + 5e5, begin + 4e6, 1e3, 50, 900}};
        run.frames.push_back(frame);
    }
    return run;
}

TEST(ProfileCompare, EndsWithAVerdict) {
    const PassChange still{"deform", 1.0, 1.01, 0.01, -0.02, 0.03, false};
    const PassChange frame{"frame", 2.0, 2.03, 0.015, -0.02, 0.03, false};
    RunChange run{"a.glb, pm", 16, {still, frame}};
    EXPECT_EQ(verdictOf({run}), "verdict: no difference; frames differ by at most 1.5 %, which counts as noise");
    run.passes.push_back({"evaluate", 1.0, 1.2, 0.2, 0.1, 0.3, true});
    RunChange other{"b.glb, pm", 16, {{"deform", 1.0, 0.5, -0.5, -0.6, -0.4, true}}};
    EXPECT_EQ(verdictOf({run}), "verdict: slower: a.glb, pm: evaluate +20.0 %");
    EXPECT_EQ(verdictOf({other}), "verdict: faster: b.glb, pm: deform -50.0 %");
    EXPECT_EQ(verdictOf({run, other}),
              "verdict: slower: a.glb, pm: evaluate +20.0 %; faster: b.glb, pm: deform -50.0 %");
    EXPECT_EQ(verdictOf({{"c.glb, pm", 1, {}}}), "verdict: nothing was compared");
}

TEST(ProfileHtml, IsOnePageWithAllOfIt) {
    const std::vector<ProfileRun> runs{runOf(4), runOf(8)};
    RunChange change{"a.glb, pm", 1, {{"deform", 1.0, 2.0, 1.0, 0.9, 1.1, true}}};
    HtmlReport report;
    report.runs = runs;
    report.changes = {&change, 1};
    report.pictures = {{"a <b>.glb", "pm", "PNG bytes"}};
    report.warnings = {"a <b>.glb: 3 faces are flat"};
    report.budgetMs = 5.0;
    const std::string page = toHtml(report);
    for (const char* part : {"a &lt;b&gt;.glb", "3 faces are flat", "<svg", "budget 5",
                             "data:image/png;base64,UE5HIGJ5dGVz", "prefers-color-scheme:dark", "over rate",
                             "class=\"slower\"", "</html>", "of the frame. ", "verdict: slower"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(page.find("a <b>"), std::string::npos) << "names are escaped";
    EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is loaded";
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("base64", page.find("base64") + 1), std::string::npos) << "a picture stands once";
    EXPECT_LT(page.size(), 300000u);
}

TEST(ProfileSpans, OverlapsCountOnce) {
    ProfileRun run = runOf(4);
    for (FrameSample& frame : run.frames) { // a second group's, half of it beside the first's
        const double begin = frame.passes[0].gpuBegin;
        frame.passes.push_back({"deform", begin + 5e5, begin + 1.5e6, 1e3, 10, 100});
        frame.passes.push_back({"motion", begin + 6e6, begin + 7e6, 1e3, 10, 100});
    }
    const RunSummary summary = summarizeRun(run);
    EXPECT_DOUBLE_EQ(summary.passes[0].gpu.median, 1.5);
    EXPECT_DOUBLE_EQ(summary.total.gpu.median, 7.0);
    EXPECT_DOUBLE_EQ(summary.covered.median, 5.0) << "2 ms lie in no pass";
    const FrameTimes times = frameTimes(run);
    ASSERT_EQ(times.passes.size(), 3u);
    EXPECT_DOUBLE_EQ(times.passes[0].times[10], 1.5);
    EXPECT_DOUBLE_EQ(times.covered[10], 5.0);
}

TEST(TimeHistory, KeepsTheLastFramesAndEachOnce) {
    TimeHistory history;
    EXPECT_EQ(history.most(), 0.0f);
    for (uint64_t frame = 1; frame <= 200; ++frame) {
        history.add(frame, {{"deform", 1.0}, {"evaluate", static_cast<double>(frame)}});
        history.add(frame, {{"deform", 9.0}});
    }
    EXPECT_EQ(history.frames(), TimeHistory::kFrames);
    EXPECT_EQ(history.row(0), (std::vector<float>{1.0f, 51.0f}));
    EXPECT_EQ(history.most(), 201.0f);
    history.add(300, {{"attributes", 2.0}});
    EXPECT_EQ(history.names(), (std::vector<std::string>{"deform", "evaluate", "attributes"}));
    EXPECT_EQ(history.row(history.frames() - 1), (std::vector<float>{0.0f, 0.0f, 2.0f}));
    history.clear();
    EXPECT_EQ(history.frames(), 0u);
}

TEST(ProfileTrace, ClocksThatWereReadTogetherLieOnOneAxis) {
    ProfileRun run = runOf(4);
    run.clocks = {{1e7, 5e9, 100.0}, {2e7, 5e9 + 1.0002e7, 300.0}}; // the device's clock is 0.02 % slow
    const nlohmann::ordered_json trace = toTrace({}, {&run, 1});
    EXPECT_EQ(trace["otherData"]["clocks"], "read together, within 0.300 us");
    const auto& events = trace["traceEvents"];
    const auto isCounter = [](const auto& event) { return event["ph"] == "C"; };
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), isCounter));
    const auto deform = std::find_if(events.begin(), events.end(), [](const auto& event) {
        return event["ph"] == "X" && event["tid"] == 1 && event["name"] == "deform" && event["ts"] > 5.0005e6;
    });
    ASSERT_NE(deform, events.end());
    EXPECT_NEAR((*deform)["ts"].get<double>(), (5e9 + 1.0002e7) / 1e3, 1e-3);
}

} // namespace
} // namespace supple::tools
