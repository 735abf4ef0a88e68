// The buffers of a group, by number. For runtime/group*.cpp alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vulkan/vulkan_core.h>

namespace supple::runtime {

enum BufferIndex : size_t {
    kPoses,
    kDeformedCage,
    kPool,
    kSecondPool, ///< motion: the pools take turns
    kSurface,
    kPreviousPositions,
    kPatchCoefficients,
    kAttributes,
    kUvs1,
    kFaceUvs,
    kScratch,
    kInstances, ///< two lists of capacity entries: visible slots; by window, for the passes
    kIndirect,
    kBufferCount
};
enum StagingIndex : size_t { kPoseStaging, kListStaging, kCullStaging, kStagingCount };
inline constexpr size_t kGridIndices = 0; // among the static buffers

inline constexpr VkDeviceSize kVec4Bytes = 16;
inline constexpr VkDeviceSize kPreviousPositionBytes = 12;

constexpr uint32_t roundUp(uint32_t value, uint32_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

} // namespace supple::runtime
