#include "gpu/barriers.h"

namespace supple::gpu {

namespace {

/// Flags that VkPipelineStageFlagBits and VkAccessFlagBits have as well. Not all that fit into 32 bits are among them:
/// synchronization2 alone has stages from bit 26 on, such as the copy of acceleration structures.
constexpr VkPipelineStageFlags2 kBasicStages = 0x03FFFFFFu;
constexpr VkAccessFlags2 kBasicAccess = 0x0FFFFFFFu;
static_assert((VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR & ~kBasicStages) == 0);

} // namespace

BasicScope basic(SyncScope scope) {
    constexpr VkPipelineStageFlags2 kTransfers = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
                                                 VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
    constexpr VkPipelineStageFlags2 kInputs =
        VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
    constexpr VkAccessFlags2 kReads = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

    BasicScope result{static_cast<VkPipelineStageFlags>(scope.stages & kBasicStages),
                      static_cast<VkAccessFlags>(scope.access & kBasicAccess)};
    if ((scope.stages & kTransfers) != 0) {
        result.stages |= VK_PIPELINE_STAGE_TRANSFER_BIT;
    }
    if ((scope.stages & kInputs) != 0) {
        result.stages |= VK_PIPELINE_STAGE_VERTEX_INPUT_BIT;
    }
    if ((scope.stages & ~(kBasicStages | kTransfers | kInputs)) != 0) {
        result.stages |= VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    }
    if ((scope.access & kReads) != 0) {
        result.access |= VK_ACCESS_SHADER_READ_BIT;
    }
    if ((scope.access & kWrites) != 0) {
        result.access |= VK_ACCESS_SHADER_WRITE_BIT;
    }
    if ((scope.access & ~(kBasicAccess | kReads | kWrites)) != 0) {
        result.stages |= VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        result.access |= VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    }
    return result;
}

void memoryBarrier(const Device& device, VkCommandBuffer commandBuffer, SyncScope before, SyncScope after) {
    constexpr VkPipelineStageFlags kBegin = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                   kEnd = VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT;
    const BasicScope from = basic(before), to = basic(after);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    device.vk.CmdPipelineBarrier(commandBuffer, from.stages != 0 ? from.stages : kBegin,
                                 to.stages != 0 ? to.stages : kEnd, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void releaseBuffers(const Device& device, VkCommandBuffer commandBuffer,
                    std::span<const VkBufferMemoryBarrier> barriers, VkPipelineStageFlags before) {
    device.vk.CmdPipelineBarrier(commandBuffer, before, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr,
                                 static_cast<uint32_t>(barriers.size()), barriers.data(), 0, nullptr);
}

void computeBarrier(const Device& device, VkCommandBuffer commandBuffer) {
    constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    memoryBarrier(device, commandBuffer, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kWrite},
                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kRead | kWrite});
}

void disjointBarrier(const Device& device, VkCommandBuffer commandBuffer) {
    if (!device.mapping.wide) {
        computeBarrier(device, commandBuffer);
    }
}

} // namespace supple::gpu
