#include "tools/supple/evaluation.h"

#include "cage/limits.h"
#include "host/patches.h"
#include "host/shaders/draw.h"
#include "tools/common/simulation.h"

#include <string>
#include <utility>

namespace supple::tools {
namespace {

/// Reads a buffer of the group's output; one that the group was made without stays empty.
Status readBack(host::Device& device, const SuppleBufferRange& view, std::vector<std::byte>& bytes) {
    if (view.buffer == VK_NULL_HANDLE) {
        return success();
    }
    Result<std::vector<std::byte>> read = device.readBuffer(view);
    if (!read) {
        return read.error();
    }
    bytes = std::move(*read);
    return success();
}

Result<EvaluatedSurface> readSurface(Session& session, SuppleGroup group, uint32_t index) {
    host::Context& context = *session.context;
    EvaluatedSurface surface;
    Status status =
        context.check(host::getGroupOutput(context.handle(), group, surface.output, index), "suppleGetGroupInfo");
    if (status) {
        Result<std::vector<SupplePatchInfo>> patches = host::patchesOf(context, group, index);
        status = patches ? success() : Status(patches.error());
        surface.patches = patches ? std::move(*patches) : std::vector<SupplePatchInfo>();
    }
    const std::pair<const SuppleBufferRange*, std::vector<std::byte>*> buffers[] = {
        {&surface.output.streams.vertices, &surface.vertices},
        {&surface.output.streams.attributes, &surface.attributes},
        {&surface.output.streams.uvs1, &surface.uvs1},
        {&surface.output.streams.tangents, &surface.tangents},
        {&surface.output.indices(), &surface.gridIndices},
        {&surface.output.surface.patchCoefficients, &surface.coefficients},
    };
    for (const auto& [view, bytes] : buffers) {
        if (status) {
            status = readBack(*session.device, *view, *bytes);
        }
    }
    if (!status) {
        return status.error();
    }
    return surface;
}

Result<Evaluation> readGroup(Session& session, SuppleGroup group) {
    Evaluation result;
    uint32_t count = 1;
    for (uint32_t index = 0; index < count; ++index) {
        Result<EvaluatedSurface> surface = readSurface(session, group, index);
        if (!surface) {
            return surface.error();
        }
        count = surface->output.info.surfaceCount;
        result.surfaces.push_back(std::move(*surface));
    }
    const Status status =
        readBack(*session.device, result.surfaces.front().output.info.deformedCage, result.deformedCage);
    if (!status) {
        return status.error();
    }
    return result;
}

/// A clip may move a vertex anywhere: a chain of large scales ends beyond what floats hold.
Status checkCage(const Evaluation& evaluation, const cage::Character& character) {
    const SuppleBufferRange& range = evaluation.surfaces.front().output.info.deformedCage;
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        const auto position = element<glm::vec3>(evaluation.deformedCage, range, v);
        if (const char* fault = cage::faultOfCoordinates(&position[0], 3)) {
            return Error{ErrorCode::asset,
                         character.name + ": the pose moves cage vertex " + std::to_string(v) + ": " + fault};
        }
    }
    return success();
}

/// What the pose mirrors, by the sides of the cage's vertices.
void findMirrored(Evaluation& evaluation, const cage::Cage& cage) {
    const SuppleBufferRange& range = evaluation.surfaces.front().output.info.deformedCage;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        float sides = 0.0f;
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            sides += element<glm::vec4>(evaluation.deformedCage, range, cage.faceVertices[corner]).w;
        }
        evaluation.mirroredFaces.push_back(host::shared::isMirrored(sides) ? 1 : 0);
    }
    for (EvaluatedSurface& surface : evaluation.surfaces) {
        for (const SupplePatchInfo& patch : surface.patches) {
            surface.mirrored.push_back(evaluation.mirroredFaces[patch.face]);
        }
    }
}

} // namespace

namespace {

/// What stands plays with speed 0; poses before and after it are needed where it lies between two.
Status playStanding(host::Context& context, SuppleGroup group, SuppleInstance instance, const Pose& pose) {
    const bool between = pose.updateInterval > 0;
    SupplePlaybackLayer layer{};
    layer.clip = pose.clip;
    layer.weight = 1.0f;
    layer.offset = between ? 0.0 : pose.time;
    layer.speed = between ? 1.0f : 0.0f;
    if (between) {
        const Status status = context.check(suppleSetTime(context.handle(), group, pose.time), "suppleSetTime");
        if (!status) {
            return status;
        }
    }
    SupplePlaybackDesc playback{};
    playback.structSize = sizeof playback;
    playback.layers = &layer;
    playback.layerCount = pose.clip == SUPPLE_BIND_POSE || pose.clip == SUPPLE_REST_POSE ? 0 : 1;
    playback.updateInterval = pose.updateInterval;
    return context.check(suppleSetPlayback(context.handle(), instance, &playback), "suppleSetPlayback");
}

/// The pose and what changes it, by the device.
Status play(host::Context& context, SuppleGroup group, SuppleInstance instance, const Pose& pose) {
    SuppleModifiersDesc modifiers{};
    modifiers.structSize = sizeof modifiers;
    modifiers.modifiers = pose.modifiers.data();
    modifiers.modifierCount = static_cast<uint32_t>(pose.modifiers.size());
    Status status = context.check(suppleSetModifiers(context.handle(), instance, &modifiers), "suppleSetModifiers");
    if (!status) {
        return status;
    }
    if (pose.transition) {
        return host::playTransition(context, group, instance, *pose.transition, pose.time);
    }
    return pose.simulate > 0.0
               ? host::simulate(context, group, instance, pose.clip, pose.time - pose.simulate, pose.time)
               : playStanding(context, group, instance, pose);
}

} // namespace

Result<Evaluation> evaluate(Session& session, SuppleAsset asset, const cage::Character& character,
                            const SurfaceFlags& surface, const Pose& pose, uint32_t groupFlags,
                            const std::function<Status(SuppleGroup)>& prepare) {
    host::Context& context = *session.context;
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = groupFlags;
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = schemeOf(surface.scheme);
    desc.rate = surface.rate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    const bool plays = !pose.modifiers.empty() || pose.transition || pose.updateInterval > 0 || pose.simulate > 0.0;
    if (plays) {
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
        desc.flags |= SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS;
        desc.flags |= pose.updateInterval > 0 ? SUPPLE_GROUP_UPDATE_RATES : 0;
        desc.flags |= pose.simulate > 0.0 ? SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_SOFT : 0;
    }
    SchemeOptions options;
    Status status = describeSurface(surface, character, options, desc);
    SuppleGroup group{};
    if (status) {
        status = context.check(suppleCreateGroup(context.handle(), &desc, &group), "suppleCreateGroup");
    }
    SuppleInstance instance{};
    if (status) {
        status = context.check(suppleCreateInstance(context.handle(), group, &instance), "suppleCreateInstance");
    }
    if (status) {
        status = plays ? play(context, group, instance, pose)
                       : context.check(suppleSetClipPose(context.handle(), instance, pose.clip, pose.time),
                                       "suppleSetClipPose");
    }
    if (status && !pose.morphWeights.empty()) {
        status = context.check(suppleSetMorphWeights(context.handle(), instance, pose.morphWeights.data(),
                                                     static_cast<uint32_t>(pose.morphWeights.size())),
                               "suppleSetMorphWeights");
    }
    if (status && prepare) {
        status = prepare(group);
    }
    if (status) {
        const SuppleGroup groups[] = {group};
        status = context.evaluate(groups);
    }
    if (!status) {
        return status.error();
    }
    Result<Evaluation> evaluation = readGroup(session, group);
    if (evaluation) {
        status = checkCage(*evaluation, character);
    }
    if (evaluation && status) {
        findMirrored(*evaluation, character.cage);
    }
    return status ? std::move(evaluation) : status.error();
}

} // namespace supple::tools
