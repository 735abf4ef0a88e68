#include "tools/supple/profile_stage.h"

#include "base/utf8_path.h"
#include "host/camera.h"
#include "host/group_output.h"
#include "host/patches.h"
#include "tools/supple/command.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::tools {

namespace {

constexpr double kFrameTime = 1.0 / 60.0;
constexpr float kWidth = 1920.0f, kHeight = 1080.0f; ///< of the picture that the crowd is drawn for
constexpr float kFieldOfView = 0.7f, kNear = 0.1f, kFar = 1000.0f;

/// A square of so many instances a side.
uint32_t sideOf(size_t instances) {
    return static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(instances))));
}

Result<uint32_t> playedClip(const cage::Character& character, const std::string& asked) {
    if (asked.empty() && !character.clips.empty()) {
        return 0u;
    }
    return host::findClip(character, asked);
}

} // namespace

Status ProfileStage::create(std::span<const host::CharacterFile> files, const std::string& scheme, ProfileRun& run) {
    Status status = options_.view ? createView(files) : success();
    const auto kinds = static_cast<uint32_t>(files.size());
    for (uint32_t k = 0; status && k < kinds; ++k) {
        const uint32_t dealt = options_.instances / kinds + (k < options_.instances % kinds ? 1 : 0);
        status = createGroup(files[k], scheme, std::max(dealt, 1u), run);
    }
    if (status && options_.view) {
        run.budget = options_.budget;
        status = place();
    }
    return status;
}

Status ProfileStage::destroy() {
    Status status = success();
    const auto keepFirst = [&](Status next) { status = status ? std::move(next) : std::move(status); };
    for (const SuppleGroup group : groups_) {
        keepFirst(check(suppleDestroyGroup(handle(), group), "suppleDestroyGroup"));
    }
    for (const Subject& subject : subjects_) {
        keepFirst(check(suppleDestroyAsset(handle(), subject.asset), "suppleDestroyAsset"));
    }
    if (view_.id != 0) {
        keepFirst(check(suppleDestroyView(handle(), view_), "suppleDestroyView"));
    }
    groups_.clear();
    firstSurfaces_.clear();
    subjects_.clear();
    view_ = {};
    return status;
}

Status ProfileStage::createView(std::span<const host::CharacterFile> files) {
    SuppleViewDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = uint32_t{SUPPLE_VIEW_CULL} | (options_.motion ? uint32_t{SUPPLE_VIEW_MOTION} : 0) |
                 (options_.tangents ? uint32_t{SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS} : 0);
    desc.maxVertices = options_.budget;
    desc.coefficientBytes = uint64_t{options_.coefficients} << 20;
    Status status = check(suppleCreateView(handle(), &desc, &view_), "suppleCreateView");
    if (!status) {
        return status;
    }
    float radius = 0.0f;
    for (const host::CharacterFile& file : files) {
        radius = std::max(radius, host::boundsOf(file.character.cage.positions).radius());
    }
    spacing_ = radius;
    return setCamera(false);
}

Status ProfileStage::setCamera(bool away) const {
    const float radius = spacing_;
    // Before the middle of the square's edge, somewhat above: some instances fill the picture, some are small, and
    // those at the sides of the first rows are out of it.
    const float reach = 0.5f * spacing_ * static_cast<float>(sideOf(options_.instances));
    const glm::vec3 eye(0.0f, 1.5f * radius, reach + 3.0f * radius), ahead(0.0f, 0.5f * radius, 0.0f);
    const glm::mat4 viewProjection =
        glm::perspectiveRH_ZO(kFieldOfView, kWidth / kHeight, kNear * radius, kFar * radius) *
        glm::lookAtRH(eye, away ? 2.0f * eye - ahead : ahead, glm::vec3(0.0f, 1.0f, 0.0f));
    SuppleCameraDesc camera{};
    camera.structSize = sizeof camera;
    std::memcpy(camera.position, &eye, sizeof camera.position);
    camera.pixelsPerUnit = 0.5f * kHeight / std::tan(0.5f * kFieldOfView);
    camera.vertexBudget = options_.budget; // subdivision minds it where it is said
    std::memcpy(camera.viewProjection, &viewProjection, sizeof camera.viewProjection);
    return check(suppleSetCamera(handle(), view_, &camera), "suppleSetCamera");
}

Status ProfileStage::createGroup(const host::CharacterFile& file, const std::string& scheme, uint32_t instances,
                                 ProfileRun& run) {
    const Result<SuppleAsset> asset = host::createAsset(context_, file);
    if (!asset) {
        return asset.error();
    }
    Subject& subject = subjects_.emplace_back();
    subject.asset = *asset;
    subject.name = printable(utf8Text(utf8Path(file.path).filename()));
    const std::vector<cage::Clip>& clips = file.character.clips;
    const Result<uint32_t> clip = playedClip(file.character, options_.clip);
    if (!clip) {
        return clip.error();
    }
    subject.clip = *clip;
    const bool bindPose = subject.clip == SUPPLE_BIND_POSE;
    subject.clipDuration = bindPose ? 0.0 : clips[subject.clip].duration;
    run.clip += (run.clip.empty() ? "" : " + ") + (bindPose ? "bind pose" : printable(clips[subject.clip].name));
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    if (!options_.view) { // nothing is drawn, so that it need not be bound as a whole
        desc.flags = SUPPLE_GROUP_WINDOWS | (options_.motion ? uint32_t{SUPPLE_GROUP_MOTION} : 0) |
                     (options_.tangents ? uint32_t{SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS} : 0);
    }
    desc.asset = subject.asset;
    desc.capacity = instances;
    desc.scheme = schemeOf(scheme);
    desc.rate = options_.surface.rate;
    SchemeOptions schemeOptions;
    if (Status described = describeSurface(options_.surface, file.character, schemeOptions, desc); !described) {
        return described;
    }
    desc.poseSource = options_.plays() ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
    desc.view = view_;
    desc.keepUnseenFrames = options_.keepUnseen;
    SuppleGroup group{};
    Status status = check(suppleCreateGroup(handle(), &desc, &group), "suppleCreateGroup");
    if (!status) {
        return status;
    }
    groups_.push_back(group);
    status = context_.createInstances(group, instances, subject.instances);
    if (status) {
        status = setMorphs(file, subject);
    }
    if (status && options_.plays()) {
        status = startPlayback(subject);
    }
    run.instances += instances;
    return status ? report(group, file, run) : status;
}

Result<ProfiledSurface> ProfileStage::reportSurface(SuppleGroup group, uint32_t index, const SuppleSurfaceInfo& info,
                                                    const host::CharacterFile& file) const {
    const cage::Character& character = file.character;
    const Result<std::vector<uint32_t>> patches =
        host::patchesByPart(context_, group, index, character.cage.faceParts, character.parts.size());
    if (!patches) {
        return patches.error();
    }
    ProfiledSurface surface{utf8Text(utf8Path(file.path).filename()), schemeName(info.scheme), {}};
    for (const uint32_t part : std::span(info.parts, info.partCount)) {
        const std::string name = part < character.parts.size() ? character.parts[part].name : "";
        surface.parts.push_back({name.empty() ? "part " + std::to_string(part) : printable(name), (*patches)[part]});
    }
    return surface;
}

size_t ProfileStage::surfaceOf(SuppleGroup group, uint32_t surface) const {
    const auto own =
        std::find_if(groups_.begin(), groups_.end(), [&](const SuppleGroup& other) { return other.id == group.id; });
    const size_t first = firstSurfaces_[static_cast<size_t>(own - groups_.begin())];
    return surface == SUPPLE_NO_SURFACE ? first : first + 1 + surface;
}

Status ProfileStage::report(SuppleGroup group, const host::CharacterFile& file, ProfileRun& run) {
    firstSurfaces_.push_back(run.surfaces.size());
    run.surfaces.push_back({utf8Text(utf8Path(file.path).filename()), "", {}});
    uint32_t patches = 0, count = 1;
    for (uint32_t surface = 0; surface < count; ++surface) {
        host::GroupOutput output{};
        Status status = check(host::getGroupOutput(handle(), group, output, surface), "suppleGetGroupInfo");
        if (!status) {
            return status;
        }
        count = output.info.surfaceCount;
        patches += output.surface.patchCount;
        Result<ProfiledSurface> reported = reportSurface(group, surface, output.surface, file);
        if (!reported) {
            return reported.error();
        }
        run.surfaces.push_back(std::move(*reported));
        const bool none = output.surface.tessellation == SUPPLE_TESSELLATION_NONE;
        run.patchRate = std::max(run.patchRate, none ? run.rate : output.grid.rate);
        const std::string scheme = schemeName(output.surface.scheme);
        if (("+" + run.scheme + "+").find("+" + scheme + "+") == std::string::npos) {
            run.scheme += (run.scheme.empty() ? "" : "+") + scheme;
        }
    }
    run.patches = std::max(run.patches, patches);
    return success();
}

double ProfileStage::phase(const Subject& subject, size_t instance) {
    return subject.clipDuration * static_cast<double>(instance) / static_cast<double>(subject.instances.size());
}

Status ProfileStage::setMorphs(const host::CharacterFile& file, const Subject& subject) {
    const Result<std::vector<float>> weights = host::morphWeights(file.character, options_.morphs);
    if (!weights) {
        return weights.error();
    }
    Status status = success();
    for (size_t i = 0; status && !weights->empty() && i < subject.instances.size(); ++i) {
        status = check(suppleSetMorphWeights(handle(), subject.instances[i], weights->data(),
                                             static_cast<uint32_t>(weights->size())),
                       "suppleSetMorphWeights");
    }
    return status;
}

Status ProfileStage::startPlayback(const Subject& subject) {
    Status status = success();
    for (size_t i = 0; status && subject.clip != SUPPLE_BIND_POSE && i < subject.instances.size(); ++i) {
        SupplePlaybackLayer layer{};
        layer.clip = subject.clip;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.speed = 1.0f;
        layer.offset = phase(subject, i);
        SupplePlaybackDesc playback{};
        playback.structSize = sizeof playback;
        playback.layers = &layer;
        playback.layerCount = 1;
        status = check(suppleSetPlayback(handle(), subject.instances[i], &playback), "suppleSetPlayback");
    }
    return status;
}

Status ProfileStage::place() {
    size_t total = 0;
    for (const Subject& subject : subjects_) {
        total += subject.instances.size();
    }
    const uint32_t side = sideOf(total);
    const float middle = 0.5f * static_cast<float>(side - 1);
    Status status = success();
    for (size_t k = 0; k < subjects_.size(); ++k) {
        for (size_t i = 0; status && i < subjects_[k].instances.size(); ++i) {
            const size_t place = i * subjects_.size() + k; // kinds side by side
            const size_t rowNumber = place / side;
            const auto column = static_cast<float>(place % side), row = static_cast<float>(rowNumber);
            const glm::mat4 transform =
                glm::translate(glm::mat4(1.0f), spacing_ * glm::vec3(column - middle, 0.0f, row - middle));
            status =
                check(suppleSetTransform(handle(), subjects_[k].instances[i], &transform[0][0]), "suppleSetTransform");
        }
    }
    return status;
}

Status ProfileStage::setPoses(uint32_t frame) {
    Status status = success();
    if (options_.plays()) {
        for (size_t g = 0; status && g < groups_.size(); ++g) {
            status = check(suppleSetTime(handle(), groups_[g], frame * kFrameTime), "suppleSetTime");
        }
        return status;
    }
    for (const Subject& subject : subjects_) {
        for (size_t i = 0; status && subject.clip != SUPPLE_BIND_POSE && i < subject.instances.size(); ++i) {
            const double time = subject.clipDuration > 0.0
                                    ? std::fmod(frame * kFrameTime + phase(subject, i), subject.clipDuration)
                                    : 0.0;
            status = check(suppleSetClipPose(handle(), subject.instances[i], subject.clip, time), "suppleSetClipPose");
        }
    }
    return status;
}

Status ProfileStage::lookAway() const {
    return setCamera(true);
}

Result<std::vector<MemoryHolder>> ProfileStage::holders() const {
    std::vector<MemoryHolder> holders;
    Status status = success();
    const auto add = [&](const std::string& name, const auto& call, const char* callName) {
        MemoryHolder& holder = holders.emplace_back();
        holder.name = name;
        holder.use.structSize = sizeof holder.use;
        status = status ? check(call(&holder.use), callName) : status;
    };
    for (size_t k = 0; k < subjects_.size(); ++k) {
        add(
            "asset " + subjects_[k].name,
            [&](SuppleMemoryUse* use) { return suppleGetAssetMemory(handle(), subjects_[k].asset, use); },
            "suppleGetAssetMemory");
        add(
            "group " + subjects_[k].name,
            [&](SuppleMemoryUse* use) { return suppleGetGroupMemory(handle(), groups_[k], use); },
            "suppleGetGroupMemory");
    }
    if (view_.id != 0) {
        add(
            "the view", [&](SuppleMemoryUse* use) { return suppleGetViewMemory(handle(), view_, use); },
            "suppleGetViewMemory");
    }
    return status ? Result<std::vector<MemoryHolder>>(std::move(holders)) : status.error();
}

std::optional<SuppleViewStatistics> ProfileStage::statistics() const {
    SuppleViewStatistics drawn{};
    drawn.structSize = sizeof drawn;
    if (view_.id == 0 || suppleGetViewStatistics(handle(), view_, &drawn) != SUPPLE_OK) {
        return std::nullopt;
    }
    return drawn;
}

} // namespace supple::tools
