// Pipeline barriers, by vkCmdPipelineBarrier: Vulkan 1.1 has no other. Scopes are said by the flags of
// synchronization2, as hosts say theirs; what these flags tell apart and the older ones do not becomes the wider scope.
#pragma once

#include "gpu/device.h"

#include <span>

namespace supple::gpu {

/// Stages, and what they do with memory.
struct SyncScope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
};

/// The same by the flags of Vulkan 1.0, or more where these have no flag. No stages stay none.
struct BasicScope {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
};
[[nodiscard]] BasicScope basic(SyncScope scope);

/// Makes the writes in `before` visible to `after`; a global barrier, so no buffer is named.
void memoryBarrier(const Device& device, VkCommandBuffer commandBuffer, SyncScope before, SyncScope after);
/// Releases buffers to another queue family, so nothing waits for them here. `barriers` have their access masks;
/// `before`: the stages that wrote the buffers.
void releaseBuffers(const Device& device, VkCommandBuffer commandBuffer,
                    std::span<const VkBufferMemoryBarrier> barriers, VkPipelineStageFlags before);
/// What compute shaders wrote before, compute shaders after may read (texel buffers too) and write.
void computeBarrier(const Device& device, VkCommandBuffer commandBuffer);
/// Between dispatches that share a buffer and nothing in it, or only atomics. Synchronization validation asks for a
/// barrier where buffers are read as texels, to it one resource each; in the wide mapping, where none are and a barrier
/// lets the device run empty, there is none.
void disjointBarrier(const Device& device, VkCommandBuffer commandBuffer);

} // namespace supple::gpu
