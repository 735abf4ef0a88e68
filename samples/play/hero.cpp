#include "hero.h"

#include "host/must.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace play {

namespace {

constexpr const char* kFile = "wren.glb";

} // namespace

Hero::Hero(Device& device, const HeroOptions& options)
    : context_(mustCreateContext(device, options.record, options.bareRecording ? SUPPLE_RECORDING_WITHOUT_ASSETS : 0)) {
    const std::vector<char> bytes = mustReadFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + kFile);
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = kFile;
    assetDesc.bytes = bytes.data();
    assetDesc.byteCount = bytes.size();
    must(supple::Asset::create(context_, assetDesc, asset_), "suppleCreateAsset");
    auto desc = supple::sized<SuppleGroupDesc>();
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS;
    desc.asset = asset_.handle();
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    desc.rate = options.rate;
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    must(supple::Group::create(context_, desc, group_), "suppleCreateGroup");
    must(supple::Instance::create(group_, instance_), "suppleCreateInstance");
    for (uint32_t point = 0; point < kJoints; ++point)
        joints_[point] = findJoint(kBody[point].joint);
    hideSword();
}

uint32_t Hero::findJoint(std::string_view name) const {
    SuppleAssetInfo info{};
    must(asset_.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.jointCount; ++i) {
        SuppleJointInfo joint{};
        must(asset_.jointInfo(i, joint), "suppleGetJointInfo");
        if (joint.name == name)
            return i;
    }
    fail(std::string(kFile) + ": has no joint " + std::string(name));
}

/// Who is about to be knocked over carries no blade.
void Hero::hideSword() {
    SuppleAssetInfo info{};
    must(asset_.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.partCount; ++i) {
        SupplePartInfo part{};
        must(asset_.partInfo(i, part), "suppleGetPartInfo");
        if (std::string_view(part.name) == "sword")
            hidden_ = i;
    }
    must(instance_.setPartVisible(hidden_, false), "suppleSetPartVisible");
}

uint32_t Hero::findClip(std::string_view name) const {
    SuppleAssetInfo info{};
    must(asset_.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.clipCount; ++i) {
        SuppleClipInfo clip{};
        must(asset_.clipInfo(i, clip), "suppleGetClipInfo");
        if (clip.name == name)
            return i;
    }
    fail(std::string(kFile) + ": has no clip " + std::string(name));
}

double Hero::duration(std::string_view clip) const {
    SuppleClipInfo info{};
    must(asset_.clipInfo(findClip(clip), info), "suppleGetClipInfo");
    return info.duration;
}

float Hero::groundSpeed(std::string_view clip) const {
    uint32_t count = 0;
    must(asset_.clipContacts(findClip(clip), nullptr, count), "suppleGetClipContacts");
    std::vector<SuppleClipContact> contacts(count);
    must(asset_.clipContacts(findClip(clip), contacts.data(), count), "suppleGetClipContacts");
    float speed = 0.0f;
    for (const SuppleClipContact& contact : contacts)
        speed += std::hypot(contact.velocity[0], contact.velocity[2]) / static_cast<float>(count);
    return speed;
}

void Hero::beginFrame(uint64_t frame, uint64_t completed) const {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Hero::addToGraph(Graph& graph, Resource buffers) const {
    Scope first{};
    Scope last{};
    must(suppleGetRecordScopes(&first, &last), "suppleGetRecordScopes");
    graph.add("supple", {writesWithin(buffers, first, last)}, [this](VkCommandBuffer commands) {
        const SuppleGroup group = group_.handle();
        must(context_.record(commands, {&group, 1}, {}, {}, SUPPLE_RECORD_NO_ENTRY_BARRIER), "suppleRecord");
    });
}

void Hero::setTime(double time) {
    time_ = time;
    must(group_.setTime(time), "suppleSetTime");
}

void Hero::play(std::string_view clip, const Start& start) const {
    SupplePlaybackLayer layer{};
    layer.clip = findClip(clip);
    layer.flags = start.loops ? SUPPLE_LAYER_LOOP : 0;
    layer.weight = 1.0f;
    layer.speed = start.speed;
    layer.startTime = time_;
    layer.offset = start.offset;
    auto playback = supple::sized<SupplePlaybackDesc>();
    playback.flags = start.fromModified ? SUPPLE_PLAYBACK_FROM_MODIFIED : 0;
    playback.layers = &layer;
    playback.layerCount = 1;
    playback.transition = start.transition;
    playback.transitionKind = start.kind;
    must(instance_.setPlayback(playback), "suppleSetPlayback");
}

void Hero::setTransform(const glm::mat4& transform) {
    transform_ = transform;
    must(instance_.setTransform(std::span<const float, 16>(glm::value_ptr(transform), 16)), "suppleSetTransform");
}

void Hero::setModifiers(std::span<const SuppleModifier> modifiers) const {
    must(instance_.setModifiers(modifiers), "suppleSetModifiers");
}

void Hero::setTarget(uint32_t modifier, float weight, const glm::vec3& point, const glm::quat& rotation) const {
    auto target = supple::sized<SuppleModifierTarget>();
    target.weight = weight;
    std::copy_n(&point[0], 3, target.target);
    std::copy_n(&rotation[0], 4, target.rotation); // x, y, z, w, as glm has them in memory
    must(instance_.setModifierTarget(modifier, target), "suppleSetModifierTarget");
}

glm::mat4 Hero::jointTransform(Point point) const {
    glm::mat4 transform;
    must(instance_.jointTransform(joints_[point], std::span<float, 16>(glm::value_ptr(transform), 16)),
         "suppleGetJointTransform");
    return transform;
}

BodyPose Hero::pose() const {
    BodyPose pose;
    for (uint32_t point = 0; point < kJoints; ++point)
        pose[point] = jointTransform(static_cast<Point>(point));
    return pose;
}

} // namespace play
