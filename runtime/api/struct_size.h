// What is said of a struct whose structSize is wrong.
#pragma once

#include "runtime/sized.h"
#include "supple/supple.h"
#include "supple/supple_cpu.h"

#include <string>

namespace supple::api {

/// The struct's name in the public headers; only structs with structSize have one.
template <class T>
inline constexpr const char* kStructName = nullptr;
#define SUPPLE_SIZED_STRUCTS(X)                                                                                        \
    X(SuppleRequirements)                                                                                              \
    X(SuppleContextDesc)                                                                                               \
    X(SuppleCageDesc)                                                                                                  \
    X(SuppleNodeDesc)                                                                                                  \
    X(SuppleSkinDesc)                                                                                                  \
    X(SuppleMorphTargetDesc)                                                                                           \
    X(SupplePrimitiveDesc)                                                                                             \
    X(SupplePartDesc)                                                                                                  \
    X(SuppleChannelDesc)                                                                                               \
    X(SuppleClipDesc)                                                                                                  \
    X(SuppleCharacterDesc)                                                                                             \
    X(SuppleAssetDesc)                                                                                                 \
    X(SuppleAssetInfo)                                                                                                 \
    X(SupplePartInfo)                                                                                                  \
    X(SuppleClipInfo)                                                                                                  \
    X(SuppleJointInfo)                                                                                                 \
    X(SuppleMorphTargetInfo)                                                                                           \
    X(SuppleExpressionInfo)                                                                                            \
    X(SuppleMaterialInfo)                                                                                              \
    X(SuppleMaterialLayers)                                                                                            \
    X(SuppleImageInfo)                                                                                                 \
    X(SupplePrepOptions)                                                                                               \
    X(SuppleBlendOptions)                                                                                              \
    X(SuppleFragmentsOptions)                                                                                          \
    X(SuppleGroupDesc)                                                                                                 \
    X(SuppleGroupInfo)                                                                                                 \
    X(SuppleSurfaceInfo)                                                                                               \
    X(SuppleVertexStreams)                                                                                             \
    X(SuppleRayGeometry)                                                                                               \
    X(SuppleDirectOutput)                                                                                              \
    X(SuppleGridOutput)                                                                                                \
    X(SuppleRecordDesc)                                                                                                \
    X(SuppleBudget)                                                                                                    \
    X(SuppleMemoryUse)                                                                                                 \
    X(SupplePrepareDesc)                                                                                               \
    X(SupplePoseDesc)                                                                                                  \
    X(SuppleRootMotion)                                                                                                \
    X(SuppleUploadState)                                                                                               \
    X(SupplePlaybackDesc)                                                                                              \
    X(SuppleRecordingDesc)                                                                                             \
    X(SuppleClipRequest)                                                                                               \
    X(SuppleMaskDesc)                                                                                                  \
    X(SuppleJointMatricesDesc)                                                                                         \
    X(SuppleModifiersDesc)                                                                                             \
    X(SuppleModifierTarget)                                                                                            \
    X(SuppleViewDesc)                                                                                                  \
    X(SuppleCameraDesc)                                                                                                \
    X(SuppleDepthPyramidDesc)                                                                                          \
    X(SupplePointSetDesc)                                                                                              \
    X(SupplePointQuery)                                                                                                \
    X(SupplePointOutput)                                                                                               \
    X(SuppleQueryPoolDesc)                                                                                             \
    X(SuppleQueryOutput)                                                                                               \
    X(SuppleQueryDesc)                                                                                                 \
    X(SuppleLevelOutput)                                                                                               \
    X(SuppleViewStatistics)                                                                                            \
    X(SuppleCpuGroupDesc)                                                                                              \
    X(SuppleCpuGroupInfo)                                                                                              \
    X(SuppleCpuGridInfo)
#define SUPPLE_NAME_STRUCT(type)                                                                                       \
    template <>                                                                                                        \
    inline constexpr const char* kStructName<type> = #type;
SUPPLE_SIZED_STRUCTS(SUPPLE_NAME_STRUCT)
#undef SUPPLE_NAME_STRUCT
#undef SUPPLE_SIZED_STRUCTS

/// Why readSized or checkOut has refused the argument `name`.
template <class T>
std::string faultOfSize(const std::string& name, uint32_t size) {
    static_assert(kStructName<T> != nullptr, "add the struct to the list above");
    const std::string is = name + ".structSize is " + std::to_string(size) + ": ";
    const std::string type = kStructName<T>;
    if (size < runtime::kFirstSize<T>) {
        return is + (size == 0 ? "" : "less than in any version; ") + "set it to sizeof(" + type + ")";
    }
    if (!runtime::isPossibleSize<T>(size)) {
        return is + "more than in any version; set it to sizeof(" + type + ")";
    }
    return is + "a newer version's " + type + ", with fields in use that this library lacks";
}

} // namespace supple::api
