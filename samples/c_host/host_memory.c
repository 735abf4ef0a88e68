#include "host_memory.h"

#include <stdio.h>
#include <stdlib.h>

#define DEFAULT_BLOCK_SIZE ((VkDeviceSize)16 << 20)

/* A run of bytes of a block, free or taken. The runs of a block follow each other without gaps, and two free ones are
 * never neighbors. */
struct HostAllocation_T {
    struct HostAllocation_T* previous;
    struct HostAllocation_T* next;
    struct HostBlock* block;
    VkDeviceSize offset;
    VkDeviceSize size;
    int taken;
};

typedef struct HostBlock {
    struct HostBlock* next;
    uint32_t memoryType;
    VkDeviceMemory memory;
    VkDeviceSize size;
    char* mapped;
    HostAllocation first;
} HostBlock;

struct HostAllocator_T {
    VkDevice device;
    const VkAllocationCallbacks* callbacks;
    VkPhysicalDeviceMemoryProperties properties;
    VkDeviceSize blockSize;
    HostBlock* blocks;
};

static VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

VkResult hostCreateAllocator(const HostAllocatorCreateInfo* pCreateInfo, HostAllocator* pAllocator) {
    HostAllocator allocator = (HostAllocator)calloc(1, sizeof *allocator);
    if (allocator == NULL) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    allocator->device = pCreateInfo->device;
    allocator->callbacks = pCreateInfo->pAllocationCallbacks;
    allocator->blockSize =
        pCreateInfo->preferredLargeHeapBlockSize != 0 ? pCreateInfo->preferredLargeHeapBlockSize : DEFAULT_BLOCK_SIZE;
    vkGetPhysicalDeviceMemoryProperties(pCreateInfo->physicalDevice, &allocator->properties);
    *pAllocator = allocator;
    return VK_SUCCESS;
}

static void destroyBlock(HostAllocator allocator, HostBlock* block) {
    HostAllocation run = block->first;
    while (run != NULL) {
        HostAllocation next = run->next;
        free(run);
        run = next;
    }
    vkFreeMemory(allocator->device, block->memory, allocator->callbacks); /* unmaps */
    free(block);
}

void hostDestroyAllocator(HostAllocator allocator) {
    HostStatistics statistics;
    hostCalculateStatistics(allocator, &statistics);
    if (statistics.allocationCount != 0) {
        fprintf(stderr, "host memory: %u allocations were never freed\n", statistics.allocationCount);
    }
    while (allocator->blocks != NULL) {
        HostBlock* block = allocator->blocks;
        allocator->blocks = block->next;
        destroyBlock(allocator, block);
    }
    free(allocator);
}

/* The first type that has all that is required and most of what is preferred; VK_MAX_MEMORY_TYPES: there is none. */
static uint32_t findMemoryType(HostAllocator allocator, uint32_t bits, const HostAllocationCreateInfo* info) {
    uint32_t best = VK_MAX_MEMORY_TYPES;
    int bestMissing = 33;
    uint32_t type;
    for (type = 0; type < allocator->properties.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = allocator->properties.memoryTypes[type].propertyFlags;
        VkMemoryPropertyFlags missing = info->preferredFlags & ~flags;
        int count = 0;
        if ((bits >> type & 1u) == 0 || (flags & info->requiredFlags) != info->requiredFlags) {
            continue;
        }
        for (; missing != 0; missing &= missing - 1) {
            ++count;
        }
        if (count < bestMissing) {
            bestMissing = count;
            best = type;
        }
    }
    return best;
}

static VkResult createBlock(HostAllocator allocator, uint32_t type, VkDeviceSize size, HostBlock** out) {
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    HostBlock* block = (HostBlock*)calloc(1, sizeof *block);
    HostAllocation run = (HostAllocation)calloc(1, sizeof *run);
    VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
    if (block == NULL || run == NULL) {
        goto failed;
    }
    info.allocationSize = size;
    info.memoryTypeIndex = type;
    result = vkAllocateMemory(allocator->device, &info, allocator->callbacks, &block->memory);
    if (result != VK_SUCCESS) {
        goto failed;
    }
    if ((allocator->properties.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = NULL;
        result = vkMapMemory(allocator->device, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            vkFreeMemory(allocator->device, block->memory, allocator->callbacks);
            goto failed;
        }
        block->mapped = (char*)mapped;
    }
    run->block = block;
    run->size = size;
    block->memoryType = type;
    block->size = size;
    block->first = run;
    block->next = allocator->blocks;
    allocator->blocks = block;
    *out = block;
    return VK_SUCCESS;

failed:
    free(block);
    free(run);
    return result;
}

/* Cuts `size` bytes off the front of a free run; what is left becomes a run of its own. */
static int cutFront(HostAllocation run, VkDeviceSize size) {
    HostAllocation rest;
    if (run->size == size) {
        return 1;
    }
    rest = (HostAllocation)calloc(1, sizeof *rest);
    if (rest == NULL) {
        return 0;
    }
    rest->block = run->block;
    rest->offset = run->offset + size;
    rest->size = run->size - size;
    rest->previous = run;
    rest->next = run->next;
    if (rest->next != NULL) {
        rest->next->previous = rest;
    }
    run->next = rest;
    run->size = size;
    return 1;
}

static void joinWithNext(HostAllocation run) {
    HostAllocation next = run->next;
    run->size += next->size;
    run->next = next->next;
    if (run->next != NULL) {
        run->next->previous = run;
    }
    free(next);
}

/* First fit. NULL: the block has no such run, or the host no memory. */
static HostAllocation takeRun(HostBlock* block, VkDeviceSize size, VkDeviceSize alignment) {
    HostAllocation run;
    for (run = block->first; run != NULL; run = run->next) {
        const VkDeviceSize pad = alignUp(run->offset, alignment) - run->offset;
        if (run->taken || run->size < pad + size) {
            continue;
        }
        if (pad != 0) {
            if (!cutFront(run, pad)) {
                return NULL;
            }
            run = run->next;
        }
        if (!cutFront(run, size)) {
            return NULL;
        }
        run->taken = 1;
        return run;
    }
    return NULL;
}

VkResult hostAllocateMemory(HostAllocator allocator, const VkMemoryRequirements* pVkMemoryRequirements,
                            const HostAllocationCreateInfo* pCreateInfo, HostAllocation* pAllocation,
                            HostAllocationInfo* pAllocationInfo) {
    const VkDeviceSize size = pVkMemoryRequirements->size;
    const VkDeviceSize alignment = pVkMemoryRequirements->alignment;
    const uint32_t type = findMemoryType(allocator, pVkMemoryRequirements->memoryTypeBits, pCreateInfo);
    HostAllocation run = NULL;
    HostBlock* block;
    if (type == VK_MAX_MEMORY_TYPES) {
        return VK_ERROR_FEATURE_NOT_PRESENT; /* as VMA has it */
    }
    for (block = allocator->blocks; block != NULL && run == NULL; block = block->next) {
        if (block->memoryType == type) {
            run = takeRun(block, size, alignment);
        }
    }
    if (run == NULL) {
        /* What is larger than half a block gets one of its own. */
        const int own = size > allocator->blockSize / 2;
        const VkResult result = createBlock(allocator, type, own ? size : allocator->blockSize, &block);
        if (result != VK_SUCCESS) {
            return result;
        }
        run = takeRun(block, size, alignment);
        if (run == NULL) {
            return VK_ERROR_OUT_OF_HOST_MEMORY;
        }
    }
    if (pAllocationInfo != NULL) {
        pAllocationInfo->memoryType = type;
        pAllocationInfo->deviceMemory = run->block->memory;
        pAllocationInfo->offset = run->offset;
        pAllocationInfo->size = run->size;
        pAllocationInfo->pMappedData = NULL;
        if ((pCreateInfo->flags & HOST_ALLOCATION_CREATE_MAPPED_BIT) != 0 && run->block->mapped != NULL) {
            pAllocationInfo->pMappedData = run->block->mapped + run->offset;
        }
    }
    *pAllocation = run;
    return VK_SUCCESS;
}

void hostFreeMemory(HostAllocator allocator, HostAllocation allocation) {
    HostBlock* block = allocation->block;
    HostBlock** link;
    allocation->taken = 0;
    if (allocation->next != NULL && !allocation->next->taken) {
        joinWithNext(allocation);
    }
    if (allocation->previous != NULL && !allocation->previous->taken) {
        joinWithNext(allocation->previous);
    }
    if (block->first->taken || block->first->next != NULL) {
        return;
    }
    for (link = &allocator->blocks; *link != block; link = &(*link)->next) {
    }
    *link = block->next;
    destroyBlock(allocator, block);
}

void hostCalculateStatistics(HostAllocator allocator, HostStatistics* pStats) {
    const HostStatistics none = {0, 0, 0, 0};
    const HostBlock* block;
    HostAllocation run;
    *pStats = none;
    for (block = allocator->blocks; block != NULL; block = block->next) {
        ++pStats->blockCount;
        pStats->blockBytes += block->size;
        for (run = block->first; run != NULL; run = run->next) {
            pStats->allocationCount += run->taken ? 1 : 0;
            pStats->allocationBytes += run->taken ? run->size : 0;
        }
    }
}
