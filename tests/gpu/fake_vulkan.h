// A gpu::Device whose entry points are functions of the test: they count objects, keep memory on the host and note what
// is recorded. One at a time.
#pragma once

#include "gpu/device.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace supple::gpu::test {

/// Barriers with the stages of the call that has them.
struct GlobalBarrier {
    VkPipelineStageFlags before = 0, after = 0;
    VkMemoryBarrier barrier{};
};
struct BufferBarrier {
    VkPipelineStageFlags before = 0, after = 0;
    VkBufferMemoryBarrier barrier{};
};

struct FakeVulkan {
    FakeVulkan();
    ~FakeVulkan();
    FakeVulkan(const FakeVulkan&) = delete;
    FakeVulkan& operator=(const FakeVulkan&) = delete;

    /// Narrow, 1 GiB of one heap with one type of memory that is everything, buffers of at most 1 GiB.
    Device device;

    // What the device says and does.
    VkDeviceSize alignment = 64; ///< of buffers
    VkDriverId driver = VK_DRIVER_ID_MESA_LLVMPIPE;
    VkBool32 keepsSignedZeros = VK_TRUE; ///< knows SignedZeroInfNanPreserve
    int64_t failAllocation = -1;         ///< index of the vkAllocateMemory that fails
    int64_t failPipeline = -1;           ///< index of the vkCreateComputePipelines that fails
    std::vector<uint64_t> queryResults;  ///< value and availability of each timestamp

    // What was called.
    struct BoundBuffer {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
        VkDeviceSize size = 0;
    };
    struct Pipeline {
        std::vector<uint32_t> code;
        std::vector<std::pair<uint32_t, uint32_t>> constants; ///< id and value
    };
    std::map<VkBuffer, BoundBuffer> buffers;                 ///< that live
    std::map<VkDeviceMemory, std::vector<std::byte>> memory; ///< that live
    std::map<VkBufferView, VkBufferViewCreateInfo> views;    ///< that live
    std::map<VkShaderModule, std::vector<uint32_t>> shaders; ///< that live
    size_t allocations = 0;                                  ///< vkAllocateMemory, those that failed included
    size_t layouts = 0;                                      ///< of sets, that live
    std::vector<VkDescriptorPoolSize> poolSizes;             ///< of the last pool
    std::vector<Pipeline> pipelines;                         ///< all ever made
    size_t pipelineCalls = 0;                                ///< vkCreateComputePipelines
    std::vector<std::pair<VkBuffer, VkBuffer>> copies;       ///< from, to
    std::vector<std::vector<VkBufferCopy>> copiedRegions;    ///< of each of the copies
    std::vector<std::pair<uint32_t, uint32_t>> dispatches;   ///< x, y
    std::vector<GlobalBarrier> barriers;
    /// By vkCmdPipelineBarrier that has any.
    std::vector<std::vector<BufferBarrier>> bufferBarriers;
    std::vector<std::pair<uint32_t, uint32_t>> resets; ///< of queries: first, count
    std::mutex mutex;                                  ///< of `resets`
};

/// A command buffer to record into: the fake never looks at it.
inline constexpr VkCommandBuffer kCommands = VK_NULL_HANDLE;

} // namespace supple::gpu::test
