/*
 * The smallest host of Supple, in C99 with plain libvulkan: creates an instance and a device, gives Supple a cube as
 * control cage, records a few frames with two in flight, copies the first surface vertex back and prints it.
 *
 * With SUPPLE_VALIDATION=1 in the environment the Khronos validation layer runs along, and any message is a failure.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <supple/supple.h>
#include <vulkan/vulkan.h>

#define FRAMES_IN_FLIGHT 2
#define FRAME_COUNT 5

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

static int validationMessages = 0;

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

static void onLog(SuppleSeverity severity, const char* text, void* user) {
    (void)user;
    if (severity != SUPPLE_SEVERITY_INFO) {
        fprintf(stderr, "%s\n", text);
    }
}

static int validationWanted(void) {
    const char* value = getenv("SUPPLE_VALIDATION");
    return value != NULL && value[0] != '\0' && strcmp(value, "0") != 0;
}

static VkInstance createInstance(int validate) {
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkDebugUtilsMessengerCreateInfoEXT messenger = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO};
    VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    VkInstance instance;

    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = onValidation;
    application.pApplicationName = "supple_c_consumer";
    application.apiVersion = VK_API_VERSION_1_3;
    info.pApplicationInfo = &application;
    if (validate) {
        info.pNext = &messenger; /* listens while the instance is created and destroyed */
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    CHECK_VK(vkCreateInstance(&info, NULL, &instance));
    return instance;
}

/* Listens from now until the instance is destroyed. */
static VkDebugUtilsMessengerEXT createMessenger(VkInstance instance) {
    PFN_vkCreateDebugUtilsMessengerEXT create =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT");
    VkDebugUtilsMessengerCreateInfoEXT info = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    VkDebugUtilsMessengerEXT messenger;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onValidation;
    CHECK_VK(create(instance, &info, NULL, &messenger));
    return messenger;
}

static void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger) {
    PFN_vkDestroyDebugUtilsMessengerEXT destroy =
        (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT");
    destroy(instance, messenger, NULL);
}

/* The first device that Supple can use. requirements is left filled for it. */
static VkPhysicalDevice pickDevice(VkInstance instance, SuppleRequirements* requirements) {
    VkPhysicalDevice devices[16];
    uint32_t count = 16;
    uint32_t i;
    const VkResult result = vkEnumeratePhysicalDevices(instance, &count, devices);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE) {
        count = 0;
    }
    for (i = 0; i < count; ++i) {
        requirements->structSize = sizeof *requirements;
        if (suppleQueryRequirements(instance, devices[i], vkGetInstanceProcAddr, requirements) == SUPPLE_OK) {
            return devices[i];
        }
        fprintf(stderr, "device %u will not do: %s\n", i, requirements->reason);
    }
    fprintf(stderr, "no suitable Vulkan device\n");
    exit(3);
}

static uint32_t computeFamily(VkPhysicalDevice physicalDevice) {
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    uint32_t i;
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &count, families);
    for (i = 0; i < count; ++i) {
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) {
            return i;
        }
    }
    fprintf(stderr, "no compute queue\n");
    exit(3);
}

/* A device with exactly what Supple asks for: its feature structs are chained as they are. */
static VkDevice createDevice(VkPhysicalDevice physicalDevice, uint32_t family, SuppleRequirements* requirements) {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    VkDevice device;
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    requirements->features12.pNext = &requirements->features13;
    info.pNext = &requirements->features12;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    CHECK_VK(vkCreateDevice(physicalDevice, &info, NULL, &device));
    return device;
}

static SuppleAsset createCube(SuppleContext context) {
    static const float positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                      -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
    static const uint32_t counts[] = {4, 4, 4, 4, 4, 4};
    static const uint32_t indices[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
    SuppleCageDesc cage = {0};
    SuppleAssetDesc desc = {0};
    SuppleAsset asset;
    cage.structSize = sizeof cage;
    cage.vertexCount = 8;
    cage.faceCount = 6;
    cage.positions = positions;
    cage.faceVertexCounts = counts;
    cage.faceVertexIndices = indices;
    desc.structSize = sizeof desc;
    desc.name = "cube";
    desc.cage = &cage;
    CHECK_SUPPLE(suppleCreateAsset(context, &desc, &asset));
    return asset;
}

typedef struct Readback {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void* mapped;
} Readback;

static Readback createReadback(VkPhysicalDevice physicalDevice, VkDevice device, VkDeviceSize size) {
    const VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkMemoryRequirements needs;
    VkPhysicalDeviceMemoryProperties types;
    Readback readback;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    CHECK_VK(vkCreateBuffer(device, &info, NULL, &readback.buffer));
    vkGetBufferMemoryRequirements(device, readback.buffer, &needs);
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &types);
    allocation.allocationSize = needs.size;
    /* Vulkan guarantees such a type, so the loop ends on one. */
    while ((needs.memoryTypeBits >> allocation.memoryTypeIndex & 1u) == 0 ||
           (types.memoryTypes[allocation.memoryTypeIndex].propertyFlags & wanted) != wanted) {
        ++allocation.memoryTypeIndex;
    }
    CHECK_VK(vkAllocateMemory(device, &allocation, NULL, &readback.memory));
    CHECK_VK(vkBindBufferMemory(device, readback.buffer, readback.memory, 0));
    CHECK_VK(vkMapMemory(device, readback.memory, 0, VK_WHOLE_SIZE, 0, &readback.mapped));
    return readback;
}

/* One frame: pose, let Supple record its passes, copy the first surface vertex. */
static void recordFrame(SuppleContext context, SuppleGroup group, VkCommandBuffer commands, VkBuffer target,
                        uint64_t frame) {
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    SuppleRecordDesc record = {0};
    SuppleGroupOutput output = {0};
    VkBufferCopy region = {0};
    VkMemoryBarrier2 toHost = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    transform[13] = (float)frame; /* the cube rises by one a frame */
    CHECK_SUPPLE(suppleSetTransform(context, group, 0, transform));

    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    CHECK_VK(vkBeginCommandBuffer(commands, &begin));
    record.structSize = sizeof record;
    record.groups = &group;
    record.groupCount = 1;
    record.before.stages = VK_PIPELINE_STAGE_2_COPY_BIT; /* the last frame's copy must have read before we overwrite */
    record.before.access = VK_ACCESS_2_TRANSFER_READ_BIT;
    record.after.stages = VK_PIPELINE_STAGE_2_COPY_BIT;
    record.after.access = VK_ACCESS_2_TRANSFER_READ_BIT;
    CHECK_SUPPLE(suppleRecord(context, commands, &record));

    output.structSize = sizeof output;
    CHECK_SUPPLE(suppleGetGroupOutput(context, group, &output));
    region.srcOffset = output.surfaceVertices.offset;
    region.dstOffset = (frame % FRAMES_IN_FLIGHT) * output.surfaceVertices.stride;
    region.size = output.surfaceVertices.stride;
    vkCmdCopyBuffer(commands, output.surfaceVertices.buffer, target, 1, &region);

    toHost.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    toHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &toHost;
    vkCmdPipelineBarrier2(commands, &dependency);
    CHECK_VK(vkEndCommandBuffer(commands));
}

int main(void) {
    const int validate = validationWanted();
    const VkInstance instance = createInstance(validate);
    VkDebugUtilsMessengerEXT messenger = validate ? createMessenger(instance) : VK_NULL_HANDLE;
    SuppleRequirements requirements;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    VkQueue queue;
    uint32_t family;
    VkCommandPoolCreateInfo poolInfo = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandBufferAllocateInfo commandInfo = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    VkFenceCreateInfo fenceInfo = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkCommandPool pool;
    VkCommandBuffer commands[FRAMES_IN_FLIGHT];
    VkFence fences[FRAMES_IN_FLIGHT];
    SuppleContextDesc contextDesc = {0};
    SuppleGroupDesc groupDesc = {0};
    SuppleGroupOutput output = {0};
    SuppleContext context;
    SuppleAsset asset;
    SuppleGroup group;
    Readback readback;
    float vertex[6];
    uint64_t frame;
    int i;

    memset(&requirements, 0, sizeof requirements);
    physicalDevice = pickDevice(instance, &requirements);
    family = computeFamily(physicalDevice);
    device = createDevice(physicalDevice, family, &requirements);
    vkGetDeviceQueue(device, family, 0, &queue);

    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = family;
    CHECK_VK(vkCreateCommandPool(device, &poolInfo, NULL, &pool));
    commandInfo.commandPool = pool;
    commandInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commandInfo.commandBufferCount = FRAMES_IN_FLIGHT;
    CHECK_VK(vkAllocateCommandBuffers(device, &commandInfo, commands));
    fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT; /* the first wait of each must pass */
    for (i = 0; i < FRAMES_IN_FLIGHT; ++i) {
        CHECK_VK(vkCreateFence(device, &fenceInfo, NULL, &fences[i]));
    }

    contextDesc.structSize = sizeof contextDesc;
    contextDesc.instance = instance;
    contextDesc.physicalDevice = physicalDevice;
    contextDesc.device = device;
    contextDesc.queueFamily = family;
    contextDesc.getInstanceProcAddr = vkGetInstanceProcAddr;
    contextDesc.framesInFlight = FRAMES_IN_FLIGHT;
    contextDesc.log = onLog;
    CHECK_SUPPLE(suppleCreateContext(&contextDesc, &context));
    asset = createCube(context);
    groupDesc.structSize = sizeof groupDesc;
    groupDesc.asset = asset;
    groupDesc.instanceCount = 1;
    groupDesc.vertexFormat = SUPPLE_VERTEX_24;
    CHECK_SUPPLE(suppleCreateGroup(context, &groupDesc, &group));
    output.structSize = sizeof output;
    CHECK_SUPPLE(suppleGetGroupOutput(context, group, &output));
    readback = createReadback(physicalDevice, device, FRAMES_IN_FLIGHT * sizeof vertex);

    for (frame = 1; frame <= FRAME_COUNT; ++frame) {
        const uint32_t slot = (uint32_t)(frame % FRAMES_IN_FLIGHT);
        const uint64_t completed = frame > FRAMES_IN_FLIGHT ? frame - FRAMES_IN_FLIGHT : 0;
        VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO};
        CHECK_VK(vkWaitForFences(device, 1, &fences[slot], VK_TRUE, UINT64_MAX));
        CHECK_VK(vkResetFences(device, 1, &fences[slot]));
        CHECK_SUPPLE(suppleBeginFrame(context, frame, completed));
        recordFrame(context, group, commands[slot], readback.buffer, frame);
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands[slot];
        CHECK_VK(vkQueueSubmit(queue, 1, &submit, fences[slot]));
    }
    CHECK_VK(vkDeviceWaitIdle(device));

    memcpy(vertex, (const char*)readback.mapped + (FRAME_COUNT % FRAMES_IN_FLIGHT) * sizeof vertex, sizeof vertex);
    printf("%u surface vertices, the first at (%.6f, %.6f, %.6f) with normal (%.6f, %.6f, %.6f)\n",
           output.vertexCount, vertex[0], vertex[1], vertex[2], vertex[3], vertex[4],
           vertex[5]);

    CHECK_SUPPLE(suppleDestroyGroup(context, group));
    CHECK_SUPPLE(suppleDestroyAsset(context, asset));
    suppleDestroyContext(context);
    for (i = 0; i < FRAMES_IN_FLIGHT; ++i) {
        vkDestroyFence(device, fences[i], NULL);
    }
    vkDestroyBuffer(device, readback.buffer, NULL);
    vkFreeMemory(device, readback.memory, NULL);
    vkDestroyCommandPool(device, pool, NULL);
    vkDestroyDevice(device, NULL);
    if (validate) {
        destroyMessenger(instance, messenger);
    }
    vkDestroyInstance(instance, NULL);

    /* A corner of the unit cube has its limit point half way out; the cube stands FRAME_COUNT high by now. */
    for (i = 0; i < 3; ++i) {
        const float centre = i == 1 ? (float)FRAME_COUNT : 0.0f;
        if (fabsf(fabsf(vertex[i] - centre) - 0.5f) > 1e-5f) {
            fprintf(stderr, "failed: component %d is %f\n", i, vertex[i]);
            return 1;
        }
    }
    if (validationMessages != 0) {
        fprintf(stderr, "failed: %d validation messages\n", validationMessages);
        return 1;
    }
    return 0;
}
