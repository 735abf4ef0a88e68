// The C ABI: checks arguments, turns errors into results and log lines, lets nothing thrown escape.
#include "supple/supple.h"

#include "cage/character_reader.h"
#include "cage/trim.h"
#include "runtime/context.h"
#include "runtime/pose_desc.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <glm/gtc/type_ptr.hpp>
#include <new>

using supple::Error;
using supple::ErrorCode;
using supple::runtime::Asset;
using supple::runtime::Context;
using supple::runtime::Group;

struct SuppleContext_T {
    std::unique_ptr<Context> context;
};

namespace {

SuppleResult resultOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::argument:
        return SUPPLE_ERROR_ARGUMENT;
    case ErrorCode::asset:
    case ErrorCode::io:
        return SUPPLE_ERROR_ASSET;
    case ErrorCode::unsupported:
        return SUPPLE_ERROR_UNSUPPORTED;
    case ErrorCode::limit:
        return SUPPLE_ERROR_LIMIT;
    case ErrorCode::hostMemory:
        return SUPPLE_ERROR_HOST_MEMORY;
    case ErrorCode::deviceMemory:
        return SUPPLE_ERROR_DEVICE_MEMORY;
    case ErrorCode::deviceLost:
        return SUPPLE_ERROR_DEVICE_LOST;
    case ErrorCode::vulkan:
        return SUPPLE_ERROR_VULKAN;
    }
    return SUPPLE_ERROR_VULKAN;
}

static_assert(SUPPLE_WRAP_REPEAT == static_cast<int>(supple::cage::Wrap::repeat) &&
              SUPPLE_WRAP_CLAMP == static_cast<int>(supple::cage::Wrap::clampToEdge) &&
              SUPPLE_WRAP_MIRROR == static_cast<int>(supple::cage::Wrap::mirroredRepeat));
static_assert(SUPPLE_MAX_TRIM_TILES == supple::cage::kMaxTrimTiles);

SuppleResult report(const Context& context, const Error& error) {
    context.log(SUPPLE_SEVERITY_ERROR, error.message);
    return resultOf(error.code);
}

SuppleResult refuse(const Context& context, const char* function, const char* reason) {
    return report(context, {ErrorCode::argument, std::string(function) + ": " + reason});
}

/// Runs an entry point's body. Out of memory is the one thing the standard library throws at us.
template <class F>
SuppleResult guarded(SuppleContext handle, const char* function, F&& body) noexcept {
    if (handle == nullptr || handle->context == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        return body(*handle->context);
    } catch (const std::bad_alloc&) {
        return SUPPLE_ERROR_HOST_MEMORY; // a log line would need memory
    } catch (const std::exception& e) {
        try {
            return report(*handle->context, {ErrorCode::vulkan, std::string(function) + ": " + e.what()});
        } catch (...) {
            return SUPPLE_ERROR_VULKAN;
        }
    }
}

template <class Body>
SuppleResult withAsset(SuppleContext handle, SuppleAsset asset, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Asset>& found = context.assets.find(asset.id);
        if (found == nullptr) {
            return refuse(context, function, "stale or foreign asset handle");
        }
        return body(context, *found);
    });
}

template <class Body>
SuppleResult withGroup(SuppleContext handle, SuppleGroup group, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Group>& found = context.groups.find(group.id);
        if (found == nullptr) {
            return refuse(context, function, "stale or foreign group handle");
        }
        return body(context, *found);
    });
}

template <class Body>
SuppleResult withInstance(SuppleContext handle, SuppleGroup group, uint32_t instance, const char* function,
                          Body&& body) noexcept {
    return withGroup(handle, group, function, [&](Context& context, Group& found) {
        if (instance >= found.instanceCount()) {
            return report(context,
                          {ErrorCode::argument, std::string(function) + ": instance " + std::to_string(instance) +
                                                    " of " + std::to_string(found.instanceCount())});
        }
        return body(context, found);
    });
}

bool finite(const float* values, size_t count) {
    return std::all_of(values, values + count, [](float x) { return std::isfinite(x); });
}

supple::Result<std::vector<std::byte>> readThrough(const SuppleFiles& files, const std::string& path) {
    SuppleFileBytes found{};
    if (files.read(path.c_str(), &found, files.user) == 0) {
        return Error{ErrorCode::io, "the host has no such file"};
    }
    const auto* first = static_cast<const std::byte*>(found.bytes);
    std::vector<std::byte> bytes(first, first + (first != nullptr ? found.byteCount : 0));
    if (files.release != nullptr) {
        files.release(&found, files.user);
    }
    return bytes;
}

/// Copies as much of `source` as fits and reports the whole count.
template <class T>
SuppleResult fillArray(const T* source, size_t size, T* out, uint32_t* count) {
    const auto total = static_cast<uint32_t>(size);
    const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
    std::copy_n(source, n, out);
    *count = total;
    return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
}

} // namespace

const char* suppleResultString(SuppleResult result) {
    switch (result) {
    case SUPPLE_OK:
        return "SUPPLE_OK";
    case SUPPLE_NOT_READY:
        return "SUPPLE_NOT_READY";
    case SUPPLE_INCOMPLETE:
        return "SUPPLE_INCOMPLETE";
    case SUPPLE_ERROR_ARGUMENT:
        return "SUPPLE_ERROR_ARGUMENT";
    case SUPPLE_ERROR_ASSET:
        return "SUPPLE_ERROR_ASSET";
    case SUPPLE_ERROR_UNSUPPORTED:
        return "SUPPLE_ERROR_UNSUPPORTED";
    case SUPPLE_ERROR_LIMIT:
        return "SUPPLE_ERROR_LIMIT";
    case SUPPLE_ERROR_HOST_MEMORY:
        return "SUPPLE_ERROR_HOST_MEMORY";
    case SUPPLE_ERROR_DEVICE_MEMORY:
        return "SUPPLE_ERROR_DEVICE_MEMORY";
    case SUPPLE_ERROR_DEVICE_LOST:
        return "SUPPLE_ERROR_DEVICE_LOST";
    case SUPPLE_ERROR_VULKAN:
        return "SUPPLE_ERROR_VULKAN";
    }
    return "unknown SuppleResult";
}

SuppleResult suppleQueryRequirements(VkInstance instance, VkPhysicalDevice physicalDevice,
                                     PFN_vkGetInstanceProcAddr getInstanceProcAddr, SuppleRequirements* out) {
    if (instance == VK_NULL_HANDLE || physicalDevice == VK_NULL_HANDLE || getInstanceProcAddr == nullptr ||
        out == nullptr || out->structSize != sizeof(SuppleRequirements)) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        const supple::gpu::Requirements requirements = supple::gpu::requirements();
        out->apiVersion = requirements.apiVersion;
        out->features12 = requirements.features12;
        out->features13 = requirements.features13;
        const std::string missing = supple::gpu::missingRequirement(instance, physicalDevice, getInstanceProcAddr);
        std::snprintf(out->reason, sizeof(out->reason), "%s", missing.c_str());
        return missing.empty() ? SUPPLE_OK : SUPPLE_ERROR_UNSUPPORTED;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

SuppleResult suppleCreateContext(const SuppleContextDesc* desc, SuppleContext* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    if (desc == nullptr || out == nullptr || desc->structSize != sizeof(SuppleContextDesc)) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    const auto log = [&](const std::string& text) {
        if (desc->log != nullptr) {
            desc->log(SUPPLE_SEVERITY_ERROR, text.c_str(), desc->logUser);
        }
    };
    try {
        if (desc->instance == VK_NULL_HANDLE || desc->physicalDevice == VK_NULL_HANDLE ||
            desc->device == VK_NULL_HANDLE || desc->getInstanceProcAddr == nullptr) {
            log("suppleCreateContext: instance, physicalDevice, device or getInstanceProcAddr is null");
            return SUPPLE_ERROR_ARGUMENT;
        }
        if (desc->framesInFlight > 4 || desc->mapping > SUPPLE_MAPPING_WIDE || desc->mapping < SUPPLE_MAPPING_AUTO) {
            log("suppleCreateContext: framesInFlight must be 0..4 and mapping one of SuppleMapping");
            return SUPPLE_ERROR_ARGUMENT;
        }
        supple::Result<std::unique_ptr<Context>> context = Context::create(*desc);
        if (!context) {
            log(context.error().message);
            return resultOf(context.error().code);
        }
        *out = new SuppleContext_T{std::move(*context)};
        return SUPPLE_OK;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

void suppleDestroyContext(SuppleContext context) {
    delete context;
}

SuppleResult suppleCreateAsset(SuppleContext handle, const SuppleAssetDesc* desc, SuppleAsset* out) {
    return guarded(handle, "suppleCreateAsset", [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, "suppleCreateAsset", "out is null");
        }
        out->id = 0;
        if (desc == nullptr || desc->structSize != sizeof(SuppleAssetDesc)) {
            return refuse(context, "suppleCreateAsset", "desc is null or its structSize is wrong");
        }
        if ((desc->bytes == nullptr) == (desc->cage == nullptr)) {
            return refuse(context, "suppleCreateAsset", "give either bytes or cage");
        }
        const std::string name = desc->name != nullptr ? desc->name : "asset";
        supple::Result<supple::cage::Character> character = [&]() -> supple::Result<supple::cage::Character> {
            if (desc->cage != nullptr) {
                if (desc->cage->structSize != sizeof(SuppleCageDesc)) {
                    return Error{ErrorCode::argument, "suppleCreateAsset: cage->structSize is wrong"};
                }
                return supple::runtime::characterFromArrays(*desc->cage, name);
            }
            supple::cage::GltfOptions options;
            options.pairQuads = (desc->flags & SUPPLE_ASSET_PAIR_QUADS) != 0;
            if (desc->files != nullptr) {
                if (desc->files->read == nullptr) {
                    return Error{ErrorCode::argument, "suppleCreateAsset: files->read is null"};
                }
                options.readFile = [files = *desc->files](const std::string& path) { return readThrough(files, path); };
            }
            return supple::cage::readCharacter({static_cast<const std::byte*>(desc->bytes), desc->byteCount}, name,
                                               desc->baseDirectory != nullptr ? desc->baseDirectory : "", options);
        }();
        if (!character) {
            return report(context, character.error());
        }
        supple::Result<uint64_t> id = context.createAsset(std::move(*character));
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyAsset(SuppleContext handle, SuppleAsset asset) {
    return guarded(handle, "suppleDestroyAsset", [&](Context& context) {
        if (context.assets.remove(asset.id) == nullptr) {
            return refuse(context, "suppleDestroyAsset", "stale or foreign asset handle");
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetAssetInfo(SuppleContext handle, SuppleAsset asset, SuppleAssetInfo* out) {
    return withAsset(handle, asset, "suppleGetAssetInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleAssetInfo)) {
            return refuse(context, "suppleGetAssetInfo", "out is null or its structSize is wrong");
        }
        const supple::cage::Character& character = found.character;
        out->cageVertexCount = character.cage.vertexCount();
        out->faceCount = character.cage.faceCount();
        out->jointCount = static_cast<uint32_t>(character.skin.joints.size());
        out->clipCount = static_cast<uint32_t>(character.clips.size());
        out->materialCount = static_cast<uint32_t>(character.materials.size());
        out->morphTargetCount = static_cast<uint32_t>(character.morphs.targets.size());
        out->imageCount = static_cast<uint32_t>(character.images.size());
        glm::vec3 low = character.cage.positions.front(), high = low;
        for (const glm::vec3& p : character.cage.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        for (int axis = 0; axis < 3; ++axis) {
            out->boundsMin[axis] = low[axis];
            out->boundsMax[axis] = high[axis];
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetClipInfo(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out) {
    return withAsset(handle, asset, "suppleGetClipInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleClipInfo)) {
            return refuse(context, "suppleGetClipInfo", "out is null or its structSize is wrong");
        }
        if (clip >= found.character.clips.size()) {
            return refuse(context, "suppleGetClipInfo", "no such clip");
        }
        out->name = found.character.clips[clip].name.c_str();
        out->duration = found.character.clips[clip].duration;
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetJointInfo(SuppleContext handle, SuppleAsset asset, uint32_t joint, SuppleJointInfo* out) {
    return withAsset(handle, asset, "suppleGetJointInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleJointInfo)) {
            return refuse(context, "suppleGetJointInfo", "out is null or its structSize is wrong");
        }
        const supple::cage::Character& character = found.character;
        if (joint >= character.skin.joints.size()) {
            return refuse(context, "suppleGetJointInfo", "no such joint");
        }
        out->name = character.skeleton.nodes[character.skin.joints[joint]].name.c_str();
        out->parent = found.rig.jointParents[joint];
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetMorphTargetInfo(SuppleContext handle, SuppleAsset asset, uint32_t target,
                                      SuppleMorphTargetInfo* out) {
    return withAsset(handle, asset, "suppleGetMorphTargetInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleMorphTargetInfo)) {
            return refuse(context, "suppleGetMorphTargetInfo", "out is null or its structSize is wrong");
        }
        const supple::cage::Morphs& morphs = found.character.morphs;
        if (target >= morphs.targets.size()) {
            return refuse(context, "suppleGetMorphTargetInfo", "no such morph target");
        }
        out->name = morphs.targets[target].name.c_str();
        out->weight = morphs.weights[target];
        out->vertexCount = static_cast<uint32_t>(morphs.targets[target].vertices.size());
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetMaterialInfo(SuppleContext handle, SuppleAsset asset, uint32_t material,
                                   SuppleMaterialInfo* out) {
    return withAsset(handle, asset, "suppleGetMaterialInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleMaterialInfo)) {
            return refuse(context, "suppleGetMaterialInfo", "out is null or its structSize is wrong");
        }
        if (material >= found.character.materials.size()) {
            return refuse(context, "suppleGetMaterialInfo", "no such material");
        }
        const supple::cage::Material& from = found.character.materials[material];
        *out = {};
        out->structSize = sizeof(SuppleMaterialInfo);
        out->name = from.name.c_str();
        out->doubleSided = from.doubleSided ? 1 : 0;
        out->trimImage = SUPPLE_NO_IMAGE;
        if (const auto trim = supple::cage::trimOf(from)) {
            const bool face = trim->domain == supple::cage::TrimDomain::face;
            out->trimDomain = face ? SUPPLE_TRIM_FACE : SUPPLE_TRIM_UV;
            out->trimImage = trim->image;
            out->trimUvSet = trim->uvSet;
            out->trimChannel = trim->channel;
            out->trimCutoff = trim->cutoff;
            out->trimFactor = from.trim ? 1.0f : from.baseColorFactor.a;
            out->trimTiles = trim->tiles;
            out->trimWrap[0] = static_cast<SuppleWrap>(trim->wrapU);
            out->trimWrap[1] = static_cast<SuppleWrap>(trim->wrapV);
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetImageInfo(SuppleContext handle, SuppleAsset asset, uint32_t image, SuppleImageInfo* out) {
    return withAsset(handle, asset, "suppleGetImageInfo", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleImageInfo)) {
            return refuse(context, "suppleGetImageInfo", "out is null or its structSize is wrong");
        }
        if (image >= found.character.images.size()) {
            return refuse(context, "suppleGetImageInfo", "no such image");
        }
        const supple::cage::Image& from = found.character.images[image];
        out->name = from.name.c_str();
        out->mimeType = from.mimeType.c_str();
        out->bytes = from.bytes.empty() ? nullptr : from.bytes.data();
        out->byteCount = from.bytes.size();
        return SUPPLE_OK;
    });
}

SuppleResult suppleFillJointMask(SuppleContext handle, SuppleAsset asset, uint32_t joint, float value, float* mask,
                                 uint32_t jointCount) {
    return withAsset(handle, asset, "suppleFillJointMask", [&](Context& context, const Asset& found) {
        if (mask == nullptr || jointCount != found.character.skin.joints.size()) {
            return refuse(context, "suppleFillJointMask", "mask is null or jointCount is not the skin's");
        }
        if (joint >= jointCount) {
            return refuse(context, "suppleFillJointMask", "no such joint");
        }
        if (!(value >= 0.0f && value <= 1.0f)) {
            return refuse(context, "suppleFillJointMask", "value leaves 0..1");
        }
        supple::skinning::fillJointMask(found.rig, joint, value, {mask, jointCount});
        return SUPPLE_OK;
    });
}

SuppleResult suppleCreateGroup(SuppleContext handle, const SuppleGroupDesc* desc, SuppleGroup* out) {
    return guarded(handle, "suppleCreateGroup", [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, "suppleCreateGroup", "out is null");
        }
        out->id = 0;
        if (desc == nullptr || desc->structSize != sizeof(SuppleGroupDesc)) {
            return refuse(context, "suppleCreateGroup", "desc is null or its structSize is wrong");
        }
        if (desc->instanceCount == 0) {
            return refuse(context, "suppleCreateGroup", "instanceCount is 0");
        }
        if (desc->rate > SUPPLE_MAX_RATE) {
            return refuse(context, "suppleCreateGroup", "rate must be 1..64");
        }
        if (static_cast<uint32_t>(desc->scheme) > SUPPLE_SCHEME_BLEND && desc->scheme != SUPPLE_SCHEME_CAGE) {
            return refuse(context, "suppleCreateGroup", "no such scheme");
        }
        if (static_cast<uint32_t>(desc->vertexFormat) > SUPPLE_VERTEX_24 ||
            static_cast<uint32_t>(desc->tangentMode) > SUPPLE_TANGENTS_PRINTED ||
            static_cast<uint32_t>(desc->cornerRule) > SUPPLE_CORNERS_SMOOTH) {
            return refuse(context, "suppleCreateGroup", "no such vertexFormat, tangentMode or cornerRule");
        }
        if (static_cast<uint32_t>(desc->creaseMode) > SUPPLE_CREASES_CURVE || !(desc->sharpThreshold >= 0.0f)) {
            return refuse(context, "suppleCreateGroup", "no such creaseMode, or sharpThreshold is negative or NaN");
        }
        if (static_cast<uint32_t>(desc->skinning) > SUPPLE_SKINNING_DUAL_QUATERNION) {
            return refuse(context, "suppleCreateGroup", "no such skinning");
        }
        supple::Result<uint64_t> id = context.createGroup(*desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyGroup(SuppleContext handle, SuppleGroup group) {
    return guarded(handle, "suppleDestroyGroup", [&](Context& context) {
        return context.destroyGroup(group.id) ? SUPPLE_OK
                                              : refuse(context, "suppleDestroyGroup", "stale or foreign group handle");
    });
}

SuppleResult suppleSetClipPose(SuppleContext handle, SuppleGroup group, uint32_t instance, uint32_t clip, double time) {
    return withInstance(handle, group, instance, "suppleSetClipPose", [&](Context& context, Group& found) {
        if (clip == SUPPLE_BIND_POSE) {
            found.poses().setBindPose(instance);
            return SUPPLE_OK;
        }
        if (clip == SUPPLE_REST_POSE) {
            found.poses().setRestPose(instance);
            return SUPPLE_OK;
        }
        if (clip >= found.asset().character.clips.size()) {
            return refuse(context, "suppleSetClipPose", "no such clip");
        }
        if (!std::isfinite(time)) {
            return refuse(context, "suppleSetClipPose", "time is not finite");
        }
        found.poses().setClipPose(instance, clip, time);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPose(SuppleContext handle, SuppleGroup group, uint32_t instance, const SupplePoseDesc* pose) {
    return withInstance(handle, group, instance, "suppleSetPose", [&](Context& context, Group& found) {
        const supple::Status valid = supple::runtime::checkPose(found.asset(), pose);
        if (!valid) {
            return refuse(context, "suppleSetPose", valid.error().message.c_str());
        }
        found.poses().setLayers(instance, *pose);
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetRootMotion(SuppleContext handle, SuppleAsset asset, const SupplePoseDesc* pose,
                                 SuppleRootMotion* out) {
    return withAsset(handle, asset, "suppleGetRootMotion", [&](Context& context, const Asset& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleRootMotion)) {
            return refuse(context, "suppleGetRootMotion", "out is null or its structSize is wrong");
        }
        const supple::Status valid = supple::runtime::checkPose(found, pose);
        if (!valid) {
            return refuse(context, "suppleGetRootMotion", valid.error().message.c_str());
        }
        const supple::skinning::RootMotion motion = supple::runtime::rootMotionOf(found, *pose);
        const glm::mat4 transform(supple::skinning::toMatrix(motion));
        for (int axis = 0; axis < 3; ++axis) {
            out->translation[axis] = transform[3][axis];
        }
        out->yaw = static_cast<float>(motion.yaw);
        std::memcpy(out->transform, glm::value_ptr(transform), sizeof(out->transform));
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMorphWeights(SuppleContext handle, SuppleGroup group, uint32_t instance, const float* weights,
                                   uint32_t morphTargetCount) {
    return withInstance(handle, group, instance, "suppleSetMorphWeights", [&](Context& context, Group& found) {
        if (weights != nullptr) {
            if (morphTargetCount != found.asset().character.morphs.targets.size()) {
                return refuse(context, "suppleSetMorphWeights", "morphTargetCount is not the asset's");
            }
            if (!finite(weights, morphTargetCount)) {
                return refuse(context, "suppleSetMorphWeights", "a weight is not finite");
            }
        }
        found.poses().setMorphWeights(instance, weights);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMatrixPose(SuppleContext handle, SuppleGroup group, uint32_t instance, const float* jointMatrices,
                                 uint32_t jointCount) {
    return withInstance(handle, group, instance, "suppleSetMatrixPose", [&](Context& context, Group& found) {
        if (jointMatrices == nullptr || jointCount != found.asset().character.skin.joints.size()) {
            return refuse(context, "suppleSetMatrixPose", "jointMatrices is null or jointCount is not the skin's");
        }
        if (!finite(jointMatrices, 16 * size_t{jointCount})) {
            return refuse(context, "suppleSetMatrixPose", "a joint matrix is not finite");
        }
        found.poses().setMatrixPose(instance, jointMatrices);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetTransform(SuppleContext handle, SuppleGroup group, uint32_t instance, const float* transform) {
    return withInstance(handle, group, instance, "suppleSetTransform", [&](Context& context, Group& found) {
        if (transform == nullptr || !finite(transform, 16)) {
            return refuse(context, "suppleSetTransform", "transform is null or not finite");
        }
        if (transform[3] != 0.0f || transform[7] != 0.0f || transform[11] != 0.0f || transform[15] != 1.0f) {
            return refuse(context, "suppleSetTransform", "the last row is not 0, 0, 0, 1");
        }
        found.poses().setTransform(instance, glm::make_mat4(transform));
        return SUPPLE_OK;
    });
}

SuppleResult suppleBeginFrame(SuppleContext handle, uint64_t frame, uint64_t completedFrame) {
    return guarded(handle, "suppleBeginFrame", [&](Context& context) {
        const supple::Status status = context.beginFrame(frame, completedFrame);
        return status ? SUPPLE_OK : report(context, status.error());
    });
}

SuppleResult suppleRecord(SuppleContext handle, VkCommandBuffer commandBuffer, const SuppleRecordDesc* desc) {
    return guarded(handle, "suppleRecord", [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE) {
            return refuse(context, "suppleRecord", "commandBuffer is null");
        }
        if (desc == nullptr || desc->structSize != sizeof(SuppleRecordDesc)) {
            return refuse(context, "suppleRecord", "desc is null or its structSize is wrong");
        }
        if (desc->groupCount > 0 && desc->groups == nullptr) {
            return refuse(context, "suppleRecord", "groups is null");
        }
        const supple::Status status = context.record(commandBuffer, *desc);
        return status ? SUPPLE_OK : report(context, status.error());
    });
}

SuppleResult suppleGetGroupOutput(SuppleContext handle, SuppleGroup group, SuppleGroupOutput* out) {
    return withGroup(handle, group, "suppleGetGroupOutput", [&](Context& context, Group& found) {
        if (out == nullptr || out->structSize != sizeof(SuppleGroupOutput)) {
            return refuse(context, "suppleGetGroupOutput", "out is null or its structSize is wrong");
        }
        *out = found.output();
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetPatches(SuppleContext handle, SuppleGroup group, SupplePatchInfo* out, uint32_t* count) {
    return withGroup(handle, group, "suppleGetPatches", [&](Context& context, Group& found) {
        if (count == nullptr) {
            return refuse(context, "suppleGetPatches", "count is null");
        }
        const auto& patches = found.tables().patches;
        const auto total = static_cast<uint32_t>(patches.size());
        const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
        for (uint32_t i = 0; i < n; ++i) {
            out[i].face = patches[i].face;
            out[i].patchClass = static_cast<SupplePatchClass>(patches[i].patchClass);
            out[i].cornerCount = patches[i].cornerCount;
            out[i].coefficientCount = supple::surface::coefficientCount(patches[i].patchClass);
            std::copy(patches[i].corners.begin(), patches[i].corners.end(), out[i].corners);
        }
        *count = total;
        return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}

SuppleResult suppleGetTimings(SuppleContext handle, SuppleTiming* out, uint32_t* count) {
    return guarded(handle, "suppleGetTimings", [&](Context& context) {
        if (count == nullptr) {
            return refuse(context, "suppleGetTimings", "count is null");
        }
        const std::vector<SuppleTiming>& latest = context.timings.latest();
        if (latest.empty()) {
            *count = 0;
            return SUPPLE_NOT_READY;
        }
        return fillArray(latest.data(), latest.size(), out, count);
    });
}
