#include "tools/bench/targets.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

struct RatioTarget {
    const char* name;
    const char* cage;  ///< empty: any
    const char* value; ///< of the rounds: "median" or "largest"
    double limits[4];  ///< at rates 4, 8, 16, 32; 0: none
};

constexpr RatioTarget kRatios[] = {
    {"prep evaluate / AVX2 bi-3", "sphere", "median", {4.7, 4.7, 4.7, 4.7}},
    {"prep evaluate / AVX2 bi-3", "sphere", "largest", {7.5, 7.5, 7.5, 7.5}},
    {"prep shared evaluate / AVX2 bi-3", "sphere", "median", {4.0, 4.0, 4.0, 4.0}},
    {"pm evaluate / AVX2 bi-3", "sphere", "median", {4.7, 4.7, 4.7, 4.7}},
    {"pm evaluate / AVX2 bi-3", "sphere", "largest", {7.5, 7.5, 7.5, 7.5}},
    {"pm shared evaluate / AVX2 bi-3", "sphere", "median", {4.0, 4.0, 4.0, 4.0}},
    {"prep evaluate / OpenSubdiv CPU, limit stencils", "", "median", {0.10, 0.10, 0.10, 0.10}},
    {"prep evaluate / OpenSubdiv GLSL, limit stencils", "", "median", {0.04, 0.04, 0.04, 0.04}},
    {"pm evaluate / OpenSubdiv CPU, limit stencils", "", "median", {0.10, 0.10, 0.10, 0.10}},
    {"pm evaluate / OpenSubdiv GLSL, limit stencils", "", "median", {0.04, 0.04, 0.04, 0.04}},
    {"prep frame / prep evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
    {"pm frame / pm evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
    {"catmull-clark evaluate / OpenSubdiv CPU, limit stencils", "", "median", {0.15, 0.15, 0.15, 0.15}},
    {"catmull-clark evaluate / OpenSubdiv GLSL, limit stencils", "", "median", {0.05, 0.05, 0.05, 0.05}},
    {"catmull-clark frame / catmull-clark evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
    {"fragments frame / fragments evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
    {"loop frame / loop evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
    {"blend frame / blend evaluate", "", "median", {1.6, 1.25, 1.15, 0}},
};
constexpr uint32_t kRates[] = {4, 8, 16, 32};
constexpr double kLoadMicrosecondsAFace = 5.0, kStaticBytesAFace = 150.0;
constexpr double kBandwidthShare = 0.70, kCrowdMilliseconds = 0.5, kOneCharacterMicroseconds = 40.0;
constexpr double kAroundEvaluate = 0.6;
constexpr double kUnseen = 0.02;
constexpr double kCenters = 1.5;
constexpr uint32_t kCrowd = 1000, kCrowdRate = 4;
struct SceneLimits {
    const char* use;
    double dispatches, barriers;
};
constexpr SceneLimits kSceneLimits[] = {{"rate 4", 40.0, 30.0}, {"view", 80.0, 60.0}};
constexpr double kSceneRecordMicroseconds = 60.0, kSceneAllocations = 12.0, kFurtherView = 0.02;
constexpr double kColdMilliseconds = 500.0, kWarmMilliseconds = 30.0;

/// Those of a GPU.
void judgeCrowd(const Json& crowd, const std::function<void(const char*, const std::string&, double, double)>& atMost,
                Json& targets) {
    for (const Json& row : crowd["rows"]) {
        const uint32_t characters = row["characters"], rate = row["rate"];
        const std::string where = row["scheme"].get<std::string>() + ", rate " + std::to_string(rate);
        if (row.contains("bandwidthShare")) {
            const double share = row["bandwidthShare"]["median"];
            targets.push_back({{"what", "crowd's evaluation / write bandwidth"},
                               {"where", where + ", " + std::to_string(characters) + " characters"},
                               {"value", share},
                               {"limit", kBandwidthShare},
                               {"atLeast", true},
                               {"met", share >= kBandwidthShare}});
        }
        if (characters == kCrowd && rate == kCrowdRate) {
            atMost("1,000 characters, pose to vertices, GPU ms", where, row["frameMs"], kCrowdMilliseconds);
        }
        if (characters == 1) {
            atMost("one character, pose to vertices, GPU us", where, 1e3 * row["frameMs"].get<double>(),
                   kOneCharacterMicroseconds);
        }
    }
}

/// How many different characters a view took, if it was asked for enough.
std::optional<uint32_t> mostInAView(const Json& rows) {
    uint32_t most = 0, asked = 0;
    for (const Json& row : rows) {
        if (row["use"] == "view") {
            asked = std::max(asked, row["characters"].get<uint32_t>());
            most = std::max(most, row.contains("refused") ? 0 : row["characters"].get<uint32_t>());
        }
    }
    return asked >= kSceneCharacters ? std::optional(most) : std::nullopt;
}

void judgeScene(const Json& scene,
                const std::function<void(const std::string&, const std::string&, double, double)>& atMost,
                Json& targets) {
    if (const std::optional<uint32_t> most = mostInAView(scene["rows"])) {
        targets.push_back({{"what", "different characters in a view"},
                           {"where", "scene"},
                           {"value", *most},
                           {"limit", kSceneCharacters},
                           {"atLeast", true},
                           {"met", *most >= kSceneCharacters}});
    }
    const std::string count = std::to_string(kSceneCharacters) + " characters: ";
    for (const Json& row : scene["rows"]) {
        const std::string where = row["use"].get<std::string>() + ", " + row["poses"].get<std::string>();
        if (row["characters"] != kSceneCharacters || row.contains("refused")) {
            continue;
        }
        for (const SceneLimits& limits : kSceneLimits) {
            if (row["use"] == limits.use) {
                atMost(count + "dispatches", where, row["dispatches"], limits.dispatches);
                atMost(count + "barriers", where, row["barriers"], limits.barriers);
            }
        }
        if (row["poses"] == "played") { // else poses are sampled while they are recorded
            atMost(count + "recording behind other work, CPU us", where, row["recordBehindWorkUs"],
                   kSceneRecordMicroseconds);
        }
        atMost(count + "allocations", where, row["allocations"], kSceneAllocations);
        if (row.contains("unseenMs")) {
            atMost(count + "all unseen / all seen", where, row["unseenMs"].get<double>() / row["frameMs"].get<double>(),
                   kUnseen);
        }
    }
    for (const Json& row : scene["views"]) {
        if (row["views"] > 1) {
            atMost("further views: passes beside levels and vertices / these", row["views"].dump() + " views",
                   row["repeatedMs"].get<double>() / row["ownMs"].get<double>(), kFurtherView);
        }
    }
}

} // namespace

Json judge(const Json& result) {
    Json targets = Json::array();
    const auto add = [&](const std::string& what, const std::string& where, double value, double limit) {
        targets.push_back(
            {{"what", what}, {"where", where}, {"value", value}, {"limit", limit}, {"met", value <= limit}});
    };
    if (result.value("cpuDevice", false)) {
        for (const RatioTarget& target : kRatios) {
            for (const Json& row : result["rows"]) {
                for (size_t r = 0; r < std::size(kRates); ++r) {
                    if (row["rate"] != kRates[r] || target.limits[r] == 0.0 ||
                        (*target.cage != '\0' && row["cage"] != target.cage)) {
                        continue;
                    }
                    for (const Json& ratio : row["ratios"]) {
                        if (ratio["name"] == target.name) {
                            add(ratio["name"].get<std::string>() +
                                    (std::string(target.value) == "largest" ? ", worst round" : ""),
                                row["cage"].get<std::string>() + ", rate " + std::to_string(kRates[r]),
                                ratio[target.value], target.limits[r]);
                        }
                    }
                }
            }
        }
    }
    if (!result.value("cpuDevice", false) && result.contains("crowd")) {
        judgeCrowd(result["crowd"], add, targets);
    }
    for (const Json& row : result.value("views", Json::array())) {
        add("level, place and attributes / evaluate, in a view", row["scheme"], row["aroundEvaluate"], kAroundEvaluate);
        add("frame with as many more unseen / without them, in a view", row["scheme"],
            row["besideCulledMs"].get<double>() / row["aloneMs"].get<double>(), 1.0 + kUnseen);
        add("frame with all unseen / with all seen, in a view", row["scheme"],
            row["unseenMs"].get<double>() / row["frameMs"].get<double>(), kUnseen);
    }
    for (const Json& row : result.value("skinning", Json::array())) {
        for (const Json& way : row["ways"]) {
            if (way["skinning"] == "centers") {
                add("centers of rotation / dual quaternions, deform pass", row["cage"], way["overDualQuaternions"],
                    kCenters);
            }
        }
    }
    if (result.contains("scene")) {
        judgeScene(result["scene"], add, targets);
    }
    for (const Json& loading : result["loading"]) {
        const std::string scheme = loading["scheme"], where = loading["cage"].get<std::string>() + ", " + scheme;
        add("load until the first frame is recorded, us a face", where, loading["untilRecordedUsPerFace"],
            kLoadMicrosecondsAFace);
        add("load until the first frame is done, us a face", where, loading["untilDoneUsPerFace"],
            kLoadMicrosecondsAFace);
        if (scheme == "prep" || scheme == "pm") {
            add("static device data, bytes a face", where, loading["staticBytesPerFace"], kStaticBytesAFace);
        }
    }
    for (const Json& pipelines : result["pipelines"]) {
        const std::string use = pipelines["use"];
        const std::string scheme = pipelines["scheme"].get<std::string>() + (use.empty() ? "" : " " + use);
        // As with ratios: on CPU devices other load of the machine does not count.
        const bool cpu = result.value("cpuDevice", false);
        const std::string unit = cpu ? "CPU ms" : "ms";
        add("pipelines created cold, " + unit, scheme, pipelines[cpu ? "coldCpuMs" : "coldMs"], kColdMilliseconds);
        add("pipelines created with a warm cache, " + unit, scheme, pipelines[cpu ? "warmCpuMs" : "warmMs"],
            kWarmMilliseconds);
        add("pipelines created while recording", scheme, pipelines["createdWhileRecording"], 0.0);
    }
    return targets;
}

} // namespace supple::bench
