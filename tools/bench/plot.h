// Plots of a result as SVG.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct Picture {
    std::string fileName, svg;
};
/// Two a cage: what a point costs, and how much dearer a whole frame is. None for a cage measured at one rate.
[[nodiscard]] std::vector<Picture> plotsOf(const nlohmann::ordered_json& result);

} // namespace supple::bench
