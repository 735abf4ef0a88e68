#include "tools/supple/profile_html.h"

#include "tools/common/charts.h"
#include "tools/common/formatted.h"
#include "tools/supple/memory_report.h"
#include "tools/supple/profile_advice.h"
#include "tools/supple/profile_report.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <supple/supple.h>

namespace supple::tools {
namespace {

constexpr const char* kStyle = R"(
:root{--card:#f5f7f9}
@media(prefers-color-scheme:dark){:root{--paper:#14171b;--ink:#e7eaee;--soft:#9aa4b0;--grid:#2c333b;--card:#1d2228;--mark:#ff7b6b;
--c0:#4aa8e0;--c1:#f0b73f;--c2:#33c49a;--c3:#e0a0c4;--c4:#8fd0f7;--c5:#f58b4c;--c6:#a79df0;--c7:#c9c75f;--c8:#aab1bb;--c9:#74829a}}
body{margin:0 auto;padding:24px;max-width:1000px;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,sans-serif}
h1{font-size:26px;margin:0 0 4px}h2{font-size:20px;margin:40px 0 2px;border-top:1px solid var(--grid);padding-top:24px}
h3{font-size:15px;margin:22px 0 4px}p{margin:4px 0}.soft{color:var(--soft)}
.tiles{display:flex;flex-wrap:wrap;gap:10px;margin:14px 0}.tile{background:var(--card);border-radius:8px;padding:8px 14px}
.tile b{display:block;font-size:20px;font-weight:600}.tile span{color:var(--soft);font-size:13px}
.show{display:flex;gap:18px;align-items:flex-start;flex-wrap:wrap}.show img{width:260px;border-radius:8px}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:14px}
td,th{padding:3px 8px;text-align:right;border-bottom:1px solid var(--grid)}th{color:var(--soft);font-weight:500}
td:first-child,th:first-child{text-align:left;white-space:nowrap}
i{display:inline-block;width:10px;height:10px;border-radius:2px;margin-right:7px}
svg{width:100%;height:auto;display:block}
ul{padding-left:20px}.wide{overflow-x:auto}.wide td{white-space:nowrap}
@media(max-width:700px){body{padding:12px}.wide svg{min-width:640px}.show img{width:100%}.tile{flex:1 1 130px}}
.slower{color:var(--mark);font-weight:600}.faster{color:var(--c2);font-weight:600}
code{background:var(--card);padding:1px 5px;border-radius:4px;overflow-wrap:anywhere}
)";

std::string styles() {
    std::string css = ":root{" + lightChartColors() + "}" + kStyle + chartRules();
    for (size_t i = 0; i < kChartColors; ++i) {
        css += formatted("i.c%zu{background:var(--c%zu)}\n", i, i);
    }
    return css;
}

/// None of the libraries that tools link with writes base64.
std::string base64(const std::string& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) {
            word = word << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
        }
    }
    return text;
}

std::string tile(const std::string& value, const std::string& name) {
    return "<div class=tile><b>" + value + "</b><span>" + escaped(name) + "</span></div>";
}

double gigabytesPerSecond(uint64_t bytes, double milliseconds) {
    return milliseconds > 0.0 ? static_cast<double>(bytes) / (milliseconds * 1e6) : 0.0;
}

std::string tilesOf(const ProfileRun& run, const RunSummary& summary) {
    const Summary& frame = summary.total.gpu;
    std::string text = "<div class=tiles>";
    text += tile(formatted("%.3f ms", frame.median), "a frame on the device, median");
    text += tile(formatted("%.3f ms", frame.p95), "95 % of frames take no longer");
    text += tile(formatted("%.3f ms", frame.max), "the longest frame");
    text += tile(formatted("%.1f M/s", summary.total.megapointsPerSecond()), "surface vertices");
    text += tile(formatted("%.2f GB/s", gigabytesPerSecond(summary.total.bytes, frame.median)), "written");
    text += tile(formatted("%.0f %%", frame.median > 0.0 ? 100.0 * summary.covered.median / frame.median : 0.0),
                 "of the frame lies in passes");
    text += tile(formatted("%.3f ms", summary.pose.median + summary.record.median), "CPU: poses and recording");
    text +=
        tile(formatted("%.1f MiB", static_cast<double>(run.memory.deviceLocal) / (1024.0 * 1024.0)), "on the device");
    return text + "</div>";
}

std::string passTable(const RunSummary& summary) {
    std::string text =
        "<div class=wide><table><tr><th>pass<th>median ms<th>5 to 95 %<th>longest<th>share<th>points<th>bytes"
        "<th>GB/s<th>CPU ms</tr>";
    const auto row = [&](const PassSummary& pass, const std::string& name) {
        text += "<tr><td>" + name +
                formatted("<td>%.4f<td>%.4f to %.4f<td>%.4f<td>%.1f %%<td>%llu<td>%llu<td>%.2f<td>%.4f</tr>",
                          pass.gpu.median, pass.gpu.p05, pass.gpu.p95, pass.gpu.max,
                          summary.total.gpu.median > 0.0 ? 100.0 * pass.gpu.median / summary.total.gpu.median : 0.0,
                          static_cast<unsigned long long>(pass.points), static_cast<unsigned long long>(pass.bytes),
                          gigabytesPerSecond(pass.bytes, pass.gpu.median), pass.cpuRecord.median);
    };
    for (size_t i = 0; i < summary.passes.size(); ++i) {
        row(summary.passes[i], "<i class=" + colorClass(i) + "></i>" + escaped(summary.passes[i].pass));
    }
    row(summary.total, "<b>frame</b>");
    return text +
           "</table></div><p class=soft>Shares are of the frame, from the first begin to the last end. Spans of a pass "
           "that overlap count once; passes that overlap each other make more than 100 %.</p>";
}

/// What each surface of each group takes.
std::string surfacesOf(const ProfileRun& run, const RunSummary& summary) {
    if (!areSeveral(run.surfaces)) {
        return "";
    }
    std::string text =
        "<h3>Groups and surfaces</h3><div class=wide><table><tr><th>what passes work on<th>median ms<th>5 to 95 %"
        "<th>share<th>parts</tr>";
    for (size_t i = 0; i < run.surfaces.size(); ++i) {
        const Summary& gpu = summary.surfaces[i];
        text += "<tr><td>" + escaped(nameOf(run.surfaces[i])) +
                formatted("<td>%.4f<td>%.4f to %.4f<td>%.1f %%<td>", gpu.median, gpu.p05, gpu.p95,
                          summary.total.gpu.median > 0.0 ? 100.0 * gpu.median / summary.total.gpu.median : 0.0) +
                escaped(partsText(run.surfaces[i])) + "</tr>";
    }
    return text + "</table></div><p class=soft>Parts of one scheme are one surface and go through passes together. How "
                  "many of "
                  "its patches a part has is a guess at its share of the time.</p>";
}

std::string memoryOf(const ProfileRun& run) {
    ShareBar bar;
    std::string legend;
    for (const MemoryPurpose& purpose : memoryPurposes(run.memory)) {
        if (purpose.bytes == 0) {
            continue;
        }
        const auto bytes = static_cast<double>(purpose.bytes);
        legend += "<i class=" + colorClass(bar.shares.size()) + "></i>" + escaped(purpose.name) +
                  formatted(" %.3f MiB &ensp; ", bytes / (1024.0 * 1024.0));
        bar.shares.emplace_back(purpose.name, bytes);
    }
    return "<h3>Memory by purpose</h3>" + toSvg(bar) + "<p>" + legend + "</p>";
}

/// What scrolls by itself where the page is narrower.
std::string wide(const std::string& content) {
    return "<div class=wide>" + content + "</div>";
}

std::string legendOf(const std::vector<ChartSeries>& series) {
    std::string text = "<p>";
    for (size_t i = 0; i < series.size(); ++i) {
        text += "<i class=" + colorClass(i) + "></i>" + escaped(series[i].name) + " &ensp; ";
    }
    return text + "</p>";
}

std::string framesOf(const ProfileRun& run, const RunSummary& summary, double budgetMs) {
    const FrameTimes times = frameTimes(run);
    StackedBars bars;
    bars.unit = "ms";
    for (const FrameTimes::Pass& pass : times.passes) {
        bars.series.push_back({pass.pass, pass.times});
    }
    Histogram histogram{times.frame, "ms", {}};
    bars.lines = {{"95 %", summary.total.gpu.p95}};
    histogram.lines = {{"median", summary.total.gpu.median}, {"95 %", summary.total.gpu.p95}};
    if (budgetMs > 0.0) {
        bars.lines.emplace_back("budget", budgetMs);
        histogram.lines.emplace_back("budget", budgetMs);
    }
    return "<h3>Passes of every frame</h3>" + wide(toSvg(bars)) + legendOf(bars.series) +
           "<h3>How long frames take on the device</h3>" + wide(toSvg(histogram));
}

std::string whatRan(const ProfileRun& run) {
    const std::string fineness = run.budget > 0 ? formatted("a view of %u vertices", run.budget)
                                 : run.patchRate != run.rate
                                     ? formatted("rate %u (%u a patch)", run.rate, run.patchRate)
                                     : formatted("rate %u", run.rate);
    return fineness +
           formatted(", %u instance%s of %u patches, ", run.instances, run.instances == 1 ? "" : "s", run.patches) +
           "clip " + run.clip + (run.playback ? ", played on the device" : "") +
           formatted(", %zu frames", run.frames.size());
}

std::string sectionOf(const ProfileRun& run, const HtmlReport& report) {
    const RunSummary summary = summarizeRun(run);
    std::string text = "<h2>" + escaped(run.file) + ": " + escaped(run.scheme) + "</h2><p class=soft>" +
                       escaped(whatRan(run)) + "</p><div class=show>";
    const bool first = &run == &*std::find_if(report.runs.begin(), report.runs.end(), [&](const ProfileRun& other) {
        return other.file == run.file && other.scheme == run.scheme;
    });
    for (const HtmlReport::Picture& picture : report.pictures) {
        if (first && picture.file == run.file && picture.scheme == run.scheme) {
            text += "<img alt=\"what was measured\" src=\"data:image/png;base64," + base64(picture.png) + "\">";
        }
    }
    text += "<div style=\"flex:1 1 300px;min-width:0\">" + tilesOf(run, summary) + "<p><b>" + escaped(adviceOf(run)) +
            "</b></p></div></div>";
    text += framesOf(run, summary, report.budgetMs) + "<h3>Passes</h3>" + passTable(summary) +
            surfacesOf(run, summary) + memoryOf(run);
    if (run.budget > 0) {
        text += "<p>Drawn: " + drawnText(run, summary) + ".</p>";
    }
    return text;
}

/// Runs of one file and scheme that differ in one number: lines over it.
std::string sweepOf(std::span<const ProfileRun> runs, uint32_t ProfileRun::*swept, uint32_t ProfileRun::*fixed,
                    const std::string& name) {
    std::string text;
    std::vector<const ProfileRun*> left;
    for (const ProfileRun& run : runs) {
        left.push_back(&run);
    }
    while (!left.empty()) {
        const ProfileRun& first = *left.front();
        std::vector<const ProfileRun*> alike;
        std::erase_if(left, [&](const ProfileRun* run) {
            const bool same = run->file == first.file && run->scheme == first.scheme && run->*fixed == first.*fixed &&
                              run->budget == first.budget;
            if (same && std::none_of(alike.begin(), alike.end(),
                                     [&](const ProfileRun* other) { return other->*swept == run->*swept; })) {
                alike.push_back(run);
            }
            return same;
        });
        if (alike.size() < 2) {
            continue;
        }
        std::sort(alike.begin(), alike.end(),
                  [&](const ProfileRun* a, const ProfileRun* b) { return a->*swept < b->*swept; });
        LineChart lines;
        lines.unit = "ms";
        lines.xName = name;
        lines.logarithmic = true;
        for (const ProfileRun* run : alike) {
            const RunSummary summary = summarizeRun(*run);
            const auto put = [&](const PassSummary& pass) {
                auto line = std::find_if(lines.series.begin(), lines.series.end(),
                                         [&](const ChartSeries& series) { return series.name == pass.pass; });
                if (line == lines.series.end()) {
                    line = lines.series.insert(line, {pass.pass, std::vector<double>(lines.x.size(), 0.0)});
                }
                line->values.resize(lines.x.size() + 1, 0.0);
                line->values.back() = pass.gpu.median;
            };
            for (const PassSummary& pass : summary.passes) {
                put(pass);
            }
            put(summary.total);
            lines.x.push_back(run->*swept);
            lines.labels.push_back(std::to_string(run->*swept));
        }
        for (ChartSeries& series : lines.series) {
            series.values.resize(lines.x.size(), 0.0);
        }
        text += "<h3>" + escaped(first.file) + ", " + escaped(first.scheme) + ": over " + escaped(name) + "</h3>" +
                wide(toSvg(lines));
    }
    return text;
}

std::string changesOf(std::span<const RunChange> changes) {
    std::string text, left;
    for (const RunChange& run : changes) {
        if (run.passes.empty()) {
            left += (left.empty() ? "" : "; ") + escaped(run.name);
            continue;
        }
        text += "<h3>" + escaped(run.name) + "</h3>";
        text += "<div class=wide><table><tr><th>pass<th>before ms<th>after ms<th>change<th>within, at 99.9 %<th></tr>";
        for (const PassChange& pass : run.passes) {
            text += "<tr><td>" + escaped(pass.pass) + formatted("<td>%.4f<td>%.4f", pass.before, pass.after);
            if (pass.before == 0.0 || pass.after == 0.0) {
                text += formatted("<td><td><td>%s</tr>", pass.before == 0.0 ? "new" : "gone");
                continue;
            }
            const char* word = !pass.significant ? "" : pass.change > 0.0 ? "slower" : "faster";
            text += formatted("<td>%+.1f %%<td>%+.1f to %+.1f %%<td class=\"%s\">%s</tr>", 100.0 * pass.change,
                              100.0 * pass.low, 100.0 * pass.high, word, word);
        }
        text += "</table></div>";
    }
    if (!left.empty()) {
        text += "<p class=soft>The earlier result does not have: " + left + ".</p>";
    }
    return text.empty() ? text
                        : "<h2>Compared with the earlier result</h2><p>" +
                              escaped(verdictOf({changes.begin(), changes.end()})) + "</p>" + text;
}

std::string missingOf(const HtmlReport& report) {
    std::string text;
    for (const std::string& warning : report.warnings) {
        text += "<li>" + escaped(warning) + "</li>";
    }
    for (const ProfileRun& run : report.runs) {
        const RunSummary summary = summarizeRun(run);
        const double share = summary.total.gpu.median > 0.0 ? summary.covered.median / summary.total.gpu.median : 1.0;
        if (share < 0.9) {
            text += "<li>" + escaped(run.file) + ", " + escaped(run.scheme) +
                    formatted(": %.0f %% of the frame lies in no pass: barriers, and what else the device does.</li>",
                              100.0 * (1.0 - share));
        }
    }
    text += "<li>Drawing is not in these figures: a host draws with shaders of its own.</li>";
    if (report.machine.cpuDevice) {
        text += "<li>The device is a CPU: its clock is the machine's, and other processes lengthen passes.</li>";
    }
    return "<h2>What to know</h2><ul>" + text + "</ul>";
}

} // namespace

std::string toHtml(const HtmlReport& report) {
    std::string title = "supple profile";
    std::string text =
        "<!doctype html><html lang=en><meta charset=utf-8>"
        "<meta name=viewport content=\"width=device-width\"><title>" +
        title + "</title><style>" + styles() + "</style><body><h1>" + title + "</h1><p>" +
        escaped(report.machine.device) + "</p><p class=soft>" + escaped(report.machine.driver) + " " +
        escaped(report.machine.driverInfo) + ", " + escaped(report.machine.mapping) + " mapping; CPU " +
        escaped(report.machine.cpu) +
        formatted("; Supple %d.%d.%d", SUPPLE_VERSION_MAJOR, SUPPLE_VERSION_MINOR, SUPPLE_VERSION_PATCH) +
        "</p><p><code>" + escaped(report.command) + "</code></p>";
    text += changesOf(report.changes);
    const std::string sweeps = sweepOf(report.runs, &ProfileRun::instances, &ProfileRun::rate, "instances") +
                               sweepOf(report.runs, &ProfileRun::rate, &ProfileRun::instances, "rate");
    if (!sweeps.empty()) {
        text += "<h2>What it depends on</h2><p class=soft>Medians of passes on the device; both axes are "
                "logarithmic.</p>" +
                sweeps;
    }
    for (const ProfileRun& run : report.runs) {
        text += sectionOf(run, report);
    }
    return text + missingOf(report) + "</body></html>\n";
}

} // namespace supple::tools
