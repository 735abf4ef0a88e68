#include "characters.h"

#include "host/must.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace engine {

namespace {

constexpr float kWalkSpeed = 0.406f; // at which the ground passes under the clip "walk"
constexpr float kWalkRadius = 1.75f;
constexpr float kGuestSize = 0.55f;

/// Where leaps are made, one after the other.
constexpr glm::vec3 kSpots[] = {{0.45f, 0.0f, 0.0f}, {-0.55f, 0.0f, -0.4f}, {0.8f, 0.0f, -0.3f}};

CharacterGroup createGroup(const supple::Context& context, const supple::Asset& asset, SuppleScheme scheme,
                           uint32_t capacity, uint32_t rate) {
    auto desc = supple::sized<SuppleGroupDesc>();
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_MOTION; // colors; previous positions for motion vectors
    desc.asset = asset.handle();
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = rate;
    CharacterGroup created;
    must(supple::Group::create(context, desc, created.group), "the character's surface");
    must(created.group.info(created.info), "suppleGetGroupInfo");
    must(created.group.vertexStreams(created.streams), "suppleGetVertexStreams");
    must(created.group.gridOutput(created.grid), "suppleGetGridOutput");
    SuppleSurfaceInfo surface{};
    must(created.group.surfaceInfo(surface), "suppleGetSurfaceInfo");
    created.patchesPerEdge = surface.patchesPerEdge;
    for (uint32_t i = 0; i < created.grid.drawRangeCount; ++i) {
        Look& look = created.looks.emplace_back();
        const uint32_t index = created.grid.drawRanges[i].material;
        if (index == SUPPLE_NO_MATERIAL)
            continue;
        SuppleMaterialInfo material{};
        must(asset.materialInfo(index, material), "suppleGetMaterialInfo");
        std::copy_n(material.baseColorFactor, 4, &look.baseColor[0]);
        look.metallic = material.metallicFactor;
        look.roughness = material.roughnessFactor;
        look.doubleSided = material.doubleSided != 0;
    }
    return created;
}

/// Layers are of clips; a character without any rests.
void play(const supple::Instance& instance, std::span<const SuppleClipLayer> layers) {
    if (layers[0].clip == SUPPLE_REST_POSE)
        must(instance.setClipPose(SUPPLE_REST_POSE, 0.0), "suppleSetClipPose");
    else
        must(instance.setPose(layers), "suppleSetPose");
}

} // namespace

Characters::Characters(Device& device, const std::string& path, uint32_t rate, const std::string& record) {
    context_ = mustCreateContext(device, record);

    const std::vector<char> file = mustReadFile(path);
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = path.c_str();
    assetDesc.bytes = file.data();
    assetDesc.byteCount = file.size();
    must(supple::Asset::create(context_, assetDesc, asset_), "suppleCreateAsset");
    walk_ = findClip("walk");
    joy_ = findClip("joy");
    idle_ = findClip("idle");
    SuppleClipInfo clip{};
    if (joy_ != SUPPLE_REST_POSE && asset_.clipInfo(joy_, clip) == SUPPLE_OK)
        joyDuration_ = clip.duration;

    groups_[0] = createGroup(context_, asset_, SUPPLE_SCHEME_PM, 1, rate);
    groups_[1] = createGroup(context_, asset_, SUPPLE_SCHEME_CATMULL_CLARK, 2, rate);
    must(supple::Instance::create(groups_[0].group, walker_), "suppleCreateInstance");
    must(supple::Instance::create(groups_[1].group, leaper_), "suppleCreateInstance");
}

/// The clip of that name; a character without it plays its first, one without clips rests.
uint32_t Characters::findClip(const char* name) const {
    SuppleAssetInfo info{};
    must(asset_.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.clipCount; ++i) {
        SuppleClipInfo clip{};
        if (asset_.clipInfo(i, clip) == SUPPLE_OK && std::strcmp(clip.name, name) == 0)
            return i;
    }
    return info.clipCount > 0 ? 0 : SUPPLE_REST_POSE;
}

void Characters::place(const supple::Instance& instance, glm::vec3 position, float heading, float size) {
    glm::mat4 transform = glm::translate(glm::mat4(1.0f), position);
    transform = glm::rotate(transform, heading, glm::vec3(0.0f, 1.0f, 0.0f));
    transform = glm::scale(transform, glm::vec3(size));
    must(instance.setTransform(std::span<const float, 16>(&transform[0][0], 16)), "suppleSetTransform");
    footprints_.push_back({position, 0.55f * size});
}

void Characters::update(double time) {
    footprints_.clear();

    // The clip walks on the spot; the host moves the walker along, at the speed of his feet.
    SuppleClipLayer walking{};
    walking.clip = walk_;
    walking.flags = SUPPLE_LAYER_LOOP;
    walking.weight = 1.0f;
    walking.time = time;
    play(walker_, {&walking, 1});
    const float angle = -1.15f + static_cast<float>(time) * kWalkSpeed / kWalkRadius;
    place(walker_, {kWalkRadius * std::sin(angle), 0.0f, kWalkRadius * std::cos(angle)}, angle + glm::half_pi<float>(),
          1.0f);

    // A leap, and half a breath of rest, crossfaded: the old clip whole, the new one over it.
    const double cycle = joyDuration_ + 0.6;
    const auto leap = static_cast<int64_t>(time / cycle);
    const double at = time - static_cast<double>(leap) * cycle;
    SuppleClipLayer layers[2]{};
    layers[0].clip = joy_;
    layers[0].weight = 1.0f;
    layers[0].time = at;
    layers[1].clip = idle_;
    layers[1].flags = SUPPLE_LAYER_LOOP;
    layers[1].weight = static_cast<float>(glm::clamp((at - joyDuration_ + 0.2) / 0.4, 0.0, 1.0));
    layers[1].time = at;
    play(leaper_, layers);
    const glm::vec3 spot = kSpots[leap % 3];
    place(leaper_, spot, 0.25f - 0.4f * spot.x, 1.0f);

    if (leap != leap_) {
        if (leap_ >= 0) // he did not go there, he is there: no motion, and no smear
            must(leaper_.teleport(), "suppleTeleport");
        leap_ = leap;
        if (leap % 2 == 1) {
            guest_.emplace();
            must(supple::Instance::create(groups_[1].group, *guest_), "suppleCreateInstance");
        } else {
            guest_.reset(); // frames in flight still draw it; Supple waits for them
        }
    }
    if (guest_) {
        must(guest_->setClipPose(joy_, glm::max(at - 0.15, 0.0)), "suppleSetClipPose");
        place(*guest_, spot + glm::vec3(spot.x > 0.0f ? -1.15f : 1.1f, 0.0f, 0.35f), 0.0f, kGuestSize);
    }
}

void Characters::beginFrame(uint64_t frame, uint64_t completed) const {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Characters::addToGraph(Graph& graph, Resource buffers) const {
    Scope first{};
    Scope last{};
    must(suppleGetRecordScopes(&first, &last), "suppleGetRecordScopes");
    graph.add("supple", {writesWithin(buffers, first, last)}, [this](VkCommandBuffer commands) {
        const SuppleGroup groups[] = {groups_[0].group.handle(), groups_[1].group.handle()};
        // No `before`: the graph has waited for the draws of the last frame and for Supple's own passes. No `after`:
        // the graph's next barrier makes `last` visible to whom it knows.
        must(context_.record(commands, groups, {}, {}, SUPPLE_RECORD_NO_ENTRY_BARRIER | SUPPLE_RECORD_TIMINGS),
             "suppleRecord");
    });
}

double Characters::milliseconds() const {
    double sum = 0.0;
    if (context_.timings(timings_) == SUPPLE_OK)
        for (const SuppleTiming& timing : timings_)
            sum += (timing.gpuEnd - timing.gpuBegin) * 1e-6;
    return sum;
}

} // namespace engine
