/* VkAllocationCallbacks over malloc that count what is held: the host's memory as Vulkan and Supple take it. */
#ifndef HOST_CALLBACKS_H
#define HOST_CALLBACKS_H

#include <vulkan/vulkan.h>

typedef struct HostCallbackCounts {
    size_t allocations; /* held now */
    size_t bytes;       /* held now */
    size_t calls;       /* allocations and reallocations ever made */
} HostCallbackCounts;

/* One for the process, valid on every thread. */
const VkAllocationCallbacks* hostCallbacks(void);
HostCallbackCounts hostCallbackCounts(void);

#endif
