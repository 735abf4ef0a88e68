#include "tools/bench/views.h"

#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/schemes.h"

#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kWarmFrames = 3, kMaxVertices = 1u << 20;

double aroundEvaluate(const PassTimes& frame) {
    return (frame.of("level") + frame.of("place") + frame.of("attributes")) / frame.of("evaluate");
}

/// A frame's times are known when the next one begins.
Result<std::vector<PassTimes>> timeFrames(host::Device& device, Workbench& workbench, SuppleGroup group,
                                          uint32_t count) {
    std::vector<PassTimes> frames;
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

double wholeOf(const PassTimes& frame) {
    return frame.whole;
}

/// `unseen`: the same frames, with all characters behind the camera.
Json rowOf(SuppleScheme scheme, const ViewsDesc& desc, uint32_t vertices, const std::vector<PassTimes>& frames,
           const std::vector<PassTimes>& unseen) {
    Json passes = Json::array();
    for (const auto& pass : frames.front().passes) {
        const std::string& name = pass.first;
        passes.push_back({{"pass", name}, {"ms", medianOf(frames, [&](const PassTimes& f) { return f.of(name); })}});
    }
    return {{"scheme", tools::schemeName(scheme)},
            {"characters", desc.characters},
            {"vertices", vertices},
            {"frames", frames.size()},
            {"frameMs", medianOf(frames, wholeOf)},
            {"unseenMs", medianOf(unseen, wholeOf)},
            {"passes", passes},
            {"aroundEvaluate", medianOf(frames, aroundEvaluate)}};
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
        const Result<std::vector<PassTimes>> frames = timeFrames(device, workbench, *group, desc.frames);
        const uint32_t vertices = workbench.verticesOf(*view);
        workbench.lookAway(*view);
        const Result<std::vector<PassTimes>> unseen =
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
