#include "tools/supple/charts.h"

#include "tools/common/formatted.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace supple::tools {
namespace {

constexpr double kWidth = 900.0, kHeight = 250.0;
constexpr double kLeft = 52.0, kRight = 890.0, kTop = 24.0, kBottom = 222.0;
constexpr size_t kMostBars = 220;
constexpr size_t kBins = 40;

/// 0.42, 4.2, 42, 420
std::string number(double value) {
    return value == 0.0    ? "0"
           : value < 0.1   ? formatted("%.3f", value)
           : value < 1.0   ? formatted("%.2f", value)
           : value < 100.0 ? formatted("%.3g", value)
                           : formatted("%.0f", value);
}

/// Round steps from 0 to what holds `largest`.
std::vector<double> ticksTo(double largest) {
    if (!(largest > 0.0)) {
        return {0.0, 1.0};
    }
    const double power = std::pow(10.0, std::floor(std::log10(largest)));
    const double step = largest / power > 5.0 ? power : largest / power > 2.0 ? power / 2.0 : power / 5.0;
    std::vector<double> ticks{0.0};
    while (ticks.back() < largest) {
        ticks.push_back(step * static_cast<double>(ticks.size()));
    }
    return ticks;
}

/// The left axis with its lines, from 0.
class Linear {
public:
    explicit Linear(double largest) : ticks_(ticksTo(largest)) {}
    [[nodiscard]] double y(double value) const { return std::lerp(kBottom, kTop, value / ticks_.back()); }
    [[nodiscard]] std::string svg(const std::string& unit) const {
        std::string text;
        for (const double tick : ticks_) {
            text += formatted("<path class=\"grid\" d=\"M%g %.1fH%g\"/><text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%s"
                              "</text>",
                              kLeft, y(tick), kRight, kLeft - 6.0, y(tick) + 4.0, number(tick).c_str());
        }
        return text + formatted("<text x=\"%g\" y=\"%g\">", kLeft - 6.0, kTop - 12.0) + escaped(unit) + "</text>";
    }

private:
    std::vector<double> ticks_;
};

std::string begin(double height = kHeight) {
    return formatted("<svg viewBox=\"0 0 %g %g\" role=\"img\">", kWidth, height);
}

size_t lengthOf(const StackedBars& chart) {
    return chart.series.empty() ? 0 : chart.series.front().values.size();
}

} // namespace

std::string colorClass(size_t series) {
    return formatted("c%zu", series % kChartColors);
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
    const Linear axis(largest);
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
    const Linear axis(*std::max_element(counts.begin(), counts.end()));
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

std::string toSvg(const SweepLines& chart) {
    constexpr double kNames = 170.0; // room on the right
    const double right = kRight - kNames;
    double least = INFINITY, most = 0.0;
    for (const ChartSeries& series : chart.series) {
        for (const double value : series.values) {
            if (value > 0.0) {
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
    }
    if (chart.x.size() < 2 || !(most > 0.0)) {
        return {};
    }
    const double low = std::pow(10.0, std::floor(std::log10(least))),
                 high = std::pow(10.0, std::ceil(std::log10(most)));
    const auto y = [&](double value) {
        return std::lerp(kBottom, kTop, std::log(value / low) / std::max(std::log(high / low), 1e-9));
    };
    const auto x = [&](double value) {
        return std::lerp(kLeft + 10.0, right,
                         std::log(value / chart.x.front()) /
                             std::max(std::log(chart.x.back() / chart.x.front()), 1e-9));
    };
    std::string svg =
        begin() + formatted("<text x=\"%g\" y=\"%g\">", kLeft - 6.0, kTop - 12.0) + escaped(chart.unit) + "</text>";
    for (double power = low; power <= 1.001 * high; power *= 10.0) {
        svg +=
            formatted("<path class=\"grid\" d=\"M%g %.1fH%g\"/><text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g</text>",
                      kLeft, y(power), right, kLeft - 6.0, y(power) + 4.0, power);
    }
    for (const double value : chart.x) {
        svg += formatted("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g</text>", x(value), kBottom + 18.0, value);
    }
    svg += formatted("<text x=\"%g\" y=\"%g\">", right + 30.0, kBottom + 18.0) + escaped(chart.xName) + "</text>";
    std::vector<std::pair<double, size_t>> names;
    for (size_t s = 0; s < chart.series.size(); ++s) {
        std::string path;
        double last = 0.0;
        for (size_t i = 0; i < chart.x.size(); ++i) {
            const double value = chart.series[s].values[i];
            if (value > 0.0) {
                last = y(value);
                path += formatted("%s%.1f %.1f", path.empty() ? "M" : "L", x(chart.x[i]), last);
            }
        }
        if (!path.empty()) {
            svg += "<path class=\"line s" + colorClass(s) + "\" d=\"" + path + "\"/>";
            names.emplace_back(last, s);
        }
    }
    std::sort(names.begin(), names.end());
    double lowest = kTop;
    for (const auto& [at, s] : names) {
        lowest = std::max(lowest, at);
        svg += formatted("<rect class=\"%s\" x=\"%g\" y=\"%.1f\" width=\"9\" height=\"9\"/><text x=\"%g\" y=\"%.1f\">",
                         colorClass(s).c_str(), right + 12.0, lowest - 5.0, right + 26.0, lowest + 4.0) +
               escaped(chart.series[s].name) + "</text>";
        lowest += 15.0;
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
