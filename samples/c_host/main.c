/*
 * A host of Supple in C99 that uses what a large engine needs of it:
 *
 *   - Supple's device memory comes from the host's allocator (host_memory.h, in the shape of VMA), its host memory from
 *     VkAllocationCallbacks, its pipelines from a cache that is kept in a file (host_device.c) and are made on several
 *     threads;
 *   - the device's feature chain is handed in, so that a feature that was forgotten is named;
 *   - two groups are posed and recorded on two threads, behind one suppleRecordUploads;
 *   - two frames are in flight; instances and a whole group come and go meanwhile;
 *   - budgets and timings.
 *
 * Nothing is drawn. One vertex of each instance looked at is copied back and compared with where it must be.
 */
#define _POSIX_C_SOURCE 200809L

#include "host_callbacks.h"
#include "host_device.h"
#include "host_file.h"
#include "host_jobs.h"
#include "host_memory.h"
#include "host_threads.h"

#include <math.h>
#include <string.h>

#define FRAMES_IN_FLIGHT 2
#define THREADS 2
/* Each thread copies the first surface vertex of the instance that stays, and of the one that came last. */
#define COPIES_PER_THREAD 2

/* ------------------------------------------------------------------------------------------ Supple's callbacks */

static const char* const severities[] = {"info", "warning", "error"};

/* Called on whichever thread calls Supple; stdio takes its own lock. */
static void onLog(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    (void)user;
    if (severity != SUPPLE_SEVERITY_INFO) {
        fprintf(stderr, "supple %s %d: %s\n", severities[severity], (int)message, text);
    }
}

/* With VMA: "vma" for "host" in what follows. */
static VkResult allocateForSupple(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user) {
    HostAllocationCreateInfo createInfo = {0};
    HostAllocationInfo info;
    HostAllocation allocation;
    VkResult result;
    (void)name; /* vmaSetAllocationName */
    createInfo.requiredFlags = required;
    createInfo.preferredFlags = preferred;
    if ((required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        createInfo.flags = HOST_ALLOCATION_CREATE_MAPPED_BIT;
    }
    result = hostAllocateMemory((HostAllocator)user, requirements, &createInfo, &allocation, &info);
    if (result == VK_SUCCESS) {
        out->memory = info.deviceMemory;
        out->offset = info.offset;
        out->mapped = info.pMappedData;
        out->allocation = allocation;
    }
    return result;
}

static void freeForSupple(const SuppleMemory* memory, void* user) {
    hostFreeMemory((HostAllocator)user, (HostAllocation)memory->allocation);
}

/* ------------------------------------------------------------------------------------------ the host's own buffers */

typedef struct Readback {
    VkBuffer buffer;
    HostAllocation allocation;
    const char* mapped;
} Readback;

static Readback createReadback(const HostDevice* host, HostAllocator memory, VkDeviceSize size) {
    VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    HostAllocationCreateInfo allocationInfo = {0};
    HostAllocationInfo allocation;
    VkMemoryRequirements needs;
    Readback readback;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    CHECK_VK(vkCreateBuffer(host->device, &info, host->callbacks, &readback.buffer));
    vkGetBufferMemoryRequirements(host->device, readback.buffer, &needs);
    allocationInfo.flags = HOST_ALLOCATION_CREATE_MAPPED_BIT;
    allocationInfo.requiredFlags = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    allocationInfo.preferredFlags = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    CHECK_VK(hostAllocateMemory(memory, &needs, &allocationInfo, &readback.allocation, &allocation));
    CHECK_VK(vkBindBufferMemory(host->device, readback.buffer, allocation.deviceMemory, allocation.offset));
    readback.mapped = (const char*)allocation.pMappedData;
    return readback;
}

/* ------------------------------------------------------------------------------------------ characters */

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

static SuppleAsset loadCharacter(SuppleContext context, const char* path) {
    SuppleAssetDesc desc = {0};
    SuppleAsset asset;
    void* bytes = hostReadFile(path, &desc.byteCount);
    if (bytes == NULL) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(1);
    }
    desc.structSize = sizeof desc;
    desc.name = path;
    desc.bytes = bytes;
    CHECK_SUPPLE(suppleCreateAsset(context, &desc, &asset));
    free(bytes); /* everything is copied */
    return asset;
}

/* A group, the instance that stays in it, and the newest of those that come and go. */
typedef struct Crowd {
    SuppleGroup group;
    SuppleInstance resident;
    SuppleInstance guests[FRAMES_IN_FLIGHT]; /* one a frame; leaves when the next comes to its place */
    SuppleVertexStreams streams;
    SuppleGridOutput grid;
} Crowd;

static void createCrowd(SuppleContext context, SuppleAsset asset, SuppleScheme scheme, Crowd* crowd) {
    SuppleGroupDesc desc = {0};
    memset(crowd, 0, sizeof *crowd);
    desc.structSize = sizeof desc;
    desc.asset = asset;
    desc.capacity = 1 + FRAMES_IN_FLIGHT;
    desc.scheme = scheme;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    CHECK_SUPPLE(suppleCreateGroup(context, &desc, &crowd->group));
    CHECK_SUPPLE(suppleCreateInstance(context, crowd->group, &crowd->resident));
    /* With a scheme by its name a group has one surface. */
    crowd->streams.structSize = sizeof crowd->streams;
    CHECK_SUPPLE(suppleGetVertexStreams(context, crowd->group, 0, &crowd->streams));
    crowd->grid.structSize = sizeof crowd->grid;
    CHECK_SUPPLE(suppleGetGridOutput(context, crowd->group, 0, &crowd->grid));
}

/* Creating and destroying is one thread's; earlier frames that still read the old guest are not disturbed. */
static void exchangeGuest(SuppleContext context, Crowd* crowd, uint64_t frame) {
    SuppleInstance* guest = &crowd->guests[frame % FRAMES_IN_FLIGHT];
    if (guest->generation != 0) {
        CHECK_SUPPLE(suppleDestroyInstance(context, *guest));
    }
    CHECK_SUPPLE(suppleCreateInstance(context, crowd->group, guest));
}

/* ------------------------------------------------------------------------------------------ recording on threads */

typedef struct Job {
    const HostDevice* host;
    SuppleContext context;
    Crowd* crowd;
    uint32_t clipCount;
    uint64_t frame;
    VkCommandPool pools[FRAMES_IN_FLIGHT]; /* of this thread alone */
    VkCommandBuffer commands[FRAMES_IN_FLIGHT];
    VkBuffer target;
    VkDeviceSize targetOffset; /* of this frame's copies */
} Job;

static void place(Job* job, SuppleInstance instance, float x) {
    float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    transform[12] = x;
    transform[13] = (float)job->frame; /* everyone rises by one a frame */
    if (job->clipCount > 0) {
        CHECK_SUPPLE(suppleSetClipPose(job->context, instance, 0, 0.05 * (double)job->frame));
    }
    CHECK_SUPPLE(suppleSetTransform(job->context, instance, transform));
}

static void copyFirstVertex(const Job* job, VkCommandBuffer commands, SuppleInstance instance, uint32_t place) {
    const SuppleBufferRange* vertices = &job->crowd->streams.vertices;
    VkBufferCopy region = {0};
    region.srcOffset =
        vertices->offset + (VkDeviceSize)instance.slot * job->crowd->grid.verticesPerInstance * vertices->stride;
    region.dstOffset = job->targetOffset + (VkDeviceSize)place * vertices->stride;
    region.size = vertices->stride;
    vkCmdCopyBuffer(commands, vertices->buffer, job->target, 1, &region);
}

/* Poses one group's instances and records its passes, beside the thread that does the same for the other group. */
static void recordCrowd(void* user) {
    Job* job = (Job*)user;
    Crowd* crowd = job->crowd;
    const uint32_t parity = (uint32_t)(job->frame % FRAMES_IN_FLIGHT);
    const SuppleInstance guest = crowd->guests[parity];
    const VkCommandBuffer commands = job->commands[parity];
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkMemoryBarrier toHost = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    SuppleRecordDesc record = {0};

    place(job, crowd->resident, 0.0f);
    place(job, guest, 4.0f);

    CHECK_VK(vkResetCommandPool(job->host->device, job->pools[parity], 0));
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    CHECK_VK(vkBeginCommandBuffer(commands, &begin));
    record.structSize = sizeof record;
    record.flags = SUPPLE_RECORD_TIMINGS;
    record.groups = &crowd->group;
    record.groupCount = 1;
    record.before.stages = VK_PIPELINE_STAGE_TRANSFER_BIT; /* the last frame's copies read before we overwrite */
    record.before.access = VK_ACCESS_TRANSFER_READ_BIT;
    record.after.stages = VK_PIPELINE_STAGE_TRANSFER_BIT;
    record.after.access = VK_ACCESS_TRANSFER_READ_BIT;
    CHECK_SUPPLE(suppleRecord(job->context, commands, &record));
    copyFirstVertex(job, commands, crowd->resident, 0);
    copyFirstVertex(job, commands, guest, 1);
    toHost.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    toHost.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &toHost, 0, NULL,
                         0, NULL);
    CHECK_VK(vkEndCommandBuffer(commands));
}

static void createCommands(const HostDevice* host, VkCommandPool* pool, VkCommandBuffer* commands) {
    VkCommandPoolCreateInfo poolInfo = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    poolInfo.queueFamilyIndex = host->queueFamily;
    CHECK_VK(vkCreateCommandPool(host->device, &poolInfo, host->callbacks, pool));
    info.commandPool = *pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    CHECK_VK(vkAllocateCommandBuffers(host->device, &info, commands));
}

/* ------------------------------------------------------------------------------------------ reports */

static void printMemory(const char* when, HostAllocator memory) {
    HostStatistics device;
    const HostCallbackCounts host = hostCallbackCounts();
    hostCalculateStatistics(memory, &device);
    printf("%-18s device: %u allocations, %.1f MiB in %u blocks of %.1f MiB; host: %lu allocations, %.1f MiB\n", when,
           device.allocationCount, (double)device.allocationBytes / 1048576.0, device.blockCount,
           (double)device.blockBytes / 1048576.0, (unsigned long)host.allocations, (double)host.bytes / 1048576.0);
}

static void printTimings(SuppleContext context) {
    SuppleTiming timings[64];
    SuppleBudget budget = {0};
    uint32_t count = 64;
    uint32_t i;
    const SuppleResult result = suppleGetTimings(context, sizeof timings[0], timings, &count);
    if (result != SUPPLE_OK && result != SUPPLE_INCOMPLETE) {
        printf("no timings: %s\n", suppleResultString(result));
        return;
    }
    for (i = 0; i < count; ++i) {
        printf("frame %lu %-10s gpu %8.3f ms, recorded in %6.3f ms, %7lu points, %8lu bytes\n",
               (unsigned long)timings[i].frame, suppleGetPassName(timings[i].pass),
               (timings[i].gpuEnd - timings[i].gpuBegin) * 1e-6, timings[i].cpuRecord * 1e-6,
               (unsigned long)timings[i].points, (unsigned long)timings[i].bytes);
    }
    budget.structSize = sizeof budget;
    CHECK_SUPPLE(suppleGetBudget(context, SUPPLE_PASS_ALL, &budget));
    printf("budget of a frame %.1f ms: worst %.3f ms, exceeded in %lu of %lu frames\n", budget.limit * 1e-6,
           budget.worst * 1e-6, (unsigned long)budget.framesOver, (unsigned long)budget.framesMeasured);
}

/* The cube's first surface vertex is a corner's limit point: half way out, and as high as the frame. */
static int cubeStandsAt(const float* vertex, float x, float y) {
    const float centre[3] = {x, y, 0.0f};
    int i;
    for (i = 0; i < 3; ++i) {
        if (fabsf(fabsf(vertex[i] - centre[i]) - 0.5f) > 1e-5f) {
            fprintf(stderr, "failed: component %d is %f, about %f\n", i, vertex[i], centre[i]);
            return 0;
        }
    }
    return 1;
}

/* ------------------------------------------------------------------------------------------ the program */

typedef struct Options {
    uint64_t frames;
    const char* cachePath;
    const char* recordPath; /* null: there is no recording */
    const char* characterPath;
} Options;

static void usage(FILE* out) {
    fprintf(out, "usage: supple_c_host [--frames N] [--pipeline-cache FILE] [--record FILE] [CHARACTER.glb]\n"
                 "Without a character: a cube, and its vertices are checked.\n");
}

static Options readOptions(int argc, char** argv) {
    Options options = {12, NULL, NULL, NULL};
    int i;
    for (i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--help") == 0) {
            usage(stdout);
            exit(0);
        } else if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc) {
            options.frames = strtoul(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--pipeline-cache") == 0 && i + 1 < argc) {
            options.cachePath = argv[++i];
        } else if (strcmp(argv[i], "--record") == 0 && i + 1 < argc) {
            options.recordPath = argv[++i];
        } else if (argv[i][0] != '-' && options.characterPath == NULL) {
            options.characterPath = argv[i];
        } else {
            usage(stderr);
            exit(2);
        }
    }
    if (options.frames == 0) {
        usage(stderr);
        exit(2);
    }
    return options;
}

static SuppleContext createContext(const HostDevice* host, HostAllocator memory) {
    SuppleMemoryCallbacks callbacks = {0};
    SuppleContextDesc desc = {0};
    SuppleContext context;
    callbacks.allocate = allocateForSupple;
    callbacks.free = freeForSupple;
    callbacks.user = memory;
    desc.structSize = sizeof desc;
    desc.instance = host->instance;
    desc.physicalDevice = host->physicalDevice;
    desc.device = host->device;
    desc.queueFamily = host->queueFamily;
    desc.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.pipelineCache = host->pipelineCache;
    desc.allocator = host->callbacks;
    desc.framesInFlight = FRAMES_IN_FLIGHT;
    desc.log = onLog;
    desc.memory = &callbacks;
    desc.runJobs = runHostJobs;
    CHECK_SUPPLE(suppleCreateContext(&desc, &context));
    return context;
}

static int appendToFile(const void* bytes, size_t count, void* file) {
    return fwrite(bytes, 1, count, file) == count && fflush(file) == 0;
}

/* All that is done to the context from now on, for supple replay. Null if there is no path. */
static FILE* startRecording(SuppleContext context, const char* path) {
    SuppleRecordingDesc desc = {0};
    FILE* file;
    if (path == NULL) {
        return NULL;
    }
    file = fopen(path, "wb");
    if (file == NULL) {
        fprintf(stderr, "failed: %s cannot be written\n", path);
        exit(1);
    }
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_RECORDING_HASHES;
    desc.write = appendToFile;
    desc.user = file;
    CHECK_SUPPLE(suppleStartRecording(context, &desc));
    return file;
}

/* One frame: guests change, uploads are recorded here, the two groups on two threads, and all is submitted in order. */
static void playFrame(const HostDevice* host, SuppleContext context, Job* jobs, VkCommandPool uploadPool,
                      VkCommandBuffer uploads, VkFence done) {
    const uint32_t parity = (uint32_t)(jobs[0].frame % FRAMES_IN_FLIGHT);
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO};
    VkCommandBuffer order[1 + THREADS];
    HostThread threads[THREADS];
    int i;

    CHECK_VK(vkResetCommandPool(host->device, uploadPool, 0));
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    CHECK_VK(vkBeginCommandBuffer(uploads, &begin));
    CHECK_SUPPLE(suppleRecordUploads(context, uploads));
    CHECK_VK(vkEndCommandBuffer(uploads));
    order[0] = uploads;

    for (i = 0; i < THREADS; ++i) {
        if (!hostStartThread(&threads[i], recordCrowd, &jobs[i])) {
            fprintf(stderr, "no thread\n");
            exit(1);
        }
        order[1 + i] = jobs[i].commands[parity];
    }
    for (i = 0; i < THREADS; ++i) {
        hostJoinThread(&threads[i]);
    }
    submit.commandBufferCount = 1 + THREADS;
    submit.pCommandBuffers = order;
    CHECK_VK(vkQueueSubmit(host->queue, 1, &submit, done));
}

int main(int argc, char** argv) {
    static const SuppleScheme schemes[THREADS] = {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK};
    const Options options = readOptions(argc, argv);
    HostAllocatorCreateInfo memoryInfo = {0};
    SuppleAssetInfo info = {0};
    HostAllocator memory;
    HostDevice host;
    SuppleContext context;
    FILE* recording;
    SuppleAsset asset;
    Crowd crowds[THREADS];
    Job jobs[THREADS];
    Readback readback;
    VkDeviceSize vertexBytes;
    VkCommandPool uploadPools[FRAMES_IN_FLIGHT];
    VkCommandBuffer uploads[FRAMES_IN_FLIGHT];
    VkFence fences[FRAMES_IN_FLIGHT];
    VkFenceCreateInfo fenceInfo = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    uint64_t frame;
    int good = 1;
    int i, j;

    hostCreateDevice(&host, hostCallbacks(), options.cachePath);
    memoryInfo.physicalDevice = host.physicalDevice;
    memoryInfo.device = host.device;
    memoryInfo.pAllocationCallbacks = host.callbacks;
    CHECK_VK(hostCreateAllocator(&memoryInfo, &memory));
    context = createContext(&host, memory);
    recording = startRecording(context, options.recordPath);
    asset = options.characterPath != NULL ? loadCharacter(context, options.characterPath) : createCube(context);
    info.structSize = sizeof info;
    CHECK_SUPPLE(suppleGetAssetInfo(context, asset, &info));
    CHECK_SUPPLE(suppleSetBudget(context, SUPPLE_PASS_ALL, 50e6));

    for (i = 0; i < THREADS; ++i) {
        createCrowd(context, asset, schemes[i], &crowds[i]);
    }
    vertexBytes = crowds[0].streams.vertices.stride;
    readback = createReadback(&host, memory, FRAMES_IN_FLIGHT * THREADS * COPIES_PER_THREAD * vertexBytes);
    fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT; /* the first wait of each must pass */
    memset(jobs, 0, sizeof jobs);
    for (j = 0; j < FRAMES_IN_FLIGHT; ++j) {
        CHECK_VK(vkCreateFence(host.device, &fenceInfo, host.callbacks, &fences[j]));
        createCommands(&host, &uploadPools[j], &uploads[j]);
        for (i = 0; i < THREADS; ++i) {
            createCommands(&host, &jobs[i].pools[j], &jobs[i].commands[j]);
        }
    }
    printMemory("before the frames:", memory);

    for (frame = 1; frame <= options.frames; ++frame) {
        const uint32_t parity = (uint32_t)(frame % FRAMES_IN_FLIGHT);
        CHECK_VK(vkWaitForFences(host.device, 1, &fences[parity], VK_TRUE, UINT64_MAX));
        CHECK_VK(vkResetFences(host.device, 1, &fences[parity]));
        CHECK_SUPPLE(suppleBeginFrame(context, frame, frame > FRAMES_IN_FLIGHT ? frame - FRAMES_IN_FLIGHT : 0));
        if (frame == options.frames / 2 + 1) { /* a group goes while the frame before still draws it, another comes */
            CHECK_SUPPLE(suppleDestroyGroup(context, crowds[1].group));
            createCrowd(context, asset, schemes[1], &crowds[1]);
            printMemory("a group changes:", memory);
        }
        for (i = 0; i < THREADS; ++i) {
            exchangeGuest(context, &crowds[i], frame);
            jobs[i].host = &host;
            jobs[i].context = context;
            jobs[i].crowd = &crowds[i];
            jobs[i].clipCount = info.clipCount;
            jobs[i].frame = frame;
            jobs[i].target = readback.buffer;
            jobs[i].targetOffset = (VkDeviceSize)(parity * THREADS + (uint32_t)i) * COPIES_PER_THREAD * vertexBytes;
        }
        playFrame(&host, context, jobs, uploadPools[parity], uploads[parity], fences[parity]);
    }
    CHECK_VK(vkDeviceWaitIdle(host.device));
    CHECK_SUPPLE(suppleBeginFrame(context, frame, options.frames)); /* frees what is no longer used, reads timestamps */
    printMemory("after the frames:", memory);
    printTimings(context);

    for (i = 0; i < THREADS; ++i) {
        const char* copies = readback.mapped + jobs[i].targetOffset;
        for (j = 0; j < COPIES_PER_THREAD; ++j) {
            float vertex[6];
            memcpy(vertex, copies + (VkDeviceSize)j * vertexBytes, sizeof vertex);
            printf("group %d, %s: first vertex (%.4f, %.4f, %.4f), normal (%.4f, %.4f, %.4f)\n", i,
                   j == 0 ? "resident" : "guest", vertex[0], vertex[1], vertex[2], vertex[3], vertex[4], vertex[5]);
            if (options.characterPath == NULL && !cubeStandsAt(vertex, j == 0 ? 0.0f : 4.0f, (float)options.frames)) {
                good = 0;
            }
        }
    }

    suppleDestroyContext(context); /* and with it assets, groups and the recording */
    if (recording != NULL) {
        fclose(recording);
    }
    for (j = 0; j < FRAMES_IN_FLIGHT; ++j) {
        vkDestroyFence(host.device, fences[j], host.callbacks);
        vkDestroyCommandPool(host.device, uploadPools[j], host.callbacks);
        for (i = 0; i < THREADS; ++i) {
            vkDestroyCommandPool(host.device, jobs[i].pools[j], host.callbacks);
        }
    }
    vkDestroyBuffer(host.device, readback.buffer, host.callbacks);
    hostFreeMemory(memory, readback.allocation);
    printMemory("at the end:", memory);
    hostDestroyAllocator(memory);
    hostDestroyDevice(&host, options.cachePath);

    if (hostValidationMessages() != 0) {
        fprintf(stderr, "failed: %d validation messages\n", hostValidationMessages());
        good = 0;
    }
    return good ? 0 : 1;
}
