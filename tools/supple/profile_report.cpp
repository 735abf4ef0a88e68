#include "tools/supple/profile_report.h"

#include "tools/supple/memory_report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <supple/supple.h>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNanosecondsInMicrosecond = 1e3;

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(line, sizeof line, pattern, arguments);
    va_end(arguments);
    return line;
}

std::string tableRow(const PassSummary& pass) {
    const double rate = pass.megapointsPerSecond();
    return format("  %-12s %10.4f %10.4f %10.4f %10.4f %12llu %13llu %10s\n", pass.pass.c_str(), pass.gpu.median,
                  pass.gpu.p95, pass.gpu.max, pass.cpuRecord.median, static_cast<unsigned long long>(pass.points),
                  static_cast<unsigned long long>(pass.bytes), rate > 0.0 ? format("%.1f", rate).c_str() : "-");
}

Json toJson(const Summary& summary) {
    return {{"median", summary.median}, {"p95", summary.p95}, {"max", summary.max}, {"min", summary.min},
            {"p05", summary.p05},       {"p25", summary.p25}, {"p75", summary.p75}};
}

Json toJson(const PassSummary& pass) {
    return {{"pass", pass.pass},     {"gpuMs", toJson(pass.gpu)}, {"cpuRecordMs", toJson(pass.cpuRecord)},
            {"points", pass.points}, {"bytes", pass.bytes},       {"megapointsPerSecond", pass.megapointsPerSecond()}};
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

Json traceSlice(const std::string& name, int process, int track, double begin, double duration) {
    return {{"ph", "X"},
            {"name", name},
            {"pid", process},
            {"tid", track},
            {"ts", begin / kNanosecondsInMicrosecond},
            {"dur", duration / kNanosecondsInMicrosecond}};
}

} // namespace

std::string toTable(const ProfileRun& run, const RunSummary& summary) {
    const std::string patchRate = run.patchRate == run.rate ? "" : format(" (%u a patch)", run.patchRate);
    const std::string fineness = run.budget > 0 ? format("in a view of %u vertices", run.budget)
                                                : format("rate %u%s", run.rate, patchRate.c_str());
    std::string table =
        run.file + format(": scheme %s, %s, clip ", run.scheme.c_str(), fineness.c_str()) + run.clip +
        format(", %u instance%s of %s%u patches, %zu frames\n", run.instances, run.instances == 1 ? "" : "s",
               run.budget > 0 ? "up to " : "", run.patches, run.frames.size());
    table += "  memory: " + memoryText(run.memory) + "\n";
    table += format("  %-12s %10s %10s %10s %10s %12s %13s %10s\n", "pass", "GPU ms", "p95", "max", "CPU ms", "points",
                    "bytes", "Mpoints/s");
    for (const PassSummary& pass : summary.passes) {
        table += tableRow(pass);
    }
    table += tableRow(summary.total);
    table += format("  passes cover %.0f %% of the frame; what of them overlaps counts once\n",
                    summary.total.gpu.median > 0.0 ? 100.0 * summary.covered.median / summary.total.gpu.median : 0.0);
    table += format("  CPU a frame: %.4f ms to set the %s, %.4f ms to record (medians)\n", summary.pose.median,
                    run.playback ? "time" : "poses", summary.record.median);
    if (run.budget > 0) {
        const DrawnSummary& drawn = summary.drawn;
        table += format(
            "  drawn: %llu vertices of %llu wanted, %llu patches, %llu instances; levels scaled by %.3f and "
            "more; %u instances dropped at most; shortfall in %zu of %zu frames\n",
            static_cast<unsigned long long>(drawn.vertices), static_cast<unsigned long long>(drawn.wantedVertices),
            static_cast<unsigned long long>(drawn.patches), static_cast<unsigned long long>(drawn.drawnInstances),
            static_cast<double>(drawn.leastLevelScale), drawn.mostDropped, drawn.shortfallFrames, run.frames.size());
    }
    return table;
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
                      {"passes", Json::array()}};
        for (const PassSummary& pass : summary.passes) {
            entry["passes"].push_back(toJson(pass));
        }
        entry["frame"] = toJson(summary.total);
        entry["frame"].erase("pass");
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
        const std::string view = run.budget == 0 ? ",,,"
                                                 : format(",%u,%llu,%zu", run.budget,
                                                          static_cast<unsigned long long>(summary.drawn.wantedVertices),
                                                          summary.drawn.shortfallFrames);
        for (const PassSummary& pass : rows) {
            csv += csvText(run.file) +
                   format(",%s,%u,%u,%zu,%s,%.6f,%.6f,%.6f,%.6f,%llu,%llu,%.3f%s\n", run.scheme.c_str(), run.rate,
                          run.instances, run.frames.size(), pass.pass.c_str(), pass.gpu.median, pass.gpu.p95,
                          pass.gpu.max, pass.cpuRecord.median, static_cast<unsigned long long>(pass.points),
                          static_cast<unsigned long long>(pass.bytes), pass.megapointsPerSecond(), view.c_str());
        }
    }
    return csv;
}

nlohmann::ordered_json toTrace(const Machine& machine, std::span<const ProfileRun> runs) {
    constexpr int kGpuTrack = 1;
    constexpr int kCpuTrack = 2;
    Json events = Json::array();
    int process = 0;
    for (const ProfileRun& run : runs) {
        ++process;
        events.push_back(traceName("process_name", process, 0, run.file + " (" + run.scheme + ")"));
        events.push_back(traceName("thread_name", process, kGpuTrack, "GPU: " + machine.device));
        events.push_back(traceName("thread_name", process, kCpuTrack, "CPU record"));
        if (run.frames.empty()) {
            continue;
        }
        double first = run.frames.front().passes.front().gpuBegin;
        for (const PassSample& pass : run.frames.front().passes) {
            first = std::min(first, pass.gpuBegin);
        }
        const double gpuOffset = run.frames.front().submitted - first;
        for (const FrameSample& frame : run.frames) {
            const Json frameNumber = {{"frame", frame.frame}};
            Json pose = traceSlice("poses", process, kCpuTrack, frame.poseBegin, frame.poseTime);
            Json record = traceSlice("record", process, kCpuTrack, frame.recordBegin, frame.recordTime);
            pose["args"] = frameNumber;
            record["args"] = frameNumber;
            events.push_back(std::move(pose));
            events.push_back(std::move(record));
            double cpu = frame.recordBegin;
            for (const PassSample& pass : frame.passes) {
                const Json args = {{"frame", frame.frame}, {"points", pass.points}, {"bytes", pass.bytes}};
                Json slice =
                    traceSlice(pass.pass, process, kGpuTrack, pass.gpuBegin + gpuOffset, pass.gpuEnd - pass.gpuBegin);
                slice["args"] = args;
                events.push_back(std::move(slice));
                // The library tells how long recording a pass took, not when: they follow each other inside "record".
                events.push_back(traceSlice(pass.pass, process, kCpuTrack, cpu, pass.cpuRecord));
                cpu += pass.cpuRecord;
            }
        }
    }
    return {{"displayTimeUnit", "ms"}, {"otherData", toJson(machine)}, {"traceEvents", std::move(events)}};
}

} // namespace supple::tools
