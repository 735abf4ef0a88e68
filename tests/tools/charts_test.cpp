#include "tools/common/charts.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <regex>

namespace supple::tools {
namespace {

size_t countOf(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

/// What the left axis says, upwards.
std::vector<double> ticksOf(const std::string& svg) {
    std::vector<double> ticks;
    const std::regex tick("class=\"grid\"[^/]*/><text [^>]*>([^<]*)<");
    for (std::sregex_iterator it(svg.begin(), svg.end(), tick), end; it != end; ++it) {
        ticks.push_back(std::stod((*it)[1]));
    }
    return ticks;
}

LineChart lineOf(std::vector<double> values, bool logarithmic) {
    LineChart chart;
    chart.labels.assign(values.size(), "rate");
    chart.series = {{"one", std::move(values)}};
    chart.logarithmic = logarithmic;
    return chart;
}

TEST(Charts, LinesAndNamesAreThere) {
    LineChart chart;
    chart.title = "a < b & c";
    chart.unit = "ns a point";
    chart.labels = {"rate 4", "rate 8", "rate 16"};
    chart.series = {{"one", {1.0, 10.0, 100.0}}, {"two", {1.0, NAN, 2.0}}, {"none", {0.0, NAN, INFINITY}}};
    chart.logarithmic = true;
    const std::string svg = toSvg(chart);
    EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
    for (const char* part :
         {"</svg>", "a &lt; b &amp; c", ">one</text>", ">two</text>", ">rate 16</text>", ">ns a point"}) {
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(svg.find(">none"), std::string::npos) << "a series without a point has no name either";
    EXPECT_EQ(countOf(svg, "<circle"), 5u);
}

TEST(Charts, TicksAreRoundAndEncloseTheValues) {
    using Ticks = std::vector<double>;
    EXPECT_EQ(ticksOf(toSvg(lineOf({3.0, 70.0}, true))), (Ticks{2.0, 5.0, 10.0, 20.0, 50.0, 100.0}));
    EXPECT_EQ(ticksOf(toSvg(lineOf({0.01, 30.0}, true))), (Ticks{0.01, 0.1, 1.0, 10.0, 100.0})) << "powers alone";
    EXPECT_EQ(ticksOf(toSvg(lineOf({5.0, 5.0}, true))), (Ticks{5.0, 10.0}));
    EXPECT_EQ(ticksOf(toSvg(lineOf({1.0, 3.2}, false))), (Ticks{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5}));
    EXPECT_EQ(ticksOf(toSvg(lineOf({1.15, 1.31}, false))), (Ticks{1.0, 1.2, 1.4})) << "far above 0";
    EXPECT_EQ(ticksOf(toSvg(StackedBars{{{"a", {7.0, 9.0}}}, "ms", {}})), (Ticks{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(ticksOf(toSvg(StackedBars{{{"a", {1.0}}}, "ms", {{"budget", 4.0}}})),
              (Ticks{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}))
        << "marks count, too";
}

TEST(Charts, FramesAreCountedInWholeNumbers) {
    for (const size_t frames : {1u, 2u, 3u, 7u, 30u}) {
        Histogram histogram{std::vector<double>(frames, 1.0), "ms", {}};
        histogram.values.back() = 2.0;
        const std::string svg = toSvg(histogram);
        size_t ticks = 0;
        for (size_t at = svg.find("text-anchor=\"end\">"); at != std::string::npos && svg.find("frames") > at;
             at = svg.find("text-anchor=\"end\">", at + 1)) {
            const double tick = std::stod(svg.substr(at + 18));
            EXPECT_EQ(tick, std::floor(tick)) << frames;
            ++ticks;
        }
        EXPECT_GE(ticks, 2u);
    }
}

TEST(Charts, NamesStandApart) {
    LineChart chart = lineOf({1.0, 2.0}, false);
    for (int i = 0; i < 10; ++i) {
        chart.series.push_back({"s", {1.0, 2.0}});
    }
    const std::string svg = toSvg(chart);
    std::vector<double> places;
    const std::regex name("<text class=\"c\\d\" x=\"[^\"]*\" y=\"([^\"]*)\">");
    for (std::sregex_iterator it(svg.begin(), svg.end(), name), end; it != end; ++it) {
        places.push_back(std::stod((*it)[1]));
    }
    ASSERT_EQ(places.size(), 11u);
    std::sort(places.begin(), places.end());
    for (size_t i = 1; i < places.size(); ++i) {
        EXPECT_GE(places[i] - places[i - 1], 14.9);
    }
    EXPECT_LE(places.back(), chart.height);
    EXPECT_NE(svg.find("stroke-dasharray=\"7 4\""), std::string::npos) << "colors are used up";
}

TEST(Charts, TakeAnything) {
    EXPECT_NE(toSvg(StackedBars{}).find("</svg>"), std::string::npos);
    EXPECT_EQ(toSvg(Histogram{}), "");
    EXPECT_EQ(toSvg(lineOf({1.0}, true)), "") << "one value makes no line";
    EXPECT_EQ(toSvg(lineOf({0.0, NAN}, true)), "");
    LineChart sweep = lineOf({0.0, 2.0}, true);
    sweep.x = {4.0, 8.0};
    sweep.series.push_back({"b", {0.0, 0.0}});
    for (const std::string& svg :
         {toSvg(StackedBars{{{"a", {0.0, 0.0}}}, "ms", {}}), toSvg(Histogram{{1.0, 1.0}, "ms", {{"median", 1.0}}}),
          toSvg(sweep), toSvg(lineOf({1.0, NAN}, true)), toSvg(lineOf({1.0, 1.0}, false)), toSvg(ShareBar{})}) {
        EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
        EXPECT_EQ(svg.find("inf"), std::string::npos) << svg;
    }
}

TEST(Charts, StandAloneWithoutAPage) {
    const std::string svg = standalone(toSvg(lineOf({1.0, 2.0}, false)));
    EXPECT_EQ(svg.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\" ", 0), 0u);
    EXPECT_EQ(svg.find("var("), std::string::npos) << "colors are inside";
    EXPECT_NE(svg.find(".c0{fill:#0072b2}"), std::string::npos);
    EXPECT_EQ(standalone(""), "");
}

} // namespace
} // namespace supple::tools
