#include "tools/supple/profile_report.h"

#include "tools/supple/memory_report.h"

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

DrawnSummary summarizeDrawn(const ProfileRun& run) {
    const auto median = [&](uint32_t DrawnSample::*count) {
        std::vector<double> values;
        for (const FrameSample& frame : run.frames) {
            values.push_back(frame.drawn.*count);
        }
        return static_cast<uint64_t>(summarize(values).median);
    };
    DrawnSummary summary;
    summary.vertices = median(&DrawnSample::vertices);
    summary.wantedVertices = median(&DrawnSample::wantedVertices);
    summary.patches = median(&DrawnSample::patches);
    summary.drawnInstances = median(&DrawnSample::drawnInstances);
    for (const FrameSample& frame : run.frames) {
        summary.mostDropped = std::max(summary.mostDropped, frame.drawn.droppedInstances);
        summary.leastLevelScale = std::min(summary.leastLevelScale, frame.drawn.levelScale);
        summary.shortfallFrames += frame.drawn.shortfall ? 1 : 0;
    }
    return summary;
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
    return {{"device", machine.device},   {"driver", machine.driver}, {"driverInfo", machine.driverInfo},
            {"mapping", machine.mapping}, {"cpu", machine.cpu},       {"cpuDevice", machine.cpuDevice}};
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

    // A pass may be missing from some frames (uploads happen once), so each is summed up over the frames that had it. A
    // frame may have it several times: a group each, or in parts.
    std::vector<std::vector<double>> gpu;
    std::vector<std::vector<double>> cpu;
    for (const FrameSample& frame : run.frames) {
        std::vector<bool> met(summary.passes.size(), false);
        for (const PassSample& pass : frame.passes) {
            const auto known = std::find_if(summary.passes.begin(), summary.passes.end(),
                                            [&](const PassSummary& s) { return s.pass == pass.pass; });
            const auto index = static_cast<size_t>(known - summary.passes.begin());
            if (known == summary.passes.end()) {
                summary.passes.push_back({pass.pass, {}, {}, 0, 0});
                gpu.emplace_back();
                cpu.emplace_back();
                met.push_back(false);
            }
            if (!met[index]) {
                met[index] = true;
                gpu[index].push_back(0.0);
                cpu[index].push_back(0.0);
            }
            if (gpu[index].size() == 1) { // points and bytes are the first such frame's
                summary.passes[index].points += pass.points;
                summary.passes[index].bytes += pass.bytes;
            }
            gpu[index].back() += (pass.gpuEnd - pass.gpuBegin) / kNanosecondsInMillisecond;
            cpu[index].back() += pass.cpuRecord / kNanosecondsInMillisecond;
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
    if (run.budget > 0) {
        summary.drawn = summarizeDrawn(run);
        if (summary.drawn.vertices > 0) { // subdivision's are the groups' own
            summary.total.points = summary.drawn.vertices;
        }
    }
    return summary;
}

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
