// supple.hpp - a thin C++17 layer over supple.h: ownership and sized structs, nothing more. Header only; no exceptions;
// every call returns the SuppleResult of the C function it stands for. Threads, units and lifetimes are supple.h's.
#pragma once

#include <supple/supple.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace supple {

/// A struct of supple.h with structSize set and everything else zero, that is: default.
template <class T>
[[nodiscard]] constexpr T sized() {
    T value{};
    value.structSize = sizeof(T);
    return value;
}

/// glTF's own material, to begin with for SuppleCharacterDesc.materials: white, metal and rough, without textures.
[[nodiscard]] inline SuppleMaterialInfo defaultMaterial() {
    SuppleMaterialInfo material = sized<SuppleMaterialInfo>();
    material.alphaCutoff = 0.5f;
    for (float& factor : material.baseColorFactor) {
        factor = 1.0f;
    }
    material.metallicFactor = material.roughnessFactor = material.normalScale = 1.0f;
    material.occlusionStrength = material.emissiveStrength = 1.0f;
    for (SuppleTextureInfo* texture : {&material.baseColor, &material.metallicRoughness, &material.normal,
                                       &material.occlusion, &material.emissive, &material.trim}) {
        texture->image = texture->alternateImage = SUPPLE_NO_IMAGE;
        texture->scale[0] = texture->scale[1] = 1.0f;
    }
    return material;
}

/// A material that has no more than its SuppleMaterialInfo, to begin with for SuppleCharacterDesc.materialLayers.
[[nodiscard]] inline SuppleMaterialLayers defaultMaterialLayers() {
    SuppleMaterialLayers layers = sized<SuppleMaterialLayers>();
    layers.clearcoatNormalScale = layers.specularFactor = 1.0f;
    for (float& factor : layers.specularColorFactor) {
        factor = 1.0f;
    }
    layers.ior = 1.5f;
    layers.iridescenceIor = 1.3f;
    layers.iridescenceThicknessMinimum = 100.0f;
    layers.iridescenceThicknessMaximum = 400.0f;
    for (int c = 0; c < 3; ++c) {
        layers.diffuseTransmissionColorFactor[c] = layers.attenuationColor[c] = 1.0f;
    }
    for (SuppleTextureInfo* texture :
         {&layers.clearcoat, &layers.clearcoatRoughness, &layers.clearcoatNormal, &layers.sheenColor,
          &layers.sheenRoughness, &layers.transmission, &layers.specular, &layers.specularColor, &layers.iridescence,
          &layers.iridescenceThickness, &layers.anisotropy, &layers.diffuseTransmission,
          &layers.diffuseTransmissionColor, &layers.thickness}) {
        texture->image = texture->alternateImage = SUPPLE_NO_IMAGE;
        texture->scale[0] = texture->scale[1] = 1.0f;
    }
    return layers;
}

/// Values that lie in a row somewhere else. It is made of an array, a std::vector, a std::array, a std::span, whatever
/// else has data() and size(), or a pointer and a count. (std::span itself is C++20.)
template <class T>
class Span {
    template <class Container>
    using Fits = std::enable_if_t<
        std::is_convertible<std::remove_pointer_t<decltype(std::declval<Container&>().data())> (*)[], T (*)[]>::value &&
        std::is_convertible<decltype(std::declval<Container&>().size()), std::size_t>::value>;

public:
    constexpr Span() = default;                                                 ///< no values
    constexpr Span(T* first, std::size_t count) : data_(first), size_(count) {} ///< pointer and count
    template <std::size_t N>
    constexpr Span(T (&values)[N]) : data_(values), size_(N) {} ///< an array
    template <class Container, class = Fits<Container>>
    constexpr Span(Container&& values) : data_(values.data()), size_(values.size()) {} ///< what has data() and size()

    [[nodiscard]] constexpr T* data() const { return data_; }          ///< the first value
    [[nodiscard]] constexpr std::size_t size() const { return size_; } ///< how many there are
    [[nodiscard]] constexpr bool empty() const { return size_ == 0; }  ///< whether there are none

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

/// The 16 floats of a column-major matrix that lies somewhere else: an array, a std::array, a std::span of 16, or,
/// said explicitly, a pointer.
template <class T>
class MatrixSpan {
    template <class FixedSpan>
    using Fits = std::enable_if_t<FixedSpan::extent == 16 &&
                                  std::is_convertible<decltype(std::declval<FixedSpan&>().data()), T*>::value>;

public:
    explicit constexpr MatrixSpan(T* first) : data_(first) {}                                      ///< of 16 floats
    constexpr MatrixSpan(T (&values)[16]) : data_(values) {}                                       ///< an array
    constexpr MatrixSpan(std::array<std::remove_const_t<T>, 16>& values) : data_(values.data()) {} ///< an array
    template <class U = T, class = std::enable_if_t<std::is_const<U>::value>>
    constexpr MatrixSpan(const std::array<std::remove_const_t<U>, 16>& values) : data_(values.data()) {} ///< an array
    template <class FixedSpan, class = Fits<FixedSpan>, class = void>
    constexpr MatrixSpan(const FixedSpan& values) : data_(values.data()) {} ///< std::span of 16

    [[nodiscard]] constexpr T* data() const { return data_; } ///< the first float

private:
    T* data_;
};

/// Calls a function that fills an array. `out` gets the entries: it is resized, and its memory is used again.
template <class T, class Fill>
[[nodiscard]] SuppleResult filled(std::vector<T>& out, Fill&& fill) {
    uint32_t count = 0;
    SuppleResult result = fill(nullptr, &count);
    out.resize(count);
    if (result == SUPPLE_OK && count > 0) {
        result = fill(out.data(), &count);
    }
    return result;
}

/// Owns a SuppleContext. The device must outlive it, and no command buffer that uses it may be pending when it goes.
class Context {
public:
    Context() = default;
    Context(Context&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Context& operator=(Context&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Context() { suppleDestroyContext(handle_); }

    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const SuppleContextDesc& desc, Context& out) {
        Context created;
        const SuppleResult result = suppleCreateContext(&desc, &created.handle_);
        if (result == SUPPLE_OK) {
            out = std::move(created);
        }
        return result;
    }

    [[nodiscard]] SuppleContext handle() const { return handle_; }
    explicit operator bool() const { return handle_ != nullptr; }

    [[nodiscard]] SuppleResult beginFrame(uint64_t frame, uint64_t completedFrame) const {
        return suppleBeginFrame(handle_, frame, completedFrame);
    }
    /// Where the coordinates on the device begin, for large worlds.
    [[nodiscard]] SuppleResult setOrigin(const std::array<double, 3>& origin) const {
        return suppleSetOrigin(handle_, origin.data());
    }
    [[nodiscard]] SuppleResult cancelFrame() const { return suppleCancelFrame(handle_); }
    /// Records every call that changes the context, from now on: for supple replay.
    [[nodiscard]] SuppleResult startRecording(const SuppleRecordingDesc& desc) const {
        return suppleStartRecording(handle_, &desc);
    }
    /// Writes what is left.
    [[nodiscard]] SuppleResult stopRecording() const { return suppleStopRecording(handle_); }
    [[nodiscard]] SuppleResult recordUploads(VkCommandBuffer commandBuffer) const {
        return suppleRecordUploads(handle_, commandBuffer);
    }
    [[nodiscard]] SuppleResult recordWarmUp(VkCommandBuffer commandBuffer, Span<const SuppleGroup> groups) const {
        return suppleRecordWarmUp(handle_, commandBuffer, groups.data(), static_cast<uint32_t>(groups.size()));
    }
    [[nodiscard]] SuppleResult record(VkCommandBuffer commandBuffer, Span<const SuppleGroup> groups,
                                      SuppleSyncScope before, SuppleSyncScope after, uint32_t flags = 0,
                                      double time = 0.0) const {
        SuppleRecordDesc desc = sized<SuppleRecordDesc>();
        desc.flags = flags;
        desc.groups = groups.data();
        desc.groupCount = static_cast<uint32_t>(groups.size());
        desc.before = before;
        desc.after = after;
        desc.time = time;
        return suppleRecord(handle_, commandBuffer, &desc);
    }
    /// The barriers that take over what the groups' last record() released, into `out` (resized).
    [[nodiscard]] SuppleResult acquireBarriers(Span<const SuppleGroup> groups, SuppleSyncScope use,
                                               std::vector<VkBufferMemoryBarrier2>& out) const {
        const auto groupCount = static_cast<uint32_t>(groups.size());
        return filled(out, [&](VkBufferMemoryBarrier2* to, uint32_t* count) {
            return suppleGetAcquireBarriers(handle_, groups.data(), groupCount, use, to, count);
        });
    }
    /// The limit of a pass's time on the device.
    [[nodiscard]] SuppleResult setBudget(SupplePass pass, double nanoseconds) const {
        return suppleSetBudget(handle_, pass, nanoseconds);
    }
    /// How well a pass has kept to its limit.
    [[nodiscard]] SuppleResult budget(SupplePass pass, SuppleBudget& out) const {
        out = sized<SuppleBudget>();
        return suppleGetBudget(handle_, pass, &out);
    }
    /// The limit of the context's memory; without `ask`, nothing may exceed it.
    [[nodiscard]] SuppleResult setMemoryBudget(VkDeviceSize bytes, SuppleMemoryBudgetFunction ask = nullptr,
                                               void* user = nullptr) const {
        return suppleSetMemoryBudget(handle_, bytes, ask, user);
    }
    [[nodiscard]] SuppleResult memory(SuppleMemoryUse& out) const {
        out = sized<SuppleMemoryUse>();
        return suppleGetContextMemory(handle_, &out);
    }
    /// Bytes of static data a frame uploads at most; 0: no bound.
    [[nodiscard]] SuppleResult setUploadBudget(VkDeviceSize bytesPerFrame) const {
        return suppleSetUploadBudget(handle_, bytesPerFrame);
    }
    /// Static data on its way, of all there is.
    [[nodiscard]] SuppleResult uploadState(SuppleUploadState& out) const {
        out = sized<SuppleUploadState>();
        return suppleGetUploadState(handle_, &out);
    }
    /// The newest completed frame's passes, into `out` (resized; its capacity is reused). SUPPLE_NOT_READY empties it.
    [[nodiscard]] SuppleResult timings(std::vector<SuppleTiming>& out) const {
        return filled(out, [&](SuppleTiming* to, uint32_t* count) {
            return suppleGetTimings(handle_, sizeof(SuppleTiming), to, count);
        });
    }
    /// NARROW or WIDE, whichever AUTO has come to.
    [[nodiscard]] SuppleResult mapping(SuppleMapping& out) const { return suppleGetMapping(handle_, &out); }
    /// The device's tick that timings count from.
    [[nodiscard]] SuppleResult timingOrigin(uint64_t& ticks) const { return suppleGetTimingOrigin(handle_, &ticks); }

private:
    SuppleContext handle_ = nullptr;
};

inline void destroy(SuppleContext context, SuppleAsset asset) {
    suppleDestroyAsset(context, asset);
}
inline void destroy(SuppleContext context, SuppleGroup group) {
    suppleDestroyGroup(context, group);
}
inline void destroy(SuppleContext context, SuppleView view) {
    suppleDestroyView(context, view);
}
inline void destroy(SuppleContext context, SuppleInstance instance) {
    suppleDestroyInstance(context, instance);
}
inline void destroy(SuppleContext context, SupplePointSet set) {
    suppleDestroyPointSet(context, set);
}

/// Owns a handle, or nothing. The context must outlive it.
template <class Handle>
class Owner {
public:
    Owner() = default; ///< owns nothing
    /// Leaves nothing behind.
    Owner(Owner&& other) noexcept
        : context_(std::exchange(other.context_, nullptr)), handle_(std::exchange(other.handle_, {})) {}
    /// Exchanges what the two own.
    Owner& operator=(Owner&& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owner() {
        if (context_ != nullptr) {
            destroy(context_, handle_);
        }
    }

    [[nodiscard]] Handle handle() const { return handle_; }          ///< as the C functions take it
    [[nodiscard]] SuppleContext context() const { return context_; } ///< null: it owns nothing

protected:
    /// Owns what create(handle) makes in its first argument, if that succeeds.
    template <class Create>
    [[nodiscard]] SuppleResult replace(SuppleContext context, Create&& create) {
        Owner made;
        const SuppleResult result = create(made.handle_);
        if (result == SUPPLE_OK) {
            made.context_ = context;
            *this = std::move(made);
        }
        return result;
    }

    SuppleContext context_ = nullptr; ///< see context()
    Handle handle_{};                 ///< see handle()
};

/// Owns a SupplePrepared, of no context.
class Prepared {
public:
    Prepared() = default;
    Prepared(const Prepared&) = delete;
    Prepared& operator=(const Prepared&) = delete;
    Prepared(Prepared&& other) noexcept { *this = std::move(other); }
    /// Exchanges what the two own.
    Prepared& operator=(Prepared&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Prepared() { suppleDestroyPrepared(handle_); }

    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const SupplePrepareDesc& desc, Prepared& out) {
        Prepared made;
        const SuppleResult result = supplePrepare(&desc, &made.handle_);
        if (result == SUPPLE_OK) {
            out = std::move(made);
        }
        return result;
    }
    /// Makes the pipelines that such groups will need in a context: on any thread.
    [[nodiscard]] SuppleResult makePipelines(const Context& context, const SupplePlannedGroup* groups,
                                             uint32_t groupCount) const {
        return suppleMakePipelines(context.handle(), handle_, groups, groupCount);
    }
    /// The bytes of a cooked file; `out` becomes as long as they are. `madeBy` may be null.
    template <class Bytes>
    [[nodiscard]] SuppleResult save(const char* madeBy, Bytes& out) const {
        static_assert(sizeof(*out.data()) == 1);
        size_t size = 0;
        const SuppleResult result = suppleSavePrepared(handle_, madeBy, nullptr, &size);
        if (result != SUPPLE_OK) {
            return result;
        }
        out.resize(size);
        return suppleSavePrepared(handle_, madeBy, out.data(), &size);
    }
    [[nodiscard]] SupplePrepared handle() const {
        return handle_;
    } ///< as the C functions take it; null: it owns nothing

private:
    SupplePrepared handle_ = nullptr;
};

/// Owns a SuppleAsset. Its context must outlive it.
class Asset : public Owner<SuppleAsset> {
public:
    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const Context& context, const SuppleAssetDesc& desc, Asset& out) {
        return out.replace(context.handle(),
                           [&](SuppleAsset& made) { return suppleCreateAsset(context.handle(), &desc, &made); });
    }

    [[nodiscard]] SuppleResult info(SuppleAssetInfo& out) const {
        out = sized<SuppleAssetInfo>();
        return suppleGetAssetInfo(context_, handle_, &out);
    }
    /// Loads it anew in its place.
    [[nodiscard]] SuppleResult reload(const SuppleAssetDesc& desc) const {
        return suppleReloadAsset(context_, handle_, &desc);
    }
    [[nodiscard]] SuppleResult memory(SuppleMemoryUse& out) const {
        out = sized<SuppleMemoryUse>();
        return suppleGetAssetMemory(context_, handle_, &out);
    }
    /// The same of what its groups share.
    [[nodiscard]] SuppleResult uploadState(SuppleUploadState& out) const {
        out = sized<SuppleUploadState>();
        return suppleGetAssetUploadState(context_, handle_, &out);
    }
    /// What a part of the character is.
    [[nodiscard]] SuppleResult partInfo(uint32_t part, SupplePartInfo& out) const {
        out = sized<SupplePartInfo>();
        return suppleGetPartInfo(context_, handle_, part, &out);
    }
    [[nodiscard]] SuppleResult clipInfo(uint32_t clip, SuppleClipInfo& out) const {
        out = sized<SuppleClipInfo>();
        return suppleGetClipInfo(context_, handle_, clip, &out);
    }
    /// Null: the whole clip.
    [[nodiscard]] SuppleResult requestClip(uint32_t clip, const SuppleClipRequest* request = nullptr) const {
        return suppleRequestClip(context_, handle_, clip, request);
    }
    /// The box of the cage.
    [[nodiscard]] SuppleResult clipBounds(uint32_t clip, SuppleBounds& out) const {
        return suppleGetClipBounds(context_, handle_, clip, &out);
    }
    /// `count`: before the call how many markers `out` has room for, after it how many there are.
    [[nodiscard]] SuppleResult clipMarkers(uint32_t clip, SuppleClipMarker* out, uint32_t& count) const {
        return suppleGetClipMarkers(context_, handle_, clip, out, &count);
    }
    /// The same for those that playback passes.
    [[nodiscard]] SuppleResult clipMarkersBetween(uint32_t clip, double from, double to, uint32_t flags,
                                                  SuppleClipMarker* out, uint32_t& count) const {
        return suppleGetClipMarkersBetween(context_, handle_, clip, from, to, flags, out, &count);
    }
    /// The same of times in which feet stand.
    [[nodiscard]] SuppleResult clipContacts(uint32_t clip, SuppleClipContact* out, uint32_t& count) const {
        return suppleGetClipContacts(context_, handle_, clip, out, &count);
    }
    /// Fills out: the sharpness that a clip gives to a crease set.
    [[nodiscard]] SuppleResult clipSharpness(uint32_t clip, uint32_t set, double time, float& out) const {
        return suppleGetClipSharpness(context_, handle_, clip, set, time, &out);
    }
    /// The same of the names of crease sets.
    [[nodiscard]] SuppleResult creaseSets(const char** out, uint32_t& count) const {
        return suppleGetCreaseSets(context_, handle_, out, &count);
    }
    [[nodiscard]] SuppleResult jointInfo(uint32_t joint, SuppleJointInfo& out) const {
        out = sized<SuppleJointInfo>();
        return suppleGetJointInfo(context_, handle_, joint, &out);
    }
    [[nodiscard]] SuppleResult morphTargetInfo(uint32_t target, SuppleMorphTargetInfo& out) const {
        out = sized<SuppleMorphTargetInfo>();
        return suppleGetMorphTargetInfo(context_, handle_, target, &out);
    }
    [[nodiscard]] SuppleResult expressionInfo(uint32_t expression, SuppleExpressionInfo& out) const {
        out = sized<SuppleExpressionInfo>();
        return suppleGetExpressionInfo(context_, handle_, expression, &out);
    }
    /// One weight per expression; weights of all morph targets.
    [[nodiscard]] SuppleResult fillExpressionWeights(Span<const float> weights, Span<float> out) const {
        return suppleFillExpressionWeights(context_, handle_, weights.data(), static_cast<uint32_t>(weights.size()),
                                           out.data(), static_cast<uint32_t>(out.size()));
    }
    [[nodiscard]] SuppleResult materialInfo(uint32_t material, SuppleMaterialInfo& out) const {
        out = sized<SuppleMaterialInfo>();
        return suppleGetMaterialInfo(context_, handle_, material, &out);
    }
    [[nodiscard]] SuppleResult materialLayers(uint32_t material, SuppleMaterialLayers& out) const {
        out = sized<SuppleMaterialLayers>();
        return suppleGetMaterialLayers(context_, handle_, material, &out);
    }
    /// `out` has room for `count` names; `count` becomes how many there are.
    [[nodiscard]] SuppleResult materialVariants(const char** out, uint32_t& count) const {
        return suppleGetMaterialVariants(context_, handle_, out, &count);
    }
    [[nodiscard]] SuppleResult imageInfo(uint32_t image, SuppleImageInfo& out) const {
        out = sized<SuppleImageInfo>();
        return suppleGetImageInfo(context_, handle_, image, &out);
    }
    [[nodiscard]] SuppleResult fillJointMask(uint32_t joint, float value, Span<float> mask) const {
        return suppleFillJointMask(context_, handle_, joint, value, mask.data(), static_cast<uint32_t>(mask.size()));
    }
    [[nodiscard]] SuppleResult rootMotion(const SupplePoseDesc& pose, SuppleRootMotion& out) const {
        out = sized<SuppleRootMotion>();
        return suppleGetRootMotion(context_, handle_, &pose, &out);
    }
};

/// Owns a SuppleGroup. Its context must outlive it; the device memory goes once the frames that used it are complete.
class Group : public Owner<SuppleGroup> {
public:
    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const Context& context, const SuppleGroupDesc& desc, Group& out) {
        return out.replace(context.handle(),
                           [&](SuppleGroup& made) { return suppleCreateGroup(context.handle(), &desc, &made); });
    }

    [[nodiscard]] SuppleResult setCapacity(uint32_t capacity) const {
        return suppleSetCapacity(context_, handle_, capacity);
    }
    [[nodiscard]] SuppleResult setRate(uint32_t rate) const { return suppleSetRate(context_, handle_, rate); }
    /// Points of its surfaces, into `out`, which is resized to query.count, or so many times query.pointsEach.
    [[nodiscard]] SuppleResult findPoints(const SupplePointQuery& query, std::vector<SuppleSurfacePoint>& out) const {
        out.resize(size_t{query.count} * (query.pointsEach > 1 ? query.pointsEach : 1));
        return suppleFindPoints(context_, handle_, &query, out.data());
    }
    /// Sets the time by which its instances play (SUPPLE_POSES_PLAYBACK).
    [[nodiscard]] SuppleResult setTime(double seconds) const { return suppleSetTime(context_, handle_, seconds); }
    /// Three floats: a velocity in the world (suppleSetWind).
    [[nodiscard]] SuppleResult setWind(const float* wind) const { return suppleSetWind(context_, handle_, wind); }
    /// An empty span: the mask has no values of that kind.
    [[nodiscard]] SuppleResult setMask(uint32_t mask, Span<const float> joints, Span<const float> morphs = {}) const {
        SuppleMaskDesc desc = sized<SuppleMaskDesc>();
        desc.mask = mask;
        desc.jointMask = joints.empty() ? nullptr : joints.data();
        desc.jointMaskCount = static_cast<uint32_t>(joints.size());
        desc.morphMask = morphs.empty() ? nullptr : morphs.data();
        desc.morphMaskCount = static_cast<uint32_t>(morphs.size());
        return suppleSetMask(context_, handle_, &desc);
    }
    [[nodiscard]] SuppleResult memory(SuppleMemoryUse& out) const {
        out = sized<SuppleMemoryUse>();
        return suppleGetGroupMemory(context_, handle_, &out);
    }
    /// Whether its static data is on the device.
    [[nodiscard]] SuppleResult uploadState(SuppleUploadState& out) const {
        out = sized<SuppleUploadState>();
        return suppleGetGroupUploadState(context_, handle_, &out);
    }
    [[nodiscard]] SuppleResult info(SuppleGroupInfo& out) const {
        out = sized<SuppleGroupInfo>();
        return suppleGetGroupInfo(context_, handle_, &out);
    }
    [[nodiscard]] SuppleResult surfaceInfo(SuppleSurfaceInfo& out, uint32_t surface = 0) const {
        out = sized<SuppleSurfaceInfo>();
        return suppleGetSurfaceInfo(context_, handle_, surface, &out);
    }
    [[nodiscard]] SuppleResult vertexStreams(SuppleVertexStreams& out, uint32_t surface = 0) const {
        out = sized<SuppleVertexStreams>();
        return suppleGetVertexStreams(context_, handle_, surface, &out);
    }
    [[nodiscard]] SuppleResult gridOutput(SuppleGridOutput& out, uint32_t surface = 0) const {
        out = sized<SuppleGridOutput>();
        return suppleGetGridOutput(context_, handle_, surface, &out);
    }
    /// With SUPPLE_GROUP_RAY_TRACING: what acceleration structures are built from.
    [[nodiscard]] SuppleResult rayGeometry(SuppleRayGeometry& out, uint32_t surface = 0) const {
        out = sized<SuppleRayGeometry>();
        return suppleGetRayGeometry(context_, handle_, surface, &out);
    }
    [[nodiscard]] SuppleResult levelOutput(SuppleLevelOutput& out, uint32_t surface = 0) const {
        out = sized<SuppleLevelOutput>();
        return suppleGetLevelOutput(context_, handle_, surface, &out);
    }
    /// The patches of an instance, into `out` (resized).
    [[nodiscard]] SuppleResult patches(std::vector<SupplePatchInfo>& out, uint32_t surface = 0) const {
        return filled(out, [&](SupplePatchInfo* to, uint32_t* count) {
            return suppleGetPatches(context_, handle_, surface, to, count);
        });
    }
    [[nodiscard]] SuppleResult instanceBounds(SuppleBufferRange& out) const {
        return suppleGetInstanceBounds(context_, handle_, &out);
    }
    /// The box of the surfaces.
    [[nodiscard]] SuppleResult clipBounds(uint32_t clip, SuppleBounds& out) const {
        return suppleGetGroupClipBounds(context_, handle_, clip, &out);
    }
};

/// Owns a SuppleView. Its context must outlive it.
class View : public Owner<SuppleView> {
public:
    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const Context& context, const SuppleViewDesc& desc, View& out) {
        return out.replace(context.handle(),
                           [&](SuppleView& made) { return suppleCreateView(context.handle(), &desc, &made); });
    }

    [[nodiscard]] SuppleResult setCamera(const SuppleCameraDesc& camera) const {
        return suppleSetCamera(context_, handle_, &camera);
    }
    [[nodiscard]] SuppleResult memory(SuppleMemoryUse& out) const {
        out = sized<SuppleMemoryUse>();
        return suppleGetViewMemory(context_, handle_, &out);
    }
    /// Null: nothing hides.
    [[nodiscard]] SuppleResult setDepthPyramid(const SuppleDepthPyramidDesc* pyramid) const {
        return suppleSetDepthPyramid(context_, handle_, pyramid);
    }
    [[nodiscard]] SuppleResult statistics(SuppleViewStatistics& out) const {
        out = sized<SuppleViewStatistics>();
        return suppleGetViewStatistics(context_, handle_, &out);
    }
};

/// Owns a SupplePointSet. Its context and its group must outlive it.
class PointSet : public Owner<SupplePointSet> {
public:
    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const Context& context, const SupplePointSetDesc& desc, PointSet& out) {
        return out.replace(context.handle(),
                           [&](SupplePointSet& made) { return suppleCreatePointSet(context.handle(), &desc, &made); });
    }

    /// Ask again when the group has another capacity or its asset is reloaded.
    [[nodiscard]] SuppleResult output(SupplePointOutput& out) const {
        out = sized<SupplePointOutput>();
        return suppleGetPointOutput(context_, handle_, &out);
    }
};

/// Owns a SuppleInstance. Its context and its group must outlive it: destroy a list of instances before their group.
class Instance : public Owner<SuppleInstance> {
public:
    /// Replaces what `out` held.
    [[nodiscard]] static SuppleResult create(const Group& group, Instance& out) {
        return out.replace(group.context(), [&](SuppleInstance& made) {
            return suppleCreateInstance(group.context(), group.handle(), &made);
        });
    }

    [[nodiscard]] SuppleResult setVisible(bool visible) const {
        return suppleSetVisible(context_, handle_, visible ? 1u : 0u);
    }
    [[nodiscard]] SuppleResult setPartVisible(uint32_t part, bool visible) const {
        return suppleSetPartVisible(context_, handle_, part, visible ? 1u : 0u);
    }
    [[nodiscard]] SuppleResult setPriority(uint32_t priority) const {
        return suppleSetPriority(context_, handle_, priority);
    }
    [[nodiscard]] SuppleResult teleport() const { return suppleTeleport(context_, handle_); }
    [[nodiscard]] SuppleResult setClipPose(uint32_t clip, double time) const {
        return suppleSetClipPose(context_, handle_, clip, time);
    }
    [[nodiscard]] SuppleResult setPose(const SupplePoseDesc& pose) const {
        return suppleSetPose(context_, handle_, &pose);
    }
    /// For crossfades and plain layers without root motion.
    [[nodiscard]] SuppleResult setPose(Span<const SuppleClipLayer> layers) const {
        SupplePoseDesc pose = sized<SupplePoseDesc>();
        pose.layers = layers.data();
        pose.layerCount = static_cast<uint32_t>(layers.size());
        return suppleSetPose(context_, handle_, &pose);
    }
    /// Sets what the device plays from now on (SUPPLE_POSES_PLAYBACK).
    [[nodiscard]] SuppleResult setPlayback(const SupplePlaybackDesc& playback) const {
        return suppleSetPlayback(context_, handle_, &playback);
    }
    /// Plain layers without root motion.
    [[nodiscard]] SuppleResult setPlayback(Span<const SupplePlaybackLayer> layers) const {
        SupplePlaybackDesc playback = sized<SupplePlaybackDesc>();
        playback.layers = layers.data();
        playback.layerCount = static_cast<uint32_t>(layers.size());
        return suppleSetPlayback(context_, handle_, &playback);
    }
    /// Replaces the list; an empty span: none (SUPPLE_GROUP_MODIFIERS).
    [[nodiscard]] SuppleResult setModifiers(Span<const SuppleModifier> modifiers) const {
        SuppleModifiersDesc desc = sized<SuppleModifiersDesc>();
        desc.modifiers = modifiers.data();
        desc.modifierCount = static_cast<uint32_t>(modifiers.size());
        return suppleSetModifiers(context_, handle_, &desc);
    }
    /// Changes a modifier of the list.
    [[nodiscard]] SuppleResult setModifierTarget(uint32_t index, const SuppleModifierTarget& target) const {
        return suppleSetModifierTarget(context_, handle_, index, &target);
    }
    /// An empty span: the weights are those of the poses again.
    [[nodiscard]] SuppleResult setMorphWeights(Span<const float> weights) const {
        return suppleSetMorphWeights(context_, handle_, weights.empty() ? nullptr : weights.data(),
                                     static_cast<uint32_t>(weights.size()));
    }
    [[nodiscard]] SuppleResult setMatrixPose(Span<const float> jointMatrices) const {
        return suppleSetMatrixPose(context_, handle_, jointMatrices.data(),
                                   static_cast<uint32_t>(jointMatrices.size() / 16));
    }
    /// Poses some joints, or all with morph weights.
    [[nodiscard]] SuppleResult setJointMatrices(const SuppleJointMatricesDesc& matrices) const {
        return suppleSetJointMatrices(context_, handle_, &matrices);
    }
    [[nodiscard]] SuppleResult setTransform(MatrixSpan<const float> transform) const {
        return suppleSetTransform(context_, handle_, transform.data());
    }
    /// The translation alone, for large worlds.
    [[nodiscard]] SuppleResult setPosition(const std::array<double, 3>& position) const {
        return suppleSetPosition(context_, handle_, position.data());
    }
    /// What its shaders read by slot.
    [[nodiscard]] SuppleResult setUserData(const std::array<float, 4>& data) const {
        return suppleSetUserData(context_, handle_, data.data());
    }
    /// Sets the sharpness of a crease set.
    [[nodiscard]] SuppleResult setSharpness(uint32_t set, float sharpness) const {
        return suppleSetSharpness(context_, handle_, set, sharpness);
    }
    /// `frame` may be null.
    [[nodiscard]] SuppleResult readBounds(SuppleBounds& out, uint64_t* frame = nullptr) const {
        return suppleReadInstanceBounds(context_, handle_, &out, frame);
    }
    [[nodiscard]] SuppleResult jointTransform(uint32_t joint, MatrixSpan<float> out) const {
        return suppleGetJointTransform(context_, handle_, joint, out.data());
    }
};

} // namespace supple
