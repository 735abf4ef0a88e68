#include "tools/common/charts.h"

#include "tools/common/formatted.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace supple::tools {
namespace {

constexpr double kWidth = 900.0, kHeight = 250.0;
constexpr double kLeft = 52.0, kRight = 890.0, kTop = 24.0, kBottom = 222.0;
constexpr size_t kMostBars = 220;
constexpr size_t kBins = 40;
constexpr double kLineRight = 650.0; ///< of lines, beside which names stand
constexpr double kNameDistance = 15.0;

/// 0.42, 4.2, 42, 420
std::string number(double value) {
    return value == 0.0    ? "0"
           : value < 0.1   ? formatted("%.3f", value)
           : value < 1.0   ? formatted("%.2f", value)
           : value < 100.0 ? formatted("%.3g", value)
                           : formatted("%.0f", value);
}

/// A color as the page's style sheet calls it, and what it is on white.
struct Color {
    const char *name, *onWhite;
};
/// c0 to c5 are Okabe and Ito's, which color-blind eyes can tell apart.
constexpr Color kColors[] = {{"paper", "#fff"},   {"ink", "#1c2026"}, {"soft", "#5d6672"}, {"grid", "#dfe3e8"},
                             {"mark", "#c0392b"}, {"c0", "#0072b2"},  {"c1", "#e69f00"},   {"c2", "#009e73"},
                             {"c3", "#cc79a7"},   {"c4", "#56b4e9"},  {"c5", "#d55e00"},   {"c6", "#7a6fd0"},
                             {"c7", "#a3a13b"},   {"c8", "#8a8f98"},  {"c9", "#4a5568"}};
/// Where the colors are used up.
constexpr const char* kDashes[] = {"none", "7 4", "2 3"};

enum class Scale : uint8_t { linear, counts, logarithmic }; ///< counts: linear, of whole numbers

/// Round values that enclose least and largest. Linear ones begin at 0 if `least` does not lie far above it.
std::vector<double> ticksOf(double least, double largest, Scale scale) {
    if (!(largest > 0.0)) {
        return {0.0, 1.0};
    }
    std::vector<double> ticks;
    if (scale != Scale::logarithmic) {
        const double power = std::pow(10.0, std::floor(std::log10(largest)));
        const double fine = largest / power > 5.0 ? power : largest / power > 2.0 ? power / 2.0 : power / 5.0;
        const double step = scale == Scale::counts ? std::max(std::round(fine), 1.0) : fine;
        const double first = least > largest / 2.0 ? std::floor(least / step) : 0.0;
        for (double tick = first; tick == first || (tick - 1.0) * step < largest; tick += 1.0) {
            ticks.push_back(tick * step);
        }
        return ticks;
    }
    // 1, 2 and 5 of every power of ten, or where these are many, the powers alone.
    const std::vector<double> steps = largest / least < 2e3 ? std::vector{1.0, 2.0, 5.0} : std::vector{1.0};
    for (double power = std::pow(10.0, std::floor(std::log10(least))); power <= 10.0 * largest; power *= 10.0) {
        for (const double step : steps) {
            ticks.push_back(step * power);
        }
    }
    while (ticks.size() > 2 && ticks[1] <= least) {
        ticks.erase(ticks.begin());
    }
    while (ticks.size() > 2 && ticks[ticks.size() - 2] >= largest) {
        ticks.pop_back();
    }
    return ticks;
}

/// The left axis with its lines.
class Axis {
public:
    Axis(double least, double largest, Scale scale, double bottom = kBottom)
        : ticks_(ticksOf(least, largest, scale)), logarithmic_(scale == Scale::logarithmic && largest > 0.0),
          bottom_(bottom) {}
    [[nodiscard]] double y(double value) const {
        const double least = ticks_.front(), most = ticks_.back();
        const double t =
            logarithmic_ ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
        return std::lerp(bottom_, kTop, t);
    }
    [[nodiscard]] std::string svg(const std::string& unit, double right = kRight) const {
        std::string text;
        for (const double tick : ticks_) {
            text += formatted("<path class=\"grid\" d=\"M%g %.1fH%g\"/><text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g"
                              "</text>",
                              kLeft, y(tick), right, kLeft - 6.0, y(tick) + 4.0, tick);
        }
        return text + formatted("<text x=\"%g\" y=\"%g\">", kLeft - 6.0, kTop - 12.0) + escaped(unit) + "</text>";
    }

private:
    std::vector<double> ticks_;
    bool logarithmic_;
    double bottom_;
};

/// From `top` down, which is below 0 where something stands above the chart.
std::string begin(double height = kHeight, double top = 0.0) {
    return formatted("<svg viewBox=\"0 %g %g %g\" role=\"img\">", top, kWidth, height - top);
}

size_t lengthOf(const StackedBars& chart) {
    return chart.series.empty() ? 0 : chart.series.front().values.size();
}

bool isPoint(double value) {
    return std::isfinite(value) && value > 0.0;
}

/// Where the series' names stand: beside their last points, pushed apart. That of a series without points is not drawn.
std::vector<double> namePlaces(const LineChart& chart, const Axis& axis, double bottom) {
    std::vector<double> places(chart.series.size(), bottom);
    std::vector<size_t> order;
    for (size_t s = 0; s < chart.series.size(); ++s) {
        const std::vector<double>& values = chart.series[s].values;
        const auto last = std::find_if(values.rbegin(), values.rend(), isPoint);
        if (last != values.rend()) {
            places[s] = axis.y(*last);
            order.push_back(s);
        }
    }
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return places[a] < places[b]; });
    double lowest = kTop;
    for (const size_t s : order) {
        places[s] = std::max(places[s], lowest);
        lowest = places[s] + kNameDistance;
    }
    double room = bottom + kNameDistance;
    for (auto s = order.rbegin(); s != order.rend(); ++s) {
        places[*s] = std::min(places[*s], room - kNameDistance);
        room = places[*s];
    }
    return places;
}

double columnX(const LineChart& chart, size_t column) {
    double t = static_cast<double>(column) / static_cast<double>(chart.labels.size() - 1);
    if (!chart.x.empty()) {
        t = std::log(chart.x[column] / chart.x.front()) / std::max(std::log(chart.x.back() / chart.x.front()), 1e-9);
    }
    return std::lerp(kLeft + 20.0, kLineRight - 10.0, t);
}

/// A series' line and points, and its name at `place`.
std::string lineSvg(const LineChart& chart, size_t series, const Axis& axis, double place) {
    const std::string color = colorClass(series);
    const std::vector<double>& values = chart.series[series].values;
    std::string path, dots;
    double last = 0.0;
    for (size_t i = 0; i < values.size(); ++i) {
        if (isPoint(values[i])) {
            last = axis.y(values[i]);
            path += formatted("%s%.1f %.1f", path.empty() ? "M" : "L", columnX(chart, i), last);
            dots += formatted("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>", color.c_str(),
                              columnX(chart, i), last);
        }
    }
    if (path.empty()) {
        return {};
    }
    return formatted("<path class=\"line s%s\" stroke-dasharray=\"%s\" d=\"", color.c_str(),
                     kDashes[series / kChartColors % std::size(kDashes)]) +
           path + "\"/>" + dots +
           formatted("<path class=\"thin s%s\" d=\"M%g %.1fL%g %.1f\"/><text class=\"%s\" x=\"%g\" y=\"%.1f\">",
                     color.c_str(), kLineRight - 4.0, last, kLineRight + 8.0, place, color.c_str(), kLineRight + 12.0,
                     place + 4.0) +
           escaped(chart.series[series].name) + "</text>";
}

} // namespace

std::string colorClass(size_t series) {
    return formatted("c%zu", series % kChartColors);
}

std::string lightChartColors() {
    std::string css;
    for (const Color& color : kColors) {
        css += formatted("--%s:%s;", color.name, color.onWhite);
    }
    return css;
}

std::string chartRules() {
    std::string css = "svg{font:12px system-ui,sans-serif;fill:var(--soft)}.title{font-size:16px;fill:var(--ink)}\n"
                      ".grid{stroke:var(--grid);fill:none}.tick{stroke:var(--ink);fill:none}"
                      "path.mark{stroke:var(--mark);stroke-dasharray:5 3;fill:none}\n"
                      "text.mark{fill:var(--mark);paint-order:stroke;stroke:var(--paper);stroke-width:4px}"
                      ".bar{fill:var(--c0)}.line{fill:none;stroke-width:2}.thin{fill:none;stroke-width:0.7}\n";
    for (size_t i = 0; i < kChartColors; ++i) {
        css += formatted(".c%zu{fill:var(--c%zu)}.sc%zu{stroke:var(--c%zu)}\n", i, i, i, i);
    }
    return css;
}

std::string standalone(const std::string& svg) {
    if (svg.empty()) {
        return {};
    }
    std::string css = chartRules();
    for (const Color& color : kColors) { // not every program that shows a picture knows variables
        const std::string variable = formatted("var(--%s)", color.name);
        for (size_t at = css.find(variable); at != std::string::npos; at = css.find(variable, at)) {
            css.replace(at, variable.size(), color.onWhite);
        }
    }
    const std::string opening = "<svg ";
    const size_t content = svg.find('>') + 1;
    return opening + "xmlns=\"http://www.w3.org/2000/svg\" " + svg.substr(opening.size(), content - opening.size()) +
           "\n<style>" + css + "</style>\n<rect y=\"-100%\" width=\"100%\" height=\"200%\" fill=\"#fff\"/>\n" +
           svg.substr(content) + "\n";
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return out;
}

std::string toSvg(const StackedBars& chart) {
    const size_t frames = lengthOf(chart), bars = std::min(frames, kMostBars);
    std::vector<double> sums(frames, 0.0);
    for (const ChartSeries& series : chart.series) {
        for (size_t i = 0; i < frames; ++i) {
            sums[i] += series.values[i];
        }
    }
    double largest = sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
    for (const auto& [name, value] : chart.lines) {
        largest = std::max(largest, value);
    }
    const Axis axis(0.0, largest, Scale::linear);
    std::string svg = begin() + axis.svg(chart.unit);
    const double step = bars == 0 ? 0.0 : (kRight - kLeft) / static_cast<double>(bars), gap = step > 4.0 ? 1.0 : 0.0;
    for (size_t bar = 0; bar < bars; ++bar) {
        const size_t first = bar * frames / bars, end = std::max(first + 1, (bar + 1) * frames / bars);
        const double x = kLeft + step * static_cast<double>(bar);
        double below = 0.0;
        for (size_t s = 0; s < chart.series.size(); ++s) {
            double mean = 0.0;
            for (size_t i = first; i < end; ++i) {
                mean += chart.series[s].values[i] / static_cast<double>(end - first);
            }
            const double bottom = axis.y(below), top = axis.y(below + mean);
            svg += formatted("<rect class=\"%s\" x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/>",
                             colorClass(s).c_str(), x, top, step - gap, bottom - top);
            below += mean;
        }
        if (frames > bars) {
            const auto from = sums.begin() + static_cast<ptrdiff_t>(first);
            const double most = axis.y(*std::max_element(from, sums.begin() + static_cast<ptrdiff_t>(end)));
            svg += formatted("<path class=\"tick\" d=\"M%.2f %.2fh%.2f\"/>", x, most, step - gap);
        }
    }
    for (const auto& [name, value] : chart.lines) {
        svg += formatted("<path class=\"mark\" d=\"M%g %.1fH%g\"/><text class=\"mark\" x=\"%g\" y=\"%.1f\" "
                         "text-anchor=\"end\">",
                         kLeft, axis.y(value), kRight, kRight, axis.y(value) - 4.0) +
               escaped(name) + " " + number(value) + "</text>";
    }
    svg += formatted("<text x=\"%g\" y=\"%g\">frame 1</text><text x=\"%g\" y=\"%g\" text-anchor=\"end\">%zu</text>",
                     kLeft, kBottom + 18.0, kRight, kBottom + 18.0, frames);
    return svg + "</svg>";
}

std::string toSvg(const Histogram& chart) {
    if (chart.values.empty()) {
        return {};
    }
    const auto [low, high] = std::minmax_element(chart.values.begin(), chart.values.end());
    const double least = *low, width = std::max(*high - least, 1e-9);
    std::vector<double> counts(kBins, 0.0);
    for (const double value : chart.values) {
        const auto bin = static_cast<size_t>((value - least) / width * static_cast<double>(kBins));
        counts[std::min(bin, kBins - 1)] += 1.0;
    }
    const Axis axis(0.0, *std::max_element(counts.begin(), counts.end()), Scale::counts);
    const auto x = [&](double value) { return std::lerp(kLeft, kRight, (value - least) / width); };
    std::string svg = begin() + axis.svg("frames");
    const double step = (kRight - kLeft) / static_cast<double>(kBins);
    for (size_t bin = 0; bin < kBins; ++bin) {
        svg += formatted("<rect class=\"bar\" x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/>",
                         kLeft + step * static_cast<double>(bin), axis.y(counts[bin]), step - 1.0,
                         kBottom - axis.y(counts[bin]));
    }
    double row = 0.0; // names of marks that lie together stand below each other
    for (const auto& [name, value] : chart.lines) {
        if (value < least || value > least + width) {
            continue;
        }
        const bool right = x(value) > 0.5 * (kLeft + kRight);
        svg += formatted("<path class=\"mark\" d=\"M%.1f %gV%g\"/><text class=\"mark\" x=\"%.1f\" y=\"%g\" "
                         "text-anchor=\"%s\">",
                         x(value), kTop, kBottom, x(value) + (right ? -5.0 : 5.0), kTop + 10.0 + row,
                         right ? "end" : "start") +
               escaped(name) + " " + number(value) + "</text>";
        row += 15.0;
    }
    svg += formatted("<text x=\"%g\" y=\"%g\">%s</text><text x=\"%g\" y=\"%g\" text-anchor=\"end\">%s ", kLeft,
                     kBottom + 18.0, number(least).c_str(), kRight, kBottom + 18.0, number(least + width).c_str());
    return svg + escaped(chart.unit) + "</text></svg>";
}

std::string toSvg(const LineChart& chart) {
    double least = INFINITY, most = 0.0;
    for (const ChartSeries& series : chart.series) {
        for (const double value : series.values) {
            if (isPoint(value)) {
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
    }
    if (chart.labels.size() < 2 || !(most > 0.0)) {
        return {};
    }
    const double bottom = chart.height - (kHeight - kBottom), titleHeight = chart.title.empty() ? 0.0 : 28.0;
    const Axis axis(least, most, chart.logarithmic ? Scale::logarithmic : Scale::linear, bottom);
    std::string svg = begin(chart.height, -titleHeight) + axis.svg(chart.unit, kLineRight);
    if (!chart.title.empty()) {
        svg += formatted("<text class=\"title\" x=\"%g\" y=\"%g\">", kLeft - 6.0, 18.0 - titleHeight) +
               escaped(chart.title) + "</text>";
    }
    for (size_t i = 0; i < chart.labels.size(); ++i) {
        svg += formatted("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">", columnX(chart, i), bottom + 18.0) +
               escaped(chart.labels[i]) + "</text>";
    }
    svg += formatted("<text x=\"%g\" y=\"%g\">", kLineRight + 30.0, bottom + 18.0) + escaped(chart.xName) + "</text>";
    const std::vector<double> names = namePlaces(chart, axis, bottom);
    for (size_t s = 0; s < chart.series.size(); ++s) {
        svg += lineSvg(chart, s, axis, names[s]);
    }
    return svg + "</svg>";
}

std::string toSvg(const ShareBar& chart) {
    double sum = 0.0;
    for (const auto& [name, share] : chart.shares) {
        sum += share;
    }
    std::string svg = begin(26.0);
    double x = 0.0;
    for (size_t i = 0; i < chart.shares.size(); ++i) {
        const double width = sum > 0.0 ? kWidth * chart.shares[i].second / sum : 0.0;
        svg += formatted("<rect class=\"%s\" x=\"%.2f\" y=\"0\" width=\"%.2f\" height=\"26\"><title>",
                         colorClass(i).c_str(), x, width) +
               escaped(chart.shares[i].first) + "</title></rect>";
        x += width;
    }
    return svg + "</svg>";
}

} // namespace supple::tools
