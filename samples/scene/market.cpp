#include "market.h"

#include "host/must.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>

namespace market {

namespace {

Source readSource(const char* name, SuppleScheme scheme) {
    return {name, mustReadFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + name + ".glb"), scheme};
}

/// In the order of Kind.
std::array<Source, kKinds> readSources() {
    return {readSource("wren", SUPPLE_SCHEME_PM), readSource("pip", SUPPLE_SCHEME_PM),
            readSource("pip_quads", SUPPLE_SCHEME_PREP)};
}

uint32_t findClip(const supple::Asset& asset, std::string_view name, SuppleClipInfo& clip) {
    SuppleAssetInfo info{};
    must(asset.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.clipCount; ++i) {
        must(asset.clipInfo(i, clip), "suppleGetClipInfo");
        if (clip.name == name)
            return i;
    }
    fail("a character has no clip " + std::string(name));
}

/// Nobody carries all that the file has.
void dress(const Figure& figure, const supple::Asset& asset, const supple::Instance& instance) {
    SuppleAssetInfo info{};
    must(asset.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.partCount; ++i) {
        SupplePartInfo part{};
        must(asset.partInfo(i, part), "suppleGetPartInfo");
        const std::string_view name = part.name;
        if ((name == "sword" && !figure.armed) || (name == "gear" && !figure.armed) ||
            (name == "scarf" && !figure.scarf))
            must(instance.setPartVisible(i, false), "suppleSetPartVisible");
    }
}

} // namespace

Market::Market(Device& device, uint32_t figures, uint32_t mostVertices, const std::string& record)
    : context_(mustCreateContext(device, record)), cast_(makeCast(figures)) {
    auto viewDesc = supple::sized<SuppleViewDesc>();
    viewDesc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    viewDesc.maxVertices = mostVertices;
    must(supple::View::create(context_, viewDesc, view_), "suppleCreateView");
    const std::array<Source, kKinds> sources = readSources();
    const size_t wanted = cast_.size();
    for (size_t i = 0; i < cast_.size(); ++i) {
        if (!addMember(cast_[i], sources[static_cast<size_t>(cast_[i].kind)]))
            cast_.resize(i);
    }
    if (cast_.size() < wanted)
        std::fprintf(stderr, "the view has room for %zu of %zu figures\n", cast_.size(), wanted);
}

/// All of it once: the device plays the clip from then on.
bool Market::addMember(const Figure& figure, const Source& source) {
    const std::string name = source.name + " " + std::to_string(members_.size());
    Member member;
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = name.c_str();
    assetDesc.bytes = source.bytes.data();
    assetDesc.byteCount = source.bytes.size();
    must(supple::Asset::create(context_, assetDesc, member.asset), "suppleCreateAsset");
    auto desc = supple::sized<SuppleGroupDesc>();
    desc.asset = member.asset.handle();
    desc.capacity = 1;
    desc.scheme = source.scheme;
    desc.view = view_.handle();
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    const SuppleResult created = supple::Group::create(context_, desc, member.group);
    if (created == SUPPLE_ERROR_LIMIT)
        return false;
    must(created, "suppleCreateGroup");
    must(supple::Instance::create(member.group, member.instance), "suppleCreateInstance");
    dress(figure, member.asset, member.instance);

    SuppleClipInfo clip{};
    SupplePlaybackLayer layer{};
    layer.clip = findClip(member.asset, figure.clip, clip);
    layer.flags = SUPPLE_LAYER_LOOP;
    layer.weight = 1.0f;
    layer.speed = figure.speed;
    layer.offset = static_cast<double>(figure.phase) * clip.duration;
    must(member.instance.setPlayback({&layer, 1}), "suppleSetPlayback");
    members_.push_back(std::move(member));
    return true;
}

void Market::beginFrame(uint64_t frame, uint64_t completed) const {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Market::update(double time, const Camera& camera, uint32_t budget) const {
    for (size_t i = 0; i < cast_.size(); ++i) {
        must(members_[i].group.setTime(time), "suppleSetTime");
        const glm::mat4 transform = transformOf(cast_[i], time);
        must(members_[i].instance.setTransform(std::span<const float, 16>(&transform[0][0], 16)), "suppleSetTransform");
    }
    auto desc = supple::sized<SuppleCameraDesc>();
    std::memcpy(desc.position, &camera.eye, sizeof desc.position);
    desc.pixelsPerUnit = camera.pixelsPerUnit;
    desc.vertexBudget = budget;
    std::memcpy(desc.viewProjection, &camera.castersViewProjection, sizeof desc.viewProjection);
    must(view_.setCamera(desc), "suppleSetCamera");
}

void Market::addToGraph(Graph& graph, Resource buffers) const {
    Scope first{};
    Scope last{};
    must(suppleGetRecordScopes(&first, &last), "suppleGetRecordScopes");
    graph.add("supple", {writesWithin(buffers, first, last)}, [this](VkCommandBuffer commands) {
        std::vector<SuppleGroup> groups;
        for (const Member& member : members_)
            groups.push_back(member.group.handle());
        must(context_.record(commands, groups, {}, {}, SUPPLE_RECORD_NO_ENTRY_BARRIER | SUPPLE_RECORD_TIMINGS),
             "suppleRecord");
    });
}

std::vector<SuppleLevelOutput> Market::surfaces() const {
    std::vector<SuppleLevelOutput> surfaces(members_.size());
    for (size_t i = 0; i < members_.size(); ++i)
        must(members_[i].group.levelOutput(surfaces[i]), "suppleGetLevelOutput");
    return surfaces;
}

SuppleVertexStreams Market::streams() const {
    SuppleVertexStreams streams{};
    must(members_.front().group.vertexStreams(streams), "suppleGetVertexStreams");
    return streams;
}

SuppleViewStatistics Market::statistics() const {
    SuppleViewStatistics statistics{};
    if (view_.statistics(statistics) != SUPPLE_OK)
        statistics = supple::sized<SuppleViewStatistics>();
    return statistics;
}

std::vector<PassMilliseconds> Market::passTimes() const {
    std::vector<PassMilliseconds> passes;
    std::vector<SuppleTiming> timings;
    if (context_.timings(timings) != SUPPLE_OK)
        return passes;
    for (const SuppleTiming& timing : timings) {
        const char* const name = suppleGetPassName(timing.pass);
        const double milliseconds = 1e-6 * (timing.gpuEnd - timing.gpuBegin);
        const auto known =
            std::find_if(passes.begin(), passes.end(), [&](const PassMilliseconds& pass) { return pass.name == name; });
        if (known == passes.end())
            passes.push_back({name, milliseconds});
        else
            known->milliseconds += milliseconds;
    }
    return passes;
}

SuppleMemoryUse Market::memory() const {
    SuppleMemoryUse use{};
    must(context_.memory(use), "suppleGetContextMemory");
    return use;
}

} // namespace market
