/* The host's Vulkan: instance, device, queue, pipeline cache. Nothing of it is Supple's. */
#ifndef HOST_DEVICE_H
#define HOST_DEVICE_H

#include <stdio.h>
#include <stdlib.h>
#include <supple/supple.h>
#include <vulkan/vulkan.h>

/* Samples may stop at the first failure: the process ends and takes everything with it. */
#define CHECK_VK(call)                                                                                                 \
    do {                                                                                                               \
        VkResult result_ = (call);                                                                                     \
        if (result_ != VK_SUCCESS) {                                                                                   \
            fprintf(stderr, "%s failed: VkResult %d\n", #call, (int)result_);                                          \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

#define CHECK_SUPPLE(call)                                                                                             \
    do {                                                                                                               \
        SuppleResult result_ = (call);                                                                                 \
        if (result_ != SUPPLE_OK) {                                                                                    \
            fprintf(stderr, "%s failed: %s\n", #call, suppleResultString(result_));                                    \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

typedef struct HostDevice {
    const VkAllocationCallbacks* callbacks;
    VkInstance instance;
    VkDebugUtilsMessengerEXT messenger; /* null without validation */
    VkPhysicalDevice physicalDevice;
    uint32_t queueFamily;
    VkDevice device;
    VkQueue queue;
    VkPipelineCache pipelineCache;
} HostDevice;

/* With SUPPLE_VALIDATION=1 in the environment the Khronos validation layer runs along. cachePath may be null; a file
 * that is not there, or of another driver, makes an empty cache. */
void hostCreateDevice(HostDevice* out, const VkAllocationCallbacks* callbacks, const char* cachePath);
/* Saves the pipeline cache. */
void hostDestroyDevice(HostDevice* device, const char* cachePath);
/* Messages of the validation layer so far. */
int hostValidationMessages(void);

#endif
