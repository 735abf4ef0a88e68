// The C ABI: checks arguments, turns errors into results and log lines, lets nothing thrown escape.
#include "supple/supple.h"

#include "cage/character_reader.h"
#include "cage/trim.h"
#include "runtime/context.h"
#include "runtime/playback_desc.h"
#include "runtime/pose_desc.h"
#include "runtime/sized.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <glm/gtc/type_ptr.hpp>
#include <new>
#include <optional>

using supple::Error;
using supple::ErrorCode;
using supple::runtime::Asset;
using supple::runtime::Context;
using supple::runtime::Group;
using supple::runtime::View;

struct SuppleContext_T {
    std::unique_ptr<Context> context;
};

namespace {

struct Verdict {
    SuppleResult result;
    SuppleMessage message;
};

Verdict verdictOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::argument:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT};
    case ErrorCode::nullPointer:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER};
    case ErrorCode::structSize:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STRUCT_SIZE};
    case ErrorCode::staleHandle:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STALE_HANDLE};
    case ErrorCode::range:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE};
    case ErrorCode::notFinite:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NOT_FINITE};
    case ErrorCode::order:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_ORDER};
    case ErrorCode::asset:
    case ErrorCode::io:
        return {SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED};
    case ErrorCode::unsupported:
        return {SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_DEVICE_UNSUITED};
    case ErrorCode::disabled:
        return {SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_FEATURE_DISABLED};
    case ErrorCode::limit:
        return {SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT};
    case ErrorCode::hostMemory:
        return {SUPPLE_ERROR_HOST_MEMORY, SUPPLE_MESSAGE_HOST_MEMORY};
    case ErrorCode::deviceMemory:
        return {SUPPLE_ERROR_DEVICE_MEMORY, SUPPLE_MESSAGE_DEVICE_MEMORY};
    case ErrorCode::deviceLost:
        return {SUPPLE_ERROR_DEVICE_LOST, SUPPLE_MESSAGE_DEVICE_LOST};
    case ErrorCode::vulkan:
        return {SUPPLE_ERROR_VULKAN, SUPPLE_MESSAGE_VULKAN};
    }
    return {SUPPLE_ERROR_VULKAN, SUPPLE_MESSAGE_VULKAN};
}

static_assert(SUPPLE_WRAP_REPEAT == static_cast<int>(supple::cage::Wrap::repeat) &&
              SUPPLE_WRAP_CLAMP == static_cast<int>(supple::cage::Wrap::clampToEdge) &&
              SUPPLE_WRAP_MIRROR == static_cast<int>(supple::cage::Wrap::mirroredRepeat));
static_assert(SUPPLE_MAX_TRIM_TILES == supple::cage::kMaxTrimTiles);

SuppleResult report(Context& context, const Error& error) {
    const Verdict verdict = verdictOf(error.code);
    if (verdict.result == SUPPLE_ERROR_DEVICE_LOST) {
        context.setLost();
    }
    context.log(SUPPLE_SEVERITY_ERROR, verdict.message, error.message);
    return verdict.result;
}

SuppleResult refuse(Context& context, ErrorCode code, const char* function, const std::string& reason) {
    return report(context, {code, std::string(function) + ": " + reason});
}

SuppleResult reportStatus(Context& context, const supple::Status& status) {
    return status ? SUPPLE_OK : report(context, status.error());
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
            return refuse(*handle->context, ErrorCode::vulkan, function, e.what());
        } catch (...) {
            return SUPPLE_ERROR_VULKAN;
        }
    }
}

/// For what needs the device.
template <class Body>
SuppleResult onDevice(SuppleContext handle, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        return context.lost() ? refuse(context, ErrorCode::deviceLost, function, "the device is lost") : body(context);
    });
}

template <class Body>
SuppleResult withAsset(SuppleContext handle, SuppleAsset asset, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Asset> found = context.assets.find(asset.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, function, "stale or foreign asset handle");
        }
        return body(context, *found);
    });
}

template <class Body>
SuppleResult withGroup(SuppleContext handle, SuppleGroup group, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Group> found = context.groups.find(group.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, function, "stale or foreign group handle");
        }
        return body(context, *found);
    });
}

template <class Body>
SuppleResult withInstance(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withGroup(handle, instance.group, function, [&](Context& context, Group& found) {
        if (!found.slots().holds(instance.slot, instance.generation)) {
            return refuse(context, ErrorCode::staleHandle, function,
                          "stale or foreign instance handle (slot " + std::to_string(instance.slot) + ")");
        }
        return body(context, found);
    });
}

template <class Body>
SuppleResult withView(SuppleContext handle, SuppleView view, const char* function, Body&& body) noexcept {
    return onDevice(handle, function, [&](Context& context) {
        const std::shared_ptr<View> found = context.views.find(view.id);
        return found == nullptr ? refuse(context, ErrorCode::staleHandle, function, "stale or foreign view handle")
                                : body(context, *found);
    });
}

/// Whether the group's poses come from `source`, or from `other`.
std::optional<SuppleResult> checkSource(Context& context, const char* function, const Group& group,
                                        SupplePoseSource source, SupplePoseSource other) {
    const SupplePoseSource own = group.poseSource();
    if (own == source || own == other) {
        return std::nullopt;
    }
    const char* reason = own == SUPPLE_POSES_SET        ? "the group was created without SUPPLE_POSES_PLAYBACK"
                         : own == SUPPLE_POSES_PLAYBACK ? "the group plays its clips on the device: suppleSetPlayback"
                                                        : "the group takes its poses from a buffer that the host fills";
    return refuse(context, ErrorCode::argument, function, reason);
}

template <class Body>
SuppleResult withPoses(SuppleContext handle, SuppleInstance instance, const char* function, SupplePoseSource source,
                       SupplePoseSource other, Body&& body) noexcept {
    return withInstance(handle, instance, function, [&](Context& context, Group& found) {
        if (const auto fault = checkSource(context, function, found, source, other)) {
            return *fault;
        }
        return body(context, found);
    });
}
/// For what sets the pose of an instance.
template <class Body>
SuppleResult withPose(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withPoses(handle, instance, function, SUPPLE_POSES_SET, SUPPLE_POSES_SET, body);
}
/// For what goes with a pose, whether it is set or played.
template <class Body>
SuppleResult withAnyPose(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withPoses(handle, instance, function, SUPPLE_POSES_SET, SUPPLE_POSES_PLAYBACK, body);
}
/// For what belongs to a group that plays on the device.
template <class Body>
SuppleResult withPlayback(SuppleContext handle, SuppleGroup group, const char* function, Body&& body) noexcept {
    return withGroup(handle, group, function, [&](Context& context, Group& found) {
        if (const auto fault = checkSource(context, function, found, SUPPLE_POSES_PLAYBACK, SUPPLE_POSES_PLAYBACK)) {
            return *fault;
        }
        return body(context, found);
    });
}

/// Takes a description in, of whatever version; null when it is fit to go on with.
template <class T>
std::optional<SuppleResult> takeIn(Context& context, const char* function, const char* name, const T* from, T& to) {
    if (from == nullptr) {
        return refuse(context, ErrorCode::nullPointer, function, std::string(name) + " is null");
    }
    if (!supple::runtime::readSized(*from, to)) {
        return refuse(context, ErrorCode::structSize, function,
                      std::string(name) + "->structSize is " + std::to_string(from->structSize) +
                          ": too small, or a newer version's with fields in use that this library lacks");
    }
    return std::nullopt;
}

/// Whether an out struct can be written.
template <class T>
std::optional<SuppleResult> checkOut(Context& context, const char* function, const T* out) {
    if (out == nullptr) {
        return refuse(context, ErrorCode::nullPointer, function, "out is null");
    }
    if (out->structSize < supple::runtime::kFirstSize<T>) {
        return refuse(context, ErrorCode::structSize, function,
                      "out->structSize is " + std::to_string(out->structSize));
    }
    return std::nullopt;
}

/// What a getter does: the check of out, then fill(T&).
template <class T, class Fill>
SuppleResult describe(Context& context, const char* function, T* out, Fill&& fill) {
    if (const auto fault = checkOut(context, function, out)) {
        return *fault;
    }
    T info{};
    fill(info);
    supple::runtime::writeSized(info, *out);
    return SUPPLE_OK;
}

/// The same for one of `count` parts of an asset.
template <class T, class Fill>
SuppleResult describePart(Context& context, const char* function, const char* part, uint32_t index, size_t count,
                          T* out, Fill&& fill) {
    if (const auto fault = checkOut(context, function, out)) {
        return *fault;
    }
    if (index >= count) {
        return refuse(context, ErrorCode::range, function,
                      std::string(part) + " " + std::to_string(index) + " of " + std::to_string(count));
    }
    return describe(context, function, out, fill);
}

template <class E>
bool within(const E& value, E last) {
    return supple::runtime::rawValue(value) <= static_cast<uint32_t>(last);
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

uint32_t suppleGetVersion(void) {
    return SUPPLE_VERSION;
}

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
        out == nullptr || out->structSize < supple::runtime::kFirstSize<SuppleRequirements>) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        const supple::gpu::Requirements requirements = supple::gpu::requirements();
        SuppleRequirements filled{};
        filled.apiVersion = requirements.apiVersion;
        filled.features12 = requirements.features12;
        filled.features13 = requirements.features13;
        const std::string missing = supple::gpu::missingRequirement(instance, physicalDevice, getInstanceProcAddr);
        std::snprintf(filled.reason, sizeof(filled.reason), "%s", missing.c_str());
        supple::runtime::writeSized(filled, *out);
        return missing.empty() ? SUPPLE_OK : SUPPLE_ERROR_UNSUPPORTED;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

SuppleResult suppleCreateContext(const SuppleContextDesc* given, SuppleContext* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    // Without a description of a known size there is no callback to tell.
    SuppleContextDesc desc{};
    if (given == nullptr || given->structSize < supple::runtime::kFirstSize<SuppleContextDesc>) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        const auto refused = [&](ErrorCode code, const std::string& text) {
            const Verdict verdict = verdictOf(code);
            if (given->log != nullptr) {
                given->log(SUPPLE_SEVERITY_ERROR, verdict.message, text.c_str(), given->logUser);
            }
            return verdict.result;
        };
        const auto refusedHere = [&](ErrorCode code, const char* reason) {
            return refused(code, std::string("suppleCreateContext: ") + reason);
        };
        if (!supple::runtime::readSized(*given, desc)) {
            return refusedHere(ErrorCode::structSize, "desc has fields in use that this library lacks");
        }
        if (out == nullptr || desc.instance == VK_NULL_HANDLE || desc.physicalDevice == VK_NULL_HANDLE ||
            desc.device == VK_NULL_HANDLE || desc.getInstanceProcAddr == nullptr) {
            return refusedHere(ErrorCode::nullPointer,
                               "out, instance, physicalDevice, device or getInstanceProcAddr is null");
        }
        constexpr uint32_t kFlags = SUPPLE_CONTEXT_DEBUG_UTILS | SUPPLE_CONTEXT_ASYNC_COMPUTE;
        if (desc.framesInFlight > SUPPLE_MAX_FRAMES_IN_FLIGHT || !within(desc.mapping, SUPPLE_MAPPING_WIDE) ||
            (desc.flags & ~kFlags) != 0) {
            return refusedHere(
                ErrorCode::range,
                "framesInFlight must be 0..4, mapping one of SuppleMapping, flags of SuppleContextFlags");
        }
        if (desc.memory != nullptr && (desc.memory->allocate == nullptr || desc.memory->free == nullptr)) {
            return refusedHere(ErrorCode::nullPointer, "memory->allocate or memory->free is null");
        }
        supple::Result<std::unique_ptr<Context>> context = Context::create(desc);
        if (!context) {
            return refused(context.error().code, context.error().message);
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

namespace {

/// A file in memory or arrays, as a character.
supple::Result<supple::cage::Character> characterOf(const SuppleAssetDesc& desc) {
    const std::string name = desc.name != nullptr ? desc.name : "asset";
    if (desc.cage != nullptr) {
        SuppleCageDesc cage{};
        if (!supple::runtime::readSized(*desc.cage, cage)) {
            return Error{ErrorCode::structSize, "suppleCreateAsset: cage->structSize is wrong"};
        }
        return supple::runtime::characterFromArrays(cage, name);
    }
    supple::cage::GltfOptions options;
    options.pairQuads = (desc.flags & SUPPLE_ASSET_PAIR_QUADS) != 0;
    if (desc.files != nullptr) {
        options.readFile = [files = *desc.files](const std::string& path) { return readThrough(files, path); };
    }
    return supple::cage::readCharacter({static_cast<const std::byte*>(desc.bytes), desc.byteCount}, name,
                                       desc.baseDirectory != nullptr ? desc.baseDirectory : "", options);
}

} // namespace

SuppleResult suppleCreateAsset(SuppleContext handle, const SuppleAssetDesc* given, SuppleAsset* out) {
    constexpr const char* kHere = "suppleCreateAsset";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleAssetDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if ((desc.bytes == nullptr) == (desc.cage == nullptr)) {
            return refuse(context, ErrorCode::argument, kHere,
                          std::string(desc.name != nullptr ? desc.name : "asset") +
                              (desc.bytes == nullptr ? ": neither bytes nor cage" : ": both bytes and cage"));
        }
        if ((desc.flags & ~uint32_t{SUPPLE_ASSET_PAIR_QUADS}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (desc.files != nullptr && desc.files->read == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "files->read is null");
        }
        supple::Result<supple::cage::Character> character = characterOf(desc);
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
            return refuse(context, ErrorCode::staleHandle, "suppleDestroyAsset", "stale or foreign asset handle");
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetAssetInfo(SuppleContext handle, SuppleAsset asset, SuppleAssetInfo* out) {
    return withAsset(handle, asset, "suppleGetAssetInfo", [&](Context& context, const Asset& found) {
        return describe(context, "suppleGetAssetInfo", out, [&](SuppleAssetInfo& info) {
            const supple::cage::Character& character = found.character;
            info.cageVertexCount = character.cage.vertexCount();
            info.faceCount = character.cage.faceCount();
            info.jointCount = static_cast<uint32_t>(character.skin.joints.size());
            info.clipCount = static_cast<uint32_t>(character.clips.size());
            info.materialCount = static_cast<uint32_t>(character.materials.size());
            info.morphTargetCount = static_cast<uint32_t>(character.morphs.targets.size());
            info.imageCount = static_cast<uint32_t>(character.images.size());
            glm::vec3 low = character.cage.positions.front(), high = low;
            for (const glm::vec3& p : character.cage.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            for (int axis = 0; axis < 3; ++axis) {
                info.boundsMin[axis] = low[axis];
                info.boundsMax[axis] = high[axis];
            }
        });
    });
}

SuppleResult suppleGetClipInfo(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out) {
    return withAsset(handle, asset, "suppleGetClipInfo", [&](Context& context, const Asset& found) {
        const auto& clips = found.character.clips;
        return describePart(context, "suppleGetClipInfo", "clip", clip, clips.size(), out, [&](SuppleClipInfo& info) {
            info.name = clips[clip].name.c_str();
            info.duration = clips[clip].duration;
        });
    });
}

SuppleResult suppleGetJointInfo(SuppleContext handle, SuppleAsset asset, uint32_t joint, SuppleJointInfo* out) {
    return withAsset(handle, asset, "suppleGetJointInfo", [&](Context& context, const Asset& found) {
        const auto& joints = found.character.skin.joints;
        return describePart(context, "suppleGetJointInfo", "joint", joint, joints.size(), out,
                            [&](SuppleJointInfo& info) {
                                info.name = found.character.skeleton.nodes[joints[joint]].name.c_str();
                                info.parent = found.rig.jointParents[joint];
                            });
    });
}

SuppleResult suppleGetMorphTargetInfo(SuppleContext handle, SuppleAsset asset, uint32_t target,
                                      SuppleMorphTargetInfo* out) {
    return withAsset(handle, asset, "suppleGetMorphTargetInfo", [&](Context& context, const Asset& found) {
        const supple::cage::Morphs& morphs = found.character.morphs;
        return describePart(context, "suppleGetMorphTargetInfo", "morph target", target, morphs.targets.size(), out,
                            [&](SuppleMorphTargetInfo& info) {
                                info.name = morphs.targets[target].name.c_str();
                                info.weight = morphs.weights[target];
                                info.vertexCount = static_cast<uint32_t>(morphs.targets[target].vertices.size());
                            });
    });
}

SuppleResult suppleGetMaterialInfo(SuppleContext handle, SuppleAsset asset, uint32_t material,
                                   SuppleMaterialInfo* out) {
    return withAsset(handle, asset, "suppleGetMaterialInfo", [&](Context& context, const Asset& found) {
        const auto& materials = found.character.materials;
        return describePart(context, "suppleGetMaterialInfo", "material", material, materials.size(), out,
                            [&](SuppleMaterialInfo& info) {
                                const supple::cage::Material& from = materials[material];
                                info.name = from.name.c_str();
                                info.doubleSided = from.doubleSided ? 1 : 0;
                                info.trimImage = SUPPLE_NO_IMAGE;
                                if (const auto trim = supple::cage::trimOf(from)) {
                                    const bool face = trim->domain == supple::cage::TrimDomain::face;
                                    info.trimDomain = face ? SUPPLE_TRIM_FACE : SUPPLE_TRIM_UV;
                                    info.trimImage = trim->image;
                                    info.trimUvSet = trim->uvSet;
                                    info.trimChannel = trim->channel;
                                    info.trimCutoff = trim->cutoff;
                                    info.trimFactor = from.trim ? 1.0f : from.baseColorFactor.a;
                                    info.trimTiles = trim->tiles;
                                    info.trimWrap[0] = static_cast<SuppleWrap>(trim->wrapU);
                                    info.trimWrap[1] = static_cast<SuppleWrap>(trim->wrapV);
                                }
                            });
    });
}

SuppleResult suppleGetImageInfo(SuppleContext handle, SuppleAsset asset, uint32_t image, SuppleImageInfo* out) {
    return withAsset(handle, asset, "suppleGetImageInfo", [&](Context& context, const Asset& found) {
        const auto& images = found.character.images;
        return describePart(context, "suppleGetImageInfo", "image", image, images.size(), out,
                            [&](SuppleImageInfo& info) {
                                const supple::cage::Image& from = images[image];
                                info.name = from.name.c_str();
                                info.mimeType = from.mimeType.c_str();
                                info.bytes = from.bytes.empty() ? nullptr : from.bytes.data();
                                info.byteCount = from.bytes.size();
                            });
    });
}

SuppleResult suppleFillJointMask(SuppleContext handle, SuppleAsset asset, uint32_t joint, float value, float* mask,
                                 uint32_t jointCount) {
    constexpr const char* kHere = "suppleFillJointMask";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (mask == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "mask is null");
        }
        const size_t joints = found.character.skin.joints.size();
        if (jointCount != joints || joint >= jointCount) {
            return refuse(context, ErrorCode::range, kHere,
                          "joint " + std::to_string(joint) + ", jointCount " + std::to_string(jointCount) +
                              ": the skin has " + std::to_string(joints));
        }
        if (!(value >= 0.0f && value <= 1.0f)) {
            return refuse(context, ErrorCode::range, kHere, "value leaves 0..1");
        }
        supple::skinning::fillJointMask(found.rig, joint, value, {mask, jointCount});
        return SUPPLE_OK;
    });
}

SuppleResult suppleCreateView(SuppleContext handle, const SuppleViewDesc* given, SuppleView* out) {
    constexpr const char* kHere = "suppleCreateView";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleViewDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        constexpr uint32_t kFlags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_UVS1 |
                                    SUPPLE_VIEW_FACE_UVS | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION |
                                    SUPPLE_VIEW_BACK_FACES;
        if ((desc.flags & ~kFlags) != 0 || !within(desc.vertexFormat, SUPPLE_VERTEX_24)) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags, or no such vertexFormat");
        }
        if ((desc.flags & (SUPPLE_VIEW_UVS1 | SUPPLE_VIEW_FACE_UVS)) != 0 &&
            (desc.flags & SUPPLE_VIEW_ATTRIBUTES) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "UVS1 and FACE_UVS go with ATTRIBUTES");
        }
        if ((desc.flags & SUPPLE_VIEW_OCCLUSION) != 0 && (desc.flags & SUPPLE_VIEW_CULL) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "OCCLUSION goes with CULL");
        }
        if (desc.maxVertices < 1024) {
            return refuse(context, ErrorCode::range, kHere, "maxVertices is below 1024");
        }
        if (!std::all_of(std::begin(desc.elasticities), std::end(desc.elasticities),
                         [](float e) { return e >= 0.0f && e <= 1.0f; })) {
            return refuse(context, ErrorCode::range, kHere, "an elasticity leaves 0..1");
        }
        supple::Result<uint64_t> id = context.createView(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyView(SuppleContext handle, SuppleView view) {
    return guarded(handle, "suppleDestroyView", [&](Context& context) {
        return context.destroyView(view.id)
                   ? SUPPLE_OK
                   : refuse(context, ErrorCode::staleHandle, "suppleDestroyView", "stale or foreign view handle");
    });
}

SuppleResult suppleSetCamera(SuppleContext handle, SuppleView view, const SuppleCameraDesc* given) {
    constexpr const char* kHere = "suppleSetCamera";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        SuppleCameraDesc camera{};
        if (const auto fault = takeIn(context, kHere, "camera", given, camera)) {
            return *fault;
        }
        if ((camera.flags & ~uint32_t{SUPPLE_CAMERA_ORTHOGRAPHIC}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        const float values[] = {camera.position[0], camera.position[1],   camera.position[2],  camera.pixelsPerUnit,
                                camera.nearest,     camera.chordError,    camera.smallestEdge, camera.edgeLength,
                                camera.farthest,    camera.smallestRadius};
        if (!finite(values, std::size(values)) || !finite(camera.viewProjection, 16) || !finite(camera.direction, 3)) {
            return refuse(context, ErrorCode::notFinite, kHere, "the camera is not finite");
        }
        if (camera.pixelsPerUnit <= 0.0f ||
            std::any_of(std::begin(values) + 4, std::end(values), [](float x) { return x < 0.0f; })) {
            return refuse(context, ErrorCode::range, kHere,
                          "pixelsPerUnit must be positive; all other lengths not negative");
        }
        const bool needsDirection =
            (camera.flags & SUPPLE_CAMERA_ORTHOGRAPHIC) != 0 && (found.desc().flags & SUPPLE_VIEW_BACK_FACES) != 0;
        if (needsDirection &&
            std::all_of(std::begin(camera.direction), std::end(camera.direction), [](float x) { return x == 0.0f; })) {
            return refuse(context, ErrorCode::range, kHere,
                          "the view has BACK_FACES and the camera is orthographic: direction is zero");
        }
        found.setCamera(camera);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetDepthPyramid(SuppleContext handle, SuppleView view, const SuppleDepthPyramidDesc* given) {
    constexpr const char* kHere = "suppleSetDepthPyramid";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        if ((found.desc().flags & SUPPLE_VIEW_OCCLUSION) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "the view was created without SUPPLE_VIEW_OCCLUSION");
        }
        if (given == nullptr) {
            found.setDepthPyramid(std::nullopt);
            return SUPPLE_OK;
        }
        SuppleDepthPyramidDesc pyramid{};
        if (const auto fault = takeIn(context, kHere, "pyramid", given, pyramid)) {
            return *fault;
        }
        if ((pyramid.flags & ~uint32_t{SUPPLE_DEPTH_REVERSED}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (pyramid.view == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, kHere, "view is null");
        }
        if (pyramid.layout != VK_IMAGE_LAYOUT_GENERAL && pyramid.layout != VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL &&
            pyramid.layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
            return refuse(context, ErrorCode::range, kHere,
                          "layout is not GENERAL, SHADER_READ_ONLY_OPTIMAL or READ_ONLY_OPTIMAL");
        }
        const uint32_t side = std::max(pyramid.width, pyramid.height), limit = context.maxImageSide();
        if (pyramid.width == 0 || pyramid.height == 0 || side > limit) {
            return refuse(context, ErrorCode::range, kHere,
                          "width and height must be 1.." + std::to_string(limit) + ", as the device's images");
        }
        const auto most = static_cast<uint32_t>(std::bit_width(side));
        if (pyramid.levels == 0 || pyramid.levels > most) {
            return refuse(context, ErrorCode::range, kHere,
                          "levels must be 1.." + std::to_string(most) + " for " + std::to_string(pyramid.width) +
                              " x " + std::to_string(pyramid.height));
        }
        if (!finite(pyramid.viewProjection, 16)) {
            return refuse(context, ErrorCode::notFinite, kHere, "viewProjection is not finite");
        }
        found.setDepthPyramid(pyramid);
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetViewStatistics(SuppleContext handle, SuppleView view, SuppleViewStatistics* out) {
    constexpr const char* kHere = "suppleGetViewStatistics";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        if (const auto fault = checkOut(context, kHere, out)) {
            return *fault;
        }
        SuppleViewStatistics statistics = found.statistics();
        statistics.structSize = sizeof(statistics);
        supple::runtime::writeSized(statistics, *out);
        return statistics.frame > 0 ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}

SuppleResult suppleCreateGroup(SuppleContext handle, const SuppleGroupDesc* given, SuppleGroup* out) {
    constexpr const char* kHere = "suppleCreateGroup";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleGroupDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if (desc.capacity == 0) {
            return refuse(context, ErrorCode::range, kHere, "capacity is 0");
        }
        if (desc.rate > SUPPLE_MAX_RATE) {
            return refuse(context, ErrorCode::range, kHere, "rate must be 1..64");
        }
        if (!within(desc.scheme, SUPPLE_SCHEME_BLEND) && supple::runtime::rawValue(desc.scheme) != SUPPLE_SCHEME_CAGE) {
            return refuse(context, ErrorCode::range, kHere, "no such scheme");
        }
        constexpr uint32_t kFlags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_MOTION |
                                    SUPPLE_GROUP_SHARED_SAMPLES | SUPPLE_GROUP_ONE_LEVEL;
        if ((desc.flags & ~kFlags) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (!within(desc.vertexFormat, SUPPLE_VERTEX_24) || !within(desc.tangentMode, SUPPLE_TANGENTS_PRINTED) ||
            !within(desc.cornerRule, SUPPLE_CORNERS_SMOOTH) || !within(desc.creaseMode, SUPPLE_CREASES_CURVE) ||
            !within(desc.skinning, SUPPLE_SKINNING_DUAL_QUATERNION) ||
            !within(desc.poseSource, SUPPLE_POSES_PLAYBACK)) {
            return refuse(context, ErrorCode::range, kHere,
                          "no such vertexFormat, tangentMode, cornerRule, creaseMode, skinning or poseSource");
        }
        if (std::isnan(desc.sharpThreshold)) {
            return refuse(context, ErrorCode::notFinite, kHere, "sharpThreshold is NaN");
        }
        if (desc.sharpThreshold < 0.0f) {
            return refuse(context, ErrorCode::range, kHere, "sharpThreshold is negative");
        }
        if (desc.poseSource == SUPPLE_POSES_PALETTE_BUFFER && desc.skinning != SUPPLE_SKINNING_LINEAR) {
            return refuse(context, ErrorCode::argument, kHere, "a palette buffer goes with linear skinning only");
        }
        if (desc.view.id != 0 && (desc.flags & ~uint32_t{SUPPLE_GROUP_ONE_LEVEL}) != 0) {
            return refuse(context, ErrorCode::argument, kHere, "a group of a view has the view's flags");
        }
        if ((desc.flags & SUPPLE_GROUP_SHARED_SAMPLES) != 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
            return refuse(context, ErrorCode::argument, kHere, "a cage has no samples to share");
        }
        if (desc.view.id == 0 && (desc.flags & SUPPLE_GROUP_ONE_LEVEL) != 0) {
            return refuse(context, ErrorCode::argument, kHere, "SUPPLE_GROUP_ONE_LEVEL without a view");
        }
        if (desc.view.id != 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
            return refuse(context, ErrorCode::argument, kHere, "a cage has no levels of detail");
        }
        supple::Result<uint64_t> id = context.createGroup(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyGroup(SuppleContext handle, SuppleGroup group) {
    return guarded(handle, "suppleDestroyGroup", [&](Context& context) {
        return context.destroyGroup(group.id)
                   ? SUPPLE_OK
                   : refuse(context, ErrorCode::staleHandle, "suppleDestroyGroup", "stale or foreign group handle");
    });
}

SuppleResult suppleSetRate(SuppleContext handle, SuppleGroup group, uint32_t rate) {
    return withGroup(handle, group, "suppleSetRate",
                     [&](Context& context, Group& found) { return reportStatus(context, found.setRate(rate)); });
}

SuppleResult suppleCreateInstance(SuppleContext handle, SuppleGroup group, SuppleInstance* out) {
    constexpr const char* kHere = "suppleCreateInstance";
    return withGroup(handle, group, kHere, [&](Context& context, Group& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        *out = {};
        const std::optional<uint32_t> slot = found.slots().create();
        if (!slot) {
            return refuse(context, ErrorCode::limit, kHere,
                          "the group is full: its capacity is " + std::to_string(found.slots().capacity()));
        }
        if (found.poseSource() == SUPPLE_POSES_SET) {
            found.poses().reset(*slot);
        } else if (found.plays()) {
            found.playback().reset(*slot);
        }
        *out = {group, *slot, found.slots().generation(*slot)};
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyInstance(SuppleContext handle, SuppleInstance instance) {
    return withInstance(handle, instance, "suppleDestroyInstance", [&](Context&, Group& found) {
        found.slots().destroy(instance.slot);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetVisible(SuppleContext handle, SuppleInstance instance, uint32_t visible) {
    return withInstance(handle, instance, "suppleSetVisible", [&](Context& context, Group& found) {
        if (visible > 1) {
            return refuse(context, ErrorCode::range, "suppleSetVisible", "visible must be 0 or 1");
        }
        found.slots().setVisible(instance.slot, visible == 1);
        return SUPPLE_OK;
    });
}

SuppleResult suppleTeleport(SuppleContext handle, SuppleInstance instance) {
    return withInstance(handle, instance, "suppleTeleport", [&](Context&, Group& found) {
        found.slots().forget(instance.slot);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPriority(SuppleContext handle, SuppleInstance instance, uint32_t priority) {
    constexpr const char* kHere = "suppleSetPriority";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        if (found.view() == nullptr) {
            return refuse(context, ErrorCode::argument, kHere, "the group belongs to no view");
        }
        if (priority >= SUPPLE_PRIORITY_COUNT) {
            return refuse(context, ErrorCode::range, kHere,
                          "priority " + std::to_string(priority) + " of " + std::to_string(SUPPLE_PRIORITY_COUNT));
        }
        found.slots().setPriority(instance.slot, priority);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetClipPose(SuppleContext handle, SuppleInstance instance, uint32_t clip, double time) {
    constexpr const char* kHere = "suppleSetClipPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (clip == SUPPLE_BIND_POSE) {
            found.poses().setBindPose(instance.slot);
            return SUPPLE_OK;
        }
        if (clip == SUPPLE_REST_POSE) {
            found.poses().setRestPose(instance.slot);
            return SUPPLE_OK;
        }
        const size_t clips = found.asset().character.clips.size();
        if (clip >= clips) {
            return refuse(context, ErrorCode::range, kHere,
                          "clip " + std::to_string(clip) + " of " + std::to_string(clips));
        }
        if (!std::isfinite(time)) {
            return refuse(context, ErrorCode::notFinite, kHere, "time is not finite");
        }
        found.poses().setClipPose(instance.slot, clip, time);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPose(SuppleContext handle, SuppleInstance instance, const SupplePoseDesc* given) {
    constexpr const char* kHere = "suppleSetPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        SupplePoseDesc pose{};
        if (const auto fault = takeIn(context, kHere, "pose", given, pose)) {
            return *fault;
        }
        const supple::Status valid = supple::runtime::checkPose(found.asset(), pose);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        found.poses().setLayers(instance.slot, pose);
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetRootMotion(SuppleContext handle, SuppleAsset asset, const SupplePoseDesc* given,
                                 SuppleRootMotion* out) {
    constexpr const char* kHere = "suppleGetRootMotion";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (const auto fault = checkOut(context, kHere, out)) {
            return *fault;
        }
        SupplePoseDesc pose{};
        if (const auto fault = takeIn(context, kHere, "pose", given, pose)) {
            return *fault;
        }
        const supple::Status valid = supple::runtime::checkPose(found, pose);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        const supple::skinning::RootMotion motion = supple::runtime::rootMotionOf(found, pose);
        const glm::mat4 transform(supple::skinning::toMatrix(motion));
        SuppleRootMotion filled{};
        for (int axis = 0; axis < 3; ++axis) {
            filled.translation[axis] = transform[3][axis];
        }
        filled.yaw = static_cast<float>(motion.yaw);
        std::memcpy(filled.transform, glm::value_ptr(transform), sizeof(filled.transform));
        supple::runtime::writeSized(filled, *out);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMorphWeights(SuppleContext handle, SuppleInstance instance, const float* weights,
                                   uint32_t morphTargetCount) {
    constexpr const char* kHere = "suppleSetMorphWeights";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (weights != nullptr) {
            const size_t targets = found.asset().character.morphs.targets.size();
            if (morphTargetCount != targets) {
                return refuse(context, ErrorCode::range, kHere,
                              "morphTargetCount " + std::to_string(morphTargetCount) + ": the asset has " +
                                  std::to_string(targets));
            }
            if (!finite(weights, morphTargetCount)) {
                return refuse(context, ErrorCode::notFinite, kHere, "a weight is not finite");
            }
        }
        if (found.plays()) {
            found.playback().setMorphWeights(instance.slot, weights);
        } else {
            found.poses().setMorphWeights(instance.slot, weights);
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMatrixPose(SuppleContext handle, SuppleInstance instance, const float* jointMatrices,
                                 uint32_t jointCount) {
    constexpr const char* kHere = "suppleSetMatrixPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (jointMatrices == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "jointMatrices is null");
        }
        const size_t joints = found.asset().character.skin.joints.size();
        if (jointCount != joints) {
            return refuse(context, ErrorCode::range, kHere,
                          "jointCount " + std::to_string(jointCount) + ": the skin has " + std::to_string(joints));
        }
        if (!finite(jointMatrices, 16 * size_t{jointCount})) {
            return refuse(context, ErrorCode::notFinite, kHere, "a joint matrix is not finite");
        }
        found.poses().setMatrixPose(instance.slot, jointMatrices);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetTransform(SuppleContext handle, SuppleInstance instance, const float* transform) {
    constexpr const char* kHere = "suppleSetTransform";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (transform == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "transform is null");
        }
        if (!finite(transform, 16)) {
            return refuse(context, ErrorCode::notFinite, kHere, "transform is not finite");
        }
        if (transform[3] != 0.0f || transform[7] != 0.0f || transform[11] != 0.0f || transform[15] != 1.0f) {
            return refuse(context, ErrorCode::range, kHere, "the last row is not 0, 0, 0, 1");
        }
        if (found.plays()) {
            found.playback().setTransform(instance.slot, glm::make_mat4(transform));
        } else {
            found.poses().setTransform(instance.slot, glm::make_mat4(transform));
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPlayback(SuppleContext handle, SuppleInstance instance, const SupplePlaybackDesc* given) {
    constexpr const char* kHere = "suppleSetPlayback";
    return withPoses(
        handle, instance, kHere, SUPPLE_POSES_PLAYBACK, SUPPLE_POSES_PLAYBACK, [&](Context& context, Group& found) {
            SupplePlaybackDesc desc{};
            if (const auto fault = takeIn(context, kHere, "playback", given, desc)) {
                return *fault;
            }
            const supple::Status valid = supple::runtime::checkPlayback(found.asset(), found.playback(), desc);
            if (!valid) {
                return refuse(context, valid.error().code, kHere, valid.error().message);
            }
            supple::runtime::PlaybackLayers layers;
            found.playback().set(instance.slot, supple::runtime::playbackOf(found.asset(), desc, layers));
            return SUPPLE_OK;
        });
}

SuppleResult suppleSetTime(SuppleContext handle, SuppleGroup group, double seconds) {
    constexpr const char* kHere = "suppleSetTime";
    return withPlayback(handle, group, kHere, [&](Context& context, Group& found) {
        const supple::Status valid = supple::runtime::checkTime(seconds);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        found.playback().setTime(seconds);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMask(SuppleContext handle, SuppleGroup group, const SuppleMaskDesc* given) {
    constexpr const char* kHere = "suppleSetMask";
    return withPlayback(handle, group, kHere, [&](Context& context, Group& found) {
        SuppleMaskDesc desc{};
        if (const auto fault = takeIn(context, kHere, "mask", given, desc)) {
            return *fault;
        }
        const supple::Status valid = supple::runtime::checkMask(found.asset(), desc);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        found.playback().setMask(desc.mask, {desc.jointMask, desc.jointMaskCount},
                                 {desc.morphMask, desc.morphMaskCount});
        return SUPPLE_OK;
    });
}

SuppleResult suppleBeginFrame(SuppleContext handle, uint64_t frame, uint64_t completedFrame) {
    return onDevice(handle, "suppleBeginFrame",
                    [&](Context& context) { return reportStatus(context, context.beginFrame(frame, completedFrame)); });
}

SuppleResult suppleCancelFrame(SuppleContext handle) {
    return guarded(handle, "suppleCancelFrame",
                   [&](Context& context) { return reportStatus(context, context.cancelFrame()); });
}

SuppleResult suppleRecordUploads(SuppleContext handle, VkCommandBuffer commandBuffer) {
    return onDevice(handle, "suppleRecordUploads", [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, "suppleRecordUploads", "commandBuffer is null");
        }
        return reportStatus(context, context.recordUploads(commandBuffer));
    });
}

SuppleResult suppleRecord(SuppleContext handle, VkCommandBuffer commandBuffer, const SuppleRecordDesc* given) {
    constexpr const char* kHere = "suppleRecord";
    return onDevice(handle, kHere, [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, kHere, "commandBuffer is null");
        }
        SuppleRecordDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if (desc.groupCount > 0 && desc.groups == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "groups is null");
        }
        if ((desc.flags & ~uint32_t{SUPPLE_RECORD_TIMINGS | SUPPLE_RECORD_NO_ENTRY_BARRIER}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        return reportStatus(context, context.record(commandBuffer, desc));
    });
}

SuppleResult suppleGetRecordScopes(SuppleSyncScope* first, SuppleSyncScope* last) {
    if (first != nullptr) {
        *first = Context::firstScope();
    }
    if (last != nullptr) {
        *last = Context::lastScope();
    }
    return SUPPLE_OK;
}

SuppleResult suppleGetAcquireBarriers(SuppleContext handle, const SuppleGroup* groups, uint32_t groupCount,
                                      SuppleSyncScope use, VkBufferMemoryBarrier2* out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetAcquireBarriers";
    return guarded(handle, kHere, [&](Context& context) {
        if (count == nullptr || (groups == nullptr && groupCount > 0)) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count or groups is null");
        }
        const uint32_t room = out == nullptr ? 0 : *count;
        const supple::Result<uint32_t> total = context.acquireBarriers({groups, groupCount}, use, {out, room});
        if (!total) {
            return report(context, total.error());
        }
        *count = *total;
        return out != nullptr && room < *total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}

SuppleResult suppleGetGroupOutput(SuppleContext handle, SuppleGroup group, SuppleGroupOutput* out) {
    return withGroup(handle, group, "suppleGetGroupOutput", [&](Context& context, Group& found) {
        return describe(context, "suppleGetGroupOutput", out,
                        [&](SuppleGroupOutput& output) { output = found.output(); });
    });
}

SuppleResult suppleGetPatches(SuppleContext handle, SuppleGroup group, SupplePatchInfo* out, uint32_t* count) {
    return withGroup(handle, group, "suppleGetPatches", [&](Context& context, Group& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, "suppleGetPatches", "count is null");
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
            return refuse(context, ErrorCode::nullPointer, "suppleGetTimings", "count is null");
        }
        const std::vector<SuppleTiming>& latest = context.timings.latest();
        if (latest.empty()) {
            *count = 0;
            return SUPPLE_NOT_READY;
        }
        return fillArray(latest.data(), latest.size(), out, count);
    });
}

SuppleResult suppleSetBudget(SuppleContext handle, const char* pass, double nanoseconds) {
    return guarded(handle, "suppleSetBudget", [&](Context& context) {
        if (!std::isfinite(nanoseconds)) {
            return refuse(context, ErrorCode::notFinite, "suppleSetBudget", "nanoseconds is not finite");
        }
        if (nanoseconds < 0.0) {
            return refuse(context, ErrorCode::range, "suppleSetBudget", "nanoseconds is negative");
        }
        return context.timings.setBudget(pass, nanoseconds)
                   ? SUPPLE_OK
                   : refuse(context, ErrorCode::range, "suppleSetBudget", std::string("no pass ") + pass);
    });
}

SuppleResult suppleGetBudget(SuppleContext handle, const char* pass, SuppleBudget* out) {
    return guarded(handle, "suppleGetBudget", [&](Context& context) {
        if (const auto fault = checkOut(context, "suppleGetBudget", out)) {
            return *fault;
        }
        const SuppleBudget* budget = context.timings.budget(pass);
        if (budget == nullptr) {
            return refuse(context, ErrorCode::range, "suppleGetBudget", std::string("no pass ") + pass);
        }
        supple::runtime::writeSized(*budget, *out);
        return budget->limit > 0.0 ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}
