#include "tools/supple/profile_report.h"

#include "tools/common/formatted.h"
#include "tools/supple/memory_report.h"
#include "tools/supple/profile_advice.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <supple/supple.h>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNanosecondsInMicrosecond = 1e3;

std::string tableRow(const PassSummary& pass) {
    const double rate = pass.megapointsPerSecond();
    return formatted("  %-12s %10.4f %10.4f %10.4f %10.4f %12llu %13llu %10s\n", pass.pass.c_str(), pass.gpu.median,
                     pass.gpu.p95, pass.gpu.max, pass.cpuRecord.median, static_cast<unsigned long long>(pass.points),
                     static_cast<unsigned long long>(pass.bytes), rate > 0.0 ? formatted("%.1f", rate).c_str() : "-");
}

/// What each surface of each group takes.
std::string surfaceTable(const ProfileRun& run, const RunSummary& summary) {
    if (!areSeveral(run.surfaces)) {
        return "";
    }
    std::string table = formatted("  %-34s %10s %10s %10s\n", "group and surface", "GPU ms", "p95", "share");
    for (size_t i = 0; i < run.surfaces.size(); ++i) {
        const Summary& gpu = summary.surfaces[i];
        const double frame = summary.total.gpu.median;
        table += formatted("  %-34s %10.4f %10.4f %8.1f %%", nameOf(run.surfaces[i]).c_str(), gpu.median, gpu.p95,
                           frame > 0.0 ? 100.0 * gpu.median / frame : 0.0);
        const std::string parts = partsText(run.surfaces[i]);
        table += (parts.empty() ? "" : "   " + parts) + "\n";
    }
    return table;
}

Json toJson(const Summary& summary) {
    return {{"median", summary.median}, {"p95", summary.p95}, {"max", summary.max}, {"min", summary.min},
            {"p05", summary.p05},       {"p25", summary.p25}, {"p75", summary.p75}};
}

Json toJson(const PassSummary& pass) {
    return {{"pass", pass.pass},     {"gpuMs", toJson(pass.gpu)}, {"cpuRecordMs", toJson(pass.cpuRecord)},
            {"points", pass.points}, {"bytes", pass.bytes},       {"megapointsPerSecond", pass.megapointsPerSecond()}};
}

Json surfacesJson(const ProfileRun& run, const RunSummary& summary) {
    Json surfaces = Json::array();
    for (size_t i = 0; i < run.surfaces.size(); ++i) {
        const ProfiledSurface& surface = run.surfaces[i];
        Json entry = {{"file", surface.file}, {"gpuMs", toJson(summary.surfaces[i])}};
        if (!surface.scheme.empty()) { // else it is the group as a whole
            entry["scheme"] = surface.scheme;
            entry["parts"] = Json::array();
        }
        for (const ProfiledSurface::Part& part : surface.parts) {
            entry["parts"].push_back({{"name", part.name}, {"patches", part.patches}});
        }
        surfaces.push_back(std::move(entry));
    }
    return surfaces;
}

Json toJson(const Machine& machine) {
    return {{"device", machine.device},   {"driver", machine.driver}, {"driverInfo", machine.driverInfo},
            {"mapping", machine.mapping}, {"cpu", machine.cpu},       {"cpuDevice", machine.cpuDevice}};
}

Json samplesOf(const ProfileRun& run) {
    const FrameTimes times = frameTimes(run);
    Json passes = Json::object();
    for (const FrameTimes::Pass& pass : times.passes) {
        passes[pass.pass] = pass.times;
    }
    return {{"frameMs", times.frame}, {"coveredMs", times.covered}, {"passMs", std::move(passes)}};
}

/// RFC 4180: quoted, quotes doubled.
std::string csvText(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

Json traceName(const char* kind, int process, int track, const std::string& name) {
    return {{"ph", "M"}, {"name", kind}, {"pid", process}, {"tid", track}, {"args", {{"name", name}}}};
}

Json traceCounter(const std::string& name, int process, double at, double value) {
    return {{"ph", "C"},
            {"name", name},
            {"pid", process},
            {"ts", at / kNanosecondsInMicrosecond},
            {"args", {{name, value}}}};
}

/// From the device's clock to the run's.
std::function<double(double)> clockOf(const ProfileRun& run) {
    if (run.clocks.size() >= 2 && run.clocks.back().device > run.clocks.front().device) {
        const ProfileRun::Clocks first = run.clocks.front(), last = run.clocks.back();
        const double scale = (last.run - first.run) / (last.device - first.device);
        return [first, scale](double device) { return first.run + (device - first.device) * scale; };
    }
    double begin = run.frames.front().passes.front().gpuBegin;
    for (const PassSample& pass : run.frames.front().passes) {
        begin = std::min(begin, pass.gpuBegin);
    }
    const double offset = run.frames.front().submitted - begin;
    return [offset](double device) { return device + offset; };
}

Json traceSlice(const std::string& name, int process, int track, double begin, double duration) {
    return {{"ph", "X"},
            {"name", name},
            {"pid", process},
            {"tid", track},
            {"ts", begin / kNanosecondsInMicrosecond},
            {"dur", duration / kNanosecondsInMicrosecond}};
}

constexpr int kGpuTrack = 1;
constexpr int kCpuTrack = 2;

void addFrame(const FrameSample& frame, int process, const std::function<double(double)>& toRun, Json& events) {
    const Json frameNumber = {{"frame", frame.frame}};
    Json pose = traceSlice("poses", process, kCpuTrack, frame.poseBegin, frame.poseTime);
    Json record = traceSlice("record", process, kCpuTrack, frame.recordBegin, frame.recordTime);
    pose["args"] = frameNumber;
    record["args"] = frameNumber;
    events.push_back(std::move(pose));
    events.push_back(std::move(record));
    double cpu = frame.recordBegin, begin = frame.passes.front().gpuBegin, end = begin;
    uint64_t vertices = 0, bytes = 0;
    for (const PassSample& pass : frame.passes) {
        const double from = toRun(pass.gpuBegin);
        Json slice = traceSlice(pass.pass, process, kGpuTrack, from, toRun(pass.gpuEnd) - from);
        slice["args"] = {{"frame", frame.frame}, {"points", pass.points}, {"bytes", pass.bytes}};
        events.push_back(std::move(slice));
        // The library tells how long recording a pass took, not when: they follow each other inside "record".
        events.push_back(traceSlice(pass.pass, process, kCpuTrack, cpu, pass.cpuRecord));
        cpu += pass.cpuRecord;
        begin = std::min(begin, pass.gpuBegin);
        end = std::max(end, pass.gpuEnd);
        vertices += pass.pass == "evaluate" ? pass.points : 0;
        bytes += pass.bytes;
    }
    const double at = toRun(begin);
    events.push_back(traceCounter("frame ms", process, at, (end - begin) / kNanosecondsInMillisecond));
    events.push_back(traceCounter("surface vertices", process, at, static_cast<double>(vertices)));
    events.push_back(traceCounter("bytes written", process, at, static_cast<double>(bytes)));
}

/// A line each, of what is on the device.
std::string holdersText(const ProfileRun& run) {
    std::string text;
    for (const MemoryHolder& holder : run.holders) {
        text += "    " + holder.name + ": " + heldText(holder.use) + "\n";
    }
    return text + (run.keptUnseen > 0
                       ? formatted("    What goes back does so when nobody is seen for %u frames.\n", run.keptUnseen)
                       : "");
}

/// An entry for each holder: what memoryJson() says, and what goes back if nobody is seen.
Json holdersJson(const ProfileRun& run) {
    Json holders = Json::array();
    for (const MemoryHolder& holder : run.holders) {
        Json entry = {{"name", holder.name}};
        entry.update(memoryJson(holder.use));
        if (run.keptUnseen > 0) {
            entry["givenBackBytes"] = holder.use.givenBack;
        }
        holders.push_back(std::move(entry));
    }
    return holders;
}

} // namespace

std::string drawnText(const ProfileRun& run, const RunSummary& summary) {
    const DrawnSummary& drawn = summary.drawn;
    return formatted(
        "%llu vertices of %llu wanted, %llu patches, %llu instances; levels scaled by %.3f and more; %u instances "
        "dropped at most; shortfall in %zu of %zu frames",
        static_cast<unsigned long long>(drawn.vertices), static_cast<unsigned long long>(drawn.wantedVertices),
        static_cast<unsigned long long>(drawn.patches), static_cast<unsigned long long>(drawn.drawnInstances),
        static_cast<double>(drawn.leastLevelScale), drawn.mostDropped, drawn.shortfallFrames, run.frames.size());
}

std::string toTable(const ProfileRun& run, const RunSummary& summary) {
    const std::string patchRate = run.patchRate == run.rate ? "" : formatted(" (%u a patch)", run.patchRate);
    const std::string fineness = run.budget > 0 ? formatted("in a view of %u vertices", run.budget)
                                                : formatted("rate %u%s", run.rate, patchRate.c_str());
    std::string table =
        run.file + formatted(": scheme %s, %s, clip ", run.scheme.c_str(), fineness.c_str()) + run.clip +
        formatted(", %u instance%s of %s%u patches, %zu frames\n", run.instances, run.instances == 1 ? "" : "s",
                  run.budget > 0 ? "up to " : "", run.patches, run.frames.size());
    table += "  memory: " + memoryText(run.memory) + "\n" + holdersText(run);
    table += formatted("  %-12s %10s %10s %10s %10s %12s %13s %10s\n", "pass", "GPU ms", "p95", "max", "CPU ms",
                       "points", "bytes", "Mpoints/s");
    for (const PassSummary& pass : summary.passes) {
        table += tableRow(pass);
    }
    table += tableRow(summary.total);
    table += surfaceTable(run, summary);
    table +=
        formatted("  passes cover %.0f %% of the frame; what of them overlaps counts once\n",
                  summary.total.gpu.median > 0.0 ? 100.0 * summary.covered.median / summary.total.gpu.median : 0.0);
    table += formatted("  CPU a frame: %.4f ms to set the %s, %.4f ms to record (medians)\n", summary.pose.median,
                       run.playback ? "time" : "poses", summary.record.median);
    if (run.budget > 0) {
        table += "  drawn: " + drawnText(run, summary) + "\n";
    }
    const std::string advice = adviceOf(run);
    return advice.empty() ? table : table + "  " + advice + "\n";
}

nlohmann::ordered_json toJson(const Machine& machine, std::span<const ProfileRun> runs) {
    Json json;
    json["version"] = std::to_string(SUPPLE_VERSION_MAJOR) + "." + std::to_string(SUPPLE_VERSION_MINOR) + "." +
                      std::to_string(SUPPLE_VERSION_PATCH);
    json["machine"] = toJson(machine);
    json["runs"] = Json::array();
    for (const ProfileRun& run : runs) {
        const RunSummary summary = summarizeRun(run);
        Json entry = {{"file", run.file},
                      {"scheme", run.scheme},
                      {"clip", run.clip},
                      {"rate", run.rate},
                      {"patchRate", run.patchRate},
                      {"instances", run.instances},
                      {"playback", run.playback},
                      {"patches", run.patches},
                      {"frames", run.frames.size()},
                      {"memory", memoryJson(run.memory)},
                      {"holders", holdersJson(run)},
                      {"passes", Json::array()}};
        for (const PassSummary& pass : summary.passes) {
            entry["passes"].push_back(toJson(pass));
        }
        entry["frame"] = toJson(summary.total);
        entry["frame"].erase("pass");
        entry["surfaces"] = surfacesJson(run, summary);
        entry["coveredMs"] = toJson(summary.covered);
        entry["samples"] = samplesOf(run);
        entry["cpuPoseMs"] = toJson(summary.pose);
        entry["cpuRecordMs"] = toJson(summary.record);
        if (run.budget > 0) {
            entry["view"] = {{"budget", run.budget},
                             {"vertices", summary.drawn.vertices},
                             {"wantedVertices", summary.drawn.wantedVertices},
                             {"patches", summary.drawn.patches},
                             {"drawnInstances", summary.drawn.drawnInstances},
                             {"mostDroppedInstances", summary.drawn.mostDropped},
                             {"leastLevelScale", summary.drawn.leastLevelScale},
                             {"shortfallFrames", summary.drawn.shortfallFrames}};
        }
        json["runs"].push_back(std::move(entry));
    }
    return json;
}

std::string toCsv(std::span<const ProfileRun> runs) {
    std::string csv = "file,scheme,rate,instances,frames,pass,gpu_ms_median,gpu_ms_p95,gpu_ms_max,cpu_ms_median,"
                      "points,bytes,mpoints_per_s,view_budget,view_wanted_vertices,view_shortfall_frames\n";
    for (const ProfileRun& run : runs) {
        const RunSummary summary = summarizeRun(run);
        std::vector<PassSummary> rows = summary.passes;
        rows.push_back(summary.total);
        const std::string view =
            run.budget == 0
                ? ",,,"
                : formatted(",%u,%llu,%zu", run.budget, static_cast<unsigned long long>(summary.drawn.wantedVertices),
                            summary.drawn.shortfallFrames);
        for (const PassSummary& pass : rows) {
            csv += csvText(run.file) +
                   formatted(",%s,%u,%u,%zu,%s,%.6f,%.6f,%.6f,%.6f,%llu,%llu,%.3f%s\n", run.scheme.c_str(), run.rate,
                             run.instances, run.frames.size(), pass.pass.c_str(), pass.gpu.median, pass.gpu.p95,
                             pass.gpu.max, pass.cpuRecord.median, static_cast<unsigned long long>(pass.points),
                             static_cast<unsigned long long>(pass.bytes), pass.megapointsPerSecond(), view.c_str());
        }
    }
    return csv;
}

nlohmann::ordered_json toTrace(const Machine& machine, std::span<const ProfileRun> runs) {
    Json events = Json::array();
    Json other = toJson(machine);
    int process = 0;
    for (const ProfileRun& run : runs) {
        ++process;
        events.push_back(traceName("process_name", process, 0, run.file + " (" + run.scheme + ")"));
        events.push_back(traceName("thread_name", process, kGpuTrack, "GPU: " + machine.device));
        events.push_back(traceName("thread_name", process, kCpuTrack, "CPU record"));
        if (run.frames.empty()) {
            continue;
        }
        double deviation = 0.0;
        for (const ProfileRun::Clocks& clocks : run.clocks) {
            deviation = std::max(deviation, clocks.deviation);
        }
        other["clocks"] = run.clocks.size() < 2
                              ? Json("laid together at the first frame's submission")
                              : Json(formatted("read together, within %.3f us", deviation / kNanosecondsInMicrosecond));
        const std::function<double(double)> toRun = clockOf(run);
        for (const FrameSample& frame : run.frames) {
            addFrame(frame, process, toRun, events);
        }
    }
    return {{"displayTimeUnit", "ms"}, {"otherData", std::move(other)}, {"traceEvents", std::move(events)}};
}

} // namespace supple::tools
