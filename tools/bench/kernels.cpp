#include "tools/bench/kernels.h"

#include "host/context.h"
#include "tools/bench/clocks.h"
#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/bench/playing_group.h"
#include "tools/bench/replay.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"

#include <cstring>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr KernelSubject kKernelSubjects[] = {
    {"", SUPPLE_SCHEME_PREP, "crowd"},
    {"regular", SUPPLE_SCHEME_PREP, "regular"},
    {"perturbed", SUPPLE_SCHEME_PREP, "irregular"},
    {"p4", SUPPLE_SCHEME_PM, "irregular"},
    {"irregular", SUPPLE_SCHEME_CATMULL_CLARK, "irregular"},
    {"polar", SUPPLE_SCHEME_PM, "polar"},
    {"p3", SUPPLE_SCHEME_PM, "regular triangles"},
    {"p5", SUPPLE_SCHEME_PM, "pentagons"},
    {"loop-regular", SUPPLE_SCHEME_LOOP, "regular triangles"},
    {"loop-irregular", SUPPLE_SCHEME_LOOP, "irregular triangles"},
    {"blend-regular", SUPPLE_SCHEME_BLEND, "regular"},
    {"blend", SUPPLE_SCHEME_BLEND, "irregular"},
};

constexpr uint32_t kKernelVertexBytes = 16, kPositionBytes = 12;
constexpr uint32_t kWarmKernelFrames = 2, kKernelViewVertices = 1u << 20;

Json spread(const std::vector<double>& values) {
    const tools::Summary summary = tools::summarize(values);
    return {{"median", summary.median}, {"least", summary.min}, {"largest", summary.max}};
}

Json spreadOfRatios(const std::vector<double>& own, const std::vector<double>& first) {
    std::vector<double> ratios;
    for (size_t i = 0; i < own.size(); ++i) {
        ratios.push_back(own[i] / first[i]);
    }
    return spread(ratios);
}

Result<cage::Character> characterOf(const KernelSubject& subject) {
    const bool crowd = std::string(subject.cage) == "crowd";
    Result<BenchCage> made = crowd ? makeCrowdCharacter() : makeCage(subject.cage);
    return made ? Result<cage::Character>(std::move(made->character)) : made.error();
}

/// A group on the context of a way.
class KernelGroup {
public:
    KernelGroup(host::Device& device, const KernelWays::Way& way) : device_(device), way_(way) {}
    ~KernelGroup() {
        if (group_.id != 0) {
            way_.workbench->destroy(group_);
        }
        if (view_.id != 0) {
            way_.workbench->destroy(view_);
        }
        if (asset_.id != 0) {
            way_.workbench->destroy(asset_);
        }
    }
    KernelGroup(const KernelGroup&) = delete;
    KernelGroup& operator=(const KernelGroup&) = delete;

    /// Up to the end of its first frame.
    Status create(const cage::Character& character, SuppleGroupDesc desc, bool inView) {
        Result<SuppleAsset> asset = way_.workbench->createAsset(character);
        if (!asset) {
            return asset.error();
        }
        asset_ = desc.asset = *asset;
        if (inView) {
            SuppleViewDesc viewDesc{};
            viewDesc.maxVertices = kKernelViewVertices;
            const Result<SuppleView> view = way_.workbench->createView(viewDesc);
            if (!view) {
                return view.error();
            }
            view_ = desc.view = *view;
        }
        desc.poseSource = character.clips.empty() ? SUPPLE_POSES_SET : SUPPLE_POSES_PLAYBACK;
        const double begin = wallSeconds();
        const Result<SuppleGroup> group = way_.workbench->createGroup(desc);
        if (!group) {
            return group.error();
        }
        group_ = *group;
        const Status status = frame(0);
        firstFrameMs_ = 1e3 * (wallSeconds() - begin);
        return status;
    }
    Status frame(uint32_t flags) {
        Status recorded = success();
        const Status submitted = device_.submitAndWait(
            [&](VkCommandBuffer commands) { recorded = way_.workbench->recordFrame(group_, commands, flags); });
        return recorded ? submitted : recorded;
    }
    [[nodiscard]] const KernelWays::Way& way() const { return way_; }
    [[nodiscard]] Workbench& workbench() const { return *way_.workbench; }
    [[nodiscard]] SuppleGroup id() const { return group_; }
    [[nodiscard]] SuppleView view() const { return view_; }
    [[nodiscard]] double firstFrameMs() const { return firstFrameMs_; }
    /// The first instance's.
    [[nodiscard]] Result<std::vector<std::byte>> vertices() const {
        const host::GroupOutput out = workbench().output(group_);
        const SuppleBufferRange all = out.streams.vertices;
        return device_.readBuffer(all.buffer, all.offset, VkDeviceSize{out.grid.vertexCount} * all.stride);
    }

private:
    host::Device& device_;
    const KernelWays::Way& way_;
    SuppleAsset asset_{};
    SuppleView view_{};
    SuppleGroup group_{};
    double firstFrameMs_ = 0.0;
};
using KernelGroups = std::vector<std::unique_ptr<KernelGroup>>;

/// A group for every way that the scheme has.
Status createAll(host::Device& device, const KernelWays& ways, const KernelSubject& subject, SuppleGroupDesc desc,
                 bool inView, KernelGroups& out) {
    const Result<cage::Character> character = characterOf(subject);
    if (!character) {
        return character.error();
    }
    desc.scheme = subject.scheme;
    for (const KernelWays::Way& way : ways.all()) {
        if (way.fanRecords && (inView || subject.scheme != SUPPLE_SCHEME_PREP)) {
            continue; // the same as without
        }
        out.push_back(std::make_unique<KernelGroup>(device, way));
        if (const Status made = out.back()->create(*character, desc, inView); !made) {
            return made;
        }
    }
    return success();
}

Status compareBits(const KernelGroups& groups, const KernelSubject& subject) {
    std::vector<std::byte> first;
    for (const auto& group : groups) {
        Result<std::vector<std::byte>> own = group->vertices();
        if (!own) {
            return own.error();
        }
        if (first.empty()) {
            first = *own;
        }
        for (size_t at = 0; at < own->size(); at += kKernelVertexBytes) {
            if (std::memcmp(&(*own)[at], &first[at], kPositionBytes) != 0) {
                return Error{ErrorCode::asset, std::string("contestants differ: positions of ") + subject.cage + ", " +
                                                   group->way().name};
            }
        }
    }
    return success();
}

Json rowOfSubject(const KernelSubject& subject) {
    return {{"class", *subject.patchClass == '\0' ? "all" : subject.patchClass},
            {"scheme", tools::schemeName(subject.scheme)},
            {"cage", subject.cage}};
}

/// Characters of which a crowd for each way fits.
Result<uint32_t> fittingCharacters(host::Device& device, const KernelWays& ways, const KernelsDesc& desc) {
    SuppleGroupDesc one{};
    one.rate = desc.rate;
    one.scheme = desc.subject.scheme;
    const Result<cage::Character> character = characterOf(desc.subject);
    if (!character) {
        return character.error();
    }
    KernelGroup group(device, ways.all().front());
    if (const Status made = group.create(*character, one, false); !made) {
        return made.error();
    }
    const VkDeviceSize bytes =
        VkDeviceSize{group.workbench().output(group.id()).grid.verticesPerInstance} * kKernelVertexBytes;
    return charactersThatFit(device, ways.all().size() * bytes, bytes, desc.characters);
}

} // namespace

std::span<const KernelSubject> kernelSubjects() {
    return kKernelSubjects;
}

Result<KernelWays> KernelWays::create(host::Device& device) {
    constexpr struct {
        const char* name;
        SuppleMapping mapping;
        uint32_t flags;
    } kWays[] = {{"wide", SUPPLE_MAPPING_WIDE, 0},
                 {"wide, fan records", SUPPLE_MAPPING_WIDE, SUPPLE_CONTEXT_FAN_RECORDS},
                 {"narrow", SUPPLE_MAPPING_NARROW, 0},
                 {"narrow, fan records", SUPPLE_MAPPING_NARROW, SUPPLE_CONTEXT_FAN_RECORDS}};
    KernelWays made;
    for (const auto& way : kWays) {
        SuppleContextDesc desc = host::contextDesc(device);
        desc.mapping = way.mapping;
        desc.flags |= way.flags;
        Result<std::unique_ptr<Workbench>> workbench = Workbench::create(desc);
        if (!workbench) {
            return workbench.error();
        }
        made.ways_.push_back({way.name, way.flags != 0, std::move(*workbench)});
    }
    return made;
}

Result<Json> measureKernels(host::Device& device, const KernelWays& ways, const KernelsDesc& desc) {
    const Result<uint32_t> characters = fittingCharacters(device, ways, desc);
    if (!characters) {
        return characters.error();
    }
    SuppleGroupDesc groupDesc{};
    groupDesc.rate = desc.rate;
    groupDesc.capacity = *characters;
    KernelGroups groups;
    Status status = createAll(device, ways, desc.subject, groupDesc, false, groups);
    status = status ? compareBits(groups, desc.subject) : status;
    if (!status) {
        return status.error();
    }
    const bool whole = *desc.subject.patchClass == '\0';
    const Workbench::ClassRange range =
        groups.front()->workbench().rangeOf(groups.front()->id(), desc.subject.patchClass);
    const uint64_t vertices = range.vertices * *characters;
    std::vector<std::unique_ptr<Replay>> replays;
    std::vector<Contestant> contestants;
    for (size_t i = 0; i < groups.size() * (whole ? 2 : 1); ++i) {
        const KernelGroup& group = *groups[i % groups.size()];
        Result<std::unique_ptr<Replay>> replay = Replay::create(device, [&](VkCommandBuffer commands) {
            if (i >= groups.size()) {
                group.workbench().recordCompute(group.id(), commands);
            } else if (whole) {
                group.workbench().recordEvaluate(group.id(), commands);
            } else {
                group.workbench().recordEvaluate(group.id(), commands, range);
            }
        });
        if (!replay) {
            return replay.error();
        }
        contestants.push_back((*replay)->contestant(group.way().name, vertices));
        replays.push_back(std::move(*replay));
    }
    const Result<std::vector<Series>> all = runRounds(contestants, desc.rounds);
    if (!all) {
        return all.error();
    }
    const auto clock = [&](const Series& series) {
        return device.isCpu() || series.gpu.empty() ? series.cpu : series.gpu;
    };
    Json row = rowOfSubject(desc.subject);
    row.update(Json{{"rate", desc.rate},
                    {"characters", *characters},
                    {"patches", range.patches},
                    {"vertices", vertices},
                    {"ways", Json::array()}});
    for (size_t w = 0; w < groups.size(); ++w) {
        Json way{{"way", groups[w]->way().name},
                 {"firstFrameMs", groups[w]->firstFrameMs()},
                 {"evaluateNs", spread(clock((*all)[w]))},
                 {"evaluateRatio", spreadOfRatios(clock((*all)[w]), clock((*all)[0]))}};
        if (whole) {
            const size_t f = groups.size() + w;
            way["frameNs"] = spread(clock((*all)[f]));
            way["frameRatio"] = spreadOfRatios(clock((*all)[f]), clock((*all)[groups.size()]));
        }
        row["ways"].push_back(std::move(way));
    }
    return row;
}

Result<Json> measureLevelKernels(host::Device& device, const KernelWays& ways, const LevelKernelsDesc& desc) {
    SuppleGroupDesc groupDesc{};
    groupDesc.capacity = desc.characters;
    KernelGroups groups;
    Status status = createAll(device, ways, desc.subject, groupDesc, true, groups);
    std::vector<std::vector<double>> times(groups.size()); // nanoseconds a vertex, by frame
    uint32_t vertices = 0;
    for (uint32_t frame = 0; status && frame <= kWarmKernelFrames + desc.frames; ++frame) {
        for (size_t g = 0; status && g < groups.size(); ++g) {
            status = groups[g]->frame(SUPPLE_RECORD_TIMINGS);
            if (status && frame > kWarmKernelFrames) { // a frame's times are known when the next one begins
                vertices = groups[g]->workbench().verticesOf(groups[g]->view());
                times[g].push_back(1e6 * PassTimes(groups[g]->workbench().timings()).of("evaluate") / vertices);
            }
        }
    }
    if (!status) {
        return status.error();
    }
    Json row = rowOfSubject(desc.subject);
    row["class"] = "all";
    row.update(Json{{"rate", "levels"},
                    {"characters", desc.characters},
                    {"patches", groups.front()->workbench().output(groups.front()->id()).surface.patchCount},
                    {"vertices", vertices},
                    {"ways", Json::array()}});
    for (size_t g = 0; g < groups.size(); ++g) {
        row["ways"].push_back({{"way", groups[g]->way().name},
                               {"firstFrameMs", groups[g]->firstFrameMs()},
                               {"evaluateNs", spread(times[g])},
                               {"evaluateRatio", spreadOfRatios(times[g], times[0])}});
    }
    return row;
}

} // namespace supple::bench
