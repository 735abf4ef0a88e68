#include "tools/supple/profile_report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <supple/supple.h>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNanosecondsInMillisecond = 1e6;
constexpr double kNanosecondsInMicrosecond = 1e3;

Summary summarizeFrames(const ProfileRun& run, const std::function<double(const FrameSample&)>& nanoseconds) {
    std::vector<double> values;
    values.reserve(run.frames.size());
    for (const FrameSample& frame : run.frames) {
        values.push_back(nanoseconds(frame) / kNanosecondsInMillisecond);
    }
    return summarize(values);
}

double firstBegin(const FrameSample& frame) {
    double first = frame.passes.empty() ? 0.0 : frame.passes.front().gpuBegin;
    for (const PassSample& pass : frame.passes) {
        first = std::min(first, pass.gpuBegin);
    }
    return first;
}

double lastEnd(const FrameSample& frame) {
    double last = frame.passes.empty() ? 0.0 : frame.passes.front().gpuEnd;
    for (const PassSample& pass : frame.passes) {
        last = std::max(last, pass.gpuEnd);
    }
    return last;
}

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
    return {{"median", summary.median}, {"p95", summary.p95}, {"max", summary.max}};
}

Json toJson(const PassSummary& pass) {
    return {{"pass", pass.pass},     {"gpuMs", toJson(pass.gpu)}, {"cpuRecordMs", toJson(pass.cpuRecord)},
            {"points", pass.points}, {"bytes", pass.bytes},       {"megapointsPerSecond", pass.megapointsPerSecond()}};
}

Json toJson(const Machine& machine) {
    return {{"device", machine.device},
            {"driver", machine.driver},
            {"driverInfo", machine.driverInfo},
            {"mapping", machine.mapping},
            {"cpu", machine.cpu}};
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

double PassSummary::megapointsPerSecond() const {
    return gpu.median > 0.0 ? static_cast<double>(points) / (gpu.median * 1e3) : 0.0;
}

RunSummary summarizeRun(const ProfileRun& run) {
    RunSummary summary;
    summary.total.pass = "frame";
    summary.total.gpu = summarizeFrames(run, [](const FrameSample& f) { return lastEnd(f) - firstBegin(f); });
    summary.total.cpuRecord = summarizeFrames(run, [](const FrameSample& f) {
        double sum = 0.0;
        for (const PassSample& pass : f.passes) {
            sum += pass.cpuRecord;
        }
        return sum;
    });
    summary.pose = summarizeFrames(run, [](const FrameSample& f) { return f.poseTime; });
    summary.record = summarizeFrames(run, [](const FrameSample& f) { return f.recordTime; });

    // A pass may be missing from some frames (uploads happen once), so each is summed up over the frames that had it.
    std::vector<std::vector<double>> gpu;
    std::vector<std::vector<double>> cpu;
    for (const FrameSample& frame : run.frames) {
        for (const PassSample& pass : frame.passes) {
            const auto known = std::find_if(summary.passes.begin(), summary.passes.end(),
                                            [&](const PassSummary& s) { return s.pass == pass.pass; });
            const auto index = static_cast<size_t>(known - summary.passes.begin());
            if (known == summary.passes.end()) {
                summary.passes.push_back({pass.pass, {}, {}, pass.points, pass.bytes});
                gpu.emplace_back();
                cpu.emplace_back();
            }
            gpu[index].push_back((pass.gpuEnd - pass.gpuBegin) / kNanosecondsInMillisecond);
            cpu[index].push_back(pass.cpuRecord / kNanosecondsInMillisecond);
        }
    }
    for (size_t i = 0; i < summary.passes.size(); ++i) {
        summary.passes[i].gpu = summarize(gpu[i]);
        summary.passes[i].cpuRecord = summarize(cpu[i]);
        summary.total.bytes += summary.passes[i].bytes;
        if (summary.passes[i].pass == "evaluate") { // what comes out of a frame is surface vertices
            summary.total.points = summary.passes[i].points;
        }
    }
    return summary;
}

std::string toTable(const ProfileRun& run, const RunSummary& summary) {
    const std::string patchRate = run.patchRate == run.rate ? "" : format(" (%u a patch)", run.patchRate);
    std::string table =
        run.file + format(": scheme %s, rate %u%s, %u instance%s of %u patches, %zu frames, %.1f MiB\n",
                          run.scheme.c_str(), run.rate, patchRate.c_str(), run.instances, run.instances == 1 ? "" : "s",
                          run.patches, run.frames.size(), static_cast<double>(run.deviceBytes) / (1024.0 * 1024.0));
    table += format("  %-12s %10s %10s %10s %10s %12s %13s %10s\n", "pass", "GPU ms", "p95", "max", "CPU ms", "points",
                    "bytes", "Mpoints/s");
    for (const PassSummary& pass : summary.passes) {
        table += tableRow(pass);
    }
    table += tableRow(summary.total);
    table += format("  CPU a frame: %.4f ms to set the %s, %.4f ms to record (medians)\n", summary.pose.median,
                    run.playback ? "time" : "poses", summary.record.median);
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
        Json entry = {{"file", run.file},           {"scheme", run.scheme},        {"rate", run.rate},
                      {"patchRate", run.patchRate}, {"instances", run.instances},  {"playback", run.playback},
                      {"patches", run.patches},     {"frames", run.frames.size()}, {"deviceBytes", run.deviceBytes},
                      {"passes", Json::array()}};
        for (const PassSummary& pass : summary.passes) {
            entry["passes"].push_back(toJson(pass));
        }
        entry["frame"] = toJson(summary.total);
        entry["frame"].erase("pass");
        entry["cpuPoseMs"] = toJson(summary.pose);
        entry["cpuRecordMs"] = toJson(summary.record);
        json["runs"].push_back(std::move(entry));
    }
    return json;
}

std::string toCsv(std::span<const ProfileRun> runs) {
    std::string csv = "file,scheme,rate,instances,frames,pass,gpu_ms_median,gpu_ms_p95,gpu_ms_max,cpu_ms_median,"
                      "points,bytes,mpoints_per_s\n";
    for (const ProfileRun& run : runs) {
        const RunSummary summary = summarizeRun(run);
        std::vector<PassSummary> rows = summary.passes;
        rows.push_back(summary.total);
        for (const PassSummary& pass : rows) {
            csv += csvText(run.file) + format(",%s,%u,%u,%zu,%s,%.6f,%.6f,%.6f,%.6f,%llu,%llu,%.3f\n",
                                              run.scheme.c_str(), run.rate, run.instances, run.frames.size(),
                                              pass.pass.c_str(), pass.gpu.median, pass.gpu.p95, pass.gpu.max,
                                              pass.cpuRecord.median, static_cast<unsigned long long>(pass.points),
                                              static_cast<unsigned long long>(pass.bytes), pass.megapointsPerSecond());
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
        const double gpuOffset = run.frames.front().submitted - firstBegin(run.frames.front());
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
