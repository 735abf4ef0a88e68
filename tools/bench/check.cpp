#include "tools/bench/check.h"

#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

const Json* find(const Json& result, const Json& row, const Json& ratio) {
    for (const Json& other : result["rows"]) {
        for (const Json& candidate : other["ratios"]) {
            if (other["cage"] == row["cage"] && other["rate"] == row["rate"] && candidate["name"] == ratio["name"]) {
                return &candidate;
            }
        }
    }
    return nullptr;
}

std::string change(double before, double after) {
    char text[96];
    std::snprintf(text, sizeof text, "%.3g, was %.3g (%+.0f %%)", after, before, 100.0 * (after / before - 1.0));
    return text;
}

/// The lines of ratios over yardsticks; how many were compared.
size_t compareRatios(const Json& stored, const Json& now, std::vector<std::string>& lines) {
    size_t compared = 0;
    for (const Json& row : stored["rows"]) {
        const std::string where = row["cage"].get<std::string>() + ", rate " + row["rate"].dump() + ": ";
        struct Growth {
            double factor = 0.0, before = 0.0, after = 0.0;
            std::string over;
        };
        std::map<std::string, Growth> least; // by contestant
        for (const Json& ratio : row["ratios"]) {
            if (!ratio.value("yardstick", false)) {
                continue;
            }
            const Json* current = find(now, row, ratio);
            if (current == nullptr) {
                lines.push_back(where + ratio["name"].get<std::string>() + ": not measured");
                continue;
            }
            ++compared;
            const double before = ratio["median"], after = (*current)["median"];
            const auto [entry, first] = least.try_emplace(ratio["of"]);
            if (first || after / before < entry->second.factor) {
                entry->second = {after / before, before, after, ratio["over"]};
            }
        }
        for (const auto& [name, growth] : least) {
            if (growth.factor > kRegression) {
                lines.push_back(where + name + " / " + growth.over + ": " + change(growth.before, growth.after));
            }
        }
    }
    return compared;
}

/// By what it is of, one value a row of a list.
std::map<std::string, double> valuesOf(const Json& rows, std::initializer_list<const char*> names,
                                       const std::function<Json(const Json&)>& valueOf) {
    std::map<std::string, double> values;
    for (const Json& row : rows) {
        const Json value = valueOf(row);
        std::string of;
        for (const char* const name : names) {
            const Json part = row.value(name, Json());
            const std::string text = part.is_string() ? part.get<std::string>() : name + (" " + part.dump());
            of += (of.empty() || text.empty() ? "" : ", ") + text;
        }
        if (value.is_number() && value.get<double>() > 0.0) {
            values.emplace(of, value.get<double>());
        }
    }
    return values;
}

/// What evaluation of a crowd reaches of the write bandwidth, where crowds are judged.
std::map<std::string, double> sharesOf(const Json& result) {
    if (result.value("cpuDevice", false) || !result.contains("crowd")) {
        return {};
    }
    return valuesOf(
        result["crowd"].value("rows", Json::array()), {"scheme", "rate", "characters"},
        [](const Json& row) { return row.value("bandwidthShare", Json::object()).value("median", Json()); });
}

std::map<std::string, double> staticBytesOf(const Json& result) {
    return valuesOf(result.value("loading", Json::array()), {"cage", "scheme"},
                    [](const Json& row) { return row.value("staticBytesPerFace", Json()); });
}

/// Calls for everything that both have.
void forBoth(const std::map<std::string, double>& stored, const std::map<std::string, double>& now,
             const std::function<void(const std::string& of, double before, double after)>& visit) {
    for (const auto& [of, before] : stored) {
        if (const auto after = now.find(of); after != now.end()) {
            visit(of, before, after->second);
        }
    }
}

} // namespace

std::string whyNoCheck(const Json& stored, const std::string& device, const std::string& mapping) {
    if (!stored.value("complete", true)) {
        return "it is not complete: the run ended early";
    }
    const Json& machine = stored["machine"];
    for (const auto& [what, here] : {std::pair("device", &device), std::pair("mapping", &mapping)}) {
        if (const std::string there = machine.value(what, ""); there != *here) {
            return std::string("it is of another ") + what + ": " + there + ", not " + *here;
        }
    }
    const std::vector<std::string> lines = findRegressions(stored, stored);
    return lines.empty() ? "" : lines.front();
}

std::vector<std::string> otherSettings(const Json& stored, const Json& now) {
    std::vector<std::string> lines;
    for (const char* const what : {"rounds", "quick"}) {
        // Results of earlier versions do not say whether they were quick.
        if (stored.contains(what) && now.contains(what) && stored[what] != now[what]) {
            lines.push_back(std::string(what) + ": " + stored[what].dump() + " in the stored result, " +
                            now[what].dump() + " in this one");
        }
    }
    return lines;
}

std::vector<std::string> firstFrames(const Json& stored, const Json& now) {
    const std::pair<const char*, const char*> kinds[] = {{"first frame", "coldFirstFrameMs"},
                                                         {"first frame after a warm-up", "preparedFirstFrameMs"}};
    std::vector<std::string> lines;
    for (const auto& [name, key] : kinds) {
        const auto of = [&, key = key](const Json& result) {
            return valuesOf(result.value("pipelines", Json::array()), {"scheme", "use"},
                            [&](const Json& row) { return row.value(key, Json()); });
        };
        const std::map<std::string, double> before = of(stored);
        for (const auto& [what, after] : of(now)) {
            char text[160];
            std::snprintf(text, sizeof text, "%.0f ms", after);
            const auto known = before.find(what);
            lines.push_back(what + ": " + name + ": " + text);
            if (known != before.end()) {
                std::snprintf(text, sizeof text, ", was %.0f", known->second);
                lines.back() += text;
            }
        }
    }
    return lines;
}

std::vector<std::string> findRegressions(const Json& stored, const Json& now) {
    std::vector<std::string> lines;
    size_t compared = compareRatios(stored, now, lines);
    forBoth(sharesOf(stored), sharesOf(now), [&](const std::string& of, double before, double after) {
        ++compared;
        if (after / before < 2.0 - kRegression) {
            lines.push_back("crowd, " + of + ": share of the write bandwidth: " + change(before, after));
        }
    });
    forBoth(staticBytesOf(stored), staticBytesOf(now), [&](const std::string& of, double before, double after) {
        if (after / before > kRegression) {
            lines.push_back(of + ": static device data, bytes a face: " + change(before, after));
        }
    });
    if (compared == 0 && lines.empty()) {
        lines.emplace_back("nothing was compared: the results have no ratio over a yardstick in common, nor on a GPU "
                           "the share of a crowd");
    }
    return lines;
}

} // namespace supple::bench
