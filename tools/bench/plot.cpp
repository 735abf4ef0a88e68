#include "tools/bench/plot.h"

#include "tools/common/charts.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

using tools::ChartSeries;
using tools::LineChart;

std::vector<Picture> plotsOf(const Json& result) {
    const bool cpu = result.value("cpuDevice", false);
    std::vector<std::string> cages;
    for (const Json& row : result["rows"]) {
        const auto cage = row["cage"].get<std::string>();
        if (std::find(cages.begin(), cages.end(), cage) == cages.end()) {
            cages.push_back(cage);
        }
    }
    std::vector<Picture> pictures;
    for (const std::string& cage : cages) {
        LineChart cost, frame;
        cost.height = frame.height = 440.0;
        cost.title = cage + ": what a point of the surface costs";
        cost.unit = cpu ? "CPU time, ns a point" : "ns a point (device time; wall time on the host)";
        cost.logarithmic = true;
        frame.title = cage + ": a whole frame of compute over its evaluation";
        frame.unit = "ratio, median of the rounds";
        std::vector<const Json*> rows;
        for (const Json& row : result["rows"]) {
            if (row["cage"] == cage) {
                rows.push_back(&row);
            }
        }
        if (rows.size() < 2) {
            continue;
        }
        const auto put = [&](LineChart& plot, size_t column, const std::string& name, const Json& value) {
            auto line = std::find_if(plot.series.begin(), plot.series.end(),
                                     [&](const ChartSeries& known) { return known.name == name; });
            if (line == plot.series.end()) {
                const double none = std::numeric_limits<double>::quiet_NaN();
                line = plot.series.insert(line, {name, std::vector<double>(rows.size(), none)});
            }
            if (value.is_number()) {
                line->values[column] = value;
            }
        };
        for (size_t column = 0; column < rows.size(); ++column) {
            const Json& row = *rows[column];
            cost.labels.push_back("rate " + row["rate"].dump());
            for (const Json& contestant : row["contestants"]) {
                const std::string name = contestant["name"];
                const Json& gpu = contestant["gpuNanosecondsPerPoint"];
                if (name.find(" frame") == std::string::npos) {
                    put(cost, column, name,
                        cpu             ? contestant["cpuNanosecondsPerPoint"]
                        : gpu.is_null() ? contestant["wallNanosecondsPerPoint"]
                                        : gpu);
                }
            }
            for (const Json& ratio : row["ratios"]) {
                const std::string name = ratio["name"];
                const size_t word = name.find(" frame");
                if (word != std::string::npos) {
                    put(frame, column, name.substr(0, word) + (name.find("24 B") == std::string::npos ? "" : " 24 B"),
                        ratio["median"]);
                }
            }
        }
        frame.labels = cost.labels;
        pictures.push_back({"bench_" + cage + "_points.svg", tools::standalone(toSvg(cost))});
        pictures.push_back({"bench_" + cage + "_frame.svg", tools::standalone(toSvg(frame))});
    }
    return pictures;
}

} // namespace supple::bench
