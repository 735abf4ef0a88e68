#include "tools/bench/scene.h"

#include "tools/bench/pass_times.h"
#include "tools/bench/scene_stage.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kSceneWarmFrames = 3;
constexpr uint32_t kRecordings = 3; ///< that are timed apart, for each frame that is measured
constexpr uint32_t kMostViews = 4;
/// What a game writes between two recordings: nothing, more than a core's own caches hold, more than all hold.
struct HostWork {
    const char* key;
    size_t bytes;
};
constexpr HostWork kHostWork[] = {
    {"recordAloneUs", 0}, {"recordBehindWorkUs", size_t{4} << 20}, {"recordColdUs", size_t{64} << 20}};

/// What a view has to do for itself, also where it shares poses, cages and coefficients with others.
constexpr SupplePass kPassesOfAView[] = {SUPPLE_PASS_BOUNDS, SUPPLE_PASS_LIST,       SUPPLE_PASS_LEVEL,
                                         SUPPLE_PASS_SOLVE,  SUPPLE_PASS_PLACE,      SUPPLE_PASS_EVALUATE,
                                         SUPPLE_PASS_MOTION, SUPPLE_PASS_ATTRIBUTES, SUPPLE_PASS_UPLOAD};

struct HostTimes {
    WatchedCommands commands;
    double setMicroseconds = 0.0, recordMicroseconds = 0.0;
};

double medianOf(const std::vector<SceneFrame>& frames, double SceneFrame::*value) {
    std::vector<double> values;
    for (const SceneFrame& frame : frames) {
        values.push_back(frame.*value);
    }
    return tools::summarize(values).median;
}

/// Frames without timestamps, as a game records them. The first ones upload what never changes.
Result<HostTimes> timeHost(SceneStage& stage, uint32_t count) {
    std::vector<SceneFrame> frames;
    for (uint32_t i = 0; i < kSceneWarmFrames + count; ++i) {
        const Result<SceneFrame> frame = stage.frame();
        if (!frame) {
            return frame.error();
        }
        if (i >= kSceneWarmFrames) {
            frames.push_back(*frame);
        }
    }
    return HostTimes{frames.back().commands, medianOf(frames, &SceneFrame::setMicroseconds),
                     medianOf(frames, &SceneFrame::recordMicroseconds)};
}

struct SceneTimes {
    std::vector<PassTimes> frames;
    /// Milliseconds of the views that were added: in the passes that a view has for itself, and in the others.
    std::vector<double> own, repeated;
};

Result<SceneTimes> timePasses(SceneStage& stage, uint32_t count) {
    SceneTimes times;
    for (uint32_t i = 0; i < kSceneWarmFrames + count; ++i) {
        const Result<SceneFrame> frame = stage.frame(SUPPLE_RECORD_TIMINGS);
        const Result<std::vector<SuppleTiming>> timings =
            frame ? stage.timings() : Result<std::vector<SuppleTiming>>(frame.error());
        if (!timings) {
            return timings.error();
        }
        if (i < kSceneWarmFrames) {
            continue;
        }
        times.frames.emplace_back(*timings);
        double own = 0.0, repeated = 0.0;
        for (const SuppleTiming& one : *timings) {
            if (stage.isOfFurtherView(one) && one.pass != SUPPLE_PASS_SHORTFALL) {
                const bool ofAView = std::find(std::begin(kPassesOfAView), std::end(kPassesOfAView), one.pass) !=
                                     std::end(kPassesOfAView);
                (ofAView ? own : repeated) += 1e-6 * (one.gpuEnd - one.gpuBegin);
            }
        }
        times.own.push_back(own);
        times.repeated.push_back(repeated);
    }
    return times;
}

/// Medians of frames that are recorded and never run: on CPU devices their passes would take the caches.
Result<Json> timeRecording(SceneStage& stage, uint32_t count) {
    Json result;
    for (const HostWork& work : kHostWork) {
        std::vector<double> times;
        for (uint32_t i = 0; i < kSceneWarmFrames + count; ++i) {
            const Result<double> time = stage.recordBehindWork(work.bytes);
            if (!time) {
                return time.error();
            }
            if (i >= kSceneWarmFrames) {
                times.push_back(*time);
            }
        }
        result[work.key] = tools::summarize(times).median;
    }
    return result;
}

double wholeFrame(const PassTimes& frame) {
    return frame.whole;
}

/// Commands, times and memory of what stands on the stage.
Result<Json> measureStage(SceneStage& stage, const SceneDesc& desc) {
    const Result<HostTimes> host = timeHost(stage, desc.frames);
    const Result<Json> recording = host ? timeRecording(stage, kRecordings * desc.frames) : Result<Json>(host.error());
    const Result<SceneTimes> times = recording ? timePasses(stage, desc.frames) : Result<SceneTimes>(recording.error());
    const Result<uint64_t> vertices = times ? stage.vertices() : Result<uint64_t>(times.error());
    const Result<SuppleMemoryUse> memory = vertices ? stage.memory() : Result<SuppleMemoryUse>(vertices.error());
    if (!memory) {
        return memory.error();
    }
    Json passes = Json::array();
    for (const auto& pass : times->frames.front().passes) {
        const std::string& name = pass.first;
        passes.push_back(
            {{"pass", name}, {"ms", medianOf(times->frames, [&](const PassTimes& f) { return f.of(name); })}});
    }
    Json row{{"dispatches", host->commands.dispatches},
             {"barriers", host->commands.barriers},
             {"copies", host->commands.copies},
             {"setUs", host->setMicroseconds},
             {"recordUs", host->recordMicroseconds},
             {"frameMs", medianOf(times->frames, wholeFrame)},
             {"passes", passes},
             {"ownMs", tools::summarize(times->own).median},
             {"repeatedMs", tools::summarize(times->repeated).median},
             {"vertices", *vertices},
             {"memoryBytes", memory->deviceLocal + memory->hostVisible},
             {"coefficientBytes", memory->coefficients},
             {"vertexBytes", memory->vertices + memory->streams},
             {"allocations", stage.countedMemory().held()}};
    row.update(*recording);
    return row;
}

Result<Json> measureRow(SceneStage& stage, const SceneDesc& desc, SceneUse use, uint32_t characters) {
    Json row{{"characters", characters},
             {"use", use.inView ? "view" : "rate " + std::to_string(SceneStage::kRate)},
             {"poses", use.played ? "played" : "posed"}};
    Status status = stage.build(characters);
    if (!status && status.error().code == ErrorCode::limit) {
        row["refused"] = status.error().message;
        status = success();
    } else if (status) {
        const Result<Json> measured = measureStage(stage, desc);
        status = measured ? success() : Status(measured.error());
        if (measured) {
            row.update(*measured);
            row.erase("ownMs"); // of views that were added
            row.erase("repeatedMs");
        }
        if (status && use.inView) {
            status = stage.lookAway();
            const Result<SceneTimes> unseen = status ? timePasses(stage, desc.frames) : status.error();
            status = unseen ? success() : Status(unseen.error());
            row["unseenMs"] = unseen ? medianOf(unseen->frames, wholeFrame) : 0.0;
        }
    }
    status = status ? stage.clear() : status;
    return status ? Result<Json>(std::move(row)) : status.error();
}

/// One, two and four views of the same characters.
Result<Json> measureFurtherViews(SceneStage& stage, const SceneDesc& desc) {
    Json rows = Json::array();
    Status status = stage.build(desc.viewedCharacters);
    for (uint32_t views = 1; views <= kMostViews && status; ++views) {
        if (views > 1) {
            status = stage.addView();
        }
        if (!status || views == kMostViews - 1) {
            continue;
        }
        const Result<Json> measured = measureStage(stage, desc);
        status = measured ? success() : Status(measured.error());
        if (measured) {
            Json row{{"characters", desc.viewedCharacters}, {"views", views}};
            row.update(*measured);
            rows.push_back(std::move(row));
        }
    }
    status = status ? stage.clear() : status;
    return status ? Result<Json>(std::move(rows)) : status.error();
}

} // namespace

Result<Json> measureScene(host::Device& device, const SceneDesc& desc) {
    Json result{{"instances", SceneStage::kInstances}, {"rows", Json::array()}, {"views", Json::array()}};
    for (const bool inView : {false, true}) {
        for (const bool played : {false, true}) {
            if (!desc.everyUse && played != inView) {
                continue;
            }
            const Result<std::unique_ptr<SceneStage>> stage =
                SceneStage::create(device, desc.mapping, {inView, played});
            if (!stage) {
                return stage.error();
            }
            for (const uint32_t characters : desc.characters) {
                if (desc.progress) {
                    desc.progress(std::to_string(characters) + (inView ? " in a view" : " at one rate") +
                                  (played ? ", played" : ", posed"));
                }
                Result<Json> row = measureRow(**stage, desc, {inView, played}, characters);
                if (!row) {
                    return row.error();
                }
                result["rows"].push_back(std::move(*row));
            }
            if (inView && played && desc.viewedCharacters > 0) {
                if (desc.progress) {
                    desc.progress("several views");
                }
                Result<Json> views = measureFurtherViews(**stage, desc);
                if (!views) {
                    return views.error();
                }
                result["views"] = std::move(*views);
            }
        }
    }
    return result;
}

} // namespace supple::bench
