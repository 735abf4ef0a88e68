// Plots of a result as SVG.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

/// Lines over rates, which stand at equal distances.
struct LinePlot {
    struct Line {
        std::string name;
        std::vector<double> values; ///< one a label; not finite: no point there
    };
    std::string title, yTitle;
    std::vector<std::string> labels; ///< of the x axis
    std::vector<Line> lines;
    bool logarithmic = false; ///< the y axis
};
[[nodiscard]] std::string toSvg(const LinePlot& plot);

struct Picture {
    std::string fileName, svg;
};
/// Two a cage: what a point costs, and how much dearer a whole frame is. None for a cage measured at one rate.
[[nodiscard]] std::vector<Picture> plotsOf(const nlohmann::ordered_json& result);

} // namespace supple::bench
