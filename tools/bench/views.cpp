#include "tools/bench/views.h"

#include "tools/bench/crowd_character.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kWarmFrames = 3, kMaxVertices = 1u << 20;

/// The passes of a frame in the order in which they came, and milliseconds.
struct FrameTimes {
    std::vector<std::pair<std::string, double>> passes;
    double whole = 0.0;

    explicit FrameTimes(const std::vector<SuppleTiming>& timings) {
        double begin = 0.0, end = 0.0;
        for (const SuppleTiming& one : timings) {
            if (one.pass == SUPPLE_PASS_SHORTFALL) { // is no pass
                continue;
            }
            begin = passes.empty() ? one.gpuBegin : std::min(begin, one.gpuBegin);
            end = std::max(end, one.gpuEnd);
            const char* const name = suppleGetPassName(one.pass);
            const auto known =
                std::find_if(passes.begin(), passes.end(), [&](const auto& pass) { return pass.first == name; });
            if (known == passes.end()) {
                passes.emplace_back(name, 1e-6 * (one.gpuEnd - one.gpuBegin));
            } else {
                known->second += 1e-6 * (one.gpuEnd - one.gpuBegin);
            }
        }
        whole = 1e-6 * (end - begin);
    }
    [[nodiscard]] double of(const std::string& name) const {
        const auto found = std::find_if(passes.begin(), passes.end(), [&](const auto& p) { return p.first == name; });
        return found == passes.end() ? 0.0 : found->second;
    }
    [[nodiscard]] double aroundEvaluate() const {
        return (of("level") + of("place") + of("attributes")) / of("evaluate");
    }
};

double medianOf(const std::vector<FrameTimes>& frames, const std::function<double(const FrameTimes&)>& value) {
    std::vector<double> values;
    for (const FrameTimes& frame : frames) {
        values.push_back(value(frame));
    }
    return tools::summarize(values).median;
}

/// A frame's times are known when the next one begins.
Result<std::vector<FrameTimes>> timeFrames(host::Device& device, Workbench& workbench, SuppleGroup group,
                                           uint32_t count) {
    std::vector<FrameTimes> frames;
    for (uint32_t i = 0; i <= kWarmFrames + count; ++i) {
        Status recorded = success();
        const Status submitted = device.submitAndWait([&](VkCommandBuffer commands) {
            recorded = workbench.recordFrame(group, commands, SUPPLE_RECORD_TIMINGS);
        });
        if (!recorded || !submitted) {
            return (recorded ? submitted : recorded).error();
        }
        if (i > kWarmFrames) {
            frames.emplace_back(workbench.timings());
        }
    }
    return frames;
}

double wholeOf(const FrameTimes& frame) {
    return frame.whole;
}

/// `unseen`: the same frames, with all characters behind the camera.
Json rowOf(SuppleScheme scheme, const ViewsDesc& desc, uint32_t vertices, const std::vector<FrameTimes>& frames,
           const std::vector<FrameTimes>& unseen) {
    Json passes = Json::array();
    for (const auto& pass : frames.front().passes) {
        const std::string& name = pass.first;
        passes.push_back({{"pass", name}, {"ms", medianOf(frames, [&](const FrameTimes& f) { return f.of(name); })}});
    }
    return {{"scheme", tools::schemeName(scheme)},
            {"characters", desc.characters},
            {"vertices", vertices},
            {"frames", frames.size()},
            {"frameMs", medianOf(frames, wholeOf)},
            {"unseenMs", medianOf(unseen, wholeOf)},
            {"passes", passes},
            {"aroundEvaluate", medianOf(frames, &FrameTimes::aroundEvaluate)}};
}

Result<Json> measureRow(host::Device& device, Workbench& workbench, const ViewsDesc& desc, SuppleAsset asset,
                        SuppleScheme scheme) {
    SuppleViewDesc viewDesc{};
    viewDesc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    viewDesc.maxVertices = kMaxVertices;
    const Result<SuppleView> view = workbench.createView(viewDesc);
    if (!view) {
        return view.error();
    }
    SuppleGroupDesc groupDesc{};
    groupDesc.asset = asset;
    groupDesc.scheme = scheme;
    groupDesc.capacity = desc.characters;
    groupDesc.view = *view;
    groupDesc.poseSource = SUPPLE_POSES_PLAYBACK;
    const Result<SuppleGroup> group = workbench.createGroup(groupDesc);
    Result<Json> row = Json();
    if (group) {
        const Result<std::vector<FrameTimes>> frames = timeFrames(device, workbench, *group, desc.frames);
        const uint32_t vertices = workbench.verticesOf(*view);
        workbench.lookAway(*view);
        const Result<std::vector<FrameTimes>> unseen =
            frames ? timeFrames(device, workbench, *group, desc.frames) : frames.error();
        row = unseen ? Result<Json>(rowOf(scheme, desc, vertices, *frames, *unseen)) : unseen.error();
        workbench.destroy(*group);
    } else {
        row = group.error();
    }
    workbench.destroy(*view);
    return row;
}

} // namespace

Result<Json> measureViews(host::Device& device, Workbench& workbench, const ViewsDesc& desc) {
    Result<BenchCage> character = makeCrowdCharacter();
    if (!character) {
        return character.error();
    }
    const Result<SuppleAsset> asset = workbench.createAsset(std::move(character->character));
    if (!asset) {
        return asset.error();
    }
    Result<Json> rows = Json::array();
    for (size_t i = 0; i < desc.schemes.size() && rows; ++i) {
        if (desc.progress) {
            desc.progress(tools::schemeName(desc.schemes[i]));
        }
        Result<Json> row = measureRow(device, workbench, desc, *asset, desc.schemes[i]);
        if (row) {
            rows->push_back(std::move(*row));
        } else {
            rows = row.error();
        }
    }
    workbench.destroy(*asset);
    return rows;
}

} // namespace supple::bench
