#include "crowd.h"

#include "common/context.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

namespace crowd {

namespace {

struct KindDesc {
    SuppleScheme scheme;
    const char* clip;
    float stride;
    float size;
};
constexpr KindDesc kDescs[kKinds] = {{SUPPLE_SCHEME_PM, "walk", 0.62f, 1.0f},
                                     {SUPPLE_SCHEME_PREP, "walk", 0.62f, 1.25f},
                                     {SUPPLE_SCHEME_PM, "joy", 0.9f, 0.7f}};

std::vector<char> readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        sample::fail(path + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

void findClip(Kind& kind, const char* wanted) {
    SuppleAssetInfo info{};
    sample::check(kind.asset.info(info), "suppleGetAssetInfo");
    kind.clip = info.clipCount > 0 ? 0 : SUPPLE_REST_POSE;
    for (uint32_t c = 0; c < info.clipCount; ++c) {
        SuppleClipInfo clip{};
        sample::check(kind.asset.clipInfo(c, clip), "suppleGetClipInfo");
        if (c == 0 || std::strcmp(clip.name, wanted) == 0) {
            kind.clip = c;
            kind.duration = std::max(clip.duration, 0.1);
        }
    }
}

} // namespace

Crowd::Crowd(const sample::Device& device, const CrowdOptions& options)
    : context_(sample::createContext(device)), budget_(options.budget), backFaces_(options.backFaces) {
    const uint32_t count = options.count;
    auto viewDesc = supple::sized<SuppleViewDesc>();
    viewDesc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    viewDesc.flags |= options.occlusion ? SUPPLE_VIEW_OCCLUSION : 0;
    viewDesc.flags |= options.backFaces ? SUPPLE_VIEW_BACK_FACES : 0;
    viewDesc.maxVertices = budget_;
    sample::check(supple::View::create(context_, viewDesc, view_), "suppleCreateView");

    for (size_t k = 0; k < kKinds; ++k) {
        Kind& kind = kinds_[k];
        const std::vector<char> bytes = readFile(options.files[k]);
        auto assetDesc = supple::sized<SuppleAssetDesc>();
        assetDesc.name = options.files[k].c_str();
        assetDesc.bytes = bytes.data();
        assetDesc.byteCount = bytes.size();
        sample::check(supple::Asset::create(context_, assetDesc, kind.asset), "suppleCreateAsset");
        findClip(kind, kDescs[k].clip);
        kind.stride = kDescs[k].stride;
        kind.size = kDescs[k].size;

        auto desc = supple::sized<SuppleGroupDesc>();
        desc.asset = kind.asset.handle();
        desc.capacity = count / kKinds + 1;
        desc.scheme = kDescs[k].scheme;
        desc.view = view_.handle();
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
        sample::check(supple::Group::create(context_, desc, kind.group), "suppleCreateGroup");
        sample::check(kind.group.output(kind.output), "suppleGetGroupOutput");
    }

    // Circles all over a square, a few steps from each other.
    std::mt19937 random(7);
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1u << 24);
    };
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    constexpr float kSpacing = 1.5f;
    reach_ = 0.5f * kSpacing * static_cast<float>(side);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t column = i % side, row = i / side;
        Walker& walker = walkers_.emplace_back();
        walker.kind = i % kKinds;
        walker.centre = {kSpacing * (static_cast<float>(column) + 0.5f) - reach_,
                         kSpacing * (static_cast<float>(row) + 0.5f) - reach_};
        if (options.wall) { // makes room on either side
            const glm::vec2 across{std::sin(kWallAngle), std::cos(kWallAngle)};
            walker.centre += (glm::dot(walker.centre, across) < 0.0f ? -1.5f : 1.5f) * across;
        }
        walker.radius = uniform(0.25f, 0.55f);
        walker.angle = uniform(0.0f, 6.2831853f);
        walker.turn = uniform(0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f;
        const Kind& kind = kinds_[walker.kind];
        sample::check(supple::Instance::create(kind.group, walker.instance), "suppleCreateInstance");
        // Once: from then on the clip runs on the device.
        SupplePlaybackLayer layer{};
        layer.clip = kind.clip;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.speed = 1.0f;
        layer.offset = static_cast<double>(uniform(0.0f, 1.0f)) * kind.duration;
        auto playback = supple::sized<SupplePlaybackDesc>();
        playback.layers = &layer;
        playback.layerCount = kind.clip == SUPPLE_REST_POSE ? 0 : 1;
        sample::check(walker.instance.setPlayback(playback), "suppleSetPlayback");
    }
}

void Crowd::beginFrame(uint64_t frame, uint64_t completed) const {
    sample::check(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Crowd::update(double time, const Camera& camera) {
    for (const Kind& kind : kinds_)
        sample::check(kind.group.setTime(time), "suppleSetTime");
    for (Walker& walker : walkers_) {
        const Kind& kind = kinds_[walker.kind];
        // As far as the feet carry it.
        const double travelled = time / kind.duration * static_cast<double>(kind.stride * kind.size);
        const float angle = walker.angle + walker.turn * static_cast<float>(travelled) / walker.radius;
        const glm::vec3 place{walker.centre.x + walker.radius * std::sin(angle), 0.0f,
                              walker.centre.y + walker.radius * std::cos(angle)};
        const float heading = angle + walker.turn * glm::half_pi<float>();
        glm::mat4 transform = glm::translate(glm::mat4(1.0f), place);
        transform = glm::rotate(transform, heading, glm::vec3(0.0f, 1.0f, 0.0f));
        transform = glm::scale(transform, glm::vec3(kind.size));
        sample::check(walker.instance.setTransform(std::span<const float, 16>(&transform[0][0], 16)),
                      "suppleSetTransform");
    }
    auto desc = supple::sized<SuppleCameraDesc>();
    std::memcpy(desc.position, &camera.eye, sizeof desc.position);
    desc.pixelsPerUnit = camera.pixelsPerUnit;
    std::memcpy(desc.viewProjection, &camera.castersViewProjection, sizeof desc.viewProjection);
    sample::check(view_.setCamera(desc), "suppleSetCamera");
}

void Crowd::setPyramid(const SuppleDepthPyramidDesc* pyramid) const {
    sample::check(view_.setDepthPyramid(pyramid), "suppleSetDepthPyramid");
}

void Crowd::addToGraph(engine::Graph& graph, engine::Resource buffers, const engine::Resource* pyramid) const {
    engine::Scope first{};
    engine::Scope last{};
    sample::check(suppleGetRecordScopes(&first, &last), "suppleGetRecordScopes");
    std::vector<engine::Use> uses = {engine::writesWithin(buffers, first, last)};
    if (pyramid != nullptr)
        uses.push_back(engine::reads(*pyramid, engine::kSampledInCompute, VK_IMAGE_LAYOUT_GENERAL));
    graph.add("supple", std::move(uses), [this](VkCommandBuffer commands) {
        std::array<SuppleGroup, kKinds> groups{};
        for (size_t k = 0; k < kKinds; ++k)
            groups[k] = kinds_[k].group.handle();
        sample::check(context_.record(commands, groups, {}, {}, SUPPLE_RECORD_NO_ENTRY_BARRIER | SUPPLE_RECORD_TIMINGS),
                      "suppleRecord");
    });
}

std::vector<std::string> Crowd::report() const {
    std::vector<std::string> lines;
    char text[160];
    std::snprintf(text, sizeof text, "%zu characters of %zu kinds", walkers_.size(), kKinds);
    lines.emplace_back(text);
    SuppleViewStatistics drawn{};
    if (view_.statistics(drawn) == SUPPLE_OK) {
        std::snprintf(text, sizeof text, "%u seen, %u hidden behind others", drawn.drawnInstanceCount,
                      drawn.occludedInstanceCount);
        lines.emplace_back(text);
        if (backFaces_) {
            std::snprintf(text, sizeof text, "%u patches left out for their backs", drawn.backFaceCount);
            lines.emplace_back(text);
        }
        std::snprintf(text, sizeof text, "%u patches, %.2f M vertices of %.2f M%s", drawn.patchCount,
                      1e-6 * drawn.vertexCount, 1e-6 * budget_, drawn.shortfall != 0 ? ", TOO FEW" : "");
        lines.emplace_back(text);
        std::snprintf(text, sizeof text, "levels scaled by %.3f", static_cast<double>(drawn.levelScales[0]));
        lines.emplace_back(text);
    }
    if (context_.timings(timings_) != SUPPLE_OK)
        return lines;
    std::vector<std::pair<const char*, double>> passes; // in the order of the frame
    double total = 0.0;
    for (const SuppleTiming& timing : timings_) {
        const double ms = 1e-6 * (timing.gpuEnd - timing.gpuBegin);
        total += ms;
        const auto found = std::find_if(passes.begin(), passes.end(),
                                        [&](const auto& pass) { return std::strcmp(pass.first, timing.pass) == 0; });
        if (found == passes.end())
            passes.emplace_back(timing.pass, ms);
        else
            found->second += ms;
    }
    for (const auto& [name, ms] : passes) {
        std::snprintf(text, sizeof text, "%-10s %8.3f ms", name, ms);
        lines.emplace_back(text);
    }
    std::snprintf(text, sizeof text, "%-10s %8.3f ms", "in all", total);
    lines.emplace_back(text);
    return lines;
}

} // namespace crowd
