#include "tools/supple/profile_compare.h"

#include "base/utf8_path.h"
#include "tools/common/formatted.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFrame = "frame";
constexpr size_t kResamples = 4000;
constexpr size_t kNeighbours = 8; ///< frames: neighbours have the same disturbance

double median(std::vector<double> values) {
    return summarize(values).median;
}

struct Interval {
    double middle = 0.0, low = 0.0, high = 0.0;
};
/// The interval of the median. It reaches from one of the values to another, so a few disturbed rounds move nothing.
/// Which values these are follows from the binomial distribution (Thompson 1936).
Interval intervalOfMedian(std::vector<double> values, double confidence) {
    std::sort(values.begin(), values.end());
    const size_t count = values.size();
    double tail = std::exp2(1.0 - static_cast<double>(count)), term = tail;
    size_t from = 0;
    while (from + 1 < count / 2) {
        term *= static_cast<double>(count - from) / static_cast<double>(from + 1);
        tail += term;
        if (tail > 1.0 - confidence) {
            break;
        }
        ++from;
    }
    return {quantile(values, 0.5), values[from], values[count - 1 - from]};
}

/// By percentiles of what `resample` gives. The same numbers give the same interval.
Interval bootstrap(double middle, double confidence, const std::function<double(std::mt19937&)>& resample) {
    std::mt19937 random(1);
    std::vector<double> values(kResamples);
    for (double& value : values) {
        value = resample(random);
    }
    std::sort(values.begin(), values.end());
    return {middle, quantile(values, 0.5 * (1.0 - confidence)), quantile(values, 0.5 * (1.0 + confidence))};
}

size_t any(std::mt19937& random, size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(random);
}

/// As many values again, in blocks of neighbours.
std::vector<double> resampledBlocks(const std::vector<double>& values, std::mt19937& random) {
    const size_t block = std::min(kNeighbours, values.size());
    std::vector<double> some;
    while (some.size() < values.size()) {
        const size_t first = any(random, values.size() - block + 1);
        some.insert(some.end(), values.begin() + static_cast<ptrdiff_t>(first),
                    values.begin() + static_cast<ptrdiff_t>(first + block));
    }
    some.resize(values.size());
    return some;
}

using Series = std::vector<std::vector<double>>; ///< by round

/// Logarithms of factors.
Interval intervalOf(const Series& before, const Series& after, double confidence) {
    if (before.size() >= kLeastRounds && before.size() == after.size()) {
        std::vector<double> changes;
        for (size_t round = 0; round < before.size(); ++round) {
            changes.push_back(std::log(median(after[round]) / median(before[round])));
        }
        return intervalOfMedian(std::move(changes), confidence);
    }
    const auto all = [](const Series& series) {
        std::vector<double> values;
        for (const std::vector<double>& round : series) {
            values.insert(values.end(), round.begin(), round.end());
        }
        return values;
    };
    const std::vector<double> a = all(before), b = all(after);
    return bootstrap(std::log(median(b) / median(a)), confidence, [&](std::mt19937& random) {
        const double divisor = median(resampledBlocks(a, random));
        return std::log(median(resampledBlocks(b, random)) / divisor);
    });
}

/// The times of a pass where frames have it.
Series seriesOf(const MeasuredRun& run, const std::string& pass) {
    Series series;
    for (const MeasuredRound& round : run.rounds) {
        std::vector<double> times;
        const auto found = round.passes.find(pass);
        if (pass == kFrame) {
            times = round.frame;
        } else if (found != round.passes.end()) {
            times = found->second;
        }
        std::erase_if(times, [](double time) { return !(time > 0.0); });
        if (!times.empty()) {
            series.push_back(std::move(times));
        }
    }
    return series;
}

double medianOf(const Series& series) {
    std::vector<double> medians;
    for (const std::vector<double>& round : series) {
        medians.push_back(median(round));
    }
    return median(medians);
}

PassChange changeOf(const std::string& pass, const MeasuredRun& before, const MeasuredRun& after,
                    const CompareRules& rules) {
    const Series a = seriesOf(before, pass), b = seriesOf(after, pass);
    PassChange change;
    change.pass = pass;
    change.before = medianOf(a);
    change.after = medianOf(b);
    if (a.empty() || b.empty()) {
        return change;
    }
    const Interval interval = intervalOf(a, b, rules.confidence);
    const bool paired = a.size() >= kLeastRounds && a.size() == b.size();
    change.change = std::expm1(interval.middle);
    change.low = std::expm1(interval.low);
    change.high = std::expm1(interval.high);
    change.significant = (change.low > 0.0 || change.high < 0.0) &&
                         std::abs(change.change) >= (paired ? rules.floor : rules.floorOfFrames) &&
                         std::max(change.before, change.after) >= rules.leastMilliseconds;
    return change;
}

std::string nameOf(const Json& run) {
    std::string name;
    const std::string files = run.value("file", std::string());
    for (size_t begin = 0; begin <= files.size();) { // "a/b.glb + c/d.glb": a build server has other folders
        const size_t end = std::min(files.find(" + ", begin), files.size());
        name += (name.empty() ? "" : " + ") + utf8Text(utf8Path(files.substr(begin, end - begin)).filename());
        begin = end + 3;
    }
    name += ", " + run.value("scheme", std::string());
    if (run.contains("view")) {
        name += ", view of " + run["view"].value("budget", Json()).dump() + " vertices";
    } else {
        name += ", rate " + run.value("rate", Json()).dump();
    }
    const std::string instances = run.value("instances", Json()).dump();
    return name + ", " + instances + (instances == "1" ? " instance" : " instances") +
           (run.value("playback", false) ? ", playback" : "");
}

/// Times of passes: 0, or between a femtosecond and a week. What is none of these comes from no measurement.
Result<std::vector<double>> timesOf(const Json& array, const std::string& where) {
    constexpr double kLeast = 1e-12, kMost = 6e8;
    std::vector<double> times;
    for (const Json& number : array) {
        const double time = number.is_number() ? number.get<double>() : -1.0;
        if (!(time == 0.0 || (time >= kLeast && time <= kMost))) {
            return Error{ErrorCode::asset, where + ": has " + number.dump().substr(0, 40) + " among its times"};
        }
        times.push_back(time);
    }
    return times;
}

Result<MeasuredRun> measuredRun(const Json& entry, const std::string& device, const std::string& where) {
    const Json& samples = entry.at("samples");
    MeasuredRun run;
    run.name = nameOf(entry);
    run.device = device;
    MeasuredRound round;
    Result<std::vector<double>> frame = timesOf(samples.at("frameMs"), where);
    if (!frame) {
        return frame.error();
    }
    if (frame->empty()) {
        return Error{ErrorCode::asset, where + ": has a run without frames"};
    }
    round.frame = std::move(*frame);
    for (const auto& [pass, array] : samples.at("passMs").items()) {
        Result<std::vector<double>> times = timesOf(array, where);
        if (!times) {
            return times.error();
        }
        run.passes.push_back(pass);
        round.passes[pass] = std::move(*times);
    }
    run.rounds.push_back(std::move(round));
    return run;
}

} // namespace

Result<std::vector<MeasuredRun>> measuredRuns(const Json& result, const std::string& where) {
    if (!result.is_object() || !result.contains("runs") || !result["runs"].is_array()) {
        return Error{ErrorCode::asset, where + ": is not a result of supple profile --json"};
    }
    std::vector<MeasuredRun> runs;
    try { // members of other types than ours
        const std::string device = result.value("machine", Json::object()).value("device", std::string());
        for (const Json& entry : result["runs"]) {
            if (!entry.is_object() || !entry.contains("samples")) {
                return Error{ErrorCode::asset,
                             where + ": has no times of its frames (an older supple profile wrote it)"};
            }
            Result<MeasuredRun> run = measuredRun(entry, device, where);
            if (!run) {
                return run.error();
            }
            addRounds(runs, {std::move(*run)});
        }
    } catch (const Json::exception&) {
        return Error{ErrorCode::asset, where + ": is not a result of supple profile --json"};
    }
    return runs;
}

void addRounds(std::vector<MeasuredRun>& runs, std::vector<MeasuredRun> more) {
    for (MeasuredRun& run : more) {
        const auto known =
            std::find_if(runs.begin(), runs.end(), [&](const MeasuredRun& r) { return r.name == run.name; });
        if (known == runs.end()) {
            runs.push_back(std::move(run));
            continue;
        }
        for (const std::string& pass : run.passes) {
            if (std::find(known->passes.begin(), known->passes.end(), pass) == known->passes.end()) {
                known->passes.push_back(pass);
            }
        }
        known->rounds.insert(known->rounds.end(), run.rounds.begin(), run.rounds.end());
    }
}

std::vector<RunChange> compareRuns(const std::vector<MeasuredRun>& before, const std::vector<MeasuredRun>& after,
                                   const CompareRules& rules) {
    std::vector<RunChange> changes;
    for (const MeasuredRun& run : after) {
        RunChange& change = changes.emplace_back();
        change.name = run.name;
        change.rounds = run.rounds.size();
        const auto old =
            std::find_if(before.begin(), before.end(), [&](const MeasuredRun& r) { return r.name == run.name; });
        if (old == before.end()) {
            continue;
        }
        std::vector<std::string> passes = run.passes;
        for (const std::string& pass : old->passes) {
            if (std::find(passes.begin(), passes.end(), pass) == passes.end()) {
                passes.push_back(pass);
            }
        }
        passes.emplace_back(kFrame);
        for (const std::string& pass : passes) {
            change.passes.push_back(changeOf(pass, *old, run, rules));
        }
    }
    return changes;
}

std::string toTable(const RunChange& run) {
    char line[256];
    std::string table = run.name + ":";
    if (run.passes.empty()) {
        return table + " not in what it is compared with\n";
    }
    if (run.rounds > 1) {
        table += " " + std::to_string(run.rounds) + " rounds";
    }
    table += "\n";
    std::snprintf(line, sizeof line, "  %-12s %10s %10s %9s   %s\n", "pass", "before ms", "after ms", "change",
                  "within, at 99.9 %");
    table += line;
    for (const PassChange& pass : run.passes) {
        if (pass.before == 0.0 || pass.after == 0.0) {
            std::snprintf(line, sizeof line, "  %-12s %10.4f %10.4f   %s\n", pass.pass.c_str(), pass.before, pass.after,
                          pass.before == 0.0 ? "new" : "gone");
        } else {
            std::snprintf(line, sizeof line, "  %-12s %10.4f %10.4f %+8.1f %%  %+.1f .. %+.1f %%%s\n",
                          pass.pass.c_str(), pass.before, pass.after, 100.0 * pass.change, 100.0 * pass.low,
                          100.0 * pass.high,
                          !pass.significant   ? ""
                          : pass.change > 0.0 ? "  SLOWER"
                                              : "  faster");
        }
        table += line;
    }
    return table;
}

std::string verdictOf(const std::vector<RunChange>& runs) {
    std::string slower, faster;
    double largest = 0.0;
    bool any = false;
    for (const RunChange& run : runs) {
        std::string ownSlower, ownFaster;
        for (const PassChange& pass : run.passes) {
            if (pass.before == 0.0 || pass.after == 0.0) {
                continue;
            }
            any = true;
            largest = pass.pass == kFrame ? std::max(largest, std::abs(pass.change)) : largest;
            if (pass.significant) {
                std::string& own = pass.change > 0.0 ? ownSlower : ownFaster;
                own += formatted("%s%s %+.1f %%", own.empty() ? "" : ", ", pass.pass.c_str(), 100.0 * pass.change);
            }
        }
        slower += ownSlower.empty() ? "" : (slower.empty() ? "" : "; ") + run.name + ": " + ownSlower;
        faster += ownFaster.empty() ? "" : (faster.empty() ? "" : "; ") + run.name + ": " + ownFaster;
    }
    if (!any) {
        return "verdict: nothing was compared";
    }
    if (slower.empty() && faster.empty()) {
        return formatted("verdict: no difference; frames differ by at most %.1f %%, which counts as noise",
                         100.0 * largest);
    }
    return "verdict: " + (slower.empty() ? "" : "slower: " + slower) + (slower.empty() || faster.empty() ? "" : "; ") +
           (faster.empty() ? "" : "faster: " + faster);
}

Json toJson(const std::vector<RunChange>& runs) {
    Json json = Json::array();
    for (const RunChange& run : runs) {
        Json entry = {{"run", run.name}, {"rounds", run.rounds}, {"passes", Json::array()}};
        for (const PassChange& pass : run.passes) {
            entry["passes"].push_back({{"pass", pass.pass},
                                       {"beforeMs", pass.before},
                                       {"afterMs", pass.after},
                                       {"change", pass.change},
                                       {"low", pass.low},
                                       {"high", pass.high},
                                       {"significant", pass.significant}});
        }
        json.push_back(std::move(entry));
    }
    return json;
}

std::vector<std::string> slowerThan(const std::vector<RunChange>& runs, double percent) {
    std::vector<std::string> lines;
    for (const RunChange& run : runs) {
        for (const PassChange& pass : run.passes) {
            if (pass.significant && 100.0 * pass.change > percent) {
                char text[64];
                std::snprintf(text, sizeof text, " is %.1f %% slower", 100.0 * pass.change);
                lines.push_back(run.name + ": " + pass.pass + text);
            }
        }
    }
    return lines;
}

} // namespace supple::tools
