// Charts as SVG. They stand inside a page, whose colors they take (var(--c0), var(--ink), ..), or alone as a file.
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

/// Bars over frames, of all series one above the other. Many frames are drawn as means of neighbors, with a tick at
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

/// Lines over columns. Series are named beside their last points. A chart of less than two columns is empty.
struct LineChart {
    std::string title; ///< may be empty
    std::string unit;  ///< of the values
    std::string xName; ///< may be empty
    std::vector<std::string> labels;
    std::vector<double> x;           ///< where columns stand, logarithmically, rising from above 0; or empty: evenly
    std::vector<ChartSeries> series; ///< a value for each label; not finite or not above 0: no point there
    bool logarithmic = false;        ///< the values' axis
    double height = 250.0;           ///< below the title; the width of all charts is 900
};
[[nodiscard]] std::string toSvg(const LineChart& chart);

/// One bar, cut into shares.
struct ShareBar {
    std::vector<std::pair<std::string, double>> shares;
};
[[nodiscard]] std::string toSvg(const ShareBar& chart);

/// Classes of the page's style sheet: c0, c1, .. for areas, sc0, sc1, .. for lines.
inline constexpr size_t kChartColors = 10;
/// The class of a series in the page's style sheet.
[[nodiscard]] std::string colorClass(size_t series);
/// The colors on white, as CSS declares them: --c0 to --c9, --ink, --soft, --grid, --mark and --paper. A page may
/// declare others beside them, for the dark.
[[nodiscard]] std::string lightChartColors();
/// The rules for charts, which take these colors.
[[nodiscard]] std::string chartRules();

/// The chart as a file of its own, on white: with its rules and colors inside.
[[nodiscard]] std::string standalone(const std::string& svg);

/// & < > " as HTML has them.
[[nodiscard]] std::string escaped(const std::string& text);

} // namespace supple::tools
