#include "tools/bench/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kWidth = 860, kHeight = 460;
constexpr double kLeft = 66, kRight = 580, kTop = 44, kBottom = 410;
constexpr double kLabelDistance = 16; ///< between the lines' names, at least
/// Okabe and Ito's colors, which color-blind eyes can tell apart; dashes go on where they are used up.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr const char* kDashes[] = {"none", "7 4", "2 3"};

std::string format(const char* pattern, auto... values) {
    char text[512];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return out;
}

struct Axis {
    double least = 0.0, largest = 1.0;
    bool logarithmic = false;
    std::vector<double> ticks;

    [[nodiscard]] double y(double value) const {
        const double t =
            logarithmic ? std::log(value / least) / std::log(largest / least) : (value - least) / (largest - least);
        return std::lerp(kBottom, kTop, t);
    }
};

Axis axisOf(const LinePlot& plot) {
    Axis axis;
    axis.logarithmic = plot.logarithmic;
    double least = INFINITY, largest = 0.0;
    for (const LinePlot::Line& line : plot.lines) {
        for (const double value : line.values) {
            if (std::isfinite(value) && value > 0.0) {
                least = std::min(least, value);
                largest = std::max(largest, value);
            }
        }
    }
    if (largest == 0.0) {
        return axis;
    }
    if (plot.logarithmic) { // ticks at 1, 2, 5 of every power of ten
        for (double power = std::pow(10.0, std::floor(std::log10(least))); power <= 10.0 * largest; power *= 10.0) {
            for (const double step : {1.0, 2.0, 5.0}) {
                axis.ticks.push_back(step * power);
            }
        }
        while (axis.ticks.size() > 2 && axis.ticks[1] <= least) {
            axis.ticks.erase(axis.ticks.begin());
        }
        while (axis.ticks.size() > 2 && axis.ticks[axis.ticks.size() - 2] >= largest) {
            axis.ticks.pop_back();
        }
        axis.least = axis.ticks.front();
    } else {
        const double power = std::pow(10.0, std::floor(std::log10(largest)));
        const double step = largest / power > 5.0 ? power : largest / power > 2.0 ? power / 2.0 : power / 5.0;
        // What lies far above 0, and close together, has no use for it.
        const double first = least > largest / 2.0 ? std::floor(least / step) : 0.0;
        for (double tick = first; (tick - 1.0) * step < largest; tick += 1.0) {
            axis.ticks.push_back(tick * step);
        }
        axis.least = axis.ticks.front();
    }
    axis.largest = axis.ticks.back();
    return axis;
}

/// Where the lines' names stand: beside their last points, pushed apart.
std::vector<double> labelPlaces(const LinePlot& plot, const Axis& axis) {
    std::vector<double> places(plot.lines.size(), kBottom);
    std::vector<size_t> order(plot.lines.size());
    std::iota(order.begin(), order.end(), size_t{0});
    for (size_t i = 0; i < plot.lines.size(); ++i) {
        for (const double value : plot.lines[i].values) {
            places[i] = std::isfinite(value) && value > 0.0 ? axis.y(value) : places[i];
        }
    }
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return places[a] < places[b]; });
    double lowest = kTop;
    for (const size_t i : order) {
        places[i] = std::max(places[i], lowest);
        lowest = places[i] + kLabelDistance;
    }
    double room = kBottom + kLabelDistance;
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        places[*i] = std::min(places[*i], room - kLabelDistance);
        room = places[*i];
    }
    return places;
}

} // namespace

std::string toSvg(const LinePlot& plot) {
    const Axis axis = axisOf(plot);
    const auto x = [&](size_t i) {
        const double t =
            plot.labels.size() < 2 ? 0.5 : static_cast<double>(i) / static_cast<double>(plot.labels.size() - 1);
        return std::lerp(kLeft + 20, kRight - 10, t);
    };
    std::string svg =
        format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
               "font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
               kWidth, kHeight);
    svg += format("<text x=\"%g\" y=\"24\" font-size=\"16\">", kLeft) + escaped(plot.title) + "</text>\n";
    svg += format("<text transform=\"translate(18 %g) rotate(-90)\" text-anchor=\"middle\">", (kTop + kBottom) / 2) +
           escaped(plot.yTitle) + "</text>\n";
    for (const double tick : axis.ticks) {
        svg += format("<path d=\"M%g %.1fH%g\" stroke=\"#d8d8d8\"/><text x=\"%g\" y=\"%.1f\" "
                      "text-anchor=\"end\">%g</text>\n",
                      kLeft, axis.y(tick), kRight, kLeft - 6, axis.y(tick) + 4, tick);
    }
    for (size_t i = 0; i < plot.labels.size(); ++i) {
        svg += format("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">", x(i), kBottom + 22) +
               escaped(plot.labels[i]) + "</text>\n";
    }
    const std::vector<double> places = labelPlaces(plot, axis);
    for (size_t l = 0; l < plot.lines.size(); ++l) {
        const char* color = kColors[l % std::size(kColors)];
        const char* dash = kDashes[l / std::size(kColors) % std::size(kDashes)];
        std::string path, dots;
        double last = kBottom;
        for (size_t i = 0; i < plot.lines[l].values.size(); ++i) {
            const double value = plot.lines[l].values[i];
            if (std::isfinite(value) && value > 0.0) {
                last = axis.y(value);
                path += format("%s%.1f %.1f", path.empty() ? "M" : "L", x(i), last);
                dots += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>", x(i), last, color);
            }
        }
        svg += "<path d=\"" + path +
               format("\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"%s\"/>", color, dash) +
               dots +
               format("<path d=\"M%g %.1fL%g %.1f\" stroke=\"%s\" stroke-width=\"0.7\"/>", kRight - 4, last, kRight + 8,
                      places[l], color) +
               format("<text x=\"%g\" y=\"%.1f\" fill=\"%s\">", kRight + 12, places[l] + 4, color) +
               escaped(plot.lines[l].name) + "</text>\n";
    }
    return svg + "</svg>\n";
}

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
        LinePlot cost, frame;
        cost.title = cage + ": what a point of the surface costs";
        cost.yTitle = cpu ? "CPU time, ns a point" : "ns a point (device time; wall time on the host)";
        cost.logarithmic = true;
        frame.title = cage + ": a whole frame of compute over its evaluation";
        frame.yTitle = "ratio, median of the rounds";
        std::vector<const Json*> rows;
        for (const Json& row : result["rows"]) {
            if (row["cage"] == cage) {
                rows.push_back(&row);
            }
        }
        if (rows.size() < 2) {
            continue;
        }
        const auto put = [&](LinePlot& plot, size_t column, const std::string& name, const Json& value) {
            auto line = std::find_if(plot.lines.begin(), plot.lines.end(),
                                     [&](const LinePlot::Line& known) { return known.name == name; });
            if (line == plot.lines.end()) {
                const double none = std::numeric_limits<double>::quiet_NaN();
                line = plot.lines.insert(line, {name, std::vector<double>(rows.size(), none)});
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
        pictures.push_back({"bench_" + cage + "_points.svg", toSvg(cost)});
        pictures.push_back({"bench_" + cage + "_frame.svg", toSvg(frame)});
    }
    return pictures;
}

} // namespace supple::bench
