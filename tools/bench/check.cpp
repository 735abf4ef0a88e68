#include "tools/bench/check.h"

#include <cstdio>
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

} // namespace

std::vector<std::string> findRegressions(const Json& stored, const Json& now) {
    std::vector<std::string> lines;
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
            const double before = ratio["median"], after = (*current)["median"];
            const auto [entry, first] = least.try_emplace(ratio["of"]);
            if (first || after / before < entry->second.factor) {
                entry->second = {after / before, before, after, ratio["over"]};
            }
        }
        for (const auto& [name, growth] : least) {
            if (growth.factor > kRegression) {
                char change[96];
                std::snprintf(change, sizeof change, "%.3g, was %.3g (%+.0f %%)", growth.after, growth.before,
                              100.0 * (growth.factor - 1.0));
                lines.push_back(where + name + " / " + growth.over + ": " + change);
            }
        }
    }
    return lines;
}

} // namespace supple::bench
