/*
 * Device memory in blocks: one vkAllocateMemory serves many buffers. Names, structs and signatures are those of the
 * Vulkan Memory Allocator with "host" for "vma", as far as they go, so that a host that has VMA sees what to replace:
 *
 *     HostAllocator              VmaAllocator
 *     HostAllocationCreateInfo   VmaAllocationCreateInfo (requiredFlags, preferredFlags, flags)
 *     HostAllocationInfo         VmaAllocationInfo
 *     hostAllocateMemory         vmaAllocateMemory
 *     hostFreeMemory             vmaFreeMemory
 *     hostCalculateStatistics    vmaCalculateStatistics
 *
 * For buffers only: next to images, bufferImageGranularity would count. One thread at a time.
 */
#ifndef HOST_MEMORY_H
#define HOST_MEMORY_H

#include <vulkan/vulkan.h>

typedef struct HostAllocator_T* HostAllocator;
typedef struct HostAllocation_T* HostAllocation;

typedef struct HostAllocatorCreateInfo {
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    VkDeviceSize preferredLargeHeapBlockSize; /* 0: 16 MiB */
    const VkAllocationCallbacks* pAllocationCallbacks;
} HostAllocatorCreateInfo;

typedef enum HostAllocationCreateFlagBits {
    HOST_ALLOCATION_CREATE_MAPPED_BIT = 0x4 /* as VMA_ALLOCATION_CREATE_MAPPED_BIT */
} HostAllocationCreateFlagBits;

typedef struct HostAllocationCreateInfo {
    VkFlags flags;
    VkMemoryPropertyFlags requiredFlags;
    VkMemoryPropertyFlags preferredFlags;
} HostAllocationCreateInfo;

typedef struct HostAllocationInfo {
    uint32_t memoryType;
    VkDeviceMemory deviceMemory;
    VkDeviceSize offset;
    VkDeviceSize size;
    void* pMappedData; /* with MAPPED_BIT, of host-visible memory: until freed; else null */
} HostAllocationInfo;

typedef struct HostStatistics {
    uint32_t blockCount;
    uint32_t allocationCount;
    VkDeviceSize blockBytes;
    VkDeviceSize allocationBytes;
} HostStatistics;

VkResult hostCreateAllocator(const HostAllocatorCreateInfo* pCreateInfo, HostAllocator* pAllocator);
/* What is still allocated is named on stderr and freed. */
void hostDestroyAllocator(HostAllocator allocator);

VkResult hostAllocateMemory(HostAllocator allocator, const VkMemoryRequirements* pVkMemoryRequirements,
                            const HostAllocationCreateInfo* pCreateInfo, HostAllocation* pAllocation,
                            HostAllocationInfo* pAllocationInfo);
void hostFreeMemory(HostAllocator allocator, HostAllocation allocation);
void hostCalculateStatistics(HostAllocator allocator, HostStatistics* pStats);

#endif
