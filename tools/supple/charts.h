// Charts of a report, as SVG that stands inside a page: its colors are the page's (var(--c0), var(--ink), ..).
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {

/// A name and its values; its color is its place among the series of a chart.
struct ChartSeries {
    std::string name;
    std::vector<double> values;
};

/// Bars over frames, of all series one above the other. Many frames are drawn as means of neighbours, with a tick at
/// the largest sum of each.
struct StackedBars {
    std::vector<ChartSeries> series; ///< all of one length
    std::string unit;
    std::vector<std::pair<std::string, double>> lines; ///< "median", "budget"
};
[[nodiscard]] std::string toSvg(const StackedBars& chart);

/// How often values fall into equal ranges.
struct Histogram {
    std::vector<double> values;
    std::string unit;
    std::vector<std::pair<std::string, double>> lines;
};
[[nodiscard]] std::string toSvg(const Histogram& chart);

/// Lines over a quantity that was swept; both axes are logarithmic.
struct SweepLines {
    std::string xName, unit;
    std::vector<double> x;
    std::vector<ChartSeries> series; ///< a value for each x
};
[[nodiscard]] std::string toSvg(const SweepLines& chart);

/// One bar, cut into shares.
struct ShareBar {
    std::vector<std::pair<std::string, double>> shares;
};
[[nodiscard]] std::string toSvg(const ShareBar& chart);

/// Classes of the page's style sheet: c0, c1, .. for areas, sc0, sc1, .. for lines.
inline constexpr size_t kChartColors = 10;
/// The class of a series in the page's style sheet.
[[nodiscard]] std::string colorClass(size_t series);
/// & < > " as HTML has them.
[[nodiscard]] std::string escaped(const std::string& text);

} // namespace supple::tools
