// supple bench run as a user would: is every row there, do the contestants do the same job. Times are not judged.
#include "tests/support/shared_assets.h"
#include "tests/tools/command_runner.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace {

using Json = nlohmann::json;

using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

class Bench : public supple::test::CommandTest {};

/// Times are not judged, so a driver may take what it has compiled before: that is two thirds of the run.
const std::string kQuick = "bench --quick --driver-cache";

std::set<std::string> names(const Json& list) {
    std::set<std::string> result;
    for (const Json& entry : list) {
        result.insert(entry["name"]);
    }
    return result;
}

bool finitePositive(const Json& value) {
    return value.is_number() && std::isfinite(value.get<double>()) && value.get<double>() > 0.0;
}

struct Expected {
    const char* cage;
    uint32_t faces;
    std::vector<std::string> schemes;
    bool bothFormats;
};
std::vector<Expected> expectedCages() {
    std::vector<Expected> cages{
        {"sphere", 1350, {"prep", "pm", "catmull-clark", "fragments", "blend"}, true},
        {"irregular", 1296, {"prep", "pm", "catmull-clark", "fragments", "blend"}, true},
        {"triangles", 2700, {"pm", "catmull-clark", "fragments", "loop", "blend"}, false},
        {"man_casual_quads", 3966, {"prep", "pm", "catmull-clark", "fragments", "blend"}, false},
        {"pip_quads", 1496, {"prep", "pm", "catmull-clark", "fragments", "blend"}, false},
        {"pip", 1832, {"pm", "catmull-clark", "fragments", "loop", "blend"}, false},
    };
    if (supple::test::sharedAssets({"characters/man_casual_quads.glb"}).empty()) {
        std::erase_if(cages, [](const Expected& expected) { return expected.cage == std::string("man_casual_quads"); });
    }
    return cages;
}

std::vector<std::string> peerJobs(bool cpu, bool glsl) {
    std::vector<std::string> jobs;
    for (const char* job : {"limit stencils", "patches"}) {
        if (cpu) {
            jobs.push_back(std::string("CPU, ") + job);
        }
        if (cpu && glsl) {
            jobs.push_back(std::string("GLSL, ") + job);
        }
    }
    return jobs;
}

/// One and three different characters, posed at one rate and played in a view, and one of them from several views.
void expectScene(const Json& scene, const std::string& out) {
    EXPECT_EQ(scene["instances"], 3);
    std::set<std::string> rows;
    for (const Json& row : scene["rows"]) {
        const std::string use = row["use"];
        rows.insert(use + ", " + row["poses"].get<std::string>() + ", " + row["characters"].dump());
        ASSERT_FALSE(row.contains("refused")) << row;
        for (const char* key :
             {"dispatches", "barriers", "setUs", "recordUs", "recordAloneUs", "recordBehindWorkUs", "recordColdUs",
              "frameMs", "vertices", "memoryBytes", "coefficientBytes", "vertexBytes", "allocations"}) {
            EXPECT_TRUE(finitePositive(row[key])) << key << " of " << row;
        }
        EXPECT_EQ(row.contains("unseenMs") && finitePositive(row["unseenMs"]), use == "view") << row;
        if (use == "view") {
            EXPECT_LE(row["vertices"], 1u << 20) << "the view's budget";
        }
    }
    EXPECT_EQ(rows,
              (std::set<std::string>{"rate 4, posed, 1", "rate 4, posed, 3", "view, played, 1", "view, played, 3"}));
    ASSERT_EQ(scene["views"].size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        const Json& row = scene["views"][i];
        EXPECT_EQ(row["views"], 1u << i);
        EXPECT_EQ(finitePositive(row["ownMs"]), i > 0) << row;
        if (i > 0) {
            EXPECT_GT(row["vertices"], scene["views"][i - 1]["vertices"]) << "every view has its own";
        }
    }
    EXPECT_NE(out.find("## A scene of different characters, 3 of each"), std::string::npos) << out;
}

TEST_F(Bench, QuickRunIsWhole) {
    const std::vector<Expected> cages = expectedCages();
    const Outcome outcome = runOnDevice(kQuick + " --json quick.json --plots plots");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json result = Json::parse(readText(file("quick.json")), nullptr, false);
    ASSERT_TRUE(result.is_object());
    for (const char* key : {"device", "driver", "driverInfo", "cpu"}) {
        EXPECT_FALSE(result["machine"][key].get<std::string>().empty()) << key;
        EXPECT_NE(outcome.out.find(result["machine"][key].get<std::string>()), std::string::npos) << key;
    }

    const bool cpuPeer = result["peers"]["OpenSubdiv CPU"].get<std::string>().find("not ") == std::string::npos;
    const bool avx2 = result["peers"]["AVX2"].get<std::string>().find("not ") == std::string::npos;
    const bool hasGlsl = result["peers"]["OpenSubdiv GLSL"].get<std::string>().find("OpenGL 4") != std::string::npos;
#ifdef SUPPLE_HAS_OPENSUBDIV
    EXPECT_TRUE(cpuPeer);
#endif
    for (const auto& [peer, what] : result["peers"].items()) { // what is missing is said
        EXPECT_NE(outcome.out.find(peer + ": " + what.get<std::string>()), std::string::npos) << peer;
    }
    EXPECT_EQ(result["complete"], true);
    EXPECT_EQ(outcome.out.find("man_casual_quads: not there") == std::string::npos, cages.size() == 6) << outcome.out;
    EXPECT_EQ(result["leftOut"].size(), 6 - cages.size());
    const size_t classical = cages.size() == 6 ? 3 : 2;
    const size_t limits = cages.size() + 1; // `triangles` also by Loop's rules
    size_t agreements =
        5 + 2 * classical + (avx2 ? 1 : 0) + (cpuPeer ? 2 * limits : 0) + (cpuPeer && hasGlsl ? 2 * limits : 0);
    EXPECT_EQ(result["agreement"].size(), agreements);
    for (const Json& one : result["agreement"]) {
        EXPECT_LE(one["difference"].get<double>(), one["bound"].get<double>()) << one["what"];
    }

    EXPECT_EQ(result["classical"].size(), classical);
#ifdef SUPPLE_WITH_CPU
    ASSERT_EQ(result["points"].size(), 2u);
    for (const Json& row : result["points"]) {
        EXPECT_EQ(row["points"], 500);
        EXPECT_GT(row["nsAPoint"].get<double>(), 0.0);
    }
    EXPECT_NE(outcome.out.find("## Points on surfaces"), std::string::npos);
    ASSERT_EQ(result["queries"].size(), 4u);
    for (const Json& row : result["queries"]) {
        EXPECT_GT(row["queriesMs"].get<double>(), 0.0) << row;
        EXPECT_GT(row["cpuOverQueries"].get<double>(), 0.0) << row;
    }
    EXPECT_NE(outcome.out.find("## Queries"), std::string::npos);
#else
    EXPECT_TRUE(result["points"].empty());
    EXPECT_TRUE(result["queries"].empty());
#endif
    ASSERT_EQ(result["rows"].size(), cages.size());
    for (size_t i = 0; i < cages.size(); ++i) {
        const Expected& expected = cages[i];
        const Json& row = result["rows"][i];
        SCOPED_TRACE(expected.cage);
        EXPECT_EQ(row["cage"], expected.cage);
        EXPECT_EQ(row["faces"], expected.faces);
        EXPECT_EQ(row["rate"], 8);
        const bool mixed = expected.cage == std::string("pip"); // OpenSubdiv's Loop takes triangles alone
        EXPECT_EQ(row["refused"].size(), mixed && cpuPeer ? 1 : 0) << row["refused"];
        std::set<std::string> contestants{"plain C++ bi-3", "write 24 B"}, ratios;
        if (avx2) {
            contestants.insert("AVX2 bi-3");
            ratios.insert({"plain C++ bi-3 / AVX2 bi-3", "AVX2 bi-3 / write 24 B"});
        }
        for (const std::string& scheme : expected.schemes) {
            contestants.insert({scheme + " evaluate", scheme + " frame"});
            ratios.insert({scheme + " frame / " + scheme + " evaluate", scheme + " evaluate / plain C++ bi-3",
                           scheme + " frame / plain C++ bi-3"});
            if (scheme != "fragments" || !mixed) { // the CPU has none where creases end inside
                contestants.insert(scheme + " CPU");
                ratios.insert(scheme + " CPU / " + scheme + " evaluate");
            }
            if (scheme != "fragments" && scheme != "blend") {
                contestants.insert({scheme + " shared evaluate", scheme + " shared frame"});
                ratios.insert({scheme + " shared evaluate / " + scheme + " evaluate",
                               scheme + " shared evaluate / plain C++ bi-3"});
            }
        }
        if (expected.bothFormats) {
            contestants.insert({"prep evaluate 24 B", "prep frame 24 B"});
        }
        for (const std::string& job : peerJobs(cpuPeer, hasGlsl)) {
            contestants.insert("OpenSubdiv " + job);
            for (const char* scheme : {"pm", "catmull-clark", "fragments"}) {
                ratios.insert(scheme + (" evaluate / OpenSubdiv " + job));
            }
            if (expected.cage == std::string("triangles")) {
                contestants.insert("OpenSubdiv Loop " + job);
                ratios.insert("loop evaluate / OpenSubdiv Loop " + job);
            }
        }
        EXPECT_EQ(names(row["contestants"]), contestants);
        const std::set<std::string> measured = names(row["ratios"]);
        EXPECT_TRUE(std::includes(measured.begin(), measured.end(), ratios.begin(), ratios.end())) << row["ratios"];
        for (const Json& contestant : row["contestants"]) {
            EXPECT_TRUE(finitePositive(contestant["points"])) << contestant;
            EXPECT_TRUE(finitePositive(contestant["cpuNanosecondsPerPoint"])) << contestant;
            EXPECT_TRUE(finitePositive(contestant["wallNanosecondsPerPoint"])) << contestant;
            const std::string name = contestant["name"];
            const bool device = name.find(" evaluate") != std::string::npos || name.find(" frame") != std::string::npos;
            EXPECT_EQ(finitePositive(contestant["gpuNanosecondsPerPoint"]), device) << contestant;
        }
        for (const Json& ratio : row["ratios"]) {
            EXPECT_TRUE(finitePositive(ratio["median"])) << ratio;
            EXPECT_LE(ratio["least"].get<double>(), ratio["median"].get<double>()) << ratio;
            EXPECT_GE(ratio["largest"].get<double>(), ratio["median"].get<double>()) << ratio;
        }
    }

    std::set<std::string> loaded, expectedLoads, compiled;
    for (const Expected& expected : cages) {
        for (const std::string& scheme : expected.schemes) {
            expectedLoads.insert(std::string(expected.cage) + " " + scheme);
        }
    }
    for (const Json& loading : result["loading"]) {
        loaded.insert(loading["cage"].get<std::string>() + " " + loading["scheme"].get<std::string>());
        for (const auto& [key, value] : loading.items()) {
            EXPECT_TRUE(value.is_string() || finitePositive(value)) << key << " of " << loading;
        }
        EXPECT_GE(loading["untilDoneUsPerFace"], loading["untilRecordedUsPerFace"]);
    }
    EXPECT_EQ(loaded, expectedLoads);
    for (const Json& scheme : result["pipelines"]) {
        compiled.insert(scheme["scheme"].get<std::string>() + ", " + scheme["use"].get<std::string>());
        EXPECT_GT(scheme["count"], 4);
        EXPECT_EQ(scheme["count"], scheme["pipelines"].size());
        EXPECT_EQ(scheme["createdWhileRecording"], 0);
        for (const Json& pipeline : scheme["pipelines"]) {
            EXPECT_TRUE(finitePositive(pipeline["spirvBytes"])) << pipeline;
            EXPECT_TRUE(finitePositive(pipeline["coldMs"])) << pipeline;
            EXPECT_TRUE(finitePositive(pipeline["warmMs"])) << pipeline;
        }
    }
    std::set<std::string> uses;
    for (const std::string scheme : {"prep", "pm", "catmull-clark", "fragments", "loop", "blend"}) {
        uses.insert(scheme + ", ");
    }
    uses.insert("prep, in a view");
    EXPECT_EQ(compiled, uses);
    expectScene(result["scene"], outcome.out);
    EXPECT_FALSE(result["targets"].empty());
    EXPECT_FALSE(std::filesystem::exists(file("plots/bench_sphere_points.svg"))) << "one rate makes no line";
}

TEST_F(Bench, TheClassicalPathHasAsManyTriangles) {
    const Outcome outcome = runOnDevice(kQuick + " --cages none --crowd 2 --no-loading --json classical.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json result = Json::parse(readText(file("classical.json")), nullptr, false);
    ASSERT_TRUE(result.is_object());
    ASSERT_EQ(result["classical"].size(), 1u);
    const Json& row = result["classical"][0];
    const uint64_t faces = 1350, rate = 4;
    EXPECT_EQ(row["cage"], "crowd");
    EXPECT_EQ(row["rate"], rate);
    EXPECT_EQ(row["characters"], 2);
    EXPECT_EQ(row["triangles"], 2 * rate * rate * faces);
    EXPECT_TRUE(row["refused"].empty());
    EXPECT_TRUE(finitePositive(row["skinAloneMs"]) && finitePositive(row["skinAloneCpuMs"])) << row;
    EXPECT_EQ(names(row["contestants"]),
              (std::set<std::string>{"polygons", "prep", "prep shared", "pm", "pm shared", "catmull-clark",
                                     "catmull-clark shared", "fragments", "blend"}));
    for (const Json& one : row["contestants"]) {
        // A closed mesh of quads has as many vertices as faces, and two more.
        EXPECT_EQ(one["skinnedVertices"], (one["name"] == "polygons" ? rate * rate * faces : faces) + 2) << one;
        for (const char* key : {"frameMs", "frameCpuMs", "loadedBytes", "characterBytes", "poseBytes", "fileBytes"}) {
            EXPECT_TRUE(finitePositive(one[key])) << key << " of " << one;
        }
        EXPECT_EQ(one["poseBytes"], row["contestants"][0]["poseBytes"]) << "both have the same joints";
    }
    EXPECT_EQ(row["ratios"].size(), 2 * (row["contestants"].size() - 1));
    for (const Json& ratio : row["ratios"]) {
        EXPECT_TRUE(finitePositive(ratio["least"])) << ratio;
        EXPECT_LE(ratio["least"].get<double>(), ratio["median"].get<double>()) << ratio;
        EXPECT_GE(ratio["largest"].get<double>(), ratio["median"].get<double>()) << ratio;
    }
    EXPECT_NE(outcome.out.find("crowd, rate 4: 2 characters of 43200 triangles, 1350 faces, 64 joints"),
              std::string::npos)
        << outcome.out;
}

/// p-rep's, which has fan records too. The command compares the bits of all ways.
TEST_F(Bench, KernelsAreMeasuredByClass) {
    const Outcome outcome =
        runOnDevice(kQuick + " --cages none --crowd 0 --no-loading --schemes prep --kernels 2 --json kernels.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json result = Json::parse(readText(file("kernels.json")), nullptr, false);
    ASSERT_TRUE(result.is_object());
    std::map<std::string, uint32_t> patches;
    for (const Json& row : result["kernels"]) {
        patches[row["class"].get<std::string>() + " of " + row["cage"].get<std::string>()] = row["patches"];
        EXPECT_EQ(row["rate"], 4);
        EXPECT_EQ(row["characters"], 2);
        EXPECT_EQ(row["vertices"], 2 * 25 * row["patches"].get<uint32_t>());
        std::vector<std::string> ways;
        for (const Json& way : row["ways"]) {
            ways.push_back(way["way"]);
            EXPECT_EQ(way.contains("frameNs"), row["class"] == "all") << way;
            EXPECT_TRUE(finitePositive(way["firstFrameMs"])) << way;
            for (const char* key : {"evaluateNs", "evaluateRatio", "frameNs", "frameRatio"}) {
                if (way.contains(key)) {
                    EXPECT_TRUE(finitePositive(way[key]["least"])) << way;
                    EXPECT_LE(way[key]["least"], way[key]["median"]) << way;
                    EXPECT_LE(way[key]["median"], way[key]["largest"]) << way;
                }
            }
        }
        EXPECT_EQ(ways, (std::vector<std::string>{"wide", "wide, fan records", "narrow", "narrow, fan records"}));
    }
    EXPECT_EQ(patches, (std::map<std::string, uint32_t>{
                           {"all of crowd", 1350}, {"regular of regular", 1296}, {"perturbed of irregular", 1296}}));
    EXPECT_NE(outcome.out.find("## Evaluation by classes of patches"), std::string::npos) << outcome.out;
}

TEST_F(Bench, CrowdGoesFromPoseToVertices) {
    const Outcome outcome = runOnDevice(kQuick + " --cages none --crowd 3 --json crowd.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json result = Json::parse(readText(file("crowd.json")), nullptr, false);
    ASSERT_TRUE(result.is_object());
    const Json& crowd = result["crowd"];
    EXPECT_EQ(crowd["faces"], 1350);
    EXPECT_NE(outcome.out.find("## Crowd: the sphere of 1350 faces"), std::string::npos) << outcome.out;
    std::set<std::string> rows;
    for (const Json& row : crowd["rows"]) {
        rows.insert(row["scheme"].get<std::string>() + " " + row["rate"].dump() + " " + row["characters"].dump());
        const uint64_t rate = row["rate"], characters = row["characters"];
        EXPECT_EQ(row["vertices"], 1350 * (rate + 1) * (rate + 1) * characters);
        EXPECT_TRUE(finitePositive(row["evaluateMs"]) && finitePositive(row["frameMs"])) << row;
        for (const char* key : {"evaluateGigabytesPerSecond", "fillGigabytesPerSecond", "storeGigabytesPerSecond"}) {
            EXPECT_EQ(row.contains(key) && finitePositive(row[key]), characters > 1) << row;
        }
        if (characters > 1) {
            const Json& share = row["bandwidthShare"];
            EXPECT_TRUE(finitePositive(share["least"])) << row;
            EXPECT_LE(share["least"].get<double>(), share["median"].get<double>()) << row;
            EXPECT_GE(share["largest"].get<double>(), share["median"].get<double>()) << row;
        }
    }
    EXPECT_EQ(rows, (std::set<std::string>{"prep 4 3", "prep 8 1", "pm 4 3", "pm 8 1"}));
    const Outcome none = runOnDevice(kQuick + " --cages none --json none.json");
    ASSERT_EQ(none.exitCode, 0) << none.err;
    EXPECT_FALSE(Json::parse(readText(file("none.json")), nullptr, false).contains("crowd"));
    expectFailure(run("bench --crowd -1"), 2, "--crowd");
}

/// A result with one ratio, as far as --check looks.
std::string resultWith(double median) {
    const Json ratios = {{{"name", "prep evaluate / AVX2 bi-3"},
                          {"of", "prep evaluate"},
                          {"over", "AVX2 bi-3"},
                          {"yardstick", true},
                          {"median", median}}};
    const Json row = {{"cage", "sphere"}, {"faces", 1350},           {"rate", 8}, {"contestants", Json::array()},
                      {"ratios", ratios}, {"refused", Json::array()}};
    return Json{
        {"machine",
         {{"device", "d"}, {"driver", "r"}, {"driverInfo", ""}, {"mapping", "auto"}, {"cpu", ""}, {"threads", 2}}},
        {"rounds", 3},
        {"peers", Json::object()},
        {"agreement", Json::array()},
        {"rows", {row}},
        {"loading", Json::array()},
        {"pipelines", Json::array()},
        {"targets", Json::array()}}
        .dump();
}

TEST_F(Bench, CheckComparesWithAStoredResult) {
    writeText(file("stored.json"), resultWith(4.0));
    writeText(file("better.json"), resultWith(3.0));
    writeText(file("worse.json"), resultWith(4.7));
    const Outcome better = run("bench --from better.json --check stored.json");
    EXPECT_EQ(better.exitCode, 0) << better.err;
    const Outcome worse = run("bench --from worse.json --check stored.json");
    EXPECT_EQ(worse.exitCode, 1);
    EXPECT_NE(worse.err.find("sphere, rate 8: prep evaluate / AVX2 bi-3: 4.7, was 4"), std::string::npos) << worse.err;
    EXPECT_NE(worse.out.find("REGRESSION sphere, rate 8"), std::string::npos) << worse.out;
    writeText(
        file("empty.json"),
        Json::parse(resultWith(4.0)).patch(Json::parse(R"([{"op": "replace", "path": "/rows", "value": []}])")).dump());
    const Outcome missing = run("bench --from empty.json --check stored.json");
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_NE(missing.err.find("not measured"), std::string::npos) << missing.err;
}

TEST_F(Bench, CheckRefusesWhatCannotBeCompared) {
    const auto stored = [&](const char* name, const char* patch) {
        writeText(file(name), Json::parse(resultWith(4.0)).patch(Json::parse(patch)).dump());
    };
    writeText(file("now.json"), resultWith(4.0));
    stored("empty.json", R"([{"op": "replace", "path": "/rows", "value": []}])");
    stored("early.json", R"([{"op": "add", "path": "/complete", "value": false}])");
    stored("device.json", R"([{"op": "replace", "path": "/machine/device", "value": "e"}])");
    stored("mapping.json", R"([{"op": "replace", "path": "/machine/mapping", "value": "wide"}])");
    stored("rounds.json", R"([{"op": "replace", "path": "/rounds", "value": 7}])");
    expectFailure(run("bench --from now.json --check empty.json"), 1, "nothing was compared");
    expectFailure(run("bench --from now.json --check early.json"), 1,
                  "early.json: cannot be checked against: it is not");
    expectFailure(run("bench --from now.json --check device.json"), 1, "of another device: e, not d");
    expectFailure(run("bench --from now.json --check mapping.json"), 1, "of another mapping: wide, not auto");
    const Outcome rounds = run("bench --from now.json --check rounds.json");
    EXPECT_EQ(rounds.exitCode, 0) << rounds.err;
    EXPECT_NE(rounds.err.find("rounds: 7 in the stored result, 3 in this one"), std::string::npos) << rounds.err;
    // Before anything is measured.
    const Outcome measured = runOnDevice("bench --cages none --check now.json");
    EXPECT_EQ(measured.exitCode, 1);
    EXPECT_NE(measured.err.find("of another device: d"), std::string::npos) << measured.err;
    EXPECT_EQ(measured.out, "");
}

TEST_F(Bench, RefusesWhatIsNoResult) {
    writeText(file("no.json"), "{");
    writeText(file("other.json"), "{}");
    expectFailure(run("bench --check no.json"), 1, "no.json: is no JSON");
    expectFailure(run("bench --check other.json"), 1, "other.json: is no result of supple bench");
    expectFailure(run("bench --from missing.json"), 1, "missing.json: cannot be opened");
    expectFailure(run("bench --cages cow"), 2, "cow is none of");
    expectFailure(run("bench missing.glb --cages none"), 1, "missing.glb");
}

} // namespace
