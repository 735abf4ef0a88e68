/**
 * @file supple.h
 * Turns animated control cages into smooth surfaces, on Vulkan compute. C99.
 *
 * A control cage is the polygon mesh that a surface is made from. The host is the program that uses Supple. Supple
 * loads a character (glTF/GLB, OBJ or arrays), poses its instances, deforms the cage, and evaluates a smooth surface
 * over it. It records this work, as a sequence of passes, into the host's command buffer. The host gets surface
 * vertices, indices and indirect draw arguments. Every pass can be timed. docs/glossary.md explains all words. (docs/
 * is installed as share/doc/supple, shaders/ as share/supple/shaders.)
 *
 * Supple does not create a Vulkan instance or device, submit, wait, draw, decode images, open windows or link a loader.
 *
 * This header is in the order of use. supple_character.h (characters from arrays), supple_prepare.h (characters read on
 * any thread), supple_view.h (level of detail, culling), supple_playback.h (layers of clips, root motion, clips that
 * the device plays), supple_points.h (points that ride on surfaces), supple_queries.h (what rays meet), supple_rays.h
 * (ray tracing), supple_direct.h (evaluation while drawing) and supple_recording.h (what a host does, to be replayed)
 * are for hosts that need them. This header includes all nine at its end.
 *
 * Structs
 *   - Most structs begin with structSize. Set it to sizeof the struct before the call, also in structs that Supple
 *     fills. If a field has a default, zero means the default. A field whose comment gives a least value above 0 must
 *     be set. Later versions add fields at the end only. Missing trailing fields read as zero. Unknown trailing fields
 *     must be zero, and come back as zero. Structs without structSize never change. A structSize of 0 is refused by
 *     name.
 *   - Matrices are column-major float[16] for column vectors. Space is right-handed with +Y up, as in glTF. Angles are
 *     radians, times are seconds.
 *   - Pointers in a description are read during the call only, unless a comment says otherwise.
 *   - Functions that fill an array take `out` and `count`. Before the call, *count is how many entries out has room
 *     for. After it, *count is how many there are. If that is more, the result is SUPPLE_INCOMPLETE. If out is null,
 *     only *count is set, and the result is SUPPLE_OK. count must not be null.
 *   - ..._MAX_ENUM is no value, and is refused like any other number that is none. It makes all numbers from 0 to
 *     0x7FFFFFFF the enum's, so that a compiler may not take it for granted that a host passes a value.
 *
 * Handles
 *   - Assets, groups, views and instances are checked in every call. A handle that is destroyed, or of another context,
 *     gives SUPPLE_ERROR_ARGUMENT, never a crash. SuppleContext is a pointer: do not use it once it is destroyed.
 *   - You may destroy them while frames in flight use them. suppleBeginFrame frees the memory when you tell it that the
 *     frame in which they were destroyed is complete.
 *
 * Errors
 *   - Errors are negative results. The log callback gets the reason, with an id that is the same in all versions.
 *     A file or a cage with several faults has one line for each. There may be no line for suppleQueryRequirements,
 *     for a null context and for SUPPLE_ERROR_HOST_MEMORY.
 *   - A call that fails has done nothing, unless its comment says otherwise. suppleCreate... may set *out to null.
 *   - Once a call has returned SUPPLE_ERROR_DEVICE_LOST, so does every later call that needs the device. Destroying
 *     still works.
 *
 * Threads
 *   - Only one thread at a time may use a context and everything made from it. There is one exception, between one
 *     suppleBeginFrame and the next: two threads may work on different groups at the same time. Each may create,
 *     destroy, set and query instances. Once suppleRecordUploads has been recorded for the frame, each may also record
 *     its groups (suppleRecord), into a command buffer of its own. The log callback must then expect calls from these
 *     threads at the same time. In this, groups of one view are one group, and so are a group and those that follow it
 *     (SuppleGroupDesc.instancesOf). Everything else, such as creating assets, groups and views, is for one thread.
 *   - supplePrepare and suppleMakePipelines are for any thread at any time: they read characters, build tables and make
 *     pipelines while the thread of frames records.
 *   - Different contexts are independent.
 *   - Supple has no threads. It uses the host's only through SuppleContextDesc.runJobs.
 *
 * Recording
 *   - Recording creates no Vulkan object and allocates no memory. It changes the compute pipeline, compute descriptor
 *     set 0 and the push constants of the given command buffer. The host must set all of these again before it uses
 *     them, also push constants of its graphics pipelines. Secondary command buffers will do, outside render passes.
 */
#ifndef SUPPLE_H
#define SUPPLE_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#if defined(_WIN32) && defined(SUPPLE_SHARED)
#ifdef SUPPLE_BUILDING
#define SUPPLE_API __declspec(dllexport)
#else
#define SUPPLE_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define SUPPLE_API __attribute__((visibility("default")))
#else
#define SUPPLE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_VERSION_MAJOR 0 /**< rises when hosts must be changed or compiled again; the SONAME's number */
#define SUPPLE_VERSION_MINOR 2 /**< rises when something is added */
#define SUPPLE_VERSION_PATCH 0
/** One number that rises with every version. */
#define SUPPLE_VERSION (SUPPLE_VERSION_MAJOR * 1000000 + SUPPLE_VERSION_MINOR * 1000 + SUPPLE_VERSION_PATCH)

#define SUPPLE_BIND_POSE 0xFFFFFFFFu         /**< clip index: the cage as modelled, without morph targets */
#define SUPPLE_REST_POSE 0xFFFFFFFEu         /**< clip index: the file's node transforms and morph weights */
#define SUPPLE_NO_MATERIAL 0xFFFFFFFFu       /**< faces without a material */
#define SUPPLE_NO_JOINT 0xFFFFFFFFu          /**< the parent of a root joint */
#define SUPPLE_NO_SURFACE 0xFFFFFFFFu        /**< a pass of a whole group: see SuppleTiming.surface */
#define SUPPLE_NO_VERTEX 0xFFFFFFFFu         /**< a patch corner that is no vertex of the cage */
#define SUPPLE_NO_IMAGE 0xFFFFFFFFu          /**< a material without a trim image: see SuppleMaterialInfo */
#define SUPPLE_NO_TRIM_TILE 0xFFFFFFFFu      /**< a face that is not trimmed: see SuppleCageDesc.faceTrimTiles */
#define SUPPLE_MAX_TRIM_TILES 1024u          /**< tiles in one trim image */
#define SUPPLE_MAX_CREASE_SETS 64u           /**< of one character */
#define SUPPLE_NO_CREASE_SET 0xFFFFFFFFu     /**< a crease in no set: see SuppleCageDesc.creaseSets */
#define SUPPLE_FILE_SHARPNESS (-1.0f)        /**< suppleSetSharpness: each edge has what the file gives it */
#define SUPPLE_LEAST_SHARPNESS (-0.5849625f) /**< suppleSetSharpness: P_m's alpha of 1, rounder than smooth */
#define SUPPLE_MAX_RATE 64u                  /**< see SuppleGroupDesc.rate */
#define SUPPLE_MAX_FRAMES_IN_FLIGHT 4u       /**< see suppleBeginFrame */
#define SUPPLE_MAX_COORDINATE 1e9f           /**< see SuppleAssetDesc */
#define SUPPLE_MAX_WIND 1e6f                 /**< units a second, along each axis: see suppleSetWind */
#define SUPPLE_MAX_TIMINGS 4096u             /**< entries per frame. Further entries are not timed */

/** A context borrows the host's device. Assets, groups and views belong to one context. */
typedef struct SuppleContext_T* SuppleContext;
/** A character as loaded: cage, skeleton, clips, materials. */
typedef struct SuppleAsset {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleAsset;
/** A character that is read, with the tables of its groups, before a context needs it: supple_prepare.h. It belongs to
 * no context. */
typedef struct SupplePrepared_T* SupplePrepared;
/** Instances of one asset with one scheme (SuppleScheme) and the same options. They go through each pass together. */
typedef struct SuppleGroup {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleGroup;
/** A camera with the groups it sees: supple_view.h. */
typedef struct SuppleView {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleView;
/** One character of a group. */
typedef struct SuppleInstance {
    SuppleGroup group;
    uint32_t slot;       /**< below the group's capacity: the place of the instance in the group's buffers */
    uint32_t generation; /**< 0 is never valid */
} SuppleInstance;

/** What a call returns. Errors are negative. */
typedef enum SuppleResult {
    SUPPLE_OK = 0,
    SUPPLE_NOT_READY = 1,          /**< there is no finished frame to report yet */
    SUPPLE_INCOMPLETE = 2,         /**< the array was too small: it is full, and *count says how many there are */
    SUPPLE_ERROR_ARGUMENT = -1,    /**< a rule of this header was broken */
    SUPPLE_ERROR_ASSET = -2,       /**< the file or cage is malformed, or the scheme cannot take it */
    SUPPLE_ERROR_UNSUPPORTED = -3, /**< the device lacks something that suppleQueryRequirements lists */
    SUPPLE_ERROR_LIMIT = -4,       /**< a limit of the device or of this header is exceeded */
    SUPPLE_ERROR_HOST_MEMORY = -5,
    SUPPLE_ERROR_DEVICE_MEMORY = -6,
    SUPPLE_ERROR_DEVICE_LOST = -7,
    SUPPLE_ERROR_VULKAN = -8, /**< a Vulkan call failed for another reason, which the log names */
    SUPPLE_RESULT_MAX_ENUM = 0x7FFFFFFF
} SuppleResult;

/** SUPPLE_VERSION of the library that is running. */
SUPPLE_API uint32_t suppleGetVersion(void);
/** The name of a result, in static storage. */
SUPPLE_API const char* suppleResultString(SuppleResult result);

/** ERROR: the call failed. WARNING: something is left out, mended or over its budget. INFO: worth knowing. */
typedef enum SuppleSeverity { SUPPLE_SEVERITY_INFO, SUPPLE_SEVERITY_WARNING, SUPPLE_SEVERITY_ERROR } SuppleSeverity;

/** What a message is about. A number never changes its meaning. Later versions may add numbers. */
typedef enum SuppleMessage {
    SUPPLE_MESSAGE_NULL_POINTER = 100,
    SUPPLE_MESSAGE_STRUCT_SIZE = 101,  /**< too small, or with fields in use that this library lacks */
    SUPPLE_MESSAGE_STALE_HANDLE = 102, /**< destroyed, or of another context */
    SUPPLE_MESSAGE_OUT_OF_RANGE = 103, /**< an index, a count or an enumerator */
    SUPPLE_MESSAGE_NOT_FINITE = 104,
    SUPPLE_MESSAGE_CONFLICT = 105,     /**< arguments exclude each other, or do not fit the group */
    SUPPLE_MESSAGE_OUT_OF_ORDER = 106, /**< a call before the one that it needs, or twice in a frame */
    SUPPLE_MESSAGE_ASSET_REFUSED = 200,
    SUPPLE_MESSAGE_ASSET_WARNING = 201,    /**< accepted, but something in the file is left out or mended */
    SUPPLE_MESSAGE_SCHEME_NOTE = 202,      /**< what a scheme changed in the cage */
    SUPPLE_MESSAGE_RATE_CHANGED = 203,     /**< the scheme takes another rate than the one asked for */
    SUPPLE_MESSAGE_NOT_PREPARED = 204,     /**< a group built what supplePrepare was not told of */
    SUPPLE_MESSAGE_POINTS_DROPPED = 205,   /**< a reloaded cage has other faces: a point set is destroyed */
    SUPPLE_MESSAGE_DEVICE_UNSUITED = 300,  /**< see suppleQueryRequirements */
    SUPPLE_MESSAGE_FEATURE_DISABLED = 301, /**< the device has it, but the host did not enable it */
    SUPPLE_MESSAGE_LIMIT = 302,
    SUPPLE_MESSAGE_HOST_MEMORY = 400,
    SUPPLE_MESSAGE_DEVICE_MEMORY = 401,
    SUPPLE_MESSAGE_DEVICE_LOST = 402,
    SUPPLE_MESSAGE_VULKAN = 403,
    SUPPLE_MESSAGE_BUDGET = 500, /**< a pass took longer than suppleSetBudget allows */
    /** A group may be drawn without ever being recorded. Given once for a group, as a warning: its outputs were asked
     * for (suppleGetVertexStreams, suppleGetGridOutput or suppleGetLevelOutput), it has visible instances, other groups
     * were recorded in 8 frames since then, and it was recorded in none. Hide the instances of a group that you hold
     * ready (suppleSetVisible), or ignore the line. */
    SUPPLE_MESSAGE_NEVER_RECORDED = 501,
    SUPPLE_MESSAGE_RECORDING_ENDED = 502 /**< before suppleStopRecording (suppleStartRecording) */
} SuppleMessage;

/** Called on the thread that called Supple, before that call returns. It must not call Supple itself. text is
 * UTF-8, if the names in the file and in the host's descriptions are. It is one line, or one for each of several
 * faults, without a line feed at the end. It is valid during the call. */
typedef void (*SuppleLogFunction)(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

/* ---------------------------------------------------------------------------------------------------- device */

/** What a device must have. Feature structs have their sType set and a null pNext, so a host can chain them into
 * VkDeviceCreateInfo. Only what Supple needs is VK_TRUE: nothing, unless contextFlags ask for it. A host may set more
 * of them for itself. Chain features12 only on devices of Vulkan 1.2 or more, features13 only from 1.3 on. Device
 * extensions are needed for ray tracing alone. */
typedef struct SuppleRequirements {
    uint32_t structSize;
    uint32_t apiVersion; /**< lowest VkPhysicalDeviceProperties::apiVersion */
    VkPhysicalDeviceVulkan12Features features12;
    VkPhysicalDeviceVulkan13Features features13;
    char reason[256]; /**< the first thing that is lacking; empty if nothing is */
    /** Set it before the call: VkApplicationInfo::apiVersion of the VkInstance, or 0 if you do not know. It must be 1.1
     * or more, and 1.2 or more for what needs bufferDeviceAddress: Vulkan gives an older instance no functions of newer
     * versions, whatever the device has. A VkInstance does not tell its version. */
    uint32_t instanceVersion;
    /** Set it before the call: the SuppleContextFlags that the context will have, or 0. SHARED_DISPATCHES and
     * RAY_TRACING need the feature bufferDeviceAddress, and RAY_TRACING what follows here. */
    uint32_t contextFlags;
    uint32_t extensionCount;       /**< device extensions to enable: 0 without RAY_TRACING */
    const char* const* extensions; /**< extensionCount names, in static storage */
    /** Chain it too if the feature of the same name is VK_TRUE in it, as with RAY_TRACING. Else leave it out: the
     * device may not know it. */
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accelerationStructure;
} SuppleRequirements;

/** SUPPLE_OK: device and instance are suitable. SUPPLE_ERROR_UNSUPPORTED: out->reason says what is lacking. Fills out
 * in both cases. SUPPLE_ERROR_ARGUMENT: out->reason says why, unless out is null or structSize is neither 0 nor right.
 */
SUPPLE_API SuppleResult suppleQueryRequirements(VkInstance instance, VkPhysicalDevice physicalDevice,
                                                PFN_vkGetInstanceProcAddr getInstanceProcAddr, SuppleRequirements* out);

/* ---------------------------------------------------------------------------------------------------- context */

/** How lanes (shader invocations) share the work. NARROW: one lane per patch, texel-buffer loads. WIDE: many lanes per
 * patch, coefficients in workgroup memory. AUTO: NARROW on CPU devices such as lavapipe, WIDE on GPUs, and on CPU
 * devices that read fewer than a million texels of a buffer (the log says so). Both give the
 * same positions, bit for bit. */
typedef enum SuppleMapping {
    SUPPLE_MAPPING_AUTO = 0,
    SUPPLE_MAPPING_NARROW = 1,
    SUPPLE_MAPPING_WIDE = 2,
    SUPPLE_MAPPING_MAX_ENUM = 0x7FFFFFFF
} SuppleMapping;

/** Options of a context. */
typedef enum SuppleContextFlags {
    SUPPLE_CONTEXT_DEBUG_UTILS = 1,   /**< the host enabled VK_EXT_debug_utils: label passes, name objects */
    SUPPLE_CONTEXT_ASYNC_COMPUTE = 2, /**< suppleRecord releases the outputs from queueFamily to drawQueueFamily */
    /** Groups share dispatches: a frame of many different characters has few more of them than a frame of one. The
     * feature bufferDeviceAddress must be enabled, and SuppleMemoryCallbacks.allocate must allocate with
     * VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. Surfaces have the same bits. With SUPPLE_RECORD_TIMINGS each group has
     * dispatches of its own, to be timed. Without effect in the narrow mapping (docs/shared_dispatches.md). */
    SUPPLE_CONTEXT_SHARED_DISPATCHES = 4,
    /** suppleStartRecording may come at any time. The context keeps what everything was told last, poses too: a copy of
     * what calls that set something hand over. For builds that are tested. */
    SUPPLE_CONTEXT_RECORDABLE = 8,
    /** Groups of SUPPLE_SCHEME_PREP at a rate keep 48 bytes a vertex of the cage, and evaluation makes limit points and
     * coefficients of these, instead of reading some 144. Positions have the same bits. It is there to be measured: no
     * GPU has run it (docs/benchmarks.md). Without effect on other schemes, in views with levels, and with
     * SUPPLE_GROUP_INDEXED_MESH. Tables for it are made when the group is created: no prepared character has them. */
    SUPPLE_CONTEXT_FAN_RECORDS = 32,
    /** Groups may have SUPPLE_GROUP_RAY_TRACING. What suppleQueryRequirements says with this flag must be enabled, and
     * SuppleMemoryCallbacks.allocate must allocate with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. */
    SUPPLE_CONTEXT_RAY_TRACING = 16
} SuppleContextFlags;

/** A piece of the host's device memory. */
typedef struct SuppleMemory {
    VkDeviceMemory memory; /**< not null. Other pieces of the host may lie in it */
    VkDeviceSize offset;   /**< a multiple of requirements->alignment */
    void* mapped; /**< if HOST_VISIBLE was required: where the byte at offset is mapped until `free`. Else ignored */
    void* allocation; /**< the host's own, for example a VmaAllocation */
} SuppleMemory;

/** Where device memory comes from. Supple calls these functions on the thread that called it: when contexts, assets,
 * groups and views are created or destroyed, in suppleSetCapacity, suppleReloadAsset and suppleBeginFrame, but never
 * while recording. */
typedef struct SuppleMemoryCallbacks {
    /** Fills out and returns VK_SUCCESS, or returns an error of vkAllocateMemory. The memory is for buffers (linear).
     * Its type must be in requirements->memoryTypeBits and have all of `required` and, if possible, `preferred`. What
     * is mapped is required to be HOST_COHERENT. If the context has SUPPLE_CONTEXT_RAY_TRACING or _SHARED_DISPATCHES,
     * buffers have addresses: vkAllocateMemory needs VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT then. If `memory` or a
     * needed `mapped` is null in spite of VK_SUCCESS, the call that asked for memory fails with SUPPLE_ERROR_ARGUMENT,
     * and `free` is called.
     *
     * name is for the host's statistics, and valid during the call. It is "supple block" for a block
     * (SuppleContextDesc.memoryBlockSize). Else it is the name of the first buffer in the memory, and says whose it is:
     * - context: "supple parameter pairs"; on CPU devices "supple timings"; with SUPPLE_CONTEXT_SHARED_DISPATCHES
     *   "supple tasks", "supple tasks staging"; if a recording has had hashes, "supple hashes" and "supple hashes, read
     *   back";
     * - asset: "supple skin tables", "supple vertices of a piece", "supple surface tables", "supple clip tables";
     * - group: "supple instances" (this holds its outputs, too), "supple list staging", "supple grid indices" (this
     *   holds those for ray tracing, too);
     * - its boxes, for the host: "supple bounds, read back";
     * - its instances: "supple poses", "supple user data staging", "supple playback", "supple playback staging";
     * - view: "supple view", "supple view staging", "supple view statistics", "supple view, grid indices".
     *
     * The tables of an asset, parameter pairs and grid indices come twice under one name: the second piece is
     * host-visible. It is freed when the frame that copied it is complete. Later versions may add names. */
    VkResult (*allocate)(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                         VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user);
    /** Called once per successful allocate. By then the buffers in the memory are destroyed and no frame uses it. */
    void (*free)(const SuppleMemory* memory, void* user);
    void* user;
} SuppleMemoryCallbacks;

/** Work for the host's threads. The function calls job(jobData, i) exactly once for every i below count, in any order
 * and on any threads. It returns when all of these calls have returned. It must not call Supple. */
typedef void (*SuppleRunJobsFunction)(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData,
                                      void* user);

/** The host's device, and how Supple uses it. */
typedef struct SuppleContextDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleContextFlags */
    /** Borrowed, as all Vulkan handles here: it must outlive the context. It must have been created with an apiVersion
     * of 1.1 or more: see SuppleRequirements.instanceVersion. */
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    /** It must have been created with what suppleQueryRequirements asks for. */
    VkDevice device;
    uint32_t queueFamily; /**< of the command buffers given to suppleRecord; must support compute */
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkPipelineCache pipelineCache;          /**< optional */
    const VkAllocationCallbacks* allocator; /**< optional; used for every object, must outlive the context */
    uint32_t framesInFlight;                /**< 1..SUPPLE_MAX_FRAMES_IN_FLIGHT, 0 = 2 */
    SuppleMapping mapping;
    SuppleLogFunction log; /**< optional */
    void* logUser;
    /** Optional: the pNext chain that was given to vkCreateDevice. If it does not enable a feature that Supple needs,
     * the call fails and the log names the feature. If it is null, a missing feature is undefined behaviour later. */
    const void* enabledFeatures;
    const SuppleMemoryCallbacks* memory; /**< optional; copied. Null: Supple calls vkAllocateMemory */
    uint32_t drawQueueFamily;            /**< with SUPPLE_CONTEXT_ASYNC_COMPUTE: see suppleGetAcquireBarriers */
    /** Optional: makes pipelines on the host's threads. suppleCreateGroup, suppleCreateView and what changes groups
     * call it, on the calling thread. A job makes one pipeline. So several threads may call the allocator, the driver
     * and debug messengers at the same time, and pipelineCache must not be
     * VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED. If a job is not run, the call that needs it fails with
     * SUPPLE_ERROR_ARGUMENT. Null: one pipeline after the other. */
    SuppleRunJobsFunction runJobs;
    void* jobsUser; /**< handed to runJobs */
    /** Bytes of the largest block, 256 MiB say; 0: none. Device memory is allocated by the block, each as large as all
     * before it of its kind, from 8 MiB on (1 MiB if it is mapped). A block is freed when nothing is in it. What takes
     * more than half of the largest, or what no block has room for within the budget (suppleSetMemoryBudget), is an
     * allocation of its own. 0: everything is, for a host whose callbacks share out blocks themselves. */
    VkDeviceSize memoryBlockSize;
} SuppleContextDesc;

/** Loads the device's functions. suppleCreateGroup compiles almost all pipelines. Errors: the device or the instance
 * lacks a requirement, the host has not enabled one, queueFamily has no compute, or memory is short. */
SUPPLE_API SuppleResult suppleCreateContext(const SuppleContextDesc* desc, SuppleContext* out);
/** Also frees all assets, groups and views. No command buffer that uses them may be pending. Null is allowed. */
SUPPLE_API void suppleDestroyContext(SuppleContext context);
/** Fills out: NARROW or WIDE, whichever AUTO has come to. Characters that are prepared for the context are prepared for
 * this one. */
SUPPLE_API SuppleResult suppleGetMapping(SuppleContext context, SuppleMapping* out);

/* ---------------------------------------------------------------------------------------------------- assets */

/** Crease control for SUPPLE_SCHEME_PM alone. alpha applies to the edge from vertex to toward, at its end `vertex`. It
 * lies in 0..1: 2/3 is smooth, smaller is sharper, larger is rounder. Less than 1/4096 counts as 1/4096, so that there
 * are normals. If all are 0, the surface is the polyhedron but for strips of that part of an edge. It replaces what the
 * sharpness of the edge would give there. */
typedef struct SuppleCreaseScalar {
    uint32_t vertex;
    uint32_t toward;
    float alpha;
} SuppleCreaseScalar;

/** A control cage given as arrays, which are copied. Faces are counter-clockwise seen from outside. Sharpness is as in
 * OpenSubdiv and USD: 0 is smooth, 10 and more is infinitely sharp. What no surface can be built on, such as three
 * faces on an edge, is repaired with a warning for each kind (docs/gltf.md): unless SUPPLE_ASSET_STRICT is set, see
 * SuppleAssetInfo.sourceVertices. */
typedef struct SuppleCageDesc {
    uint32_t structSize;
    uint32_t vertexCount;
    uint32_t faceCount;
    const float* positions;            /**< 3 * vertexCount */
    const uint32_t* faceVertexCounts;  /**< faceCount */
    const uint32_t* faceVertexIndices; /**< sum of faceVertexCounts */
    const float* cornerUvs;            /**< optional: 2 per entry of faceVertexIndices */
    const float* cornerUvs1;           /**< optional: a second UV set */
    uint32_t creaseCount;
    const uint32_t* creaseVertices; /**< 2 per crease: the ends of the edge */
    const float* creaseSharpnesses;
    uint32_t cornerCount; /**< sharp vertices */
    const uint32_t* cornerVertices;
    const float* cornerSharpnesses;
    uint32_t creaseScalarCount;
    const SuppleCreaseScalar* creaseScalars;
    uint32_t holeCount; /**< entries of holes: faces that shape their neighbours but are not drawn */
    const uint32_t* holes;
    const uint32_t* faceTrimTiles; /**< optional: per face a trim tile or SUPPLE_NO_TRIM_TILE; see SuppleTrimDomain */
    /** Optional: per face a material of the character or SUPPLE_NO_MATERIAL. A bare cage (SuppleAssetDesc.cage) has no
     * materials. */
    const uint32_t* faceMaterials;
    const float* cornerNormals; /**< optional: 3 per corner, normalised. One without a direction: the corner is flat */
    /** Optional: 4 per corner, x y z and the sign of the bitangent. One without a direction: that of the texture
     * coordinates instead. Without cornerNormals, they are not looked at. */
    const float* cornerTangents;
    const float* cornerColors; /**< optional: 4 per corner, linear RGBA */
    /** Optional: how SUPPLE_SCHEME_POLYGONS cuts faces into triangles. 3 per triangle, which are corners counted over
     * all faces; a face of n corners has n - 2 triangles; face after face. */
    const uint32_t* faceTriangles;
    uint32_t roundCornerCount;
    const uint32_t* roundCorners; /**< vertices that round the boundary off if they have one face; rising */
    /** Names of crease sets (suppleSetSharpness). No name is empty. Sets of one name in several parts are one set. */
    uint32_t creaseSetCount;
    const char* const* creaseSetNames;
    const uint32_t* creaseSets; /**< optional: per crease the number of its name, or SUPPLE_NO_CREASE_SET */
} SuppleCageDesc;

/** A whole character as arrays: supple_character.h. */
typedef struct SuppleCharacterDesc SuppleCharacterDesc;

/** Options of reading a file or arrays. */
typedef enum SuppleAssetFlags {
    /** Plain triangles of a glTF file or of SupplePrimitiveDesc: pair all into quads that share an edge, have the same
     * normals, UVs and colors along it, and face the same side. Without this flag, they are paired if nearly all of a
     * mesh make good quads, and a warning says so. Polygons that the file lists are left as they are. */
    SUPPLE_ASSET_PAIR_QUADS = 1,
    /** Refuse a damaged cage instead of repairing it, and a file with faults instead of mending them or leaving out
     * what is broken (docs/gltf.md). The message has one line for each fault, and one for each kind of damage, which
     * counts it and names the first place. Then the vertices of a cage given as arrays keep their numbers. */
    SUPPLE_ASSET_STRICT = 2,
    /** Parts of a file or of a character from arrays stay apart. Without this flag, parts are sewn together where
     * their boundaries coincide in position, skin and morph targets, and the surface goes on smoothly from one to the
     * other. */
    SUPPLE_ASSET_PARTS_APART = 4,
    /** Plain triangles of a glTF file or of SupplePrimitiveDesc stay as they are. Not together with
       SUPPLE_ASSET_PAIR_QUADS. */
    SUPPLE_ASSET_KEEP_TRIANGLES = 8,
    /** All edges of a file or of arrays whose normals are split become hard creases (sharpness 10), so that smooth
     * schemes keep the hard edges of the file. Edges of the boundary and corners without a normal are left as they are.
     * Without this flag that is done for parts of plain triangles of which some edges are split (docs/gltf.md), and a
     * warning says so. */
    SUPPLE_ASSET_CREASES_FROM_NORMALS = 16,
    /** Vertices of an OBJ file stay as they are. Without this flag, those of one part that lie in one place become one
     * vertex where faces meet edge by edge, and a warning counts them. Files of other kinds are not touched by it. */
    SUPPLE_ASSET_VERTICES_APART = 32,
    /** No edge becomes a crease because its normals are split. Not together with SUPPLE_ASSET_CREASES_FROM_NORMALS. */
    SUPPLE_ASSET_SMOOTH = 64
} SuppleAssetFlags;

/** The content of a file, from the host's own file system. */
typedef struct SuppleFileBytes {
    const void* bytes;
    size_t byteCount;
    void* handle; /**< the host's own, for release */
} SuppleFileBytes;
/** The host's file system: how the external files of an asset (buffers, images, MTL files) are found. */
typedef struct SuppleFiles {
    /** Fills out and returns non-zero, or returns 0 if there is no such file. The bytes must stay valid until release.
     * path is UTF-8, relative to the asset and percent-decoded. It has forward slashes, and no "..", "." or colon.
     * Supple calls both functions in suppleCreateAsset and suppleReloadAsset, on the thread that called it. */
    int (*read)(const char* path, SuppleFileBytes* out, void* user);
    void (*release)(SuppleFileBytes* bytes, void* user); /**< optional; called once per successful read */
    void* user;
} SuppleFiles;

/** A glTF file whose clips an asset takes: animations are often in other files than the character, which have the same
 * skeleton and no mesh. Its meshes, images and scenes are not looked at.
 *
 * A clip moves the nodes that have the names of those that it was made for. If several nodes of one skeleton have the
 * same name, the names of the nodes above tell them apart, else the first one is taken. Morph weights move the targets
 * of the part that the node of that name carries: by the targets' names if both files have them, else all if there are
 * as many. What has no counterpart is left out, and one warning per file says what that is. Clips of bipeds whose
 * skeleton is another one are retargeted (SuppleRetargeting). Else a warning says so if the bones of the two skeletons
 * differ in length by more than 1 %. */
typedef struct SuppleClipFile {
    const char* name; /**< optional; begins every message about the file. Clips without a name are called as the file */
    const void* bytes; /**< a .glb or .gltf file */
    size_t byteCount;
    const char* baseDirectory; /**< where its external files lie, in UTF-8; null allows none */
    const SuppleFiles* files;  /**< optional: asked instead of baseDirectory; needed during the call only */
} SuppleClipFile;

/** What becomes of clips that were made for another skeleton (docs/gltf.md#retargeting). Then joints are told by what
 * they are, by names as rigs have them and by structure: hips, thighs, shins, feet, and so on. Their turns from the
 * rest pose are taken over, the hips move by the ratio of the legs, and the legs bend so that ankles go where those of
 * the clip go. A warning says how many joints follow, what is left out, and for which clips the legs are too short. */
typedef enum SuppleRetargeting {
    /** Clip files of which nodes of one role have other names than the asset's, or other bones. Both skeletons must be
     * of bipeds that stand upright: hips above two legs. Else clips move nodes of their names alone, and the warning
     * says why. */
    SUPPLE_RETARGET_DIFFERING = 0,
    SUPPLE_RETARGET_NEVER = 1, /**< clips move nodes of their names */
    SUPPLE_RETARGET_ALL = 2,   /**< all clip files; one of which it cannot be done fails the call */
    /** As SUPPLE_RETARGET_ALL, but legs keep the angles of the clip, and ankles come where these take them. */
    SUPPLE_RETARGET_FREE_FEET = 3
} SuppleRetargeting;

/** Two joints that are the same, one of the clip files and one of the asset, where their names do not tell it: names of
 * nodes. One of the two may be null if there is a role: that one is then found. A clip file without the node ignores
 * the pair, and its warning says so: so one list may serve files of several rigs. */
typedef struct SuppleJointPair {
    /** What both are: "hips", "neck" or "head", or with ".l" or ".r" behind it "thigh", "shin", "foot", "toes",
     * "clavicle", "upperarm", "lowerarm" or "hand". Null: nothing of these; the one turns as the other does. */
    const char* role;
    const char* from; /**< of the clip file */
    const char* to;   /**< of the asset */
} SuppleJointPair;

/** Either a file in memory (`bytes`), or arrays (`cage`, `character`), or what was prepared of one of these
 * (`prepared`). Everything is copied before the call returns.
 *
 * Positions, displacements, numbers of matrices and keys of clips must be within plus or minus SUPPLE_MAX_COORDINATE.
 * Otherwise the asset is refused. A pose can still move vertices farther: by a chain of large scales, by layers, by
 * matrices of the host. Then the surface of that instance is not defined, and may be not finite, until its next pose.
 * The surfaces of other instances are what they would be without it. In a view it counts as large: it takes its part of
 * the budget. suppleGetClipBounds tells how far a clip goes, suppleReadInstanceBounds how far an instance went. */
typedef struct SuppleAssetDesc {
    uint32_t structSize;
    uint32_t flags;   /**< SuppleAssetFlags */
    const char* name; /**< optional; begins every message about the asset */
    /** A .glb or .gltf file; an .obj file if `name` ends in .obj; or a cooked file (suppleSavePrepared), for which
     * scene, clipFiles and flags other than SUPPLE_ASSET_STRICT must be 0. */
    const void* bytes;
    size_t byteCount;
    const char* baseDirectory; /**< where the external files of a .gltf or .obj lie, in UTF-8; null allows none */
    const SuppleFiles* files;  /**< optional: asked instead of baseDirectory; needed during the call only */
    const SuppleCageDesc*
        cage;       /**< a bare cage: a character of one part with one joint, which is called as the asset */
    uint32_t scene; /**< which scene of a glTF file: its number + 1; 0: the one that the file names, else the first */
    uint32_t clipFileCount;
    /** clipFileCount glTF files whose clips follow those of the asset's own file, which must be glTF as well. A clip
     * whose name is taken gets "@" and the name of its file, without folder and ending, and a number if that is taken
     * too. One file that cannot be read fails the call. */
    const SuppleClipFile* clipFiles;
    /** Not for arrays. Most bytes of host memory that reading a glTF file may take at a time, and each of the clip
     * files: small files can ask for much. 0: 16 MiB, and 64 bytes for each byte of the file and of those that it
     * names. A file that needs more is refused with SUPPLE_ERROR_LIMIT before it gets it. */
    uint64_t memoryLimit;
    /** Instead of bytes, cage or character: what supplePrepare made. Then all other members but structSize and
     * clipPoolBytes must be 0.
     * It need not outlive the call. */
    SupplePrepared prepared;
    const SuppleCharacterDesc* character; /**< instead of bytes or cage */
    /** The name of one of the file's variants of materials (KHR_materials_variants, suppleGetMaterialVariants): what
     * draws name (SuppleDrawRange.material) are its materials. Null or empty: the file's own. To show another variant,
     * load the asset anew with suppleReloadAsset: instances, poses and playback stay. glTF files alone: cooked files
     * have the variant that they were cooked with. Errors: no such variant; the message lists those there are. */
    const char* materialVariant;
    SuppleRetargeting retargeting; /**< of clipFiles; 0: of those whose skeleton is another one */
    uint32_t jointPairCount;       /**< of jointPairs */
    /** jointPairCount pairs, for all clipFiles: they go before what names and structure say, and clip files are then
     * retargeted even if their skeleton is the asset's. Errors: a role that there is none of, a node that the asset
     * does not have, a clip file that cannot be retargeted, SUPPLE_RETARGET_NEVER. */
    const SuppleJointPair* jointPairs;
    /** Also with `prepared`; not for supplePrepare. Bytes of device memory for segments of clips that have a coarse
     * twin (SupplePrepareDesc.coarseClipError): the device then has those segments that suppleRequestClip has asked
     * for, and what lacks its segments plays the twin (docs/playback.md, "Streaming"). There is room for the largest
     * segment, however few bytes these are, and for no more than all segments. Clips without a twin are there as a
     * whole; if no clip has one, a warning says that this is of no use. suppleReloadAsset takes what is given there. 0:
     * all segments are there from the beginning. */
    uint64_t clipPoolBytes;
} SuppleAssetDesc;

/** What an asset holds. The meshes of all nodes of the scene are parts of one character. Vertices that the file repeats
 * because their UVs or normals differ are one cage vertex. */
typedef struct SuppleAssetInfo {
    uint32_t structSize;
    uint32_t cageVertexCount;
    uint32_t faceCount;
    uint32_t jointCount;
    uint32_t clipCount;
    uint32_t materialCount;
    uint32_t morphTargetCount;
    float boundsMin[3]; /**< of the cage's vertices in the bind pose */
    float boundsMax[3];
    uint32_t imageCount;
    uint32_t partCount; /**< 1 or more */
    /** cageVertexCount entries, which live as long as the asset: the number that each vertex of the cage had in the
     * arrays, among the v lines of an OBJ file, or among the vertices of a glTF mesh. A repair may leave vertices out
     * and add copies behind all others: those who write the deformed cage themselves (SUPPLE_POSES_CAGE_BUFFER) put
     * vertex sourceVertices[i] in place i. */
    const uint32_t* sourceVertices;
    uint32_t expressionCount;
} SuppleAssetInfo;

/** How the deformed cage becomes a surface. docs/schemes.md says which one to choose. */
typedef enum SuppleScheme {
    /** Each part has the scheme that suits it: SupplePartInfo.scheme. The group has a surface per scheme. What a scheme
     * lacks of SUPPLE_GROUP_PATCHES and SUPPLE_GROUP_INDEXED_MESH its surface goes without. */
    SUPPLE_SCHEME_AUTO = 0,
    SUPPLE_SCHEME_PREP = 1, /**< p-rep: quads, G1 at any valence, one patch per face; creases are drawn smooth */
    SUPPLE_SCHEME_PM = 2,   /**< P_m: any polygons, polar fans, creases; G1 except at creases, one patch per facet */
    /** The limit of Catmull-Clark subdivision by one patch per quad (docs/catmull_clark.md), at any rate: any polygons,
     * semi-sharp creases. If not all faces are quads, the cage is subdivided once. */
    SUPPLE_SCHEME_CATMULL_CLARK = 3,
    /** The limit of Loop subdivision by one patch per triangle (docs/loop.md), at any rate: triangles, into which
     * larger faces are split, semi-sharp creases. */
    SUPPLE_SCHEME_LOOP = 4,
    /** Charts blended: any polygons (if not all are quads, the cage is subdivided once). Interpolates the cage's
     * vertices. Edges are either sharp or smooth. */
    SUPPLE_SCHEME_BLEND = 5,
    /** No smooth surface: the file's own triangles, deformed, with the file's normals. Takes any cage, manifold or not.
     * Its groups have SUPPLE_TESSELLATION_INDEXED_MESH, in a view SUPPLE_TESSELLATION_RATES with one rate. */
    SUPPLE_SCHEME_POLYGONS = 6,
    /** The limit of Catmull-Clark too, or with SUPPLE_RULES_LOOP that of Loop, but by refinement (docs/subdivision.md):
     * rates are powers of two, views draw an instance at one of several rates, and evaluation costs several times as
     * much. For comparisons. */
    SUPPLE_SCHEME_FRAGMENTS = 7,
    SUPPLE_SCHEME_CAGE = 100, /**< the deformed cage alone, of any polygons: no patches, no surface vertices */
    SUPPLE_SCHEME_MAX_ENUM = 0x7FFFFFFF
} SuppleScheme;

/** A part of a character: what one node carries as its mesh. OBJ files and bare cages have one part. All parts
 * have one cage, one skeleton and one pose. The faces of a part are a run of the cage's faces. */
typedef struct SupplePartInfo {
    uint32_t structSize;
    const char* name;   /**< of the node, else of its mesh; may be empty. All pointers live as long as the asset */
    uint32_t node;      /**< its number in the file */
    uint32_t joint;     /**< the joint that all its vertices follow, or SUPPLE_NO_JOINT if they follow several */
    uint32_t firstFace; /**< of the cage */
    uint32_t faceCount;
    uint32_t firstMorphTarget; /**< among the asset's. Parts that are always morphed alike share their targets */
    uint32_t morphTargetCount;
    uint32_t materialCount;    /**< entries of materials */
    const uint32_t* materials; /**< that its faces have, in rising order; SUPPLE_NO_MATERIAL for faces without one */
    float boundsMin[3];        /**< of its cage vertices in the bind pose */
    float boundsMax[3];
    SuppleScheme scheme;      /**< what SUPPLE_SCHEME_AUTO takes for it. Parts that are sewn have the same */
    const char* schemeReason; /**< why, for people: "its polygons are known" */
} SupplePartInfo;

/** An animation clip. */
typedef struct SuppleClipInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    double duration;  /**< seconds */
    /** That it takes on the device if all its segments are there, with its coarse twin, beside key times that it shares
     * with other clips. With a pool the segments are in that: then it takes byteCount - segmentBytes beside it. */
    uint64_t byteCount;
    /** How far packing has moved a vertex at most, as a part of the extent (SupplePrepareDesc.clipError); 0: the clip
     * is not packed. */
    double packedError;
    /** The same of its coarse twin (SupplePrepareDesc.coarseClipError); 0: the clip has none, and is never streamed. */
    double coarseError;
    uint64_t segmentBytes; /**< that its segments take, of byteCount; 0 without a twin */
    /** Of these, those of segments that groups play in the next suppleRecord; for the others they play the twin. All of
     * them, if the asset has no pool (SuppleAssetDesc.clipPoolBytes). The sum over all clips of an asset is what its
     * pool holds. */
    uint64_t residentBytes;
} SuppleClipInfo;

/** A box with sides along the axes. min is greater than max where there is nothing. */
typedef struct SuppleBounds {
    float min[3]; /**< the least corner */
    float max[3]; /**< the greatest corner */
} SuppleBounds;

/** A joint of the skin. */
typedef struct SuppleJointInfo {
    uint32_t structSize;
    const char* name;        /**< lives as long as the asset */
    uint32_t parent;         /**< the nearest joint above it in the node tree, or SUPPLE_NO_JOINT */
    uint32_t bindIsSingular; /**< 0 or 1: the file's inverse bind matrix has no inverse, as with a scale of 0 */
    /** Where the file's node transforms put the joint, in model space. SUPPLE_REST_POSE puts it there. */
    float restTransform[16];
    /** Where the joint is in the bind pose, in model space: the inverse of its inverse bind matrix. A joint whose
     * inverse bind matrix is singular has no such place; then this is restTransform. */
    float bindTransform[16];
} SuppleJointInfo;

/** A morph target of the cage. It moves vertices of those parts p for which target - p.firstMorphTarget is below
 * p.morphTargetCount (SupplePartInfo). Targets of several parts may have the same name. */
typedef struct SuppleMorphTargetInfo {
    uint32_t structSize;
    const char* name;     /**< lives as long as the asset; empty if the file has none */
    float weight;         /**< the weight that the file gives it */
    uint32_t vertexCount; /**< cage vertices that it moves */
} SuppleMorphTargetInfo;

/** An expression of a VRM file, such as "happy" or "blink": a named set of weights of morph targets. */
typedef struct SuppleExpressionInfo {
    uint32_t structSize;
    const char* name;        /**< lives as long as the asset, as the lists do; never empty, and unlike all others */
    uint32_t isBinary;       /**< 0 or 1: it is there or not. A weight above 0.5 counts as 1, any other as 0 */
    uint32_t targetCount;    /**< may be 0: what it does besides, to materials, is not read */
    const uint32_t* targets; /**< numbers of morph targets, rising */
    const float* weights;    /**< one per target: its weight where the expression's is 1 */
} SuppleExpressionInfo;

/** Trimming: the surface exists where a channel of an image is at least a cutoff. The host's fragment shaders must test
 * this in every pass that draws the surface, shadows too. docs/trimming.md has the test as a GLSL include. */
typedef enum SuppleTrimDomain {
    SUPPLE_TRIM_NONE = 0, /**< the material is whole */
    SUPPLE_TRIM_UV = 1,   /**< the image lies on a UV set: SuppleVertexStreams.attributes or uvs1 */
    SUPPLE_TRIM_FACE = 2  /**< the image is a strip of tiles; a face has one or none: SuppleVertexStreams.faceUvs */
} SuppleTrimDomain;

/** What a texture lookup outside of 0..1 finds, as the address modes of Vulkan's samplers. */
typedef enum SuppleWrap { SUPPLE_WRAP_REPEAT = 0, SUPPLE_WRAP_CLAMP = 1, SUPPLE_WRAP_MIRROR = 2 } SuppleWrap;

/** How texels become a value. The first word is the filter within a mip level; the second chooses between mip levels.
 */
typedef enum SuppleFilter {
    SUPPLE_FILTER_ANY = 0, /**< the file leaves it to the host */
    SUPPLE_FILTER_NEAREST = 1,
    SUPPLE_FILTER_LINEAR = 2,
    SUPPLE_FILTER_NEAREST_MIPMAP_NEAREST = 3,
    SUPPLE_FILTER_LINEAR_MIPMAP_NEAREST = 4,
    SUPPLE_FILTER_NEAREST_MIPMAP_LINEAR = 5,
    SUPPLE_FILTER_LINEAR_MIPMAP_LINEAR = 6
} SuppleFilter;

/** A texture of a material: an image, how it is sampled, and where it lies on the surface. A surface vertex with the
 * texture coordinates (u, v) of `uvSet` looks the image up at
 *
 *     offset[0] + cos(rotation) * scale[0] * u + sin(rotation) * scale[1] * v
 *     offset[1] - sin(rotation) * scale[0] * u + cos(rotation) * scale[1] * v
 *
 * (0, 0) is the upper left corner of the image. This is glTF's KHR_texture_transform; without it the offset and the
 * rotation are 0 and the scales 1. */
typedef struct SuppleTextureInfo {
    uint32_t image; /**< index for suppleGetImageInfo, or SUPPLE_NO_IMAGE: no texture, everything else is default.
                     * PNG or JPEG if the file has one of these; else look at SuppleImageInfo.mimeType */
    uint32_t alternateImage; /**< the same picture as KTX2 or WebP, or SUPPLE_NO_IMAGE */
    uint32_t uvSet;          /**< 0 or 1: SuppleVertexStreams.attributes or uvs1 */
    SuppleWrap wrap[2];      /**< along u and v */
    SuppleFilter magFilter;  /**< ANY, NEAREST or LINEAR */
    SuppleFilter minFilter;  /**< ANY leaves mip levels to the host as well */
    float offset[2];         /**< 1 is the whole width or height of the image */
    float rotation;          /**< radians */
    float scale[2];          /**< of u and v, before the rotation */
} SuppleTextureInfo;

/** What alpha does: baseColorFactor[3], times the alpha of the texture, times that of the color attribute. */
typedef enum SuppleAlphaMode {
    SUPPLE_ALPHA_OPAQUE = 0, /**< nothing */
    SUPPLE_ALPHA_MASK = 1,   /**< the surface exists where alpha is at least alphaCutoff; see trimDomain */
    SUPPLE_ALPHA_BLEND = 2   /**< coverage */
} SuppleAlphaMode;

/** A material as the file describes it: the metallic-roughness model of glTF 2.0. The host does all shading.
 *
 * Factors are linear. A texture multiplies its factor; without a texture the factor stands alone. Images of base color
 * and emission hold sRGB colors (their alpha is linear). All other images hold linear numbers. The color attribute
 * (COLOR_0, SuppleVertexStreams.attributes) multiplies the base color. */
typedef struct SuppleMaterialInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    SuppleAlphaMode alphaMode;
    float alphaCutoff;                   /**< MASK */
    uint32_t doubleSided;                /**< 1: both sides are seen, and the normal of the back is turned round */
    uint32_t unlit;                      /**< 1: the base color is shown as it is (KHR_materials_unlit) */
    float baseColorFactor[4];            /**< RGBA, 0..1 */
    float metallicFactor;                /**< 0..1: 0 is a dielectric, 1 a metal */
    float roughnessFactor;               /**< 0..1: perceptual; its square is the alpha of GGX */
    float normalScale;                   /**< multiplies x and y of the normal that the texture gives */
    float occlusionStrength;             /**< 0..1: ambient light is multiplied by 1 + strength * (texture - 1) */
    float emissiveFactor[3];             /**< RGB, 0..1 */
    float emissiveStrength;              /**< 0 and more; multiplies emissiveFactor (KHR_materials_emissive_strength) */
    SuppleTextureInfo baseColor;         /**< RGBA, sRGB */
    SuppleTextureInfo metallicRoughness; /**< green: roughness; blue: metallic */
    SuppleTextureInfo normal;            /**< in tangent space: 2 * RGB - 1, +Y up in the image */
    SuppleTextureInfo occlusion;         /**< red */
    SuppleTextureInfo emissive;          /**< RGB, sRGB */
    SuppleTrimDomain trimDomain;         /**< the trim that the file names; else alphaMode MASK with a texture */
    uint32_t trimChannel;                /**< 0..3: red, green, blue, alpha */
    float trimCutoff;                    /**< the surface stays where the value is at least this */
    float trimFactor;   /**< multiplies the lookup before the test: 1, or the alpha of baseColorFactor */
    uint32_t trimAlpha; /**< 1: the trim is alphaMode MASK, and the alpha of the color attribute multiplies it too */
    uint32_t trimTiles; /**< FACE: tiles in the image */
    SuppleTextureInfo trim; /**< linear numbers. FACE: uvSet and the transform are not used */
} SuppleMaterialInfo;

/** What a material has beyond the metallic-roughness model, as glTF's extensions describe it. A material without one of
 * these extensions has the value in brackets, and textures without an image. Factors are linear and multiply their
 * textures. Images of sheenColor, specularColor and diffuseTransmissionColor hold sRGB colors, all others linear
 * numbers. */
typedef struct SuppleMaterialLayers {
    uint32_t structSize;
    float clearcoatFactor;          /**< 0..1: how much of a clear layer lies over all; KHR_materials_clearcoat (0) */
    float clearcoatRoughnessFactor; /**< 0..1, as roughnessFactor (0) */
    float clearcoatNormalScale;     /**< multiplies x and y of the layer's normal map (1) */
    float sheenColorFactor[3];      /**< RGB, 0..1: what fibers scatter, as those of velvet; KHR_materials_sheen (0) */
    float sheenRoughnessFactor;     /**< 0..1 (0) */
    float transmissionFactor;       /**< 0..1: the share of light that goes through, as through thin glass, and takes
                                     * on the base color; KHR_materials_transmission (0) */
    float ior;                      /**< 1 and more; 0: infinite; KHR_materials_ior (1.5) */
    float specularFactor;           /**< 0..1: what a dielectric mirrors; KHR_materials_specular (1) */
    float specularColorFactor[3];   /**< RGB, 0 and more: its color where it is looked at straight (1) */
    float iridescenceFactor;        /**< 0..1: how much a thin film colors what is mirrored; KHR_materials_iridescence
                                     * (0) */
    float iridescenceIor;           /**< 1 and more: of the film (1.3) */
    float iridescenceThicknessMinimum; /**< nanometres, where the texture is 0 (100) */
    float iridescenceThicknessMaximum; /**< nanometres, where the texture is 1, or without one (400) */
    float anisotropyStrength;    /**< 0..1: highlights are stretched, as on brushed metal; KHR_materials_anisotropy
                                  * (0) */
    float anisotropyRotation;    /**< radians, counter-clockwise from the tangent (0) */
    SuppleTextureInfo clearcoat; /**< red */
    SuppleTextureInfo clearcoatRoughness;   /**< green */
    SuppleTextureInfo clearcoatNormal;      /**< in tangent space, as SuppleMaterialInfo.normal */
    SuppleTextureInfo sheenColor;           /**< RGB, sRGB */
    SuppleTextureInfo sheenRoughness;       /**< alpha */
    SuppleTextureInfo transmission;         /**< red */
    SuppleTextureInfo specular;             /**< alpha */
    SuppleTextureInfo specularColor;        /**< RGB, sRGB */
    SuppleTextureInfo iridescence;          /**< red */
    SuppleTextureInfo iridescenceThickness; /**< green */
    SuppleTextureInfo anisotropy;           /**< red and green: 2 * RG - 1 is a direction; blue: strength */
    float diffuseTransmissionFactor; /**< 0..1: the share of scattered light that comes out on the other side, as of
                                      * leaves, wax and skin; KHR_materials_diffuse_transmission (0) */
    float diffuseTransmissionColorFactor[3]; /**< RGB, 0..1: its color there (1) */
    float thicknessFactor;     /**< units of the mesh: of what lies behind the surface; KHR_materials_volume (0: a thin
                                * wall) */
    float attenuationDistance; /**< units: inside, white light has the color below after so far. 0: it loses nothing
                                * (0) */
    float attenuationColor[3]; /**< RGB, 0..1 (1) */
    SuppleTextureInfo diffuseTransmission;      /**< alpha */
    SuppleTextureInfo diffuseTransmissionColor; /**< RGB, sRGB */
    SuppleTextureInfo thickness;                /**< green */
} SuppleMaterialLayers;

/** An image as the file holds it. The host decodes it. */
typedef struct SuppleImageInfo {
    uint32_t structSize;
    const char* name;     /**< all pointers here live as long as the asset */
    const char* mimeType; /**< "image/png", "image/jpeg", "image/webp", "image/ktx2", whatever else the file says, or
                           * empty if neither the file nor the first bytes tell */
    const void* bytes;    /**< null if the image is missing */
    size_t byteCount;
} SuppleImageInfo;

/** Fails if the arrays are malformed, or if nothing can be read of the file; the message has one line for each kind of
 * fault. Single faults of a file are mended, or what is broken is left out, and a cage that is damaged (three faces on
 * an edge, flipped faces) is repaired: with a warning in the log for each kind, or refused with SUPPLE_ASSET_STRICT.
 * If only a scheme cannot take the cage (a face that is no quad), suppleCreateGroup fails instead, so the cage alone
 * can still be used (SUPPLE_SCHEME_CAGE). */
SUPPLE_API SuppleResult suppleCreateAsset(SuppleContext context, const SuppleAssetDesc* desc, SuppleAsset* out);
/** Loads an asset anew in its place (hot reload). desc is as for suppleCreateAsset. The handles of the asset, of its
 * groups and of their instances stay valid. Instances keep their slots, transforms, visibility, user data and poses.
 * What they have of the old version is found in the new one by name: joints, morph targets, hidden parts, clips and
 * masks that play, schemes of parts, crease sets. Joints and morph targets that are new are in the rest pose. A layer
 * of suppleSetPlayback whose clip is gone is left out. Numbers of clips, joints, parts, morph targets and materials may
 * change: look them up by name again. What is not given again is gone: pass the same clipFiles.
 * With SUPPLE_POSES_SET an instance keeps the joint matrices of its pose, so a clip or a bone that was edited shows
 * when the pose is set again.
 * All pointers that live as long as the asset, and all output of its groups (suppleGetGroupInfo, ...), are dead at
 * once: see suppleSetCapacity for what that means.
 * Takes as long as creating the asset and its groups. Errors: those of suppleCreateAsset and of suppleCreateGroup; then
 * nothing has changed, and everything goes on as it was. */
SUPPLE_API SuppleResult suppleReloadAsset(SuppleContext context, SuppleAsset asset, const SuppleAssetDesc* desc);
/** The handle and all pointers that live as long as the asset are dead at once. The asset's groups keep what they
 * need. */
SUPPLE_API SuppleResult suppleDestroyAsset(SuppleContext context, SuppleAsset asset);
/** Fills out. */
SUPPLE_API SuppleResult suppleGetAssetInfo(SuppleContext context, SuppleAsset asset, SuppleAssetInfo* out);
/** Fills out. Parts have the order of the file's nodes. Errors: part is not below partCount. */
SUPPLE_API SuppleResult suppleGetPartInfo(SuppleContext context, SuppleAsset asset, uint32_t part, SupplePartInfo* out);
/** Fills out. Errors: clip is not below SuppleAssetInfo.clipCount. */
SUPPLE_API SuppleResult suppleGetClipInfo(SuppleContext context, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out);
/** A box in model space that holds every vertex of the cage, of all parts, at every time of a clip, between its keys
 * too. Morph weights are those of the clip. clip may also be SUPPLE_BIND_POSE or SUPPLE_REST_POSE. The box is
 * conservative: it may be a little larger than what it holds.
 *
 * It holds cages that linear skinning deforms. The smooth surface may lie a little outside its cage, and dual
 * quaternions bulge: suppleGetGroupClipBounds has the box of a surface. An instance's transform is applied afterwards:
 * transform the eight corners. The root moves as in the clip. If rootMotion takes the root's movement out of a pose,
 * the box does not hold: move each side out by the farthest that the root gets from where it starts, or use the boxes
 * of instances (suppleReadInstanceBounds). With YAW, use those. The box holds for one clip alone: poses of several
 * layers may leave the boxes of their clips.
 *
 * The box of a clip is computed when it is first asked for, and kept with the asset. That takes
 * milliseconds, or a few tenths of a second for long clips of large cages: ask while loading, and from one thread
 * alone. Errors: no such clip. */
SUPPLE_API SuppleResult suppleGetClipBounds(SuppleContext context, SuppleAsset asset, uint32_t clip, SuppleBounds* out);
/** Fills out. Joints have the order of the file's skin. Errors: joint is not below jointCount. */
SUPPLE_API SuppleResult suppleGetJointInfo(SuppleContext context, SuppleAsset asset, uint32_t joint,
                                           SuppleJointInfo* out);
/** Fills out. Errors: target is not below morphTargetCount. */
SUPPLE_API SuppleResult suppleGetMorphTargetInfo(SuppleContext context, SuppleAsset asset, uint32_t target,
                                                 SuppleMorphTargetInfo* out);
/** Fills out. Expressions have the order of the file. Errors: expression is not below expressionCount. */
SUPPLE_API SuppleResult suppleGetExpressionInfo(SuppleContext context, SuppleAsset asset, uint32_t expression,
                                                SuppleExpressionInfo* out);
/** Makes weights of morph targets of expressions, for suppleSetMorphWeights. weights has a weight per expression of the
 * asset; it counts from 0 to 1. out has morphTargetCount weights and is filled: those that the file gives the targets,
 * and what expressions add to each. As VRM 1.0 says, an expression may hold back those that blink, look or speak; their
 * weights then count less, or not at all. Errors: a count is not the asset's, or a weight is not a number. */
SUPPLE_API SuppleResult suppleFillExpressionWeights(SuppleContext context, SuppleAsset asset, const float* weights,
                                                    uint32_t expressionCount, float* out, uint32_t morphTargetCount);
/** Names the crease sets of an asset, at most SUPPLE_MAX_CREASE_SETS, for suppleSetSharpness. `out` has room for *count
 * names, which live as long as the asset, or is null. *count becomes the number of sets. SUPPLE_INCOMPLETE: there are
 * more than fit. */
SUPPLE_API SuppleResult suppleGetCreaseSets(SuppleContext context, SuppleAsset asset, const char** out,
                                            uint32_t* count);
/** Fills out. Materials have the order of the file. Errors: material is not below materialCount. */
SUPPLE_API SuppleResult suppleGetMaterialInfo(SuppleContext context, SuppleAsset asset, uint32_t material,
                                              SuppleMaterialInfo* out);
/** Fills out with what a material has beyond suppleGetMaterialInfo. Errors: material is not below materialCount. */
SUPPLE_API SuppleResult suppleGetMaterialLayers(SuppleContext context, SuppleAsset asset, uint32_t material,
                                                SuppleMaterialLayers* out);
/** Names the variants of materials that an asset's file has (KHR_materials_variants), for
 * SuppleAssetDesc.materialVariant. `out` has room for *count names, which live as long as the asset, or is null. *count
 * becomes the number of variants. SUPPLE_INCOMPLETE: there are more than fit. */
SUPPLE_API SuppleResult suppleGetMaterialVariants(SuppleContext context, SuppleAsset asset, const char** out,
                                                  uint32_t* count);
/** Fills out. Images have the order of the file. Errors: image is not below imageCount. */
SUPPLE_API SuppleResult suppleGetImageInfo(SuppleContext context, SuppleAsset asset, uint32_t image,
                                           SuppleImageInfo* out);

/* ---------------------------------------------------------------------------------------------------- groups */

/** How SUPPLE_SCHEME_PREP scales the tangents at irregular vertices (of a valence other than 4). DEFAULT: as
 * docs/prep.md derives it. PRINTED: as the paper prints it. */
typedef enum SuppleTangentMode {
    SUPPLE_TANGENTS_DEFAULT = 0,
    SUPPLE_TANGENTS_PRINTED = 1,
    SUPPLE_TANGENTS_MAX_ENUM = 0x7FFFFFFF
} SuppleTangentMode;
/** At a boundary vertex that has one face, the surface passes through the vertex (SHARP) or is rounded (SMOOTH). */
typedef enum SuppleCornerRule {
    SUPPLE_CORNERS_SHARP = 0,
    SUPPLE_CORNERS_SMOOTH = 1,
    SUPPLE_CORNERS_MAX_ENUM = 0x7FFFFFFF
} SuppleCornerRule;
/** Options of SUPPLE_SCHEME_PREP. */
typedef struct SupplePrepOptions {
    uint32_t structSize;
    SuppleTangentMode tangentMode;
    SuppleCornerRule cornerRule;
} SupplePrepOptions;

/** What SUPPLE_SCHEME_BLEND makes of a sharp edge. CUT: a line in which two sheets meet. CURVE: a narrow ridge, as in
 * the paper. */
typedef enum SuppleCreaseMode {
    SUPPLE_CREASES_CUT = 0,
    SUPPLE_CREASES_CURVE = 1,
    SUPPLE_CREASES_MAX_ENUM = 0x7FFFFFFF
} SuppleCreaseMode;
/** Options of SUPPLE_SCHEME_BLEND. */
typedef struct SuppleBlendOptions {
    uint32_t structSize;
    SuppleCreaseMode creaseMode;
    float sharpThreshold; /**< edges of this sharpness and more are sharp, others smooth; 0 = 1 */
} SuppleBlendOptions;

/** Whose rules SUPPLE_SCHEME_FRAGMENTS refines by. CATMULL_CLARK: any polygons. LOOP: triangles, into which larger
 * faces are split; patches are of class SUPPLE_PATCH_LOOP. */
typedef enum SuppleFragmentRules {
    SUPPLE_RULES_CATMULL_CLARK = 0,
    SUPPLE_RULES_LOOP = 1,
    SUPPLE_RULES_MAX_ENUM = 0x7FFFFFFF
} SuppleFragmentRules;
/** Options of SUPPLE_SCHEME_FRAGMENTS. */
typedef struct SuppleFragmentsOptions {
    uint32_t structSize;
    SuppleFragmentRules rules;
} SuppleFragmentsOptions;

/** Layout of a surface vertex. Positions have the same bits in all. */
typedef enum SuppleVertexFormat {
    SUPPLE_VERTEX_16 = 0, /**< float3 position, octahedral normal in 2 x snorm16 (x in the low half) */
    SUPPLE_VERTEX_24 = 1, /**< float3 position, float3 normal */
    /** float3 position alone: for rays, physics and depth. It costs less to evaluate. Not for views, and not with
     * SUPPLE_GROUP_TANGENTS. */
    SUPPLE_VERTEX_12 = 2,
    SUPPLE_VERTEX_MAX_ENUM = 0x7FFFFFFF
} SuppleVertexFormat;

/** How several joints move one vertex. DUAL_QUATERNION keeps the girth of a limb that twists or bends, and bulges where
 * it bends far. CENTERS_OF_ROTATION keeps the girth too, with less of a bulge. DELTA_MUSH evens out rough weights, and
 * keeps no volume. Joints may scale and shear with all. A vertex that follows one joint alone, as all its neighborhood
 * does, moves the same with all. docs/skinning.md compares them. */
typedef enum SuppleSkinning {
    SUPPLE_SKINNING_LINEAR = 0,
    SUPPLE_SKINNING_DUAL_QUATERNION = 1,
    /** Each vertex turns about a point of the rest pose. The first group that asks for it finds these points, one per
     * cage vertex, unless they are prepared (supple_prepare.h). */
    SUPPLE_SKINNING_CENTERS_OF_ROTATION = 2,
    /** Weights are smoothed over the cage, and each vertex turns as its neighborhood does: for rigs whose weights are
     * hard or rough. The first group that asks for it smooths them, unless they are prepared (supple_prepare.h). The
     * file may say by how much (SUPPLE_deformers: smoothing). SUPPLE_ERROR_LIMIT if the cage has so many vertices and
     * joints that this would take too long. */
    SUPPLE_SKINNING_DELTA_MUSH = 3,
    /** The same, but a vertex turns as the smoothed weights mix the joints' rotations. It takes half of the memory and
     * of the time. */
    SUPPLE_SKINNING_DELTA_MUSH_LIGHT = 4,
    /** What the file says of the meshes (SUPPLE_deformers: skinning): of the first part of which it says something. If
     * it says nothing, LINEAR. */
    SUPPLE_SKINNING_FROM_FILE = 5,
    SUPPLE_SKINNING_MAX_ENUM = 0x7FFFFFFF
} SuppleSkinning;

/** Who deforms the instances. With PALETTE_BUFFER and CAGE_BUFFER, the host writes a buffer on the device, for all
 * visible instances, in any frame it likes. `before` of suppleRecord must then name these writes, and the host's next
 * writes must wait for the compute shaders that suppleRecord recorded. With SUPPLE_CONTEXT_ASYNC_COMPUTE queueFamily
 * must own that buffer while they run: it is in none of the barriers of suppleRecord and suppleGetAcquireBarriers.
 * Functions that set poses or transforms give SUPPLE_ERROR_ARGUMENT if the group's source does not go with them. */
typedef enum SupplePoseSource {
    SUPPLE_POSES_SET = 0,            /**< suppleSetClipPose, suppleSetPose, suppleSetMatrixPose, ... */
    SUPPLE_POSES_PALETTE_BUFFER = 1, /**< SuppleGroupInfo.poses: joint palettes and morph weights */
    SUPPLE_POSES_CAGE_BUFFER = 2,    /**< SuppleGroupInfo.deformedCage: cage vertices, for example of a cloth solver */
    SUPPLE_POSES_PLAYBACK = 3,       /**< suppleSetPlayback: clips that the device plays by the group's time */
    SUPPLE_POSES_MAX_ENUM = 0x7FFFFFFF
} SupplePoseSource;

/** How texture coordinates are interpolated over the surface. LINEAR_ALL: linearly in every face. Otherwise they are
 * smooth, as the surface is: they belong to it like two more coordinates of the cage, with borders of their own along
 * seams. The names are those of OpenSubdiv and USD, and say which vertices on seams and borders keep their values
 * (docs/smooth_uvs.md). */
typedef enum SuppleUvInterpolation {
    /** What the file says of the parts (SUPPLE_mesh_cage: faceVaryingLinearInterpolation). If it says nothing,
     * LINEAR_ALL, but with tangents LINEAR_CORNERS_PLUS1. If the scheme cannot do it, LINEAR_ALL, and the log warns. */
    SUPPLE_UV_FROM_FILE = 0,
    SUPPLE_UV_LINEAR_NONE = 1,          /**< none: seams are smooth curves, ends of seams too */
    SUPPLE_UV_LINEAR_CORNERS_ONLY = 2,  /**< a corner where a chart has one face, or is sharp */
    SUPPLE_UV_LINEAR_CORNERS_PLUS1 = 3, /**< and where three charts and more meet */
    SUPPLE_UV_LINEAR_CORNERS_PLUS2 = 4, /**< and where seams end */
    SUPPLE_UV_LINEAR_BOUNDARIES = 5,    /**< all vertices on seams and borders */
    SUPPLE_UV_LINEAR_ALL = 6,
    SUPPLE_UV_MAX_ENUM = 0x7FFFFFFF
} SuppleUvInterpolation;

/** What a group writes besides surface vertices, and how. */
typedef enum SuppleGroupFlags {
    SUPPLE_GROUP_PATCHES = 1,    /**< also write the patch coefficients, for inspection */
    SUPPLE_GROUP_ATTRIBUTES = 2, /**< also write the static surface attributes: UVs, color, face UVs */
    SUPPLE_GROUP_MOTION = 4,     /**< also write where every surface vertex was in the frame before */
    /** PREP, PM, CATMULL_CLARK and LOOP without a view (POLYGONS has it in any case): an instance is one indexed mesh,
     * which stores samples on the borders of patches once. Positions have the same bits as in other groups. Along
     * creases and boundaries, and with ATTRIBUTES along their seams, each side has vertices of its own. See
     * SuppleDrawRange. */
    SUPPLE_GROUP_INDEXED_MESH = 8,
    /** Groups of a view: one level of detail per instance instead of one per edge. It is computed from the instance's
     * bounds, and from the longest edge and the sharpest bend in the bind pose. */
    SUPPLE_GROUP_ONE_LEVEL = 32,
    /** Also compute the bounds of every visible instance (suppleGetInstanceBounds), which groups of a view have in any
     * case, and copy them to the host (suppleReadInstanceBounds). */
    SUPPLE_GROUP_BOUNDS = 64,
    /** Groups without a view: the host draws the group window by window (SuppleGroupInfo.windowCount). Without this
     * flag suppleCreateGroup fails if the device cannot bind the surface vertices as a whole, and the log names the
     * largest capacity. To learn it in a program, create the group with this flag: if its windowCount is not 1, its
     * windowSize is a capacity that fits. */
    SUPPLE_GROUP_WINDOWS = 128,
    /** With ATTRIBUTES: also write a tangent per surface vertex, for normal maps. See SuppleVertexStreams.tangents. */
    SUPPLE_GROUP_TANGENTS = 256,
    /** Groups of a view: what the camera sees does not matter for poses. In a view with SUPPLE_VIEW_CULL all visible
     * instances are posed and deformed. Without this flag, those that surely are out of sight are left out before they
     * are posed. Use it if you read poses or deformed cages of instances that the camera does not see. In any view,
     * steps of SUPPLE_GROUP_SPRINGS and SUPPLE_GROUP_SOFT are run in full however small an instance is on the screen.
     * Without this flag, what plays has less of them below 64 pixels, and none below 24 (docs/soft.md). Use it if
     * replays with other cameras must have the same bits. */
    SUPPLE_GROUP_POSE_UNSEEN = 512,
    /** With SUPPLE_POSES_SET or SUPPLE_POSES_PLAYBACK: instances may have modifiers (suppleSetModifiers). These cost 2
     * KiB of memory per instance, on the device if it plays. */
    SUPPLE_GROUP_MODIFIERS = 1024,
    /** With SUPPLE_POSES_PLAYBACK: instances may go over from what they play to something else
     * (SupplePlaybackDesc.transition). Room for it costs 64 bytes per node that moves a joint, and 8 per morph target,
     * for each instance: of device memory, and of staging memory for each frame in flight. */
    SUPPLE_GROUP_TRANSITIONS = 2048,
    /** With SUPPLE_POSES_PLAYBACK: instances may be posed at every second, fourth or eighth step of a grid of times
     * only, and go straight from pose to pose between these (SupplePlaybackDesc.updateInterval). Two poses more are
     * kept of each instance: 96 bytes of device memory per joint, 128 with dual quaternions, 8 per morph target, and 48
     * per node. SuppleGroupInfo.poses has what is shown, as ever. The first group of an asset with this flag measures
     * its clips, which takes some milliseconds for each. */
    SUPPLE_GROUP_UPDATE_RATES = 4096,
    /** With SUPPLE_POSES_PLAYBACK or SUPPLE_POSES_SET: joints swing by the springs of the character's file (VRM:
     * docs/springs.md), behind layers, transitions and modifiers, in steps of 1/60 s of the group's time. What a step
     * leaves depends on the times at which calls are made, not on the frames between. It has no effect if the file has
     * no springs. Instances in the bind pose do not swing. suppleGetJointTransform gives joints without their swinging.
     * An instance that was just created, or whose time has gone back or forward by more than 8 steps, begins with its
     * joints at rest in the pose; so does one that was hidden, or out of a view's sight, for more than 8 steps.
     * suppleTeleport keeps how they hang. SUPPLE_GROUP_POSE_UNSEEN makes them independent of cameras. Device memory for
     * an instance: 9 times the matrices of all nodes, 64 bytes for each joint that swings, twice what is played, and
     * half a KiB. It does not go with SUPPLE_GROUP_UPDATE_RATES.
     *
     * With SUPPLE_POSES_SET the CPU runs the steps of all visible instances, in sight or not, in suppleRecord. Their
     * time is SuppleRecordDesc.time. A step is posed straight between the pose of the frame before and that of its own,
     * so what it leaves depends on frames too. No box is known of such instances before they are posed. */
    SUPPLE_GROUP_SPRINGS = 8192,
    /** With SUPPLE_POSES_PLAYBACK or SUPPLE_POSES_SET: vertices that the character's file paints jiggle about where
     * joints have them, or hang as cloth (SUPPLE_deformers: docs/soft.md, docs/cloth.md), in steps of 1/60 s of the
     * group's time, behind springs if the group has these. What a step leaves depends on the times at which calls are
     * made, not on frames. Without such vertices it has no effect. They begin at rest where springs do, but over time
     * that frames leave out they jiggle on, and cloth keeps its shape; suppleTeleport keeps how they move. All visible
     * instances are posed, in sight or not. Device memory for an instance: 64 bytes for each such vertex, 80 if its
     * volume is kept, 768, 112 for each cloth, 9 times all node matrices, twice what is played, 8 poses. It does not go
     * with UPDATE_RATES.
     *
     * With SUPPLE_POSES_SET the time is SuppleRecordDesc.time, and a step is posed straight between the pose of the
     * frame before and that of its own, so what it leaves depends on frames too. The memory is then without node
     * matrices and what is played; 8 poses more are staging memory, for each frame in flight. */
    SUPPLE_GROUP_SOFT = 16384,
    /** Groups without a view, in a context with SUPPLE_CONTEXT_RAY_TRACING: the host may build acceleration structures
     * from the surface vertices (suppleGetRayGeometry). Grids have 12 bytes of indices more for each triangle of an
     * instance, which all instances share. suppleSetRate takes no other rate than the group's. To trace what a view
     * draws, let a group with this flag follow its group (SuppleGroupDesc.instancesOf): docs/ray_tracing.md. */
    SUPPLE_GROUP_RAY_TRACING = 32768,
    /** PREP and PM without a view: surface vertices are neither stored nor written. The host's shaders evaluate patches
     * while they draw (supple_direct.h), with the same bits. That saves memory, and costs time (docs/direct.md).
     * Surfaces of other schemes in the same group have their vertices as ever, in vertexFormat. If all are such,
     * suppleCreateGroup fails. The flag goes with neither MOTION, TANGENTS, INDEXED_MESH nor RAY_TRACING. */
    SUPPLE_GROUP_DIRECT = 65536
} SuppleGroupFlags;

/** How the surface of a group is made, and how many instances it has room for. */
typedef struct SuppleGroupDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleGroupFlags */
    SuppleAsset asset;
    uint32_t capacity; /**< instances that can exist at a time, 1 or more */
    SuppleScheme scheme;
    /** Segments along a patch edge, 1..SUPPLE_MAX_RATE; 0 = 8.
     * FRAGMENTS: segments along an edge of the cage, rounded up to a power of two. A patch edge has half
     * of them (SuppleGridOutput.rate). With Catmull-Clark's rules, if the cage has faces that are no quads, it has a
     * quarter. BLEND and CATMULL_CLARK: if the cage has faces that are no quads, `rate` counts segments along an edge
     * of the cage. It is rounded up to an even number, and a patch edge has half of it. POLYGONS ignores it: the rate
     * is 1. */
    uint32_t rate;
    SuppleVertexFormat vertexFormat;
    SuppleSkinning skinning;
    SupplePoseSource poseSource; /**< PALETTE_BUFFER needs linear skinning */
    /** Optional: the group belongs to this view, which chooses its levels of detail (supple_view.h). flags may then
     * only have ONE_LEVEL and BOUNDS: the view's flags and vertexFormat apply. PREP, PM, CATMULL_CLARK, LOOP and BLEND
     * ignore `rate` and have a SuppleLevelOutput. With FRAGMENTS each instance gets the rate that its level asks for,
     * at most `rate`: see SuppleGridOutput.rates. POLYGONS has one rate only, so it is drawn as it is. The vertices of
     * FRAGMENTS and POLYGONS are in the group's own memory. They use none of the view's maxVertices, but count in
     * SuppleCameraDesc.vertexBudget. */
    SuppleView view;
    const SupplePrepOptions* prep;   /**< null: the defaults; other schemes ignore it */
    const SuppleBlendOptions* blend; /**< the same */
    /** Optional: partSchemeCount schemes for the first parts of the asset, which count instead of `scheme`. A part with
     * SUPPLE_SCHEME_AUTO has `scheme`. Parts that are sewn need the same scheme. If `scheme` is AUTO, name it for one
     * of them; it counts for the others. SUPPLE_SCHEME_CAGE is for all parts or none. */
    const SuppleScheme* partSchemes;
    uint32_t partSchemeCount;
    /** Optional: the group draws the instances of this group, which it follows, instead of instances of its own: in a
     * second view (split screen, a mirror), with another scheme or rate. Both groups have the same asset. capacity,
     * skinning and poseSource are those of the followed group, and 0 here. Instances are created and posed in the
     * followed group alone, and both use their slots. A frame that records the group must record the followed group
     * too, in the same suppleRecord or an earlier one. A group that follows another cannot be followed. Once the
     * followed group is destroyed, this group can only be destroyed.
     * Where both have the same surfaces at levels, each in its view, this group reads the coefficients that the
     * followed one makes (docs/lod.md). Then a frame that leaves this group out leaves its instances without motion in
     * the next. What belongs to the instances is asked of the followed group alone: priorities (so it needs a view if
     * they are to count), the boxes of suppleReadInstanceBounds, the memory of poses and cages, and the acquire
     * barriers of poses, cages and user data. */
    SuppleGroup instancesOf;
    /** It holds for both UV sets. POLYGONS has LINEAR_ALL alone. BLEND has all modes but
     * LINEAR_BOUNDARIES. If `scheme` names one of them with another mode, suppleCreateGroup fails. */
    SuppleUvInterpolation uvInterpolation;
    const SuppleFragmentsOptions* fragments; /**< null: the defaults; other schemes ignore it */
    /** 0: the group keeps its memory as long as it lives. Else it gives back the memory of its surfaces (vertices, what
     * they have beside, coefficients, scratch) once it has been recorded so many times in a row without an instance to
     * draw: all are hidden or, with SUPPLE_VIEW_CULL, surely out of sight (SuppleViewStatistics.unposedInstanceCount).
     * suppleBeginFrame looks whether there is one again, by the cameras, poses and visibilities that are set then, and
     * takes the memory before the frame. An instance that only comes into sight later in that frame is drawn from the
     * next frame on, as one that was hidden until then: it has no motion in its first frame. If there is no memory, the
     * log says so (SUPPLE_MESSAGE_DEVICE_MEMORY), nothing of the group is drawn, and each suppleBeginFrame tries again.
     * Whenever memory goes or comes, SuppleGroupInfo.surfaceVersion rises: ask for the outputs of grids and meshes, and
     * for ray geometry, anew. They have null buffers meanwhile. The buffers of a view stay. Instances, poses, cages and
     * points stay too. A group whose instances another group draws (instancesOf) keeps its memory: suppleCreateGroup of
     * the other one takes it again. */
    uint64_t keepUnseenFrames;
} SuppleGroupDesc;

/** Creates a group without instances. Compiles the pipelines that no earlier group of the context has needed, which may
 * take long. So create groups while loading, with a pipeline cache: docs/integration.md says which groups need the same
 * pipelines. Errors: a cage that the scheme cannot take, limits of the device, a view that is full (SuppleViewDesc),
 * memory. */
SUPPLE_API SuppleResult suppleCreateGroup(SuppleContext context, const SuppleGroupDesc* desc, SuppleGroup* out);
/** Also destroys its instances. The handle is dead at once. The memory is freed when the frames that used the group are
 * complete (suppleBeginFrame). */
SUPPLE_API SuppleResult suppleDestroyGroup(SuppleContext context, SuppleGroup group);
/** Changes how many instances the group has room for, 1 or more. The handles of the group, of its instances and of
 * groups that follow it (SuppleGroupDesc.instancesOf) stay valid. Instances keep their slots, poses, transforms,
 * visibility, hidden parts, priorities and user data. The group keeps its rate, its time and its masks. Compiles no
 * pipeline. It may become smaller too. If it has this capacity already, nothing is done.
 *
 * All output of these groups (suppleGetGroupInfo, ...) is dead at once: ask for it again, and write your descriptors
 * anew. Command buffers that are recorded may still use the old buffers, which are freed when their frames are
 * complete. Until then both groups are there, with memory for both and, in a view, runs for both (docs/lod.md). Call
 * this before the frame's suppleRecord of the group, which then writes the new buffers. In it all instances are new
 * (suppleTeleport). suppleReadInstanceBounds has no box until that frame is complete. With PALETTE_BUFFER and
 * CAGE_BUFFER the host fills the new buffers.
 * Errors: an instance has a slot that is not below capacity (SUPPLE_ERROR_LIMIT); the group follows another one; those
 * of suppleCreateGroup. Then nothing has changed. */
SUPPLE_API SuppleResult suppleSetCapacity(SuppleContext context, SuppleGroup group, uint32_t capacity);
/** Changes the rate of all surfaces from the next suppleRecord on. Call suppleGetGridOutput again after it. rate must
 * be 1 to the rate that the group was created with. Groups of FRAGMENTS, BLEND or POLYGONS, or with
 * SUPPLE_GROUP_INDEXED_MESH or _RAY_TRACING, cannot change it: they take only the rate that they were created with.
 * CATMULL_CLARK rounds it as it does SuppleGroupDesc.rate. Groups with levels take none. If one surface of the group
 * cannot change it, none does; only POLYGONS beside other schemes has no say. */
SUPPLE_API SuppleResult suppleSetRate(SuppleContext context, SuppleGroup group, uint32_t rate);

/* ---------------------------------------------------------------------------------------------------- instances */

/** Creates an instance in the bind pose, visible, with the identity transform. It gets the lowest free slot. (With
 * PALETTE_BUFFER and CAGE_BUFFER, Supple writes neither pose nor transform: the slot holds what the host writes there.)
 * SUPPLE_ERROR_LIMIT: the group is full. If frames in flight still read what a destroyed instance left in the slot, it
 * is not overwritten before they end. */
SUPPLE_API SuppleResult suppleCreateInstance(SuppleContext context, SuppleGroup group, SuppleInstance* out);
/** The instance is gone from the next suppleRecord on. */
SUPPLE_API SuppleResult suppleDestroyInstance(SuppleContext context, SuppleInstance instance);
/** visible: 0 or 1. A hidden instance costs nothing on the device and is not drawn. Its pose and transform stay. */
SUPPLE_API SuppleResult suppleSetVisible(SuppleContext context, SuppleInstance instance, uint32_t visible);
/** Hides or shows a part of an instance: a body under clothes, a weapon in a hand. visible: 0 or 1. New instances show
 * all parts, and suppleSetVisible changes no part. The rest of the instance keeps its bits: parts that are sewn to a
 * hidden part have the same surface, and bounds for culling hold the hidden part as well. No draw of the group's
 * outputs draws a hidden part, so it casts no shadow either. A part that is shown again has the motion that it would
 * have had.
 * Groups with levels leave hidden patches out of everything but bounds. Other groups go on computing them.
 * Groups that have a SuppleGridOutput need the device feature drawIndirectFirstInstance, because the draws of a part
 * that only some instances show have a firstInstance in their indirect commands: see SuppleGroupInfo.instances.
 * Errors: part is not below SuppleAssetInfo.partCount; the device lacks that feature (SUPPLE_ERROR_UNSUPPORTED). If the
 * device has it, but no VkPhysicalDeviceFeatures2 in SuppleContextDesc.enabledFeatures tells whether the host enabled
 * it, the call succeeds, and the host must have enabled it. */
SUPPLE_API SuppleResult suppleSetPartVisible(SuppleContext context, SuppleInstance instance, uint32_t part,
                                             uint32_t visible);
/** The next suppleRecord treats the instance as new: previous positions equal positions, so it has no motion.
 * Instances that were not visible in the group's last suppleRecord are new without this call. With
 * SUPPLE_GROUP_SPRINGS or SUPPLE_GROUP_SOFT, what swings or jiggles goes on as it did, as if the instance had not
 * moved: call this at the group's time of the jump. */
SUPPLE_API SuppleResult suppleTeleport(SuppleContext context, SuppleInstance instance);
/** Sets the wind about the instances of a group: float[3], a velocity in the world, in its units a second; 0 at first.
 * It carries along what swings (SUPPLE_GROUP_SPRINGS: docs/springs.md) and cloth (SUPPLE_GROUP_SOFT: docs/cloth.md), by
 * their drag in the air; elsewhere it has no effect. It blows from the group's time at the call on until that of the
 * next call, in groups with SUPPLE_POSES_SET from that of their last suppleRecord on. Errors: not finite, or beyond
 * SUPPLE_MAX_WIND; the group draws the instances of another one, whose wind it is. */
SUPPLE_API SuppleResult suppleSetWind(SuppleContext context, SuppleGroup group, const float* wind);
/** Places an instance. transform is an affine float[16] (last row 0, 0, 0, 1), applied after the pose. Surface vertices
 * are written in the space that it maps to, relative to the origin (suppleSetOrigin). A mirroring transform (negative
 * determinant) reverses the winding and the normals: both then show the inside as the outside, as they do where joints
 * mirror. SuppleGroupInfo.deformedCage says where. Errors: not finite, another last row, or the host fills the group's
 * poses (SupplePoseSource). */
SUPPLE_API SuppleResult suppleSetTransform(SuppleContext context, SuppleInstance instance, const float* transform);
/** Sets the translation of an instance's transform alone, with the precision that large worlds need. position: three
 * doubles. The next suppleSetTransform replaces it. Errors: as suppleSetTransform. */
SUPPLE_API SuppleResult suppleSetPosition(SuppleContext context, SuppleInstance instance, const double* position);
/** Gives an instance four floats of the host's own, such as a tint, which its shaders read by slot
 * (SuppleGroupInfo.userData, suppleUserData in supple_surface.glsl). Supple does not look at them. They are 0 in new
 * instances, and stay until they are set again. The next suppleRecord uploads those that have changed. */
SUPPLE_API SuppleResult suppleSetUserData(SuppleContext context, SuppleInstance instance, const float* data);
/** Gives an instance its own sharpness of a crease set: all edges of the set have it, whatever the file gives them. It
 * may change in every frame. sharpness is as in files: 0 is smooth, and every 1 more halves P_m's alpha, (2/3)
 * 2^-sharpness. It may be infinite. Below 0 the surface is rounder than smooth, down to SUPPLE_LEAST_SHARPNESS. With
 * SUPPLE_FILE_SHARPNESS, which new instances have, each edge has what the file gives it. Edges that are hard in the
 * file (10 and more) are cut and stay so, as boundaries do. Surfaces of SUPPLE_SCHEME_PM alone follow it (docs/pm.md);
 * texture coordinates stay where they are. Vertices move then, and motion vectors have that movement. A reloaded asset
 * keeps it by the set's name. Errors: set is not below the count of suppleGetCreaseSets, sharpness is out of range or
 * not a number, or no group draws the instance with SUPPLE_SCHEME_PM (SUPPLE_ERROR_ARGUMENT). */
SUPPLE_API SuppleResult suppleSetSharpness(SuppleContext context, SuppleInstance instance, uint32_t set,
                                           float sharpness);

/* ---------------------------------------------------------------------------------------------------- poses */

/** A pose stays until it is set again. Instances may be created, posed and placed at any time, also before the first
 * suppleBeginFrame and after suppleCancelFrame. With SUPPLE_POSES_SET, every frame uploads the poses of the slots in
 * use. A pose is 48 bytes per joint; with dual quaternions, 64 bytes per joint and 48 more. Morph targets add 4 bytes
 * each, and the sum is rounded up to 16. If instances were created, destroyed, hidden, shown or teleported, this frame
 * and the next one also upload 8 bytes per visible instance and 20 per draw range. With SUPPLE_CONTEXT_ASYNC_COMPUTE
 * every frame uploads these. For every part that some instance hides, 4 more bytes per visible instance that shows it
 * are uploaded with these; in a view, the masks of all slots in use instead: 8 bytes each, and 4 more per 32 parts
 * beyond the first 32. */

/** Poses an instance from a clip at a time in seconds, clamped to the clip. clip may also be SUPPLE_BIND_POSE or
 * SUPPLE_REST_POSE, without a time. What the clip does not animate is as in the rest pose. suppleSetPose in
 * supple_playback.h takes layers of clips. Errors: no such clip, time is not finite. */
SUPPLE_API SuppleResult suppleSetClipPose(SuppleContext context, SuppleInstance instance, uint32_t clip, double time);
/** Poses an instance from the host's own animation: jointCount model-space joint matrices (float[16] each), in the
 * order of the skin's joints. Supple applies the inverse bind matrices. Morph weights are those of the rest pose.
 * Errors: jointCount is not the asset's, a value is not finite. */
SUPPLE_API SuppleResult suppleSetMatrixPose(SuppleContext context, SuppleInstance instance, const float* jointMatrices,
                                            uint32_t jointCount);
/** Sets an instance's morph weights (morphTargetCount values). They replace the weights of all its poses, until you
 * pass null; pose drivers of the file (docs/pose_drivers.md) add to them. Errors: morphTargetCount is not the asset's,
 * a weight is not finite. */
SUPPLE_API SuppleResult suppleSetMorphWeights(SuppleContext context, SuppleInstance instance, const float* weights,
                                              uint32_t morphTargetCount);

/** Where a joint is, for what a character holds: out gets the joint's global transform (column-major float[16]). It is
 * the instance's transform times the joint's matrix in model space, without the inverse bind matrix, so it maps from
 * the joint's space to that of the surface vertices. It is what the next suppleRecord shows if nothing is set before
 * it: call this after the frame's suppleSetPose, suppleSetTransform, suppleSetTime, ..., also of hidden instances and
 * before the first frame. In the bind pose the joint's matrix is SuppleJointInfo.bindTransform. After
 * suppleSetMatrixPose it is the host's own, bit for bit if the instance's transform is the identity. Cost: with
 * SUPPLE_POSES_SET a matrix product, because the pose is kept. With SUPPLE_POSES_PLAYBACK the CPU computes the whole
 * pose that the device will compute, which costs what suppleSetPose costs with the same layers. The pose is kept for
 * more joints of the same instance, until another instance of the group is asked for, or suppleSetPlayback,
 * suppleSetTime or suppleSetMask changes it. So ask for all joints of one instance before the next one. Crowds read
 * SuppleGroupInfo.poses on the device instead (docs/integration.md). With SUPPLE_GROUP_SPRINGS it is where the joint is
 * before anything swings: how it swings, the device alone knows.
 * Errors: joint is not below jointCount; the host fills the group's poses (PALETTE_BUFFER, CAGE_BUFFER), so only the
 * device knows. */
SUPPLE_API SuppleResult suppleGetJointTransform(SuppleContext context, SuppleInstance instance, uint32_t joint,
                                                float* out);

/* ---------------------------------------------------------------------------------------------------- frame */

/** Starts a frame. frame is the host's number for it: 1 or more, and larger in every call. All frames up
 * to completedFrame, and this one too, have finished; it is 0 if none has. It must never fall, and must be below frame.
 * A cancelled frame counts as finished: pass its number only when all earlier frames have finished too. frame -
 * completedFrame must not exceed framesInFlight, so wait for the fence of frame - framesInFlight first. Numbers that
 * are skipped count in it. A frame lasts until the next suppleBeginFrame, or suppleCancelFrame. Frees what was
 * destroyed and is no longer used, and reads finished timestamps. Never waits. If the call is refused, no frame is
 * open, and the earlier one cannot be cancelled any more. suppleRecord, suppleRecordUploads, suppleRecordWarmUp and
 * suppleCancelFrame are then refused until a call succeeds. The log names the refused frame. */
SUPPLE_API SuppleResult suppleBeginFrame(SuppleContext context, uint64_t frame, uint64_t completedFrame);
/** Large worlds: sets where the coordinates on the device begin, three doubles; (0, 0, 0) at first. Set it near the
 * camera, after suppleBeginFrame and before the frame's first suppleRecord. The origin applies at once. If this frame
 * has recorded a group, it applies from the next suppleBeginFrame on. Move it in steps, for example when the camera has
 * gone 1 km: a new origin places all instances anew, and groups with SUPPLE_POSES_PLAYBACK upload the playback of all
 * slots in use.
 *
 * suppleSetTransform and suppleSetPosition take places in the world. Supple subtracts the origin from them in double
 * precision. Surface vertices, previous positions, bounds and suppleGetJointTransform are relative to it. So are
 * cameras and depth pyramids: set both again after a change (suppleSetCamera, suppleSetDepthPyramid). Previous
 * positions always use the present origin: for motion vectors, subtract the present origin from the last camera's
 * position. A box of suppleReadInstanceBounds is relative to the origin of its frame.
 * A group that is not recorded in a frame stays relative to the origin that it was recorded with: draw it with a camera
 * as seen from that one. Palettes and cages that the host writes (PALETTE_BUFFER, CAGE_BUFFER) are its own: it
 * subtracts the origin itself.
 * Errors: not finite. */
SUPPLE_API SuppleResult suppleSetOrigin(SuppleContext context, const double* origin);
/** Tells Supple that what was recorded since suppleBeginFrame will never be submitted (for example because the
 * swapchain is lost). The next frame repeats its uploads, and its instances are then new (suppleTeleport). Count the
 * frame as completed in suppleBeginFrame. Nothing can be recorded until the next suppleBeginFrame. */
SUPPLE_API SuppleResult suppleCancelFrame(SuppleContext context);

/** Stages and accesses on buffers, as in synchronization2. The flags of Vulkan 1.0 (VkPipelineStageFlags,
 * VkAccessFlags) have the same values and the same meaning here, so hosts that use 32-bit masks pass them on. */
typedef struct SuppleSyncScope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
} SuppleSyncScope;

/** Records the upload of the static tables of what was created since the last upload, and a barrier after it.
 * suppleRecord does this too. Only hosts that call suppleRecord on several threads need this call. They record it into
 * a command buffer that is submitted before the others. */
SUPPLE_API SuppleResult suppleRecordUploads(SuppleContext context, VkCommandBuffer commandBuffer);

/** Bounds the bytes of static data (tables of skins, clips and schemes, indices) that a frame uploads; 0, as at first:
 * no bound. Call it whenever no other call of the context runs. It applies at once, also to what waits already, and
 * takes `bytesPerFrame` of mapped memory for each frame in flight: all static data of what is created from then on goes
 * through it. Memory that an earlier bound took is freed once the frames with it are complete.
 *
 * What does not fit goes up with the next frames. The groups of suppleRecord are served in their order, so put first
 * what must be seen first; suppleRecordUploads and suppleRecordWarmUp serve all groups. A group whose data, or whose
 * leader's (SuppleGroupDesc.instancesOf), is not all there is left out: suppleRecord succeeds, none of the group's
 * passes runs, and its indirect draws draw nothing. Its other buffers hold nothing yet. Instances may be created, posed
 * and played meanwhile. suppleGetGroupUploadState tells when it is there: the first suppleRecord after bytesLeft has
 * become 0, or the one that uploads the last of them, works on it. If suppleSetCapacity makes a group anew that was
 * there, it is there at once. suppleReloadAsset brings new data, for which its groups wait.
 *
 * With 0, the call takes memory for all that waits, and the next suppleRecord uploads it.
 * Errors: device memory, or more than the device has for a buffer; then nothing has changed. */
SUPPLE_API SuppleResult suppleSetUploadBudget(SuppleContext context, VkDeviceSize bytesPerFrame);

/** Static data on its way to the device. */
typedef struct SuppleUploadState {
    uint32_t structSize;
    uint32_t complete;       /**< 1: bytesLeft is 0. A group that waits for nothing is not left out */
    VkDeviceSize bytes;      /**< in all */
    VkDeviceSize bytesLeft;  /**< that no frame has recorded yet */
    VkDeviceSize frameBytes; /**< that the open frame has recorded */
    VkDeviceSize totalBytes; /**< of a context: what all its frames have recorded, also of what is destroyed; else 0 */
} SuppleUploadState;

/** Fills out: what the context's assets, groups and views have. */
SUPPLE_API SuppleResult suppleGetUploadState(SuppleContext context, SuppleUploadState* out);
/** Fills out: what the asset's groups share. It goes up when a group is recorded that needs it. */
SUPPLE_API SuppleResult suppleGetAssetUploadState(SuppleContext context, SuppleAsset asset, SuppleUploadState* out);
/** Fills out: what the group needs, also of its asset, its view and the group that it follows. */
SUPPLE_API SuppleResult suppleGetGroupUploadState(SuppleContext context, SuppleGroup group, SuppleUploadState* out);

/** Lets drivers finish at load time what they would do in the first frames: lavapipe compiles a pipeline at its first
 * dispatch, which may take a second. Records the uploads of suppleRecordUploads, for all groups. Then it dispatches,
 * over no workgroups, every kernel that the given groups can use. This includes kernels that a first frame may not run:
 * those of additive layers, root motion and budgets. Name followed groups too. Groups need no instances and views no
 * camera. Record it outside a render pass, and not beside other calls of the context. The groups may be recorded by
 * suppleRecord in the same frame and command buffer, after this call. Without a loop of frames yet: suppleBeginFrame
 * with frame 1, this call, submit, wait, and go on with frame 2. Two things still wait for their first use:
 * suppleSetDepthPyramid, and another rate (call this again after suppleSetRate). Errors: no frame has begun, or it was
 * refused or cancelled; a stale handle. */
SUPPLE_API SuppleResult suppleRecordWarmUp(SuppleContext context, VkCommandBuffer commandBuffer,
                                           const SuppleGroup* groups, uint32_t groupCount);

/** Options of recording. */
typedef enum SuppleRecordFlags {
    SUPPLE_RECORD_TIMINGS = 1, /**< write GPU timestamps round every pass */
    /** suppleRecord places no barrier before its passes and ignores `before`. The host's own barrier must wait for all
     * earlier uses, also those by Supple: see suppleGetRecordScopes. */
    SUPPLE_RECORD_NO_ENTRY_BARRIER = 2
} SuppleRecordFlags;

/** What suppleRecord records, and how the host uses the outputs before and after it. */
typedef struct SuppleRecordDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleRecordFlags */
    const SuppleGroup* groups;
    uint32_t groupCount;
    /** Earlier uses of the outputs on this queue (for example the last frame's vertex shader reads), and the host's
     * writes into them (SupplePoseSource). Supple waits for its own earlier passes in any case. So it may be all zero
     * if there is no such use, or if a semaphore or a barrier of the host's has waited for it. */
    SuppleSyncScope before;
    /** The next uses of the outputs on this queue: all of Supple's writes become visible to them. If stages = 0, no
     * barrier follows the passes, and the host must place its own. With SUPPLE_CONTEXT_ASYNC_COMPUTE neither scope has
     * the draws of drawQueueFamily: semaphores and suppleGetAcquireBarriers are for these. */
    SuppleSyncScope after;
    /** The host's time in seconds, within plus or minus SUPPLE_MAX_TIME: the same for all groups of a frame. What moves
     * by itself, with what it remembers of each instance, gets the time that has passed since the group was recorded
     * last. If the time has not risen since then, it stands still; springs that see it go back begin anew. Springs of
     * groups with SUPPLE_POSES_SET move by it (SUPPLE_GROUP_SPRINGS); where there are none it may be 0. Clips play by
     * suppleSetTime. */
    double time;
} SuppleRecordDesc;

/** Records the passes of the groups, outside a render pass, for the visible instances as they are set now. Each group
 * may be recorded once per frame. Groups of one view must be recorded in one call. A frame may leave out a group; it
 * is then drawn as it was. It must record all groups of a view, or none. Supple does not check this. They write into
 * the same buffers, so the vertices of a group that is left out are lost. The host must submit what is recorded once,
 * in the order of recording, on one queue, or else call suppleCancelFrame. If the call fails, nothing is recorded. */
SUPPLE_API SuppleResult suppleRecord(SuppleContext context, VkCommandBuffer commandBuffer,
                                     const SuppleRecordDesc* desc);

/** For hosts whose frame graph places the barriers. `first` gets how suppleRecord's commands begin, and `last` what
 * they write. The barrier before suppleRecord: from your uses and from `last`, to `first`. The barrier after it: from
 * `last`, to your uses. Either pointer may be null. They are the same in every context and frame, on any thread.
 * All flags are those of Vulkan 1.0: cast to VkPipelineStageFlags and VkAccessFlags, they can go into
 * vkCmdPipelineBarrier as well as into vkCmdPipelineBarrier2. */
SUPPLE_API SuppleResult suppleGetRecordScopes(SuppleSyncScope* first, SuppleSyncScope* last);

/** With SUPPLE_CONTEXT_ASYNC_COMPUTE, suppleRecord ends with barriers that release the outputs to drawQueueFamily. This
 * call gives the matching acquire barriers. Record them with one vkCmdPipelineBarrier2 in the command buffer that
 * draws. Where there is no such function, put the same members into VkBufferMemoryBarrier, for vkCmdPipelineBarrier.
 * The submission that draws must wait for the compute submission's semaphore. Call it after the frame's suppleRecord
 * and before the next suppleBeginFrame. Release nothing back, because every frame writes the outputs anew. But the
 * compute submission must wait, by a semaphore, for the draws of earlier frames.
 * Ask for all groups that are drawn in one call. An acquire must match one release, so record each barrier once. A view
 * comes with the first of its groups in every call: if you ask in several, leave out what you have recorded.
 * use: the stages and accesses of the draws. Fills out and count. Errors: the context lacks that flag; a group was not
 * recorded in this frame; a stale handle. */
SUPPLE_API SuppleResult suppleGetAcquireBarriers(SuppleContext context, const SuppleGroup* groups, uint32_t groupCount,
                                                 SuppleSyncScope use, VkBufferMemoryBarrier2* out, uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- output */

/** Where a group's buffers are. These calls may be made at any time. suppleRecord fills the buffers. They are valid
 * until the group is destroyed or made anew (suppleSetCapacity, suppleReloadAsset). Data per instance lies at the
 * instance's slot. Buffers have usage STORAGE, UNIFORM_TEXEL and TRANSFER_SRC, and, as needed, TRANSFER_DST, VERTEX,
 * INDEX or INDIRECT. Offsets and sizes are in bytes. */

/** A part of one of Supple's buffers, to read, bind and copy from.
 *
 * Alignment: offset is a multiple of 256, so that it suits the descriptors of every device; only that of `indirect` is
 * a multiple of 4. size is a multiple of stride. stride is a multiple of 16, 12, 8 or 4 (of 2 for uint16 indices), as
 * the element has float4, float3, float2 or uint32 members, so buffers that can be vertex input satisfy every vertex
 * format with 32-bit components. */
typedef struct SuppleBufferRange {
    VkBuffer buffer; /**< null: the group was created without it */
    VkDeviceSize offset;
    VkDeviceSize size;
    uint32_t stride; /**< bytes per element */
} SuppleBufferRange;

/** How a surface becomes vertices. It follows from the group's description. */
typedef enum SuppleTessellation {
    SUPPLE_TESSELLATION_NONE = 0,         /**< SUPPLE_SCHEME_CAGE: there are no surface vertices */
    SUPPLE_TESSELLATION_GRIDS = 1,        /**< a grid of samples per patch: SuppleGridOutput */
    SUPPLE_TESSELLATION_INDEXED_MESH = 2, /**< one mesh per instance: SuppleGridOutput */
    /** FRAGMENTS in a view: grids, and a rate per instance. POLYGONS in a view: one mesh per instance, and one rate.
     * SuppleGridOutput. */
    SUPPLE_TESSELLATION_RATES = 3,
    SUPPLE_TESSELLATION_LEVELS = 4, /**< other schemes in a view: SuppleLevelOutput in supple_view.h */
    /** SUPPLE_GROUP_DIRECT: GRIDS without vertices. SuppleGridOutput says what to draw, SuppleDirectOutput what the
     * host's shaders make vertices of. All patches of a draw range have one class. */
    SUPPLE_TESSELLATION_DIRECT = 5
} SuppleTessellation;

/** What every group has. */
typedef struct SuppleGroupInfo {
    uint32_t structSize;
    uint32_t surfaceCount;            /**< see SuppleSurfaceInfo */
    uint32_t capacity;                /**< instances that it has room for */
    uint32_t cageVertexCount;         /**< per instance */
    uint32_t cageVerticesPerInstance; /**< >= cageVertexCount: the stride of deformedCage between slots */
    /** float4 (x, y, z, side) per cage vertex: slot * cageVerticesPerInstance + vertex. side is -1 if the joint that
     * moves the vertex most mirrors it (the determinant of its matrix in `poses`, with the transform, is negative),
     * else 1. docs/integration.md says what hosts do with it. With SUPPLE_POSES_CAGE_BUFFER the host writes 1, or -1
     * where it mirrors: SUPPLE_SCHEME_POLYGONS reads it. */
    SuppleBufferRange deformedCage;
    /** Per slot (stride bytes): per joint three rows of four floats, the 3x4 matrix transform * joint * inverse bind,
     * which takes a cage vertex from the bind pose to its place; then a float weight per morph target. With every
     * SuppleSkinning but LINEAR: first the three rows of the transform; per joint the three rows of joint * inverse
     * bind, then its rotation as a quaternion (x, y, z, w); then the weights. Null with SUPPLE_POSES_CAGE_BUFFER. */
    SuppleBufferRange poses;
    /** uint32 per visible instance (in a view: per instance that its camera sees): the slot, in rising order. Groups
     * without a view have more entries behind these: for every part that some instance hides, the slots of the visible
     * instances that show it, in rising order. The draws of such a part begin there: firstInstance of the indirect
     * command is the first of these entries, times SuppleDrawRange.patchCount. gl_InstanceIndex counts from
     * firstInstance, so shaders do the same as without hidden parts.
     * With SUPPLE_GROUP_WINDOWS, the visible slots of window w begin at entry w * windowSize. The draws of a window
     * count their entries from there, and firstInstance leads from there to the list of a part. */
    SuppleBufferRange instances;
    SuppleBufferRange userData; /**< float4 per slot: suppleSetUserData */
    /** A device bounds storage buffers (VkPhysicalDeviceLimits::maxStorageBufferRange), so a large group is cut into
     * windows. Window w is the slots from w * windowSize on, windowSize or what is left of them. vertices,
     * previousPositions, deformedCage, poses and patchCoefficients can be bound for one window, from its first slot on.
     * That is a multiple of 256 bytes, but not in `poses` of a group that follows another one. Bind all other buffers
     * as a whole. Without SUPPLE_GROUP_WINDOWS draws need no windows, however many there are. */
    uint32_t windowCount;
    uint32_t windowSize;     /**< slots per window; the last one may have fewer */
    SuppleSkinning skinning; /**< how Supple skins its cages, if it does: never FROM_FILE */
    /** 1: the group has given back the memory of its surfaces (SuppleGroupDesc.keepUnseenFrames), else 0. */
    uint32_t surfacesGivenBack;
    uint64_t surfaceVersion; /**< rises when that memory goes or comes */
} SuppleGroupInfo;

/** Fills out. */
SUPPLE_API SuppleResult suppleGetGroupInfo(SuppleContext context, SuppleGroup group, SuppleGroupInfo* out);

/** As suppleGetClipBounds, of the group's surfaces: with the group's skinning, and made larger by as far as a surface
 * of its schemes may lie outside the box of its cage. Errors: no such clip; the group was created with
 * SUPPLE_POSES_CAGE_BUFFER. */
SUPPLE_API SuppleResult suppleGetGroupClipBounds(SuppleContext context, SuppleGroup group, uint32_t clip,
                                                 SuppleBounds* out);

/** A surface: what a group makes of the parts that have one scheme. A group has one surface per scheme, in the order of
 * their first parts. If all parts have the same scheme, that is one. The functions below that take a surface want its
 * number, 0 to SuppleGroupInfo.surfaceCount - 1. To draw a group, draw all its surfaces. */
typedef struct SuppleSurfaceInfo {
    uint32_t structSize;
    SuppleScheme scheme; /**< never SUPPLE_SCHEME_AUTO */
    SuppleTessellation tessellation;
    uint32_t patchCount;     /**< per instance */
    uint32_t patchesPerEdge; /**< along an edge of the cage: 1, or 2 or 4 if the scheme subdivides the cage first */
    const uint32_t* parts;   /**< that the surface has, in rising order. Lives as long as the group's buffers */
    uint32_t partCount;
    /** SUPPLE_GROUP_PATCHES: float4 per coefficient, SUPPLE_PATCH_STRIDE per patch; see SupplePatchInfo. */
    SuppleBufferRange patchCoefficients;
} SuppleSurfaceInfo;

/** Fills out. Errors: surface is not below SuppleGroupInfo.surfaceCount. */
SUPPLE_API SuppleResult suppleGetSurfaceInfo(SuppleContext context, SuppleGroup group, uint32_t surface,
                                             SuppleSurfaceInfo* out);

/** The buffers of surface vertices. A surface vertex is made from a sample, which is a point of a patch's grid.
 * SuppleGridOutput and SuppleLevelDraw say which vertex belongs to which patch. vertices, previousPositions and
 * tangents have an entry per vertex of every slot. The others are static: an entry per vertex, which all instances of
 * the group use. In groups with levels all streams belong to the view: every frame writes them anew, one entry per
 * vertex. */
typedef struct SuppleVertexStreams {
    uint32_t structSize;
    SuppleVertexFormat vertexFormat;
    SuppleBufferRange vertices; /**< in vertexFormat. Null with SUPPLE_TESSELLATION_DIRECT */
    /** MOTION: float3, where the vertex was in the group's suppleRecord before the last one, at the present rate,
     * relative to the present origin. For new instances (suppleTeleport) it is the present position. In a frame that
     * does not record the group, nothing has moved since the frame before: bind `vertices` in its place, with their
     * stride (previousWords in supple_surface.glsl). The same holds for a view that is not recorded in a frame. */
    SuppleBufferRange previousPositions;
    SuppleBufferRange attributes; /**< ATTRIBUTES: float2 uv, linear RGBA in 4 x unorm16 */
    SuppleBufferRange uvs1;       /**< ATTRIBUTES, if the cage has a second UV set: float2 */
    /** ATTRIBUTES, if faces of the cage have trim tiles: float2 (u + 2 * tile, v), where the vertex lies in the tile of
     * its face; tile -1 for faces without one (docs/trimming.md). */
    SuppleBufferRange faceUvs;
    /** TANGENTS: one uint32 per vertex, counted as vertices are. It is glTF's TANGENT: a unit vector that is orthogonal
     * to the normal, in octahedral coordinates (x in snorm16 in the low half, y in the 15 bits above), and the sign w
     * of the frame in the highest bit, 1 if it is -1. suppleTangent in supple_surface.glsl decodes it, and
     * docs/tangents.md says where tangents point: as the normal map of the face's material lies (its uvSet, rotation
     * and scale), or the first UV set if it has none. The bitangent is w * cross(normal, tangent), for a normal map
     * whose green points up in the picture, as in glTF. w is the same all over a face. Where a pose or a transform
     * mirrors, w belongs to the normal that the vertex has. Hosts that turn that normal round negate w. */
    SuppleBufferRange tangents;
} SuppleVertexStreams;

/** Fills out. Errors: no such surface, or SUPPLE_TESSELLATION_NONE. */
SUPPLE_API SuppleResult suppleGetVertexStreams(SuppleContext context, SuppleGroup group, uint32_t surface,
                                               SuppleVertexStreams* out);

/** The shape that a patch is sampled over. R is the rate. Samples are numbered row by row, from 0. Corner i of the
 * patch is corner i of the domain. Triangles of all domains are counter-clockwise seen from outside, in the space of
 * the surface vertices, and their normals point outside, as the faces of the cage do: in Vulkan that is
 * VK_FRONT_FACE_COUNTER_CLOCKWISE, if the projection shows the world unmirrored. Where a pose or a transform mirrors,
 * both are reversed (SuppleGroupInfo.deformedCage).
 * - QUAD: (R+1)^2 samples. Sample (i, j) is number j (R+1) + i. u = i/R runs from corner 0 to 1, v = j/R from corner 0
 *   to 3.
 * - POLAR: the same samples. The row j = R is one point, corner 2.
 * - TRIANGLE: (R+1)(R+2)/2 samples. Rows j = 0..R go from the edge 0-1 towards corner 2, each with i = 0..R-j.
 * - PENTAGON: 5 R(R+1)/2 + 1 samples. For each edge s-(s+1), rows j = 0..R-1 go from the edge towards the centre, each
 *   with i = 0..R-j-1. The last point of a row is the first of the next edge's row. The centre comes last.
 * - MESH: a whole instance, with SUPPLE_TESSELLATION_INDEXED_MESH or SUPPLE_SCHEME_POLYGONS. */
typedef enum SuppleDomain {
    SUPPLE_DOMAIN_QUAD = 0,
    SUPPLE_DOMAIN_POLAR = 1,
    SUPPLE_DOMAIN_TRIANGLE = 2,
    SUPPLE_DOMAIN_PENTAGON = 3,
    SUPPLE_DOMAIN_MESH = 4
} SuppleDomain;

/** The patches of one domain, one material and one part. Ranges follow each other without gaps. Draw instance i, which
 * counts from the firstInstance of the indirect command (as gl_InstanceIndex does), is patch firstPatch + i %
 * patchCount of the instance in slot instances[i / patchCount]. firstInstance is 0 unless an instance hides the part.
 *
 * SUPPLE_DOMAIN_MESH: all triangles of one material and one part. Draw instance i is the instance in slot instances[i],
 * and an index is a surface vertex within the instance. To shaders that pull vertices, the mesh is one big patch:
 * patchCount is 1, firstVertex and firstPatch are 0, samplesPerPatch is SuppleGridOutput.vertexCount. Triangles have
 * the order of the patches of that range (suppleGetPatches), and within a patch the order of its domain's grid. */
typedef struct SuppleDrawRange {
    uint32_t firstPatch;
    uint32_t patchCount;
    uint32_t material; /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    SuppleDomain domain;
    uint32_t samplesPerPatch;
    uint32_t firstVertex; /**< of the range, among the surface vertices of an instance */
    uint32_t firstIndex;  /**< in SuppleGridOutput.indices: the triangles of one patch, used by all of the range */
    uint32_t indexCount;
    uint32_t part; /**< of the asset: suppleGetPartInfo */
} SuppleDrawRange;

/** What is drawn at one rate. Per draw range: bind `instances` and draw the range's command of `indirect`. */
typedef struct SuppleRate {
    uint32_t rate;           /**< segments along a patch edge: R of SuppleDomain */
    uint32_t firstDrawRange; /**< in SuppleGridOutput.drawRanges */
    uint32_t drawRangeCount; /**< the same at every rate of a group */
    /** uint32 per instance drawn at this rate: the slot, in rising order. Behind these, as in
     * SuppleGroupInfo.instances, the slots of those that show a part, for every part that some instance hides. */
    SuppleBufferRange instances;
} SuppleRate;

/** Tessellation GRIDS, INDEXED_MESH, RATES and DIRECT: what is drawn. All of it, arrays too, is valid until the group
 * is destroyed or made anew, or its rate is set.
 *
 * Sample s of patch p, in the draw range r, is the surface vertex slot * verticesPerInstance + r.firstVertex +
 * (p - r.firstPatch) * r.samplesPerPatch + s. Of a MESH, index i is the vertex slot * verticesPerInstance + i. */
typedef struct SuppleGridOutput {
    uint32_t structSize;
    uint32_t rate;        /**< segments along a patch edge: R of SuppleDomain. RATES: the largest */
    uint32_t vertexCount; /**< surface vertices per instance. RATES: the sum over all rates, coarser ones first */
    uint32_t verticesPerInstance;      /**< >= vertexCount: slot k starts at vertex k * this */
    const SuppleDrawRange* drawRanges; /**< drawRangeCount entries. RATES: those of all rates, see SuppleRate */
    uint32_t drawRangeCount;
    uint32_t rateCount;        /**< entries of rates */
    const SuppleRate* rates;   /**< in rising order. RATES: each instance is drawn at one. Else there is one entry */
    SuppleBufferRange indices; /**< uint16, of meshes uint32: see `stride` and SuppleDrawRange */
    /** VkDrawIndexedIndirectCommand per draw range, for the visible instances that show its part. With
     * SUPPLE_GROUP_WINDOWS: the same for each window, window after window. */
    SuppleBufferRange indirect;
} SuppleGridOutput;

/** Fills out. Errors: no such surface, or it has another tessellation (SuppleSurfaceInfo.tessellation). */
SUPPLE_API SuppleResult suppleGetGridOutput(SuppleContext context, SuppleGroup group, uint32_t surface,
                                            SuppleGridOutput* out);

/** Classes of patches: how many coefficients a patch has, and their order (docs/prep.md, docs/pm.md). */
typedef enum SupplePatchClass {
    SUPPLE_PATCH_REGULAR = 0,          /**< 16: bicubic, g[i + 4 j] */
    SUPPLE_PATCH_PERTURBED = 1,        /**< 32, p-rep: 16 g, then 16 h */
    SUPPLE_PATCH_POLAR = 2,            /**< 13, P_m: 12 as a bicubic's, then the apex for the whole row j = 3 */
    SUPPLE_PATCH_P3 = 3,               /**< 19, P_m: b004, then for each edge b300 b210 b120 b211 b121 b112 */
    SUPPLE_PATCH_P4 = 4,               /**< 25 */
    SUPPLE_PATCH_P5 = 5,               /**< 31 */
    SUPPLE_PATCH_FRAGMENT = 6,         /**< none, FRAGMENTS: a face of the cage once (or twice) subdivided */
    SUPPLE_PATCH_LOOP = 7,             /**< of versions that refined LOOP: no patch has it any more */
    SUPPLE_PATCH_BLEND = 8,            /**< none: a face of the cage, or of the subdivided cage */
    SUPPLE_PATCH_BLEND_SHARP = 9,      /**< none: with sharp edges */
    SUPPLE_PATCH_TRIANGLE = 10,        /**< none, POLYGONS: a triangle, as it is */
    SUPPLE_PATCH_IRREGULAR = 11,       /**< none, CATMULL_CLARK: a quad of leaves */
    SUPPLE_PATCH_IRREGULAR_SHARP = 12, /**< none, CATMULL_CLARK: with sharp edges */
    /** None, CATMULL_CLARK: no corner has a chain of leaves, but a semi-sharp crease passes. */
    SUPPLE_PATCH_CREASED = 13,
    SUPPLE_PATCH_LOOP_REGULAR = 14,         /**< none, LOOP: a triangle whose corners have valence 6 */
    SUPPLE_PATCH_LOOP_IRREGULAR = 15,       /**< none, LOOP: a triangle of leaves */
    SUPPLE_PATCH_LOOP_IRREGULAR_SHARP = 16, /**< none, LOOP: with semi-sharp edges */
    SUPPLE_PATCH_BLEND_REGULAR = 17 /**< none, BLEND: smooth, with corners of valence 4, or on a boundary 2 or 1 */
} SupplePatchClass;
#define SUPPLE_PATCH_STRIDE 32
#define SUPPLE_MAX_SIDES 5

/** A patch, as the cage sees it. */
typedef struct SupplePatchInfo {
    uint32_t face; /**< its face of the cage. A face of six or more sides, with POLYGONS of four, is split: each part is
                    * a patch */
    SupplePatchClass patchClass;
    uint32_t cornerCount;
    uint32_t corners[SUPPLE_MAX_SIDES]; /**< cage vertices, corner i at corner i of the domain. Points that subdivision
                                         * added: SUPPLE_NO_VERTEX */
    uint32_t coefficientCount;
} SupplePatchInfo;

/** Fills out and count: the surface's patches of one instance, in the order of SuppleDrawRange.firstPatch. */
SUPPLE_API SuppleResult suppleGetPatches(SuppleContext context, SuppleGroup group, uint32_t surface,
                                         SupplePatchInfo* out, uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- timings */

/** The passes of a frame. Later versions may add some, with new numbers. */
typedef enum SupplePass {
    SUPPLE_PASS_ALL = 0, /**< suppleSetBudget: all passes together. No timing has it */
    SUPPLE_PASS_UPLOAD = 1,
    SUPPLE_PASS_ATTRIBUTES = 2,
    SUPPLE_PASS_POSE = 3,
    SUPPLE_PASS_DEFORM = 4,
    SUPPLE_PASS_BOUNDS = 5,
    SUPPLE_PASS_LIST = 6,
    SUPPLE_PASS_VERTEX = 7,
    SUPPLE_PASS_ASSEMBLE = 8,
    SUPPLE_PASS_PATCH = 9,
    SUPPLE_PASS_LEVEL = 10,
    SUPPLE_PASS_SOLVE = 11,
    SUPPLE_PASS_PLACE = 12,
    SUPPLE_PASS_EVALUATE = 13,
    SUPPLE_PASS_MOTION = 14,
    SUPPLE_PASS_SHORTFALL = 15, /**< no pass: see SuppleTiming.pass */
    SUPPLE_PASS_POINTS = 16,    /**< supple_points.h */
    SUPPLE_PASS_QUERIES = 17,   /**< supple_queries.h */
    SUPPLE_PASS_MAX_ENUM = 0x7FFFFFFF
} SupplePass;

/** The name of a pass, in static storage: "deform", for example. */
SUPPLE_API const char* suppleGetPassName(SupplePass pass);

/** What a pass cost, for one group and frame. Its time is that from the end of what was recorded before it to its own
 * end, so it includes the barrier before it. Draws of the host are in no pass, also if they are in the same command
 * buffer. On a GPU, work of the host that runs at the same time takes its share of the device. */
typedef struct SuppleTiming {
    /** Upload, attributes, pose (up to five times), deform, vertex, assemble, patch, evaluate, motion. Groups of a
     * view also have bounds (twice with OCCLUSION; groups with SUPPLE_GROUP_BOUNDS have it as well), list, level
     * (twice), solve (once per view) and place, which comes once more if instances choose rates; and assemble and place
     * once more each, for the levels of chains that views ask for, if patches of catmull-clark or loop have chains. If
     * a group has several surfaces, passes that work on surfaces have an entry for each, and deform has one more for
     * each. An entry SHORTFALL is no pass and takes no time. It follows solve only in frames in which the view's budget
     * was not enough (SuppleViewStatistics.shortfall). QUERIES: a batch of suppleRecordQueries, if suppleRecord of the
     * frame was timed. */
    SupplePass pass;
    /** The surface of the group that the entry is about: SuppleSurfaceInfo has its parts. Parts of one surface go
     * through each pass together, so there are no times for each of them. SUPPLE_NO_SURFACE: the whole group. */
    uint32_t surface;
    SuppleGroup group; /**< of suppleRecord. QUERIES: id 0, as a batch asks several groups at once */
    uint64_t frame;
    double gpuBegin; /**< nanoseconds since the context's first timestamp; 0 if the queue has no timestamps */
    double gpuEnd;
    double cpuRecord; /**< nanoseconds of CPU time for recording the pass */
    /** How many elements the pass wrote, and how many bytes. Both are 0 if only the device knows, as in groups of a
     * view: SuppleViewStatistics has what the whole view wrote. SHORTFALL: how many instances are missing, and how
     * many bytes of surface vertices had no room. Missing instances count at their coarsest. */
    uint64_t points;
    uint64_t bytes; /**< see points */
} SuppleTiming;

/** The passes of the newest completed frame that was recorded with SUPPLE_RECORD_TIMINGS. timingSize is
 * sizeof(SuppleTiming): entries are as many bytes apart. The struct may grow in later versions: a caller of an older
 * one gets what it knows. Fills out and count. SUPPLE_NOT_READY: there is no such frame, and *count is 0. Never waits.
 * Errors: timingSize is of no version. */
SUPPLE_API SuppleResult suppleGetTimings(SuppleContext context, uint32_t timingSize, SuppleTiming* out,
                                         uint32_t* count);
/** The timestamp of the device, in its ticks, that gpuBegin and gpuEnd count from. It stays as long as the context
 * does. With VK_EXT_calibrated_timestamps a host lays the timings beside its own clock (docs/profiling.md).
 * SUPPLE_NOT_READY: nothing was timed yet, and *ticks is 0. Never waits. */
SUPPLE_API SuppleResult suppleGetTimingOrigin(SuppleContext context, uint64_t* ticks);

/** How well a pass has kept to its budget since the budget was set. */
typedef struct SuppleBudget {
    uint32_t structSize;
    double limit;            /**< nanoseconds of GPU time per frame */
    double latest;           /**< nanoseconds in the newest completed frame that was timed */
    double worst;            /**< nanoseconds in the slowest measured frame */
    uint64_t framesMeasured; /**< completed frames that were recorded with SUPPLE_RECORD_TIMINGS */
    uint64_t framesOver;     /**< measured frames above the limit */
} SuppleBudget;

/** Gives a pass a limit in nanoseconds of GPU time per frame, for all groups together. 0 removes the limit. If a
 * measured frame exceeds it and the one before did not, Supple logs a warning (SUPPLE_MESSAGE_BUDGET). The first frame
 * of a group also uploads its tables, so set budgets after it. Errors: no such pass; nanoseconds is negative or not
 * finite. */
SUPPLE_API SuppleResult suppleSetBudget(SuppleContext context, SupplePass pass, double nanoseconds);
/** Fills out. SUPPLE_NOT_READY: the pass has no budget. */
SUPPLE_API SuppleResult suppleGetBudget(SuppleContext context, SupplePass pass, SuppleBudget* out);

/* ---------------------------------------------------------------------------------------------------- memory */

/** Device memory in bytes, by purpose. It is what vkAllocateMemory or SuppleMemoryCallbacks gave, alignment included.
 * Each byte counts for one purpose, or is spare, so these add up to deviceLocal + hostVisible. */
typedef struct SuppleMemoryUse {
    uint32_t structSize;
    /** Successful calls of vkAllocateMemory or SuppleMemoryCallbacks.allocate. Blocks count for the context alone. */
    uint32_t allocationCount;
    VkDeviceSize deviceLocal;  /**< never mapped */
    VkDeviceSize hostVisible;  /**< mapped: staging and readback */
    VkDeviceSize tables;       /**< static: skins, clips, the tables of schemes, indices */
    VkDeviceSize poses;        /**< palettes, morph weights, what instances play */
    VkDeviceSize cages;        /**< deformed cages */
    VkDeviceSize coefficients; /**< of patches; with MOTION those of two frames */
    VkDeviceSize vertices;     /**< surface vertices */
    VkDeviceSize streams;      /**< beside them: previous positions, attributes, frames of points */
    VkDeviceSize lists;        /**< of instances and patches, with bounds, levels and indirect arguments */
    VkDeviceSize scratch;      /**< what one pass leaves for the next */
    VkDeviceSize staging;      /**< what goes up: per frame in flight, and of static tables until they are uploaded */
    VkDeviceSize readback;     /**< what comes back: statistics of views, boxes, timings on CPU devices */
    VkDeviceSize spare;        /**< of the context alone: in blocks, and free for what comes; never mapped */
    VkDeviceSize spareVisible; /**< the same of what is mapped */
    /** What a group has given back and will take again (SuppleGroupDesc.keepUnseenFrames). No other number counts it.
     * 0 for all but groups. */
    VkDeviceSize givenBack;
} SuppleMemoryUse;

/** Fills out: all that the context has allocated and not yet freed. That is its assets, groups and views, the context's
 * own, and what is destroyed but may still be used by frames in flight: suppleBeginFrame frees that. */
SUPPLE_API SuppleResult suppleGetContextMemory(SuppleContext context, SuppleMemoryUse* out);
/** Fills out: what all groups of the asset share. Groups add to it the tables of their schemes, which stay as long as
 * the asset and its groups. */
SUPPLE_API SuppleResult suppleGetAssetMemory(SuppleContext context, SuppleAsset asset, SuppleMemoryUse* out);
/** Fills out: what the group has beside its asset, its view and the group that it follows. */
SUPPLE_API SuppleResult suppleGetGroupMemory(SuppleContext context, SuppleGroup group, SuppleMemoryUse* out);
/** Fills out: what the view has for all its groups. */
SUPPLE_API SuppleResult suppleGetViewMemory(SuppleContext context, SuppleView view, SuppleMemoryUse* out);

/** An allocation that would exceed the budget. */
typedef struct SuppleMemoryRequest {
    uint32_t structSize;
    uint32_t hostVisible; /**< 0 or 1: mapped memory */
    const char* name;     /**< as in SuppleMemoryCallbacks.allocate; valid during the call */
    VkDeviceSize bytes;   /**< of this allocation */
    VkDeviceSize used;    /**< deviceLocal + hostVisible of the context before it */
    VkDeviceSize budget;  /**< that suppleSetMemoryBudget has set */
} SuppleMemoryRequest;

/** Returns 1 to allow the allocation, or 0 to refuse it. It may free memory of the host's own before it answers. It
 * must not call Supple. Called on the thread that called Supple. */
typedef uint32_t (*SuppleMemoryBudgetFunction)(const SuppleMemoryRequest* request, void* user);

/** Limits the context's memory, deviceLocal and hostVisible together. If an allocation would exceed it, Supple asks
 * `ask`; null: it is refused. Then the call that needed it fails with SUPPLE_ERROR_DEVICE_MEMORY, the log names what
 * was to be allocated (SUPPLE_MESSAGE_DEVICE_MEMORY), and all that exists goes on as before. `ask` and `user` are kept
 * until the next call or until the context is destroyed. suppleSetCapacity and suppleReloadAsset need the old and the
 * new memory together. bytes = 0 removes the limit. A limit below what is in use frees nothing. Hosts that follow
 * VK_EXT_memory_budget set the limit anew when their share changes. */
SUPPLE_API SuppleResult suppleSetMemoryBudget(SuppleContext context, VkDeviceSize bytes, SuppleMemoryBudgetFunction ask,
                                              void* user);

#ifdef __cplusplus
}
#endif

#include "supple_character.h" /* IWYU pragma: export */
#include "supple_direct.h"    /* IWYU pragma: export */
#include "supple_playback.h"  /* IWYU pragma: export */
#include "supple_points.h"    /* IWYU pragma: export */
#include "supple_prepare.h"   /* IWYU pragma: export */
#include "supple_queries.h"   /* IWYU pragma: export */
#include "supple_rays.h"      /* IWYU pragma: export */
#include "supple_recording.h" /* IWYU pragma: export */
#include "supple_view.h"      /* IWYU pragma: export */
#endif
