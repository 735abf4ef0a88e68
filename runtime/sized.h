// Structs of supple.h that begin with structSize, across versions: read from older and newer callers, written to them.
#pragma once

#include "supple/supple.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace supple::runtime {

/// The size a struct had in the first version of the ABI (SOVERSION 0). A struct that grows gets a specialization with
/// its old size. A new field must not lie where an older struct had padding, unless only Supple fills that struct.
template <class T>
inline constexpr size_t kFirstSize = sizeof(T);
template <>
inline constexpr size_t kFirstSize<SuppleAssetDesc> = offsetof(SuppleAssetDesc, scene);
template <>
inline constexpr size_t kFirstSize<SuppleCharacterDesc> = offsetof(SuppleCharacterDesc, materialLayers);
template <>
inline constexpr size_t kFirstSize<SuppleClipInfo> = offsetof(SuppleClipInfo, byteCount);
template <>
inline constexpr size_t kFirstSize<SuppleContextDesc> = offsetof(SuppleContextDesc, memoryBlockSize);
template <>
inline constexpr size_t kFirstSize<SuppleMaterialLayers> = offsetof(SuppleMaterialLayers, diffuseTransmissionFactor);
template <>
inline constexpr size_t kFirstSize<SuppleMemoryUse> = offsetof(SuppleMemoryUse, spare);
template <>
inline constexpr size_t kFirstSize<SuppleCageDesc> = offsetof(SuppleCageDesc, faceMaterials);
template <>
inline constexpr size_t kFirstSize<SupplePrimitiveDesc> = offsetof(SupplePrimitiveDesc, creaseScalarCount);
template <>
inline constexpr size_t kFirstSize<SuppleClipDesc> = offsetof(SuppleClipDesc, sharpnessCurveCount);
template <>
inline constexpr size_t kFirstSize<SuppleGroupDesc> = offsetof(SuppleGroupDesc, uvInterpolation);
template <>
inline constexpr size_t kFirstSize<SuppleJointInfo> = offsetof(SuppleJointInfo, restTransform);
template <>
inline constexpr size_t kFirstSize<SuppleGroupInfo> = offsetof(SuppleGroupInfo, userData);
template <>
inline constexpr size_t kFirstSize<SupplePlaybackDesc> = offsetof(SupplePlaybackDesc, transition);
template <>
inline constexpr size_t kFirstSize<SuppleRecordDesc> = offsetof(SuppleRecordDesc, time);
template <>
inline constexpr size_t kFirstSize<SuppleRequirements> = offsetof(SuppleRequirements, instanceVersion);
template <>
inline constexpr size_t kFirstSize<SuppleViewDesc> = offsetof(SuppleViewDesc, maxRuns);
template <>
inline constexpr size_t kFirstSize<SuppleViewStatistics> = offsetof(SuppleViewStatistics, hiddenPatchCount);

/// No version's struct is larger than ours by more than this: a size beyond is what happened to lie there.
inline constexpr size_t kMostGrowth = 4096;

/// Whether a caller's struct can be of some version.
template <class T>
[[nodiscard]] bool isPossibleSize(size_t size, size_t firstSize = kFirstSize<T>) {
    return size >= firstSize && size <= sizeof(T) + kMostGrowth;
}

/// Reads what the caller's version has of a struct; the rest is zero. False: of no possible size, or with something in
/// fields that this library does not know.
template <class T>
[[nodiscard]] bool readSized(const T& from, T& to, size_t firstSize = kFirstSize<T>) {
    const size_t size = from.structSize;
    if (!isPossibleSize<T>(size, firstSize)) {
        return false;
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(&from);
    if (size > sizeof(T) && std::any_of(bytes + sizeof(T), bytes + size, [](unsigned char b) { return b != 0; })) {
        return false;
    }
    to = {};
    std::memcpy(&to, &from, std::min(size, sizeof(T)));
    to.structSize = sizeof(T);
    return true;
}

/// The number a C caller has put into an enumeration, before it is known to be one of its values.
template <class E>
[[nodiscard]] uint32_t rawValue(const E& value) {
    static_assert(sizeof(E) == sizeof(uint32_t));
    uint32_t raw = 0;
    std::memcpy(&raw, &value, sizeof(raw));
    return raw;
}

/// Writes what the caller's version has room for. What a newer caller has beyond is zeroed. The caller has checked
/// that structSize is possible.
template <class T>
void writeSized(const T& from, T& to) {
    const size_t size = to.structSize;
    auto* bytes = reinterpret_cast<unsigned char*>(&to);
    std::memcpy(bytes, &from, std::min(size, sizeof(T)));
    if (size > sizeof(T)) {
        std::memset(bytes + sizeof(T), 0, size - sizeof(T));
    }
    to.structSize = static_cast<uint32_t>(size);
}

} // namespace supple::runtime
