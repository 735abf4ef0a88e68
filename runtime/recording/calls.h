// The calls that change a context, as a recording has them: a struct each, with the arguments that another context
// needs to do the same. Getters are not among them, nor what a host answers when it is asked (memory, jobs, files).
#pragma once

#include "runtime/recording/call_archive.h"
#include "supple/supple_playback.h"
#include "supple/supple_queries.h"
#include "supple/supple_view.h"

#include <array>
#include <cstdint>
#include <variant>

namespace supple::runtime {

template <class T, class Struct>
concept CallStruct = std::same_as<std::remove_const_t<T>, Struct>;

namespace calls {

/// Which asset a call loads: the XXH3-128 of its character's bytes (cooked/file.h).
struct AssetHash {
    uint64_t low = 0, high = 0;
    bool operator==(const AssetHash&) const = default;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.low, c.high);
    }
};

struct CreateAsset {
    SuppleAsset asset{};
    AssetHash hash;
    uint64_t clipPoolBytes = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.asset, c.hash);
        a.later(c.clipPoolBytes);
    }
};
struct ReloadAsset {
    SuppleAsset asset{};
    AssetHash hash;
    uint64_t clipPoolBytes = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.asset, c.hash);
        a.later(c.clipPoolBytes);
    }
};
struct DestroyAsset {
    SuppleAsset asset{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.asset);
    }
};
struct CreateView {
    SuppleView view{};
    SuppleViewDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.view, c.desc);
    }
};
struct DestroyView {
    SuppleView view{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.view);
    }
};
struct CreateGroup {
    SuppleGroup group{};
    SuppleGroupDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.desc);
    }
};
struct DestroyGroup {
    SuppleGroup group{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group);
    }
};
struct SetCapacity {
    SuppleGroup group{};
    uint32_t capacity = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.capacity);
    }
};
struct SetRate {
    SuppleGroup group{};
    uint32_t rate = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.rate);
    }
};
struct CreateInstance {
    SuppleInstance instance{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance);
    }
};
struct DestroyInstance {
    SuppleInstance instance{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance);
    }
};
struct SetVisible {
    SuppleInstance instance{};
    uint32_t visible = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.visible);
    }
};
struct SetPartVisible {
    SuppleInstance instance{};
    uint32_t part = 0, visible = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.part, c.visible);
    }
};
struct Teleport {
    SuppleInstance instance{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance);
    }
};
struct SetTransform {
    SuppleInstance instance{};
    float transform[16] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.transform);
    }
};
struct SetPosition {
    SuppleInstance instance{};
    double position[3] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.position);
    }
};
struct SetUserData {
    SuppleInstance instance{};
    float data[4] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.data);
    }
};
struct SetSharpness {
    SuppleInstance instance{};
    uint32_t set = 0;
    float sharpness = 0.0f;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.set, c.sharpness);
    }
};
struct SetPriority {
    SuppleInstance instance{};
    uint32_t priority = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.priority);
    }
};
struct SetClipPose {
    SuppleInstance instance{};
    uint32_t clip = 0;
    double time = 0.0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.clip, c.time);
    }
};
struct SetMatrixPose {
    SuppleInstance instance{};
    const float* matrices = nullptr; ///< 16 each
    uint32_t numberCount = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance);
        a.list(c.matrices, c.numberCount);
    }
};
struct SetMorphWeights {
    SuppleInstance instance{};
    const float* weights = nullptr;
    uint32_t weightCount = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance);
        a.list(c.weights, c.weightCount);
    }
};
struct SetJointMatrices {
    SuppleInstance instance{};
    SuppleJointMatricesDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.desc);
    }
};
struct SetPose {
    SuppleInstance instance{};
    SupplePoseDesc pose{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.pose);
    }
};
struct SetPlayback {
    SuppleInstance instance{};
    SupplePlaybackDesc playback{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.playback);
    }
};
struct SetTime {
    SuppleGroup group{};
    double seconds = 0.0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.seconds);
    }
};
struct SetMask {
    SuppleGroup group{};
    SuppleMaskDesc mask{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.mask);
    }
};
struct SetModifiers {
    SuppleInstance instance{};
    SuppleModifiersDesc modifiers{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.modifiers);
    }
};
struct SetModifierTarget {
    SuppleInstance instance{};
    uint32_t index = 0;
    SuppleModifierTarget target{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.instance, c.index, c.target);
    }
};
struct SetCamera {
    SuppleView view{};
    SuppleCameraDesc camera{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.view, c.camera);
    }
};
/// The picture is the host's, so a recording lacks it.
struct SetDepthPyramid {
    SuppleView view{};
    uint32_t isThere = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.view, c.isThere);
    }
};
struct SetOrigin {
    double origin[3] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.origin);
    }
};
struct SetUploadBudget {
    uint64_t bytesPerFrame = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.bytesPerFrame);
    }
};
struct BeginFrame {
    uint64_t frame = 0, completedFrame = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.frame, c.completedFrame);
    }
};
struct CancelFrame {
    uint32_t reserved = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.reserved);
    }
};
struct RecordUploads {
    uint32_t reserved = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.reserved);
    }
};
struct RecordWarmUp {
    const SuppleGroup* groups = nullptr;
    uint32_t groupCount = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a.list(c.groups, c.groupCount);
    }
};
struct Record {
    const SuppleGroup* groups = nullptr;
    uint32_t groupCount = 0;
    double time = 0.0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.time);
        a.list(c.groups, c.groupCount);
    }
};
struct RequestClip {
    SuppleAsset asset{};
    uint32_t clip = 0;
    SuppleClipRequest request{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.asset, c.clip, c.request);
    }
};
struct CreatePointSet {
    SupplePointSet set{};
    SupplePointSetDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.set, c.desc);
    }
};
struct DestroyPointSet {
    SupplePointSet set{};
    SuppleGroup group{}; ///< whose it is
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.set, c.group);
    }
};
struct SetWind {
    SuppleGroup group{};
    float wind[3] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.wind);
    }
};
struct CreateQueryPool {
    SuppleQueryPool pool{};
    SuppleQueryPoolDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.pool, c.desc);
    }
};
struct DestroyQueryPool {
    SuppleQueryPool pool{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.pool);
    }
};
/// What lies in buffers of the device is the host's, so a recording lacks such batches.
struct RecordQueries {
    SuppleQueryPool pool{};
    SuppleQueryDesc desc{};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.pool, c.desc);
    }
};

} // namespace calls

/// A call's number in a file is its place here: new ones come at the end.
using Call =
    std::variant<calls::CreateAsset, calls::ReloadAsset, calls::DestroyAsset, calls::CreateView, calls::DestroyView,
                 calls::CreateGroup, calls::DestroyGroup, calls::SetCapacity, calls::SetRate, calls::CreateInstance,
                 calls::DestroyInstance, calls::SetVisible, calls::SetPartVisible, calls::Teleport, calls::SetTransform,
                 calls::SetPosition, calls::SetUserData, calls::SetSharpness, calls::SetPriority, calls::SetClipPose,
                 calls::SetMatrixPose, calls::SetMorphWeights, calls::SetJointMatrices, calls::SetPose,
                 calls::SetPlayback, calls::SetTime, calls::SetMask, calls::SetModifiers, calls::SetModifierTarget,
                 calls::SetCamera, calls::SetDepthPyramid, calls::SetOrigin, calls::SetUploadBudget, calls::BeginFrame,
                 calls::CancelFrame, calls::RecordUploads, calls::RecordWarmUp, calls::Record, calls::RequestClip,
                 calls::CreatePointSet, calls::DestroyPointSet, calls::SetWind, calls::CreateQueryPool,
                 calls::DestroyQueryPool, calls::RecordQueries>;

/// The functions that make them, in the same order.
inline constexpr std::array<const char*, std::variant_size_v<Call>> kCallNames = {
    "suppleCreateAsset",       "suppleReloadAsset",     "suppleDestroyAsset",     "suppleCreateView",
    "suppleDestroyView",       "suppleCreateGroup",     "suppleDestroyGroup",     "suppleSetCapacity",
    "suppleSetRate",           "suppleCreateInstance",  "suppleDestroyInstance",  "suppleSetVisible",
    "suppleSetPartVisible",    "suppleTeleport",        "suppleSetTransform",     "suppleSetPosition",
    "suppleSetUserData",       "suppleSetSharpness",    "suppleSetPriority",      "suppleSetClipPose",
    "suppleSetMatrixPose",     "suppleSetMorphWeights", "suppleSetJointMatrices", "suppleSetPose",
    "suppleSetPlayback",       "suppleSetTime",         "suppleSetMask",          "suppleSetModifiers",
    "suppleSetModifierTarget", "suppleSetCamera",       "suppleSetDepthPyramid",  "suppleSetOrigin",
    "suppleSetUploadBudget",   "suppleBeginFrame",      "suppleCancelFrame",      "suppleRecordUploads",
    "suppleRecordWarmUp",      "suppleRecord",          "suppleRequestClip",      "suppleCreatePointSet",
    "suppleDestroyPointSet",   "suppleSetWind",         "suppleCreateQueryPool",  "suppleDestroyQueryPool",
    "suppleRecordQueries"};

/// The place of a type among those of a variant.
template <class T, class... Types>
constexpr size_t placeIn(const std::variant<Types...>*) {
    size_t place = 0;
    (void)((std::is_same_v<T, Types> || (++place, false)) || ...);
    return place;
}
template <class T>
inline constexpr uint32_t kCallNumber = static_cast<uint32_t>(placeIn<T>(static_cast<const Call*>(nullptr)));
static_assert(kCallNumber<calls::Record> == 37 && kCallNumber<calls::SetTransform> == 14, "files have these numbers");

template <class A, CallStruct<SuppleInstance> T>
void fields(A& a, T& instance) {
    a(instance.group, instance.slot, instance.generation);
}
template <class A, CallStruct<SupplePrepOptions> T>
void fields(A& a, T& options) {
    a.sized(options);
    a(options.tangentMode, options.cornerRule);
}
template <class A, CallStruct<SuppleBlendOptions> T>
void fields(A& a, T& options) {
    a.sized(options);
    a(options.creaseMode, options.sharpThreshold);
}
template <class A, CallStruct<SuppleFragmentsOptions> T>
void fields(A& a, T& options) {
    a.sized(options);
    a(options.rules);
}
template <class A, CallStruct<SuppleViewDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.flags, desc.maxVertices, desc.vertexFormat, desc.elasticities, desc.maxRuns, desc.coefficientBytes);
    a.later(desc.memoryBytes);
}
template <class A, CallStruct<SuppleGroupDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.flags, desc.asset, desc.capacity, desc.scheme, desc.rate, desc.vertexFormat, desc.skinning, desc.poseSource,
      desc.view, desc.instancesOf, desc.uvInterpolation);
    a.optional(desc.prep);
    a.optional(desc.blend);
    a.optional(desc.fragments);
    a.list(desc.partSchemes, desc.partSchemeCount);
    a.later(desc.keepUnseenFrames);
}
template <class A, CallStruct<SuppleJointMatricesDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.jointCount);
    uint32_t numbers = 16 * desc.jointCount, joints = desc.jointCount;
    a.list(desc.jointMatrices, numbers);
    a.list(desc.joints, joints);
    a.require(numbers == 16 * uint64_t{desc.jointCount} && (desc.joints == nullptr || joints == desc.jointCount));
    a.list(desc.morphWeights, desc.morphTargetCount);
}
template <class A, CallStruct<SuppleClipLayer> T>
void fields(A& a, T& layer) {
    a(layer.clip, layer.flags, layer.mode, layer.weight, layer.time, layer.previousTime, layer.referenceTime);
    a.list(layer.jointMask, layer.jointMaskCount);
    a.list(layer.morphMask, layer.morphMaskCount);
}
template <class A, CallStruct<SupplePoseDesc> T>
void fields(A& a, T& pose) {
    a.sized(pose);
    a(pose.flags, pose.rootMotion, pose.rootJoint);
    a.list(pose.layers, pose.layerCount);
}
template <class A, CallStruct<SupplePlaybackLayer> T>
void fields(A& a, T& layer) {
    a(layer.clip, layer.flags, layer.mode, layer.mask, layer.weight, layer.fadeWeight, layer.fadeDuration, layer.speed,
      layer.startTime, layer.offset, layer.fadeStart, layer.referenceTime);
}
template <class A, CallStruct<SupplePlaybackDesc> T>
void fields(A& a, T& playback) {
    a.sized(playback);
    a(playback.flags, playback.rootMotion, playback.rootJoint, playback.transition, playback.transitionKind,
      playback.updateInterval);
    a.list(playback.layers, playback.layerCount);
}
template <class A, CallStruct<SuppleClipRequest> T>
void fields(A& a, T& request) {
    a.sized(request);
    a(request.use, request.begin, request.end);
}
template <class A, CallStruct<SuppleSurfacePoint> T>
void fields(A& a, T& point) {
    a(point.face, point.side, point.a, point.b);
}
template <class A, CallStruct<SupplePointSetDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.flags, desc.group, desc.format);
    a.list(desc.points, desc.pointCount);
    uint32_t numbers = 3 * desc.pointCount;
    a.list(desc.tangents, numbers);
    a.require(desc.tangents == nullptr || numbers == 3 * uint64_t{desc.pointCount});
}
template <class A, CallStruct<SuppleQueryPoolDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.flags, desc.rayCount);
    a.list(desc.groups, desc.groupCount);
}
template <class A, CallStruct<SuppleRay> T>
void fields(A& a, T& ray) {
    a(ray.origin, ray.tMin, ray.direction, ray.tMax);
}
template <class A, CallStruct<SuppleTriangleHit> T>
void fields(A& a, T& hit) {
    a(hit.group, hit.surface, hit.slot, hit.geometry, hit.primitive, hit.t);
}
template <class A, CallStruct<SupplePlace> T>
void fields(A& a, T& place) {
    a(place.position, place.mostDistance);
}
template <class A, CallStruct<SuppleQueryDesc> T>
void fields(A& a, T& desc) {
    a.sized(desc);
    a(desc.flags, desc.rayCount);
    a.list(desc.groups, desc.groupCount);
    const auto listed = [&](auto& elements) { // null, or one for each ray
        uint32_t count = desc.rayCount;
        a.list(elements, count);
        a.require(elements == nullptr || count == desc.rayCount);
    };
    listed(desc.hostRays);
    listed(desc.hostTriangles);
    listed(desc.hostPlaces);
}
template <class A, CallStruct<SuppleMaskDesc> T>
void fields(A& a, T& mask) {
    a.sized(mask);
    a(mask.mask);
    a.list(mask.jointMask, mask.jointMaskCount);
    a.list(mask.morphMask, mask.morphMaskCount);
}
template <class A, CallStruct<SuppleModifier> T>
void fields(A& a, T& modifier) {
    a(modifier.kind, modifier.flags, modifier.joint, modifier.chainLength, modifier.weight, modifier.fadeWeight,
      modifier.fadeDuration, modifier.share, modifier.fadeStart, modifier.target, modifier.pole, modifier.rotation,
      modifier.axis, modifier.offset, modifier.limit, modifier.soft, modifier.poleWeight);
}
template <class A, CallStruct<SuppleModifiersDesc> T>
void fields(A& a, T& modifiers) {
    a.sized(modifiers);
    a.list(modifiers.modifiers, modifiers.modifierCount);
}
template <class A, CallStruct<SuppleModifierTarget> T>
void fields(A& a, T& target) {
    a.sized(target);
    a(target.weight, target.target, target.pole, target.rotation);
}
template <class A, CallStruct<SuppleCameraDesc> T>
void fields(A& a, T& camera) {
    a.sized(camera);
    a(camera.flags, camera.position, camera.pixelsPerUnit, camera.nearest, camera.chordError, camera.smallestEdge,
      camera.edgeLength, camera.vertexBudget, camera.viewProjection, camera.farthest, camera.smallestRadius,
      camera.direction);
}

} // namespace supple::runtime
