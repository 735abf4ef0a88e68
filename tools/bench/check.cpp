#include "tools/bench/check.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

const Json* find(const Json& result, const Json& cage, const Json& rate, const Json& name) {
    for (const Json& row : result["rows"]) {
        for (const Json& ratio : row["ratios"]) {
            if (row["cage"] == cage && row["rate"] == rate && ratio["name"] == name) {
                return &ratio;
            }
        }
    }
    return nullptr;
}

} // namespace

std::vector<std::string> findRegressions(const Json& stored, const Json& now) {
    std::vector<std::string> lines;
    for (const Json& row : stored["rows"]) {
        for (const Json& ratio : row["ratios"]) {
            const std::string where = row["cage"].get<std::string>() + ", rate " + row["rate"].dump() + ": " +
                                      ratio["name"].get<std::string>();
            const Json* current = find(now, row["cage"], row["rate"], ratio["name"]);
            if (current == nullptr) {
                lines.push_back(where + ": not measured");
                continue;
            }
            const double before = ratio["median"], after = (*current)["median"];
            if (!(after <= kRegression * before)) {
                char change[96];
                std::snprintf(change, sizeof change, ": %.3g, was %.3g (%+.0f %%)", after, before,
                              100.0 * (after / before - 1.0));
                lines.push_back(where + change);
            }
        }
    }
    return lines;
}

} // namespace supple::bench
