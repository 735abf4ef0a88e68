#include "tests/gpu/fake_vulkan.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace supple::gpu::test {
namespace {

FakeVulkan* fake = nullptr; // the one there is

template <class T>
T newHandle() {
    static uintptr_t last = 0;
    return std::bit_cast<T>(++last);
}

VKAPI_ATTR void VKAPI_CALL deviceProperties(VkPhysicalDevice, VkPhysicalDeviceProperties2* properties) {
    for (auto* next = static_cast<VkBaseOutStructure*>(properties->pNext); next != nullptr; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceDriverProperties*>(next)->driverID = fake->driver;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceFloatControlsProperties*>(next)->shaderSignedZeroInfNanPreserveFloat32 =
                fake->keepsSignedZeros;
        }
    }
}
VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice, const VkBufferCreateInfo* info, const VkAllocationCallbacks*,
                                            VkBuffer* buffer) {
    *buffer = newHandle<VkBuffer>();
    fake->buffers[*buffer].size = info->size;
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyBuffer(VkDevice, VkBuffer buffer, const VkAllocationCallbacks*) {
    fake->buffers.erase(buffer);
}
VKAPI_ATTR void VKAPI_CALL bufferRequirements(VkDevice, VkBuffer buffer, VkMemoryRequirements* needs) {
    *needs = {fake->buffers.at(buffer).size, fake->alignment, 1u};
}
VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*,
                                              VkDeviceMemory* memory) {
    if (static_cast<int64_t>(fake->allocations++) == fake->failAllocation) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    *memory = newHandle<VkDeviceMemory>();
    fake->memory[*memory].resize(info->allocationSize);
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice, VkDeviceMemory memory, const VkAllocationCallbacks*) {
    fake->memory.erase(memory);
}
VKAPI_ATTR VkResult VKAPI_CALL bindBufferMemory(VkDevice, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
    fake->buffers.at(buffer).memory = memory;
    fake->buffers.at(buffer).offset = offset;
    return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize,
                                         VkMemoryMapFlags, void** mapped) {
    *mapped = fake->memory.at(memory).data() + offset;
    return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL createBufferView(VkDevice, const VkBufferViewCreateInfo* info,
                                                const VkAllocationCallbacks*, VkBufferView* view) {
    *view = newHandle<VkBufferView>();
    fake->views[*view] = *info;
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyBufferView(VkDevice, VkBufferView view, const VkAllocationCallbacks*) {
    fake->views.erase(view);
}
VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks*, VkShaderModule* shader) {
    *shader = newHandle<VkShaderModule>();
    fake->shaders[*shader].assign(info->pCode, info->pCode + info->codeSize / sizeof(uint32_t));
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyShaderModule(VkDevice, VkShaderModule shader, const VkAllocationCallbacks*) {
    fake->shaders.erase(shader);
}
VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice, const VkDescriptorSetLayoutCreateInfo*,
                                               const VkAllocationCallbacks*, VkDescriptorSetLayout* layout) {
    ++fake->layouts;
    *layout = newHandle<VkDescriptorSetLayout>();
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroySetLayout(VkDevice, VkDescriptorSetLayout, const VkAllocationCallbacks*) {
    --fake->layouts;
}
VKAPI_ATTR VkResult VKAPI_CALL createPipelineLayout(VkDevice, const VkPipelineLayoutCreateInfo*,
                                                    const VkAllocationCallbacks*, VkPipelineLayout* layout) {
    *layout = newHandle<VkPipelineLayout>();
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyPipelineLayout(VkDevice, VkPipelineLayout, const VkAllocationCallbacks*) {}
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice, VkPipelineCache, uint32_t,
                                               const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks*,
                                               VkPipeline* pipeline) {
    if (static_cast<int64_t>(fake->pipelineCalls++) == fake->failPipeline) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    FakeVulkan::Pipeline& made = fake->pipelines.emplace_back();
    made.code = fake->shaders.at(info->stage.module);
    const VkSpecializationInfo& given = *info->stage.pSpecializationInfo;
    for (uint32_t i = 0; i < given.mapEntryCount; ++i) {
        const VkSpecializationMapEntry& entry = given.pMapEntries[i];
        uint32_t value = 0;
        std::memcpy(&value, static_cast<const std::byte*>(given.pData) + entry.offset, sizeof value);
        made.constants.emplace_back(entry.constantID, value);
    }
    *pipeline = newHandle<VkPipeline>();
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyPipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*) {}
VKAPI_ATTR VkResult VKAPI_CALL createPool(VkDevice, const VkDescriptorPoolCreateInfo* info,
                                          const VkAllocationCallbacks*, VkDescriptorPool* pool) {
    fake->poolSizes.assign(info->pPoolSizes, info->pPoolSizes + info->poolSizeCount);
    *pool = newHandle<VkDescriptorPool>();
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyPool(VkDevice, VkDescriptorPool, const VkAllocationCallbacks*) {}
VKAPI_ATTR VkResult VKAPI_CALL createQueryPool(VkDevice, const VkQueryPoolCreateInfo*, const VkAllocationCallbacks*,
                                               VkQueryPool* pool) {
    *pool = newHandle<VkQueryPool>();
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyQueryPool(VkDevice, VkQueryPool, const VkAllocationCallbacks*) {}
VKAPI_ATTR VkResult VKAPI_CALL queryPoolResults(VkDevice, VkQueryPool, uint32_t, uint32_t, size_t size, void* data,
                                                VkDeviceSize, VkQueryResultFlags) {
    std::memcpy(data, fake->queryResults.data(), std::min(size, fake->queryResults.size() * sizeof(uint64_t)));
    return VK_NOT_READY;
}
/// As if the device had run at once.
VKAPI_ATTR void VKAPI_CALL copyQueryPoolResults(VkCommandBuffer, VkQueryPool, uint32_t first, uint32_t count,
                                                VkBuffer to, VkDeviceSize offset, VkDeviceSize stride,
                                                VkQueryResultFlags) {
    const FakeVulkan::BoundBuffer& target = fake->buffers.at(to);
    for (uint32_t i = 0; i < count; ++i) {
        std::memcpy(fake->memory.at(target.memory).data() + target.offset + offset + i * stride,
                    &fake->queryResults.at(2 * (size_t{first} + i)), 2 * sizeof(uint64_t));
    }
}
VKAPI_ATTR void VKAPI_CALL writeTimestamp(VkCommandBuffer, VkPipelineStageFlagBits, VkQueryPool, uint32_t) {}
VKAPI_ATTR void VKAPI_CALL resetQueryPool(VkCommandBuffer, VkQueryPool, uint32_t first, uint32_t count) {
    const std::lock_guard lock(fake->mutex);
    fake->resets.emplace_back(first, count);
}
VKAPI_ATTR void VKAPI_CALL pipelineBarrier(VkCommandBuffer, VkPipelineStageFlags before, VkPipelineStageFlags after,
                                           VkDependencyFlags, uint32_t count, const VkMemoryBarrier* barriers,
                                           uint32_t bufferCount, const VkBufferMemoryBarrier* buffers, uint32_t,
                                           const VkImageMemoryBarrier*) {
    for (uint32_t i = 0; i < count; ++i) {
        fake->barriers.push_back({before, after, barriers[i]});
    }
    if (bufferCount > 0) {
        std::vector<BufferBarrier> call;
        for (uint32_t i = 0; i < bufferCount; ++i) {
            call.push_back({before, after, buffers[i]});
        }
        fake->bufferBarriers.push_back(std::move(call));
    }
}
VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer, uint32_t x, uint32_t y, uint32_t) {
    fake->dispatches.emplace_back(x, y);
}
VKAPI_ATTR void VKAPI_CALL copyBuffer(VkCommandBuffer, VkBuffer from, VkBuffer to, uint32_t count,
                                      const VkBufferCopy* regions) {
    fake->copies.emplace_back(from, to);
    fake->copiedRegions.emplace_back(regions, regions + count);
    const FakeVulkan::BoundBuffer& source = fake->buffers.at(from);
    const FakeVulkan::BoundBuffer& target = fake->buffers.at(to);
    for (const VkBufferCopy& region : fake->copiedRegions.back()) {
        std::memcpy(fake->memory.at(target.memory).data() + target.offset + region.dstOffset,
                    fake->memory.at(source.memory).data() + source.offset + region.srcOffset, region.size);
    }
}
VKAPI_ATTR VkDeviceAddress VKAPI_CALL bufferAddress(VkDevice, const VkBufferDeviceAddressInfo* info) {
    return std::bit_cast<uintptr_t>(info->buffer) << 32u;
}
VKAPI_ATTR void VKAPI_CALL bindPipeline(VkCommandBuffer, VkPipelineBindPoint, VkPipeline) {}
VKAPI_ATTR void VKAPI_CALL pushConstants(VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags, uint32_t, uint32_t,
                                         const void*) {}

} // namespace

FakeVulkan::FakeVulkan() {
    fake = this;
    Functions& vk = device.vk;
    vk.GetPhysicalDeviceProperties2 = deviceProperties;
    vk.CreateBuffer = createBuffer;
    vk.DestroyBuffer = destroyBuffer;
    vk.GetBufferMemoryRequirements = bufferRequirements;
    vk.AllocateMemory = allocateMemory;
    vk.FreeMemory = freeMemory;
    vk.BindBufferMemory = bindBufferMemory;
    vk.MapMemory = mapMemory;
    vk.CreateBufferView = createBufferView;
    vk.DestroyBufferView = destroyBufferView;
    vk.CreateShaderModule = createShaderModule;
    vk.DestroyShaderModule = destroyShaderModule;
    vk.CreateDescriptorSetLayout = createSetLayout;
    vk.DestroyDescriptorSetLayout = destroySetLayout;
    vk.CreatePipelineLayout = createPipelineLayout;
    vk.DestroyPipelineLayout = destroyPipelineLayout;
    vk.CreateComputePipelines = createPipelines;
    vk.DestroyPipeline = destroyPipeline;
    vk.CreateDescriptorPool = createPool;
    vk.DestroyDescriptorPool = destroyPool;
    vk.CreateQueryPool = createQueryPool;
    vk.DestroyQueryPool = destroyQueryPool;
    vk.GetQueryPoolResults = queryPoolResults;
    vk.CmdCopyQueryPoolResults = copyQueryPoolResults;
    vk.CmdWriteTimestamp = writeTimestamp;
    vk.CmdResetQueryPool = resetQueryPool;
    vk.CmdPipelineBarrier = pipelineBarrier;
    vk.CmdDispatch = dispatch;
    vk.CmdCopyBuffer = copyBuffer;
    vk.GetBufferDeviceAddress = bufferAddress;
    vk.CmdBindPipeline = bindPipeline;
    vk.CmdPushConstants = pushConstants;

    constexpr VkDeviceSize kGiB = VkDeviceSize{1} << 30;
    device.maxBufferSize = kGiB;
    device.maxAllocationSize = kGiB;
    device.memory.memoryHeapCount = 1;
    device.memory.memoryHeaps[0].size = kGiB;
    device.memory.memoryTypeCount = 1;
    device.memory.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                 VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    device.limits.maxComputeWorkGroupCount[0] = 65535;
    device.limits.maxTexelBufferElements = 65536;
    device.limits.maxStorageBufferRange = 1u << 27;
}

FakeVulkan::~FakeVulkan() {
    fake = nullptr;
}

} // namespace supple::gpu::test
