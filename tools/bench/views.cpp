#include "tools/bench/views.h"

#include "tools/bench/clocks.h"
#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/schemes.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kWarmFrames = 3, kMaxVertices = 1u << 20;
constexpr uint32_t kCulledCharacters = 80; ///< at most, beside as many that are seen

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

/// A group in a view of its own, whose camera does not see the last ones of its characters.
class CulledGroup {
public:
    CulledGroup(Workbench& workbench, SuppleAsset asset, SuppleScheme scheme) : workbench_(workbench) {
        viewDesc_.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
        viewDesc_.maxVertices = kMaxVertices;
        groupDesc_.asset = asset;
        groupDesc_.scheme = scheme;
        groupDesc_.poseSource = SUPPLE_POSES_PLAYBACK;
    }
    ~CulledGroup() {
        workbench_.destroy(group_);
        workbench_.destroy(view_);
    }
    CulledGroup(const CulledGroup&) = delete;
    CulledGroup& operator=(const CulledGroup&) = delete;

    [[nodiscard]] Status create(uint32_t seen, uint32_t culled) {
        const Result<SuppleView> view = workbench_.createView(viewDesc_);
        if (!view) {
            return view.error();
        }
        view_ = groupDesc_.view = *view;
        workbench_.lookAhead(view_);
        groupDesc_.capacity = seen + culled;
        const Result<SuppleGroup> group = workbench_.createGroup(groupDesc_);
        if (!group) {
            return group.error();
        }
        group_ = *group;
        for (uint32_t slot = seen; slot < seen + culled; ++slot) {
            workbench_.moveBehind(group_, slot);
        }
        return success();
    }
    [[nodiscard]] SuppleGroup group() const { return group_; }
    [[nodiscard]] uint32_t vertices() const { return workbench_.verticesOf(view_); }

private:
    Workbench& workbench_;
    SuppleViewDesc viewDesc_{};
    SuppleGroupDesc groupDesc_{};
    SuppleView view_{};
    SuppleGroup group_{};
};

/// What as many characters out of sight add to a group that is seen: frames with and without them, in turns.
Result<Json> measureCulled(host::Device& device, Workbench& workbench, const ViewsDesc& desc, SuppleAsset asset,
                           SuppleScheme scheme) {
    CulledGroup alone(workbench, asset, scheme), beside(workbench, asset, scheme);
    const uint32_t count = std::min(desc.characters, kCulledCharacters);
    Status status = alone.create(count, 0);
    status = status ? beside.create(count, count) : status;
    if (!status) {
        return status.error();
    }
    std::array<std::vector<double>, 2> times;
    std::array<uint32_t, 2> vertices{};
    const CulledGroup* const groups[] = {&alone, &beside};
    for (uint32_t turn = 0; turn <= 2 * (kWarmFrames + desc.frames) && status; ++turn) {
        const size_t own = turn % 2, last = 1 - own;
        Status recorded = success();
        const double before = processSeconds();
        status = device.submitAndWait([&](VkCommandBuffer commands) {
            recorded = workbench.recordFrame(groups[own]->group(), commands, SUPPLE_RECORD_TIMINGS);
        });
        status = status ? recorded : status;
        if (turn > 2 * kWarmFrames) { // a frame's times are known when the next one begins
            // On CPU devices other load would count in timestamps.
            const double cpu = 1e3 * (processSeconds() - before);
            times[device.isCpu() ? own : last].push_back(device.isCpu() ? cpu : PassTimes(workbench.timings()).whole);
            vertices[last] = groups[last]->vertices();
        }
    }
    if (!status) {
        return status.error();
    }
    if (vertices[0] != vertices[1]) {
        return Error{ErrorCode::vulkan, "characters out of sight change what is drawn"};
    }
    const auto least = [](const std::vector<double>& own) { return *std::min_element(own.begin(), own.end()); };
    return Json{{"culled", count}, {"aloneMs", least(times[0])}, {"besideCulledMs", least(times[1])}};
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
        const Result<Json> culled = row ? measureCulled(device, workbench, desc, *asset, desc.schemes[i]) : row;
        if (culled) {
            row->update(*culled);
        } else {
            row = culled.error();
        }
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
