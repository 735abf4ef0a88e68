#include "host_device.h"
#include "host_file.h"

#include <string.h>

static int validationMessages = 0;

int hostValidationMessages(void) {
    return validationMessages;
}

/* The layer calls one thread at a time. */
static VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT type,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    (void)severity;
    (void)type;
    (void)user;
    ++validationMessages;
    fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

static VkDebugUtilsMessengerCreateInfoEXT messengerInfo(void) {
    VkDebugUtilsMessengerCreateInfoEXT info = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onValidation;
    return info;
}

static int validationWanted(void) {
    const char* value = getenv("SUPPLE_VALIDATION");
    return value != NULL && value[0] != '\0' && strcmp(value, "0") != 0;
}

static void createInstance(HostDevice* host, int validate) {
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo();
    VkValidationFeaturesEXT features = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO};
    VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};

    application.pApplicationName = "supple_c_host";
    application.apiVersion = VK_API_VERSION_1_1;
    info.pApplicationInfo = &application;
    if (validate) {
        features.enabledValidationFeatureCount = 1;
        features.pEnabledValidationFeatures = &synchronization;
        features.pNext = &messenger; /* listens while the instance is created and destroyed */
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        info.enabledExtensionCount = 2;
        info.ppEnabledExtensionNames = extensions;
    }
    CHECK_VK(vkCreateInstance(&info, host->callbacks, &host->instance));
    if (validate) {
        PFN_vkCreateDebugUtilsMessengerEXT create =
            (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->instance, "vkCreateDebugUtilsMessengerEXT");
        messenger = messengerInfo();
        CHECK_VK(create(host->instance, &messenger, host->callbacks, &host->messenger));
    }
}

/* The first device that Supple can use. */
static void pickPhysicalDevice(HostDevice* host) {
    VkPhysicalDevice devices[16];
    SuppleRequirements requirements = {.structSize = sizeof requirements, .instanceVersion = VK_API_VERSION_1_1};
    uint32_t count = 16;
    uint32_t i;
    const VkResult result = vkEnumeratePhysicalDevices(host->instance, &count, devices);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE) {
        count = 0;
    }
    for (i = 0; i < count; ++i) {
        if (suppleQueryRequirements(host->instance, devices[i], vkGetInstanceProcAddr, &requirements) == SUPPLE_OK) {
            host->physicalDevice = devices[i];
            return;
        }
        fprintf(stderr, "device %u will not do: %s\n", i, requirements.reason);
    }
    fprintf(stderr, "no suitable Vulkan device\n");
    exit(3);
}

static void pickQueueFamily(HostDevice* host) {
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(host->physicalDevice, &count, families);
    for (host->queueFamily = 0; host->queueFamily < count; ++host->queueFamily) {
        if ((families[host->queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) {
            return;
        }
    }
    fprintf(stderr, "no compute queue\n");
    exit(3);
}

/* A device without any feature: Supple asks for none. A host adds what it needs itself, and hands that chain to
 * SuppleContextDesc.enabledFeatures. */
static void createDevice(HostDevice* host) {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    queue.queueFamilyIndex = host->queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    CHECK_VK(vkCreateDevice(host->physicalDevice, &info, host->callbacks, &host->device));
    vkGetDeviceQueue(host->device, host->queueFamily, 0, &host->queue);
}

static void createPipelineCache(HostDevice* host, const char* path) {
    VkPipelineCacheCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    void* bytes = hostReadFile(path, &info.initialDataSize);
    info.pInitialData = bytes;
    /* The driver looks at the header, and takes nothing that is not its own. */
    CHECK_VK(vkCreatePipelineCache(host->device, &info, host->callbacks, &host->pipelineCache));
    if (path != NULL) {
        printf("pipeline cache: %lu bytes read\n", (unsigned long)info.initialDataSize);
    }
    free(bytes);
}

static void savePipelineCache(HostDevice* host, const char* path) {
    FILE* file;
    void* bytes;
    size_t size = 0;
    CHECK_VK(vkGetPipelineCacheData(host->device, host->pipelineCache, &size, NULL));
    bytes = malloc(size);
    file = fopen(path, "wb");
    if (bytes != NULL && file != NULL &&
        vkGetPipelineCacheData(host->device, host->pipelineCache, &size, bytes) == VK_SUCCESS &&
        fwrite(bytes, 1, size, file) == size) {
        printf("pipeline cache: %lu bytes written\n", (unsigned long)size);
    } else {
        fprintf(stderr, "the pipeline cache could not be saved to %s\n", path);
    }
    if (file != NULL) {
        fclose(file);
    }
    free(bytes);
}

void hostCreateDevice(HostDevice* out, const VkAllocationCallbacks* callbacks, const char* cachePath) {
    memset(out, 0, sizeof *out);
    out->callbacks = callbacks;
    createInstance(out, validationWanted());
    pickPhysicalDevice(out);
    pickQueueFamily(out);
    createDevice(out);
    createPipelineCache(out, cachePath);
}

void hostDestroyDevice(HostDevice* device, const char* cachePath) {
    if (cachePath != NULL) {
        savePipelineCache(device, cachePath);
    }
    vkDestroyPipelineCache(device->device, device->pipelineCache, device->callbacks);
    vkDestroyDevice(device->device, device->callbacks);
    if (device->messenger != VK_NULL_HANDLE) {
        PFN_vkDestroyDebugUtilsMessengerEXT destroy = (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
            device->instance, "vkDestroyDebugUtilsMessengerEXT");
        destroy(device->instance, device->messenger, device->callbacks);
    }
    vkDestroyInstance(device->instance, device->callbacks);
}
