#include "crowd.h"

#include "arcs.h"
#include "host/must.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <optional>
#include <random>

namespace crowd {

namespace {

struct KindDesc {
    SuppleScheme scheme;
    float size;
    float speed; ///< of the clip: feet stand still on the ground at any
};
constexpr KindDesc kDescs[kKinds] = {
    {SUPPLE_SCHEME_PM, 1.0f, 1.0f}, {SUPPLE_SCHEME_PREP, 1.25f, 0.85f}, {SUPPLE_SCHEME_BLEND, 0.7f, 1.3f}};
/// Metres a loop of the demo character's walk: two cycles in which each foot stands for 0.56, moving back by 0.25.
constexpr float kStride = 2.0f * 0.25f / 0.56f;
constexpr std::array<float, 3> kRadii = {0.28f, 0.4f, 0.52f};

/// Every radius to either side.
std::vector<Arc> arcs() {
    std::vector<Arc> all;
    for (const float radius : kRadii)
        for (const float turn : {1.0f, -1.0f})
            all.push_back({"arc " + std::to_string(all.size()), radius, turn});
    return all;
}

/// Every kind has hues of its own, every slot a shade of them. character.vert says what the numbers are.
std::array<float, 4> tintOf(size_t kind, uint32_t slot) {
    constexpr std::array<float, kKinds> kHues = {0.0f, 2.9f, -1.75f};
    const uint32_t hash = (slot * 3u + static_cast<uint32_t>(kind)) * 2654435761u;
    const auto part = [&](uint32_t shift) { return static_cast<float>((hash >> shift) & 255u) / 255.0f; };
    return {kHues[kind] + 0.5f * (part(0) - 0.5f), 0.8f + 0.4f * part(8), 0.0f, 0.0f};
}

std::vector<char> readGlb(const std::string& path) {
    std::vector<char> bytes = mustReadFile(path);
    if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0)
        fail(path + ": is no GLB (.gltf is not read here)");
    return bytes;
}

/// Arcs are the last clips.
void findArcs(Kind& kind) {
    SuppleAssetInfo info{};
    must(kind.asset.info(info), "suppleGetAssetInfo");
    kind.firstArc = info.clipCount - static_cast<uint32_t>(arcs().size());
    SuppleClipInfo clip{};
    must(kind.asset.clipInfo(kind.firstArc, clip), "suppleGetClipInfo");
    kind.duration = std::max(clip.duration, 0.1);
}

} // namespace

Crowd::Crowd(Device& device, const CrowdOptions& options)
    : context_(mustCreateContext(device, options.record)), budget_(options.budget), fixedRate_(options.fixedRate),
      backFaces_(options.backFaces), isDirect_(options.direct) {
    if (hasLevels())
        createView(options);
    for (size_t k = 0; k < kKinds; ++k)
        createKind(k, options);
    createInstances(options);
}

void Crowd::createView(const CrowdOptions& options) {
    auto desc = supple::sized<SuppleViewDesc>();
    desc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    desc.flags |= options.occlusion ? SUPPLE_VIEW_OCCLUSION : 0;
    desc.flags |= options.backFaces ? SUPPLE_VIEW_BACK_FACES : 0;
    desc.maxVertices = budget_;
    desc.coefficientBytes = uint64_t{options.coefficients} << 20;
    must(supple::View::create(context_, desc, view_), "suppleCreateView");
}

void Crowd::createKind(size_t number, const CrowdOptions& options) {
    Kind& kind = kinds_[number];
    const std::vector<char> file = readGlb(options.files[number]);
    const std::optional<std::vector<char>> walking = withArcs(file, "walk", kStride, arcs());
    const std::vector<char>& bytes = walking ? *walking : file;
    kind.walks = walking.has_value();
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = options.files[number].c_str();
    assetDesc.bytes = bytes.data();
    assetDesc.byteCount = bytes.size();
    must(supple::Asset::create(context_, assetDesc, kind.asset), "suppleCreateAsset");
    if (kind.walks)
        findArcs(kind);

    auto desc = supple::sized<SuppleGroupDesc>();
    desc.asset = kind.asset.handle();
    desc.capacity = options.count / kKinds + 1;
    desc.scheme = kDescs[number].scheme;
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    if (hasLevels()) {
        desc.view = view_.handle();
    } else {
        desc.rate = fixedRate_;
        desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_WINDOWS | (isDirect_ ? uint32_t{SUPPLE_GROUP_DIRECT} : 0u);
        if (desc.scheme == SUPPLE_SCHEME_BLEND) // which is not evaluated while it is drawn
            desc.scheme = SUPPLE_SCHEME_PM;
    }
    must(supple::Group::create(context_, desc, kind.group), "suppleCreateGroup");
    must(kind.group.info(kind.info), "suppleGetGroupInfo");
    must(kind.group.vertexStreams(kind.streams), "suppleGetVertexStreams");
    if (hasLevels())
        must(kind.group.levelOutput(kind.levels), "suppleGetLevelOutput");
    else
        must(kind.group.gridOutput(kind.grid), "suppleGetGridOutput");
    if (isDirect_)
        must(kind.group.directOutput(kind.direct), "suppleGetDirectOutput");
}

void Crowd::createInstances(const CrowdOptions& options) {
    const uint32_t count = options.count;
    // Circles all over a square, a few steps from each other.
    std::mt19937 random(7);
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1u << 24);
    };
    const std::vector<Arc> all = arcs();
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    constexpr float kSpacing = 1.5f;
    reach_ = 0.5f * kSpacing * static_cast<float>(side);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t column = i % side, row = i / side;
        const Kind& kind = kinds_[i % kKinds];
        const KindDesc& kindDesc = kDescs[i % kKinds];
        glm::vec2 centre{kSpacing * (static_cast<float>(column) + 0.5f) - reach_,
                         kSpacing * (static_cast<float>(row) + 0.5f) - reach_};
        if (options.wall) { // makes room on either side
            const glm::vec2 across{std::sin(kWallAngle), std::cos(kWallAngle)};
            centre += (glm::dot(centre, across) < 0.0f ? -1.5f : 1.5f) * across;
        }
        const auto arc = static_cast<uint32_t>(uniform(0.0f, static_cast<float>(all.size())));
        const float angle = uniform(0.0f, 6.2831853f), radius = all[arc].radius * kindDesc.size;
        supple::Instance& instance = instances_.emplace_back();
        must(supple::Instance::create(kind.group, instance), "suppleCreateInstance");
        must(instance.setUserData(tintOf(i % kKinds, instance.handle().slot)), "suppleSetUserData");

        // All of it once. From then on the clip runs on the device, and where its root goes, the character goes.
        SupplePlaybackLayer layer{};
        layer.clip = kind.firstArc + arc;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.speed = kindDesc.speed;
        layer.offset = static_cast<double>(uniform(0.0f, 1.0f)) * kind.duration;
        auto playback = supple::sized<SupplePlaybackDesc>();
        playback.flags = SUPPLE_PLAYBACK_TRAVEL;
        playback.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
        playback.layers = &layer;
        playback.layerCount = kind.walks ? 1 : 0;
        must(instance.setPlayback(playback), "suppleSetPlayback");
        const glm::vec3 place{centre.x + radius * std::sin(angle), 0.0f, centre.y + radius * std::cos(angle)};
        glm::mat4 transform = glm::translate(glm::mat4(1.0f), place);
        transform = glm::rotate(transform, angle + all[arc].turn * glm::half_pi<float>(), glm::vec3(0.0f, 1.0f, 0.0f));
        transform = glm::scale(transform, glm::vec3(kindDesc.size));
        must(instance.setTransform(std::span<const float, 16>(&transform[0][0], 16)), "suppleSetTransform");
    }
}

void Crowd::beginFrame(uint64_t frame, uint64_t completed) const {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Crowd::update(double time, const Camera& camera) const {
    for (const Kind& kind : kinds_)
        must(kind.group.setTime(time), "suppleSetTime");
    if (!hasLevels())
        return;
    auto desc = supple::sized<SuppleCameraDesc>();
    std::memcpy(desc.position, &camera.eye, sizeof desc.position);
    desc.pixelsPerUnit = camera.pixelsPerUnit;
    std::memcpy(desc.viewProjection, &camera.castersViewProjection, sizeof desc.viewProjection);
    must(view_.setCamera(desc), "suppleSetCamera");
}

void Crowd::setPyramid(const SuppleDepthPyramidDesc* pyramid) const {
    must(view_.setDepthPyramid(pyramid), "suppleSetDepthPyramid");
}

void Crowd::addToGraph(Graph& graph, Resource buffers, const Resource* pyramid) const {
    Scope first{};
    Scope last{};
    must(suppleGetRecordScopes(&first, &last), "suppleGetRecordScopes");
    std::vector<Use> uses = {writesWithin(buffers, first, last)};
    if (pyramid != nullptr)
        uses.push_back(reads(*pyramid, kSampledInCompute, VK_IMAGE_LAYOUT_GENERAL));
    graph.add("supple", std::move(uses), [this](VkCommandBuffer commands) {
        std::array<SuppleGroup, kKinds> groups{};
        for (size_t k = 0; k < kKinds; ++k)
            groups[k] = kinds_[k].group.handle();
        must(context_.record(commands, groups, {}, {}, SUPPLE_RECORD_NO_ENTRY_BARRIER | SUPPLE_RECORD_TIMINGS),
             "suppleRecord");
    });
}

std::vector<std::string> Crowd::report() const {
    std::vector<std::string> lines;
    char text[160];
    std::snprintf(text, sizeof text, "%zu characters of %zu kinds", instances_.size(), kKinds);
    lines.emplace_back(text);
    if (hasLevels())
        reportView(lines);
    reportMemory(lines);
    reportPasses(lines);
    return lines;
}

void Crowd::reportView(std::vector<std::string>& lines) const {
    char text[160];
    SuppleViewStatistics drawn{};
    if (view_.statistics(drawn) != SUPPLE_OK)
        return;
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
    if (drawn.coefficientBytes > 0) {
        std::snprintf(text, sizeof text, "%.1f MiB of coefficients",
                      static_cast<double>(drawn.coefficientBytes) / 0x100000);
        lines.emplace_back(text);
    }
}

void Crowd::reportMemory(std::vector<std::string>& lines) const {
    SuppleMemoryUse use{};
    if (context_.memory(use) != SUPPLE_OK)
        return;
    const auto mib = [](VkDeviceSize bytes) { return static_cast<double>(bytes) / 0x100000; };
    char text[160];
    std::snprintf(text, sizeof text, "%.1f MiB: vertices %.1f, coefficients %.1f",
                  mib(use.deviceLocal + use.hostVisible), mib(use.vertices), mib(use.coefficients));
    lines.emplace_back(text);
}

void Crowd::reportPasses(std::vector<std::string>& lines) const {
    char text[160];
    if (context_.timings(timings_) != SUPPLE_OK)
        return;
    std::vector<std::pair<SupplePass, double>> passes; // in the order of the frame
    double total = 0.0;
    for (const SuppleTiming& timing : timings_) {
        const double ms = 1e-6 * (timing.gpuEnd - timing.gpuBegin);
        total += ms;
        const auto found =
            std::find_if(passes.begin(), passes.end(), [&](const auto& pass) { return pass.first == timing.pass; });
        if (found == passes.end())
            passes.emplace_back(timing.pass, ms);
        else
            found->second += ms;
    }
    for (const auto& [pass, ms] : passes) {
        std::snprintf(text, sizeof text, "%-10s %8.3f ms", suppleGetPassName(pass), ms);
        lines.emplace_back(text);
    }
    std::snprintf(text, sizeof text, "%-10s %8.3f ms", "in all", total);
    lines.emplace_back(text);
}

} // namespace crowd
