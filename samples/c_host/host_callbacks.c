#include "host_callbacks.h"

#include "host_threads.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Stands before every allocation. C99 has no aligned allocation, so the block is larger and remembers where it began.
 */
typedef struct Header {
    void* start;
    size_t size;
} Header;

static HostMutex mutex = HOST_MUTEX_INITIALIZER;
static HostCallbackCounts counts;

static Header* headerOf(void* pointer) {
    return (Header*)pointer - 1;
}

static VKAPI_ATTR void* VKAPI_CALL hostAllocate(void* user, size_t size, size_t alignment,
                                                VkSystemAllocationScope scope) {
    char* start;
    uintptr_t address;
    (void)user;
    (void)scope;
    if (alignment < sizeof(Header)) {
        alignment = sizeof(Header);
    }
    start = (char*)malloc(sizeof(Header) + alignment + size);
    if (start == NULL) {
        return NULL;
    }
    address = ((uintptr_t)start + sizeof(Header) + alignment - 1) / alignment * alignment;
    headerOf((void*)address)->start = start;
    headerOf((void*)address)->size = size;
    hostLock(&mutex);
    ++counts.allocations;
    ++counts.calls;
    counts.bytes += size;
    hostUnlock(&mutex);
    return (void*)address;
}

static VKAPI_ATTR void VKAPI_CALL hostFree(void* user, void* pointer) {
    (void)user;
    if (pointer == NULL) {
        return;
    }
    hostLock(&mutex);
    --counts.allocations;
    counts.bytes -= headerOf(pointer)->size;
    hostUnlock(&mutex);
    free(headerOf(pointer)->start);
}

static VKAPI_ATTR void* VKAPI_CALL hostReallocate(void* user, void* original, size_t size, size_t alignment,
                                                  VkSystemAllocationScope scope) {
    void* moved;
    if (size == 0) {
        hostFree(user, original);
        return NULL;
    }
    moved = hostAllocate(user, size, alignment, scope);
    if (moved != NULL && original != NULL) {
        const size_t before = headerOf(original)->size;
        memcpy(moved, original, before < size ? before : size);
        hostFree(user, original);
    }
    return moved;
}

const VkAllocationCallbacks* hostCallbacks(void) {
    static const VkAllocationCallbacks callbacks = {NULL, hostAllocate, hostReallocate, hostFree, NULL, NULL};
    return &callbacks;
}

HostCallbackCounts hostCallbackCounts(void) {
    HostCallbackCounts result;
    hostLock(&mutex);
    result = counts;
    hostUnlock(&mutex);
    return result;
}
