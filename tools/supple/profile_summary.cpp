#include "tools/supple/profile_summary.h"

#include "tools/common/formatted.h"

#include <algorithm>
#include <functional>
#include <map>

namespace supple::tools {
namespace {

Summary summarizeFrames(const ProfileRun& run, const std::function<double(const FrameSample&)>& nanoseconds) {
    std::vector<double> values;
    values.reserve(run.frames.size());
    for (const FrameSample& frame : run.frames) {
        values.push_back(nanoseconds(frame) / kNanosecondsInMillisecond);
    }
    return summarize(values);
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

struct Span {
    double begin = 0.0, end = 0.0;
};
/// What spans cover, overlaps once.
double lengthOf(std::vector<Span> spans) {
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
    double length = 0.0, end = spans.empty() ? 0.0 : spans.front().begin;
    for (const Span& span : spans) {
        length += std::max(0.0, span.end - std::max(span.begin, end));
        end = std::max(end, span.end);
    }
    return length;
}

/// What a frame has of each pass, in nanoseconds.
struct PassOfFrame {
    std::vector<Span> spans;
    double cpuRecord = 0.0;
    uint64_t points = 0, bytes = 0;
};
std::map<std::string, PassOfFrame> passesOf(const FrameSample& frame) {
    std::map<std::string, PassOfFrame> passes;
    for (const PassSample& sample : frame.passes) {
        PassOfFrame& pass = passes[sample.pass];
        pass.spans.push_back({sample.gpuBegin, sample.gpuEnd});
        pass.cpuRecord += sample.cpuRecord;
        pass.points += sample.points;
        pass.bytes += sample.bytes;
    }
    return passes;
}
std::vector<Span> spansOf(const FrameSample& frame) {
    std::vector<Span> spans;
    for (const PassSample& pass : frame.passes) {
        spans.push_back({pass.gpuBegin, pass.gpuEnd});
    }
    return spans;
}
double envelope(const FrameSample& frame) {
    double begin = frame.passes.empty() ? 0.0 : frame.passes.front().gpuBegin, end = begin;
    for (const PassSample& pass : frame.passes) {
        begin = std::min(begin, pass.gpuBegin);
        end = std::max(end, pass.gpuEnd);
    }
    return end - begin;
}

/// The names of all passes, in the order in which frames have them first.
std::vector<std::string> passNames(const ProfileRun& run) {
    std::vector<std::string> names;
    for (const FrameSample& frame : run.frames) {
        for (const PassSample& pass : frame.passes) {
            if (std::find(names.begin(), names.end(), pass.pass) == names.end()) {
                names.push_back(pass.pass);
            }
        }
    }
    return names;
}

/// A pass may be missing from some frames (uploads happen once), so it is summed up over the frames that have it.
/// Points and bytes are those of the first such frame.
PassSummary summarizePass(const std::string& name, const std::vector<std::map<std::string, PassOfFrame>>& frames) {
    PassSummary summary;
    summary.pass = name;
    std::vector<double> gpu, cpu;
    for (const std::map<std::string, PassOfFrame>& frame : frames) {
        const auto pass = frame.find(name);
        if (pass == frame.end()) {
            continue;
        }
        if (gpu.empty()) {
            summary.points = pass->second.points;
            summary.bytes = pass->second.bytes;
        }
        gpu.push_back(lengthOf(pass->second.spans) / kNanosecondsInMillisecond);
        cpu.push_back(pass->second.cpuRecord / kNanosecondsInMillisecond);
    }
    summary.gpu = summarize(gpu);
    summary.cpuRecord = summarize(cpu);
    return summary;
}

Summary summarizeSurface(const ProfileRun& run, size_t surface) {
    return summarizeFrames(run, [&](const FrameSample& frame) {
        std::vector<Span> spans;
        for (const PassSample& pass : frame.passes) {
            if (pass.surface == surface) {
                spans.push_back({pass.gpuBegin, pass.gpuEnd});
            }
        }
        return lengthOf(std::move(spans));
    });
}

} // namespace

bool areSeveral(const std::vector<ProfiledSurface>& surfaces) {
    constexpr size_t kOneGroup = 2; // as a whole, and its surface
    return surfaces.size() > kOneGroup ||
           std::any_of(surfaces.begin(), surfaces.end(), [](const auto& surface) { return surface.parts.size() > 1; });
}

std::string nameOf(const ProfiledSurface& surface) {
    return surface.file + ", " + (surface.scheme.empty() ? "as a whole" : surface.scheme);
}

std::string partsText(const ProfiledSurface& surface) {
    uint32_t all = 0;
    for (const ProfiledSurface::Part& part : surface.parts) {
        all += part.patches;
    }
    std::string text;
    for (const ProfiledSurface::Part& part : surface.parts) {
        text +=
            (text.empty() ? "" : ", ") + part.name + formatted(" %.0f %%", 100.0 * part.patches / std::max(all, 1u));
    }
    return surface.parts.size() < 2 ? "" : text + " of the patches";
}

double PassSummary::megapointsPerSecond() const {
    return gpu.median > 0.0 ? static_cast<double>(points) / (gpu.median * 1e3) : 0.0;
}

RunSummary summarizeRun(const ProfileRun& run) {
    RunSummary summary;
    summary.total.pass = "frame";
    summary.total.gpu = summarizeFrames(run, envelope);
    summary.total.cpuRecord = summarizeFrames(run, [](const FrameSample& f) {
        double sum = 0.0;
        for (const PassSample& pass : f.passes) {
            sum += pass.cpuRecord;
        }
        return sum;
    });
    summary.covered = summarizeFrames(run, [](const FrameSample& f) { return lengthOf(spansOf(f)); });
    summary.pose = summarizeFrames(run, [](const FrameSample& f) { return f.poseTime; });
    summary.record = summarizeFrames(run, [](const FrameSample& f) { return f.recordTime; });

    std::vector<std::map<std::string, PassOfFrame>> frames;
    for (const FrameSample& frame : run.frames) {
        frames.push_back(passesOf(frame));
    }
    for (const std::string& name : passNames(run)) {
        const PassSummary& pass = summary.passes.emplace_back(summarizePass(name, frames));
        summary.total.bytes += pass.bytes;
        if (name == "evaluate") { // what comes out of a frame is surface vertices
            summary.total.points = pass.points;
        }
    }
    for (size_t surface = 0; surface < run.surfaces.size(); ++surface) {
        summary.surfaces.push_back(summarizeSurface(run, surface));
    }
    if (run.budget > 0) {
        summary.drawn = summarizeDrawn(run);
        if (summary.drawn.vertices > 0) { // subdivision's are the groups' own
            summary.total.points = summary.drawn.vertices;
        }
    }
    return summary;
}

FrameTimes frameTimes(const ProfileRun& run) {
    FrameTimes times;
    for (const std::string& name : passNames(run)) {
        times.passes.push_back({name, {}});
    }
    for (const FrameSample& frame : run.frames) {
        times.frame.push_back(envelope(frame) / kNanosecondsInMillisecond);
        times.covered.push_back(lengthOf(spansOf(frame)) / kNanosecondsInMillisecond);
        const std::map<std::string, PassOfFrame> passes = passesOf(frame);
        for (FrameTimes::Pass& pass : times.passes) {
            const auto found = passes.find(pass.pass);
            pass.times.push_back(found == passes.end() ? 0.0
                                                       : lengthOf(found->second.spans) / kNanosecondsInMillisecond);
        }
    }
    return times;
}

} // namespace supple::tools
