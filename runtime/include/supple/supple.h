/**
 * @file supple.h
 * Animated control cages to smooth surfaces, on Vulkan compute. C99.
 *
 * What it does: loads a character (glTF/GLB or arrays), poses its instances, deforms the control cage, builds the
 * patches of a smooth surface from it and evaluates them, all recorded into the host's command buffer; hands out
 * surface vertices, shared grid indices and indirect draw arguments; measures every pass.
 *
 * What it does not: create a Vulkan instance or device, submit, wait, draw, decode images, open windows, link a loader.
 *
 * Structs
 *   - start with structSize, the sizeof of the caller's header; zero in every other field means the default. Later
 *     versions only add fields at the end: a smaller struct of an older caller is taken as if the rest were zero, of a
 *     larger one what this library does not know must be zero, and comes back as zero. Structs without structSize never
 *     change.
 *   - Matrices are column-major float[16] for column vectors, right-handed, +Y up as glTF; angles radians, time
 *     seconds.
 *
 * Handles
 *   - carry an index and a generation: a stale or foreign one gives SUPPLE_ERROR_ARGUMENT, never a crash.
 *   - Destroying is allowed while frames are in flight: memory is freed by the suppleBeginFrame that is told of the
 *     completion of the last frame that used it.
 *
 * Errors
 *   - Functions return SUPPLE_OK or what went wrong; the reason goes to the log callback in one line, with an id that
 *     stays the same in all versions. A call that fails has done nothing, where its comment does not say otherwise.
 *   - After SUPPLE_ERROR_DEVICE_LOST every call that needs the device gives it again; destroying works.
 *
 * Threads
 *   - A context and everything made from it is used by one thread at a time, but for this: between suppleBeginFrame
 *     calls, what sets and queries instances of different groups may run at the same time, and so may suppleRecord for
 *     different groups into different command buffers, once suppleRecordUploads has been recorded for the frame. The
 *     log callback is then called from those threads.
 *   - Different contexts are independent.
 *
 * Recording
 *   - creates no Vulkan object and allocates no memory. It binds the compute pipeline, descriptor set 0 and push
 *     constants of the given command buffer; the host rebinds its own compute state afterwards.
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

#define SUPPLE_VERSION_MAJOR 0 /**< rises when a host must be changed or built anew; the SONAME's number */
#define SUPPLE_VERSION_MINOR 1 /**< rises with what is added */
#define SUPPLE_VERSION_PATCH 0
/** One number that rises with every version. */
#define SUPPLE_VERSION (SUPPLE_VERSION_MAJOR * 1000000 + SUPPLE_VERSION_MINOR * 1000 + SUPPLE_VERSION_PATCH)

#define SUPPLE_BIND_POSE 0xFFFFFFFFu   /**< clip index that means: the cage as modelled, without morph targets */
#define SUPPLE_REST_POSE 0xFFFFFFFEu   /**< clip index that means: the file's node transforms and morph weights */
#define SUPPLE_NO_MATERIAL 0xFFFFFFFFu /**< faces without a material */
#define SUPPLE_NO_JOINT 0xFFFFFFFFu    /**< the parent of a root joint */
#define SUPPLE_NO_VERTEX 0xFFFFFFFFu   /**< a patch corner that is no vertex of the cage */
#define SUPPLE_NO_IMAGE 0xFFFFFFFFu
#define SUPPLE_NO_TRIM_TILE 0xFFFFFFFFu
#define SUPPLE_MAX_TRIM_TILES 1024u
#define SUPPLE_MAX_RATE 64u                /**< segments along a patch edge */
#define SUPPLE_MAX_FRAMES_IN_FLIGHT 4u     /**< see suppleBeginFrame */
#define SUPPLE_PRIORITY_COUNT 4u           /**< see suppleSetPriority */
#define SUPPLE_MAX_PLAYBACK_LAYERS 8u      /**< see suppleSetPlayback */
#define SUPPLE_MAX_MASKS 16u               /**< a group's: see suppleSetMask */
#define SUPPLE_MAX_TIME 1e9                /**< seconds: times of playback lie between minus this and this */
#define SUPPLE_MAX_VIEW_VERTICES 50331648u /**< see SuppleViewDesc.maxVertices */
#define SUPPLE_MAX_TIMINGS 4096u           /**< entries a frame: passes x groups; what goes beyond is not timed */

/** A context borrows the host's device; assets and groups belong to one context. */
typedef struct SuppleContext_T* SuppleContext;
/** A character as loaded: cage, skeleton, clips, materials. */
typedef struct SuppleAsset {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleAsset;
/** Instances of one asset with one scheme and rate, evaluated together. */
typedef struct SuppleGroup {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleGroup;
/** A camera's level of detail, for the groups it sees. */
typedef struct SuppleView {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleView;
/** One character of a group. */
typedef struct SuppleInstance {
    SuppleGroup group;
    uint32_t slot;       /**< below the group's capacity: where its output lies, see SuppleGroupOutput */
    uint32_t generation; /**< 0 is never valid */
} SuppleInstance;

/** What a call gives back. Errors are negative. */
typedef enum SuppleResult {
    SUPPLE_OK = 0,
    SUPPLE_NOT_READY = 1,          /**< no finished frame to report yet */
    SUPPLE_INCOMPLETE = 2,         /**< the array was too small; it was filled as far as it went */
    SUPPLE_ERROR_ARGUMENT = -1,    /**< a rule of this header was broken */
    SUPPLE_ERROR_ASSET = -2,       /**< malformed file or cage, or the scheme cannot take it */
    SUPPLE_ERROR_UNSUPPORTED = -3, /**< the device lacks something listed by suppleQueryRequirements */
    SUPPLE_ERROR_LIMIT = -4,       /**< a limit of the device or of this header is exceeded */
    SUPPLE_ERROR_HOST_MEMORY = -5,
    SUPPLE_ERROR_DEVICE_MEMORY = -6,
    SUPPLE_ERROR_DEVICE_LOST = -7,
    SUPPLE_ERROR_VULKAN = -8
} SuppleResult;

/** SUPPLE_VERSION of the library that is running. */
SUPPLE_API uint32_t suppleGetVersion(void);
/** The name of a result, static storage. */
SUPPLE_API const char* suppleResultString(SuppleResult result);

/** ERROR: the call failed. WARNING: something is left out, mended or over its budget. INFO: worth knowing. */
typedef enum SuppleSeverity { SUPPLE_SEVERITY_INFO, SUPPLE_SEVERITY_WARNING, SUPPLE_SEVERITY_ERROR } SuppleSeverity;

/** What a message is about. Numbers keep their meaning; new ones may come. */
typedef enum SuppleMessage {
    SUPPLE_MESSAGE_NULL_POINTER = 100,
    SUPPLE_MESSAGE_STRUCT_SIZE = 101,  /**< smaller than the first version's, or with fields this library lacks */
    SUPPLE_MESSAGE_STALE_HANDLE = 102, /**< destroyed, or another context's */
    SUPPLE_MESSAGE_OUT_OF_RANGE = 103, /**< an index, a count or an enumerator */
    SUPPLE_MESSAGE_NOT_FINITE = 104,
    SUPPLE_MESSAGE_CONFLICT = 105,     /**< arguments that exclude each other, or the group's description */
    SUPPLE_MESSAGE_OUT_OF_ORDER = 106, /**< a call before the one it needs, or twice in a frame */
    SUPPLE_MESSAGE_ASSET_REFUSED = 200,
    SUPPLE_MESSAGE_ASSET_WARNING = 201,    /**< taken, but something in the file is left out or mended */
    SUPPLE_MESSAGE_SCHEME_NOTE = 202,      /**< what a scheme changed about the cage */
    SUPPLE_MESSAGE_RATE_CHANGED = 203,     /**< the scheme takes another rate than the one asked for */
    SUPPLE_MESSAGE_DEVICE_UNSUITED = 300,  /**< see suppleQueryRequirements */
    SUPPLE_MESSAGE_FEATURE_DISABLED = 301, /**< the device has it, the host did not enable it */
    SUPPLE_MESSAGE_LIMIT = 302,
    SUPPLE_MESSAGE_HOST_MEMORY = 400,
    SUPPLE_MESSAGE_DEVICE_MEMORY = 401,
    SUPPLE_MESSAGE_DEVICE_LOST = 402,
    SUPPLE_MESSAGE_VULKAN = 403,
    SUPPLE_MESSAGE_BUDGET = 500 /**< a pass took longer than suppleSetBudget allows */
} SuppleMessage;

/** Called on the thread that called into Supple. text is one line, valid during the call. */
typedef void (*SuppleLogFunction)(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

/* ---------------------------------------------------------------------------------------------------- device */

/** What a device must have. Feature structs have their sType set and pNext null, so that a host can chain them into
 * VkDeviceCreateInfo as they are; only what Supple needs is VK_TRUE. No device extensions are needed. */
typedef struct SuppleRequirements {
    uint32_t structSize;
    uint32_t apiVersion; /**< lowest VkPhysicalDeviceProperties::apiVersion */
    VkPhysicalDeviceVulkan12Features features12;
    VkPhysicalDeviceVulkan13Features features13;
    char reason[256]; /**< empty when the device has it all, else the first thing missing */
} SuppleRequirements;

/** Fills out. SUPPLE_OK: the device will do. SUPPLE_ERROR_UNSUPPORTED: out->reason says what is missing. */
SUPPLE_API SuppleResult suppleQueryRequirements(VkInstance instance, VkPhysicalDevice physicalDevice,
                                                PFN_vkGetInstanceProcAddr getInstanceProcAddr, SuppleRequirements* out);

/** How work is laid on the device. AUTO: NARROW on CPU devices (one lane a patch, texel-buffer loads), WIDE on GPUs
 * (many lanes a patch, coefficients in shared memory). Positions agree bit for bit. */
typedef enum SuppleMapping {
    SUPPLE_MAPPING_AUTO = 0,
    SUPPLE_MAPPING_NARROW = 1,
    SUPPLE_MAPPING_WIDE = 2
} SuppleMapping;

/** Options of a context. */
typedef enum SuppleContextFlags {
    SUPPLE_CONTEXT_DEBUG_UTILS = 1,  /**< the host enabled VK_EXT_debug_utils: label passes, name objects */
    SUPPLE_CONTEXT_ASYNC_COMPUTE = 2 /**< what is drawn goes from queueFamily to drawQueueFamily */
} SuppleContextFlags;

/** A piece of device memory of the host's. */
typedef struct SuppleMemory {
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void* mapped;     /**< the byte at offset, mapped until freed, where HOST_VISIBLE was required; else ignored */
    void* allocation; /**< the host's own, e.g. a VmaAllocation */
} SuppleMemory;

/** Where device memory comes from. Called while contexts, assets and groups are created and destroyed and by
 * suppleBeginFrame, on the calling thread, never while recording. */
typedef struct SuppleMemoryCallbacks {
    /** VK_SUCCESS with out filled, else the reason. The memory is for buffers (linear), of a type in
     * requirements->memoryTypeBits that has all of `required` and, if that can be had, `preferred`. name is for
     * statistics and valid during the call. */
    VkResult (*allocate)(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                         VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user);
    /** Once for every successful allocate; no buffer is bound to it any more and no frame uses it. */
    void (*free)(const SuppleMemory* memory, void* user);
    void* user;
} SuppleMemoryCallbacks;

/** The host's device, and how Supple is to use it. */
typedef struct SuppleContextDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleContextFlags */
    /** Borrowed, as all handles here: must outlive the context. */
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    /** Created with what suppleQueryRequirements asks for. */
    VkDevice device;
    uint32_t queueFamily; /**< of the command buffers handed to suppleRecord; must support compute */
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkPipelineCache pipelineCache;          /**< optional */
    const VkAllocationCallbacks* allocator; /**< optional; used for every object, must outlive the context */
    uint32_t framesInFlight;                /**< 1..SUPPLE_MAX_FRAMES_IN_FLIGHT, 0 = 2 */
    SuppleMapping mapping;
    SuppleLogFunction log; /**< optional */
    void* logUser;
    /** Optional: the chain that was given to vkCreateDevice (VkDeviceCreateInfo::pNext). What Supple needs and does not
     * find enabled in it is named, instead of undefined behaviour later. Read during the call. */
    const void* enabledFeatures;
    const SuppleMemoryCallbacks* memory; /**< optional; copied. Null: vkAllocateMemory */
    uint32_t drawQueueFamily;            /**< with SUPPLE_CONTEXT_ASYNC_COMPUTE: see suppleGetAcquireBarriers */
} SuppleContextDesc;

/** Loads the device's functions; compiles next to nothing (see suppleCreateGroup). Errors: a requirement that the
 * device lacks or the host has not enabled, no compute in queueFamily, memory. */
SUPPLE_API SuppleResult suppleCreateContext(const SuppleContextDesc* desc, SuppleContext* out);
/** Frees all assets and groups too. No command buffer that uses them may be pending. Null is allowed. */
SUPPLE_API void suppleDestroyContext(SuppleContext context);

/* ---------------------------------------------------------------------------------------------------- assets */

/** P_m's own crease control: alpha of the edge vertex -> toward at its end `vertex`, in (0, 1]: 2/3 is smooth, smaller
 * is sharper. Overrides what follows from a crease's sharpness there. */
typedef struct SuppleCreaseScalar {
    uint32_t vertex;
    uint32_t toward;
    float alpha;
} SuppleCreaseScalar;

/** A control cage given as arrays (copied). Polygons are oriented counter-clockwise seen from outside. Sharpness counts
 * as in OpenSubdiv and USD: 0 is smooth, 10 and more infinitely sharp. */
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
    const uint32_t* creaseVertices; /**< 2 per crease: the edge's ends */
    const float* creaseSharpnesses;
    uint32_t cornerCount; /**< sharp vertices */
    const uint32_t* cornerVertices;
    const float* cornerSharpnesses;
    uint32_t creaseScalarCount;
    const SuppleCreaseScalar* creaseScalars;
    uint32_t holeCount; /**< faces that shape their neighbours but are not drawn */
    const uint32_t* holes;
    const uint32_t* faceTrimTiles; /**< optional: a trim tile a face, or SUPPLE_NO_TRIM_TILE; see SuppleTrimDomain */
} SuppleCageDesc;

/** Options of reading a file. */
typedef enum SuppleAssetFlags {
    SUPPLE_ASSET_PAIR_QUADS = 1 /**< plain triangles: merge consecutive pairs into quads */
} SuppleAssetFlags;

/** How an asset's external files (buffers, images) are found where a file system of the host's own holds them. */
typedef struct SuppleFileBytes {
    const void* bytes;
    size_t byteCount;
    void* handle; /**< the host's */
} SuppleFileBytes;
/** The host's file system, as far as an asset needs it. */
typedef struct SuppleFiles {
    /** Fills out, whose bytes stay valid until release, and returns non-zero; 0: there is no such file. path is
     * relative to the asset, percent-decoded, with forward slashes, without "..", "." or a scheme. Called on the thread
     * that calls suppleCreateAsset, before that returns. */
    int (*read)(const char* path, SuppleFileBytes* out, void* user);
    void (*release)(SuppleFileBytes* bytes, void* user); /**< optional; once for every read that succeeded */
    void* user;
} SuppleFiles;

/** Either a file in memory (bytes) or a cage as arrays. Everything is copied before the call returns. */
typedef struct SuppleAssetDesc {
    uint32_t structSize;
    uint32_t flags;    /**< SuppleAssetFlags */
    const char* name;  /**< begins every message about the asset; optional */
    const void* bytes; /**< .glb or .gltf; .obj when `name` ends so */
    size_t byteCount;
    const char* baseDirectory; /**< where the .gltf's external files lie; null allows none */
    const SuppleFiles* files;  /**< optional: asked instead of baseDirectory; needed during the call only */
    const SuppleCageDesc* cage;
} SuppleAssetDesc;

/** What an asset holds. Counts are those of the control cage, after welding. */
typedef struct SuppleAssetInfo {
    uint32_t structSize;
    uint32_t cageVertexCount;
    uint32_t faceCount;
    uint32_t jointCount;
    uint32_t clipCount;
    uint32_t materialCount;
    uint32_t morphTargetCount;
    float boundsMin[3]; /**< of the rest cage */
    float boundsMax[3];
    uint32_t imageCount;
} SuppleAssetInfo;

/** An animation clip. */
typedef struct SuppleClipInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    double duration;  /**< seconds */
} SuppleClipInfo;

/** A joint of the skin. */
typedef struct SuppleJointInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    uint32_t parent;  /**< the nearest joint above it, or SUPPLE_NO_JOINT */
} SuppleJointInfo;

/** A morph target of the cage. */
typedef struct SuppleMorphTargetInfo {
    uint32_t structSize;
    const char* name;     /**< lives as long as the asset; empty where the file has none */
    float weight;         /**< the file's */
    uint32_t vertexCount; /**< cage vertices it moves */
} SuppleMorphTargetInfo;

/** Trimming: the surface is there where a channel of an image is at least a cutoff. It is the host's fragment shaders
 * that test it, in every pass that draws the surface, shadows too; docs/trimming.md has the test as a GLSL include. */
typedef enum SuppleTrimDomain {
    SUPPLE_TRIM_NONE = 0, /**< the material is whole */
    SUPPLE_TRIM_UV = 1,   /**< the image lies on a UV set: SuppleGroupOutput.attributes or uvs1 */
    SUPPLE_TRIM_FACE = 2  /**< a strip of tiles side by side, of which a face of the cage has one:
                           * SuppleGroupOutput.faceUvs */
} SuppleTrimDomain;

/** How a lookup outside of 0..1 goes on; as samplers have it. */
typedef enum SuppleWrap { SUPPLE_WRAP_REPEAT = 0, SUPPLE_WRAP_CLAMP = 1, SUPPLE_WRAP_MIRROR = 2 } SuppleWrap;

/** What of a material bears on where the surface is; shading is the host's. */
typedef struct SuppleMaterialInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    uint32_t doubleSided;
    SuppleTrimDomain trimDomain; /**< the file's own trim, else its alphaMode MASK with a texture: then the lookup is
                                  * multiplied by trimFactor and the color attribute's alpha */
    uint32_t trimImage;          /**< or SUPPLE_NO_IMAGE */
    uint32_t trimUvSet;          /**< 0 or 1 */
    uint32_t trimChannel;        /**< 0..3: red, green, blue, alpha */
    float trimCutoff;
    float trimFactor;       /**< 1, or with MASK the base color's alpha */
    uint32_t trimTiles;     /**< FACE: tiles in the image */
    SuppleWrap trimWrap[2]; /**< along u and v */
} SuppleMaterialInfo;

/** An image as the file holds it; decoding is the host's. */
typedef struct SuppleImageInfo {
    uint32_t structSize;
    const char* name;     /**< this and what follows live as long as the asset */
    const char* mimeType; /**< "image/png", "image/jpeg" or empty */
    const void* bytes;    /**< null where the image is missing */
    size_t byteCount;
} SuppleImageInfo;

/** Refuses malformed files and arrays. What only a surface cannot take (a non-manifold edge, a face that is no quad) is
 * refused by suppleCreateGroup, so that the cage alone can still be had. */
SUPPLE_API SuppleResult suppleCreateAsset(SuppleContext context, const SuppleAssetDesc* desc, SuppleAsset* out);
/** The asset's groups keep what they need; the handle is dead at once. */
SUPPLE_API SuppleResult suppleDestroyAsset(SuppleContext context, SuppleAsset asset);
/** Fills out. */
SUPPLE_API SuppleResult suppleGetAssetInfo(SuppleContext context, SuppleAsset asset, SuppleAssetInfo* out);
/** Fills out. Errors: clip is not below SuppleAssetInfo.clipCount. */
SUPPLE_API SuppleResult suppleGetClipInfo(SuppleContext context, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out);
/** Fills out. Joints are numbered as the file's skin numbers them. Errors: joint is not below jointCount. */
SUPPLE_API SuppleResult suppleGetJointInfo(SuppleContext context, SuppleAsset asset, uint32_t joint,
                                           SuppleJointInfo* out);
/** Fills out. Errors: target is not below morphTargetCount. */
SUPPLE_API SuppleResult suppleGetMorphTargetInfo(SuppleContext context, SuppleAsset asset, uint32_t target,
                                                 SuppleMorphTargetInfo* out);
/** Fills out. Materials are numbered as in the file. Errors: material is not below materialCount. */
SUPPLE_API SuppleResult suppleGetMaterialInfo(SuppleContext context, SuppleAsset asset, uint32_t material,
                                              SuppleMaterialInfo* out);
/** Fills out. Images are numbered as in the file. Errors: image is not below imageCount. */
SUPPLE_API SuppleResult suppleGetImageInfo(SuppleContext context, SuppleAsset asset, uint32_t image,
                                           SuppleImageInfo* out);
/** Sets mask[joint] and mask of every joint below it to value; the others stay. mask has jointCount values. */
SUPPLE_API SuppleResult suppleFillJointMask(SuppleContext context, SuppleAsset asset, uint32_t joint, float value,
                                            float* mask, uint32_t jointCount);

/* ---------------------------------------------------------------------------------------------------- views */

/** Layout of a surface vertex. Positions have the same bits in both. */
typedef enum SuppleVertexFormat {
    SUPPLE_VERTEX_16 = 0, /**< float3 position, octahedral normal in 2 x snorm16 (x in the low half) */
    SUPPLE_VERTEX_24 = 1  /**< float3 position, float3 normal */
} SuppleVertexFormat;

/** Level of detail. A group that belongs to a view is drawn with as many triangles as the view's camera needs: every
 * edge has a real-valued level that both patches at it take from its boundary curve alone, so that there are no cracks
 * and, since levels and patterns move continuously, no pops; nothing changes while the camera only turns. All groups
 * of a view share its surface vertices. What they want in a frame is counted before anything is written: when it does
 * not fit, all levels are scaled down together, by one continuous factor (docs/lod.md). Subdivision has no real-valued
 * levels: its instances take one of several rates each, and change from one to the next at once. */

/** What a view writes besides surface vertices, for all its groups. */
typedef enum SuppleViewFlags {
    SUPPLE_VIEW_MOTION = 1,     /**< where every surface vertex was in the frame before */
    SUPPLE_VIEW_ATTRIBUTES = 2, /**< surface attributes, every frame anew */
    SUPPLE_VIEW_UVS1 = 4,       /**< with ATTRIBUTES: second UV sets */
    SUPPLE_VIEW_FACE_UVS = 8,   /**< with ATTRIBUTES: where vertices lie in their faces' trim tiles */
    SUPPLE_VIEW_CULL = 16, /**< instances that the camera does not see are deformed, but no surface is made of them */
    SUPPLE_VIEW_OCCLUSION = 32, /**< with CULL: nor of those behind a depth pyramid, see suppleSetDepthPyramid */
    SUPPLE_VIEW_BACK_FACES = 64 /**< patches of PREP and PM that surely show the camera their backs are left out, but
                                 * for those of double-sided materials: for hosts that draw what winds
                                 * counter-clockwise alone, and that from this camera alone. Other schemes' stay */
} SuppleViewFlags;

/** How much a view may write. */
typedef struct SuppleViewDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleViewFlags */
    /** Surface vertices a frame, of all groups: what memory is kept for. 1024 to SUPPLE_MAX_VIEW_VERTICES; of them 192
     * go a run of patches of its groups (see SuppleGroupDesc.view), and suppleCreateGroup refuses where nothing is
     * left. */
    uint32_t maxVertices;
    SuppleVertexFormat vertexFormat; /**< of all groups */
    /** By priority, 0..1: what part of the scaling down an instance takes, as the exponent of the factor. 1: all of it,
     * 0: none, until the others have become 2^-8 of what they were by theirs; from there on all go down alike. All
     * zero: 1, 1/2, 1/4, 0. */
    float elasticities[SUPPLE_PRIORITY_COUNT];
} SuppleViewDesc;

/** A view without groups. */
SUPPLE_API SuppleResult suppleCreateView(SuppleContext context, const SuppleViewDesc* desc, SuppleView* out);
/** The handle is dead at once. Its groups keep what they need and are drawn as before, from the camera that was set
 * last, which still culls; the depth pyramid goes: from the next suppleRecord on nothing is occluded. */
SUPPLE_API SuppleResult suppleDestroyView(SuppleContext context, SuppleView view);

/** Options of a camera. */
typedef enum SuppleCameraFlags {
    SUPPLE_CAMERA_ORTHOGRAPHIC = 1 /**< pixelsPerUnit everywhere; position matters to `farthest` alone */
} SuppleCameraFlags;

/** From where levels are measured, and how fine they are. */
typedef struct SuppleCameraDesc {
    uint32_t structSize;
    uint32_t flags;      /**< SuppleCameraFlags */
    float position[3];   /**< in the space surface vertices come out in */
    float pixelsPerUnit; /**< of a thing of unit size at unit distance: viewport height / (2 tan(field of view / 2)) */
    float nearest;       /**< nothing counts as nearer, 0 = 0.01 */
    float chordError;    /**< pixels between an edge and its segments, 0 = 0.25 */
    float smallestEdge;  /**< pixels: segments are not made shorter, 0 = 3 */
    float edgeLength;    /**< pixels: segments of this length whatever the error; 0: by the two above */
    /** Surface vertices a frame, of all groups: those of CATMULL_CLARK and LOOP count, too, though they lie in memory
     * of the groups' own. At most the view's maxVertices, as which it counts with 192 a run of patches: with no more
     * than these no patches are drawn. 0: that, and CATMULL_CLARK and LOOP have no budget. */
    uint32_t vertexBudget;
    /** SUPPLE_VIEW_CULL: what is outside of it is not seen; column-major, depth 0..w (or reversed, or without end). All
     * zero: everything is inside. Shadow maps want what casts a shadow into the picture: a larger volume. */
    float viewProjection[16];
    float farthest;       /**< CULL: what is farther from position is not seen; 0: no limit */
    float smallestRadius; /**< CULL: pixels: what is smaller is not seen */
    float direction[3];   /**< BACK_FACES with ORTHOGRAPHIC: where the camera looks, of any length; else not used */
} SuppleCameraDesc;

/** Moves a view's camera; stands until set again. A view needs one before its groups are recorded. Shadow passes and
 * mirrors draw what the main camera chose: other levels would shadow themselves. */
SUPPLE_API SuppleResult suppleSetCamera(SuppleContext context, SuppleView view, const SuppleCameraDesc* camera);

/** Options of a depth pyramid. */
typedef enum SuppleDepthPyramidFlags {
    SUPPLE_DEPTH_REVERSED = 1 /**< near is 1, far is 0 */
} SuppleDepthPyramidFlags;

/** A depth picture and smaller ones of it: level 0 has width x height texels, the next ones half as many, rounded down,
 * at least 1. Texel (x, y) of a level that is w x h holds the farthest depth (the largest, or REVERSED the smallest) of
 * all that the rectangle from (x/w, y/h) to ((x+1)/w, (y+1)/h) of the picture touches; level 0 may be smaller than the
 * picture. shaders/supple_depth_pyramid.comp makes one. */
typedef struct SuppleDepthPyramidDesc {
    uint32_t structSize;
    uint32_t flags;       /**< SuppleDepthPyramidFlags */
    VkImageView view;     /**< 2D, R32_SFLOAT, all levels from 0 on; of an image with usage SAMPLED */
    VkImageLayout layout; /**< that it has while suppleRecord's commands run: GENERAL, SHADER_READ_ONLY_OPTIMAL or
                           * READ_ONLY_OPTIMAL */
    uint32_t width;       /**< of level 0 */
    uint32_t height;
    uint32_t levels;          /**< of the view: 1 to as many as there can be; more find more hidden */
    float viewProjection[16]; /**< of the picture, as in SuppleCameraDesc; x and y -1..1 from texel 0 to the last */
} SuppleDepthPyramidDesc;

/** SUPPLE_VIEW_OCCLUSION: what an instance must come out of to be seen, from the next suppleRecord on until set again;
 * null, as at first: nothing hides. An instance is hidden where the box round its surface lies behind the pyramid
 * everywhere; boxes that reach out of the picture or behind the eye are never hidden. With the depth of the frame
 * before what comes into view appears a frame late; with this frame's occluders it does not. The image is the host's.
 * suppleRecord samples it in compute shaders, and only those: its writes must be in `before` (or before
 * suppleGetRecordScopes' first), its next writes wait for compute shaders. It must be owned by queueFamily then, also
 * with SUPPLE_CONTEXT_ASYNC_COMPUTE: share it concurrently, or transfer it. The image and its view must live until the
 * frames that were recorded with them are completed, which a change here does not touch: set another, or null, first.
 */
SUPPLE_API SuppleResult suppleSetDepthPyramid(SuppleContext context, SuppleView view,
                                              const SuppleDepthPyramidDesc* pyramid);

/** What a view drew. */
typedef struct SuppleViewStatistics {
    uint32_t structSize;
    uint32_t shortfall; /**< 1: scaling down by elasticity is not enough: all priorities are scaled further down alike,
                         * and where even the coarsest have no room whole instances are missing, the smallest first */
    uint64_t frame;     /**< of suppleBeginFrame */
    float
        levelScales[SUPPLE_PRIORITY_COUNT]; /**< by priority: the factor that levels were scaled by, 1 within budget */
    uint32_t vertexCount;           /**< surface vertices written; CATMULL_CLARK and LOOP: with a vertexBudget */
    uint32_t wantedVertexCount;     /**< without a budget, up to a few per cent more; instances that are missing count
                                     * at their coarsest */
    uint32_t patchCount;            /**< drawn */
    uint32_t instanceCount;         /**< visible ones of its groups */
    uint32_t drawnInstanceCount;    /**< of these: seen, and not missing */
    uint32_t droppedInstanceCount;  /**< seen, and missing for want of room */
    uint32_t occludedInstanceCount; /**< not seen for OCCLUSION alone */
    uint32_t backFaceCount;         /**< patches of drawn instances that BACK_FACES left out */
} SuppleViewStatistics;

/** Of the newest completed frame; never blocks. SUPPLE_NOT_READY: there is none. */
SUPPLE_API SuppleResult suppleGetViewStatistics(SuppleContext context, SuppleView view, SuppleViewStatistics* out);

/* ---------------------------------------------------------------------------------------------------- groups */

/** How the deformed cage becomes a surface; docs/schemes.md says which one to choose. */
typedef enum SuppleScheme {
    SUPPLE_SCHEME_AUTO = 0, /**< P_m */
    SUPPLE_SCHEME_PREP = 1, /**< p-rep: quads, G1 at any valence, one patch a face; creases are ignored */
    SUPPLE_SCHEME_PM = 2,   /**< P_m: any polygons, polar fans, creases; G1 but at creases, one patch a facet */
    SUPPLE_SCHEME_CATMULL_CLARK = 3, /**< subdivision: any polygons, semi-sharp creases; the limit itself */
    SUPPLE_SCHEME_LOOP = 4,  /**< subdivision: triangles (larger faces are split into them), semi-sharp creases */
    SUPPLE_SCHEME_BLEND = 5, /**< charts blended: any polygons (others than quads are subdivided once), interpolates the
                              * cage's vertices, edges are sharp or smooth, nothing between */
    SUPPLE_SCHEME_CAGE =
        100 /**< no surface: the deformed cage alone, of any polygons; no patches, no surface vertices */
} SuppleScheme;

/** BLEND: what a sharp edge is. CUT: two sheets that meet in it. CURVE: a narrow ridge, as in the paper. */
typedef enum SuppleCreaseMode { SUPPLE_CREASES_CUT = 0, SUPPLE_CREASES_CURVE = 1 } SuppleCreaseMode;
/** PREP: DEFAULT scales the tangents of irregular vertices as docs/prep.md derives it, PRINTED as the paper prints it.
 */
typedef enum SuppleTangentMode { SUPPLE_TANGENTS_DEFAULT = 0, SUPPLE_TANGENTS_PRINTED = 1 } SuppleTangentMode;
/** PREP: what a boundary vertex of one face is: SHARP passes through it, SMOOTH rounds it. */
typedef enum SuppleCornerRule { SUPPLE_CORNERS_SHARP = 0, SUPPLE_CORNERS_SMOOTH = 1 } SuppleCornerRule;

/** How joints move the vertices between them. DUAL_QUATERNION keeps the girth of a limb that twists or bends; joints
 * may scale and shear, and a vertex of one joint moves as with LINEAR. */
typedef enum SuppleSkinning { SUPPLE_SKINNING_LINEAR = 0, SUPPLE_SKINNING_DUAL_QUATERNION = 1 } SuppleSkinning;

/** Who says how instances are deformed. The BUFFER sources are filled by the host on the device, every frame or when
 * it likes, for all visible instances: suppleRecord's `before` then names the writes, and the host's next writes wait
 * for compute shaders that suppleRecord recorded. What a source leaves to the host, the functions of Supple's refuse.
 */
typedef enum SupplePoseSource {
    SUPPLE_POSES_SET = 0,            /**< suppleSetClipPose, suppleSetPose, suppleSetMatrixPose, ... */
    SUPPLE_POSES_PALETTE_BUFFER = 1, /**< SuppleGroupOutput.poses: joint palettes and morph weights */
    SUPPLE_POSES_CAGE_BUFFER = 2,    /**< SuppleGroupOutput.deformedCage: cage vertices, as from a cloth solver */
    SUPPLE_POSES_PLAYBACK = 3        /**< suppleSetPlayback: clips that the device plays by the group's time */
} SupplePoseSource;

/** What a group writes besides surface vertices. */
typedef enum SuppleGroupFlags {
    SUPPLE_GROUP_PATCHES = 1,    /**< also write the patch coefficients (for inspection) */
    SUPPLE_GROUP_ATTRIBUTES = 2, /**< also write the static surface attributes: UVs, color, face UVs */
    SUPPLE_GROUP_MOTION = 4,     /**< also write where every surface vertex was in the frame before */
    /** Samples that patches share are surface vertices once, and an instance is one indexed mesh. PREP and PM, without
     * a view. Positions are those of other groups to the bit; along creases, boundaries and, with ATTRIBUTES, seams of
     * these, each side has vertices of its own. See SuppleDrawRange. */
    SUPPLE_GROUP_INDEXED_MESH = 8,
    SUPPLE_GROUP_ONE_LEVEL = 32 /**< groups of a view: a level an instance, from its bounds and the longest edge and
                                 * sharpest bend of the cage's bind pose, instead of one an edge */
} SuppleGroupFlags;

/** How a group's surface is made, and for how many instances there is room. */
typedef struct SuppleGroupDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleGroupFlags */
    SuppleAsset asset;
    uint32_t capacity; /**< instances that can be there at a time, 1 or more */
    SuppleScheme scheme;
    uint32_t rate; /**< segments along a patch edge, 1..64; 0 = 8. CATMULL_CLARK and LOOP: along an edge of the cage,
                    * rounded up to a power of two; a patch is a half of it (a quarter where Catmull-Clark is given
                    * faces other than quads), see SuppleGroupOutput.rate. BLEND: likewise, but rounded up to even, on
                    * cages with faces other than quads */
    SuppleVertexFormat vertexFormat;
    SuppleTangentMode tangentMode;
    SuppleCornerRule cornerRule;
    SuppleSkinning skinning;
    SuppleCreaseMode creaseMode; /**< BLEND */
    float sharpThreshold;        /**< BLEND: edges of this sharpness and more are sharp; 0 = 1 */
    SupplePoseSource poseSource; /**< PALETTE_BUFFER goes with linear skinning only */
    /** Optional: the group is drawn at this view's levels of detail. vertexFormat and flags are then the view's. PREP,
     * PM and BLEND: rate, too; see SuppleGroupOutput.lodDraws. CATMULL_CLARK and LOOP: every instance has the rate its
     * level asks for, rate being the largest; see SuppleGroupOutput.rates. The vertices are the group's own: none of
     * the view's maxVertices, but of SuppleCameraDesc.vertexBudget.
     * A view has room for 256 runs of patches, in which those of a group lie side by side: one for each class of its
     * patches, material and window of its instances, a window being as many as the device can bind of every buffer.
     * CATMULL_CLARK and LOOP have none; a view has at most 256 groups of these. */
    SuppleView view;
} SuppleGroupDesc;

/** A group without instances. Compiles the pipelines that no group before has needed: create one of each kind while
 * loading, with a pipeline cache. Errors: a cage that the scheme cannot take, limits of the device, memory. */
SUPPLE_API SuppleResult suppleCreateGroup(SuppleContext context, const SuppleGroupDesc* desc, SuppleGroup* out);
/** Its instances go with it. The handle is dead at once; memory is freed once the frames that used the group are
 * completed (suppleBeginFrame). */
SUPPLE_API SuppleResult suppleDestroyGroup(SuppleContext context, SuppleGroup group);
/** Changes the rate from the next suppleRecord on; outputs must be queried anew. At most the rate the group was created
 * with; CATMULL_CLARK, LOOP and BLEND have tables for that rate alone, SUPPLE_GROUP_INDEXED_MESH has indices for it
 * alone. */
SUPPLE_API SuppleResult suppleSetRate(SuppleContext context, SuppleGroup group, uint32_t rate);

/** An instance in the bind pose, visible, with the identity transform. SUPPLE_ERROR_LIMIT: the group is full. The slot
 * is the lowest free one; what earlier frames of a destroyed instance still read is not touched before they end. */
SUPPLE_API SuppleResult suppleCreateInstance(SuppleContext context, SuppleGroup group, SuppleInstance* out);
/** Gone from the next suppleRecord on. */
SUPPLE_API SuppleResult suppleDestroyInstance(SuppleContext context, SuppleInstance instance);
/** Hidden instances cost nothing on the device and are not drawn; what is set for them stays. visible: 0 or 1. */
SUPPLE_API SuppleResult suppleSetVisible(SuppleContext context, SuppleInstance instance, uint32_t visible);
/** The next suppleRecord sees the instance as new: its previous positions are its positions, so that it leaves no
 * motion behind. Instances that were not visible in the group's last suppleRecord are new by themselves. */
SUPPLE_API SuppleResult suppleTeleport(SuppleContext context, SuppleInstance instance);

/** Groups of a view: 0..SUPPLE_PRIORITY_COUNT-1, 0 at first; see SuppleViewDesc.elasticities. */
SUPPLE_API SuppleResult suppleSetPriority(SuppleContext context, SuppleInstance instance, uint32_t priority);

/* ---------------------------------------------------------------------------------------------------- poses */

/** What crosses to the device each frame: with SUPPLE_POSES_SET the poses of the slots in use; in frames where
 * instances came, went, were hidden, shown or teleported, and in the next ones, 8 bytes a visible instance and 20 a
 * draw range (with SUPPLE_CONTEXT_ASYNC_COMPUTE in every frame). A pose is 48 bytes a joint, or with dual quaternions
 * 64 bytes a joint and 48 more; and with morph targets 4 bytes a target, rounded up to 16. */

/** Poses an instance from a clip at a time (clamped to the clip), or SUPPLE_BIND_POSE or SUPPLE_REST_POSE. What the
 * clip does not animate is as in the rest pose. */
SUPPLE_API SuppleResult suppleSetClipPose(SuppleContext context, SuppleInstance instance, uint32_t clip, double time);

/** BLEND: the pose moves towards the clip's by the weight, 0..1: rotations along the shorter arc, all else straight.
 * Weight 1 replaces the pose, weight 0 leaves it, both to the bit.
 * ADDITIVE: what the clip differs by from its own pose at referenceTime is added, times the weight w, of any size and
 * sign: rotations in the joint's own frame, pose * (reference^-1 * clip)^w; scales as factors; translations and morph
 * weights as sums. */
typedef enum SuppleLayerMode { SUPPLE_LAYER_BLEND = 0, SUPPLE_LAYER_ADDITIVE = 1 } SuppleLayerMode;

/** Options of a layer. */
typedef enum SuppleLayerFlags {
    SUPPLE_LAYER_LOOP = 1 /**< times wrap round at the clip's duration; else they are clamped to the clip */
} SuppleLayerFlags;

/** One clip of a pose. The bind and rest poses are no clips: a pose without layers is the rest pose. */
typedef struct SuppleClipLayer {
    uint32_t clip;
    uint32_t flags; /**< SuppleLayerFlags */
    SuppleLayerMode mode;
    float weight;           /**< 0 leaves the layer out */
    double time;            /**< seconds */
    double previousTime;    /**< suppleGetRootMotion: the movement from here to time */
    double referenceTime;   /**< additive: 0 is the clip's first pose */
    const float* jointMask; /**< optional: a value a joint, 0..1, that multiplies the weight. Nodes that are no joints
                             * follow the joint above them, or if there is none the first below */
    uint32_t jointMaskCount;
    uint32_t morphMaskCount;
    const float* morphMask; /**< optional: a value a morph target, 0..1; null: 1, but 0 where there is a jointMask */
} SuppleClipLayer;

/** What of the root's movement is the character's, not the pose's; in model space, where +Y is up. */
typedef enum SuppleRootMotionFlags {
    SUPPLE_ROOT_MOTION_GROUND = 1, /**< translation along x and z */
    SUPPLE_ROOT_MOTION_HEIGHT = 2, /**< translation along y */
    SUPPLE_ROOT_MOTION_YAW = 4     /**< the turn about +Y */
} SuppleRootMotionFlags;

/** Options of a pose. */
typedef enum SupplePoseFlags {
    SUPPLE_POSE_ROOT_JOINT = 1 /**< rootJoint names the root; else it is the topmost node that clips move or turn, of
                                * several the one above most joints */
} SupplePoseFlags;

/** Layers are applied in order to the rest pose. A crossfade is two layers: the old clip with weight 1, then the new
 * one with a weight that rises from 0 to 1. */
typedef struct SupplePoseDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePoseFlags */
    const SuppleClipLayer* layers;
    uint32_t layerCount;
    uint32_t rootMotion; /**< SuppleRootMotionFlags: what is taken out of every layer's clip; the root stays where the
                          * clip starts */
    uint32_t rootJoint;
} SupplePoseDesc;

/** The arrays are read during the call. */
SUPPLE_API SuppleResult suppleSetPose(SuppleContext context, SuppleInstance instance, const SupplePoseDesc* pose);

/** A movement of the root: first the turn, then the translation. */
typedef struct SuppleRootMotion {
    uint32_t structSize;
    float translation[3];
    float yaw;           /**< radians about +Y, the shorter way */
    float transform[16]; /**< column-major: turns by yaw, then translates */
} SuppleRootMotion;

/** How far the root moves under pose from every layer's previousTime to its time, in the frame the character has at
 * previousTime: an instance placed by T comes to T * transform (suppleSetTransform). Runs on over the ends of looping
 * clips. Blend layers blend their movements as their poses, by the mask's value at the root; additive layers add
 * theirs. With the pose set as given, clip and host together move the character as the clip alone did. */
SUPPLE_API SuppleResult suppleGetRootMotion(SuppleContext context, SuppleAsset asset, const SupplePoseDesc* pose,
                                            SuppleRootMotion* out);

/** Sets an instance's morph weights (morphTargetCount values), which stand whatever its poses say; null: the poses' own
 * again. */
SUPPLE_API SuppleResult suppleSetMorphWeights(SuppleContext context, SuppleInstance instance, const float* weights,
                                              uint32_t morphTargetCount);
/** Poses an instance from the host's own animation: jointCount model-space joint matrices (float[16] each), in the
 * order of the skin's joints; Supple applies the inverse bind matrices. Morph weights are the file's. */
SUPPLE_API SuppleResult suppleSetMatrixPose(SuppleContext context, SuppleInstance instance, const float* jointMatrices,
                                            uint32_t jointCount);
/** Places an instance: an affine float[16] (last row 0, 0, 0, 1) applied after the pose, so that surface vertices come
 * out in the space it maps to. A mirroring transform turns the winding and with it the normals. */
SUPPLE_API SuppleResult suppleSetTransform(SuppleContext context, SuppleInstance instance, const float* transform);

/* ---------------------------------------------------------------------------------------------------- playback */

/** One clip of what an instance plays, with T for the group's time (suppleSetTime): its time is
 * offset + speed * (T - startTime), its weight the one that stands or, with a fade, goes from weight to fadeWeight,
 * straight, while T goes from fadeStart to fadeStart + fadeDuration. At every T the layer is the SuppleClipLayer of
 * that time and weight. */
typedef struct SupplePlaybackLayer {
    uint32_t clip;
    uint32_t flags;       /**< SuppleLayerFlags */
    SuppleLayerMode mode; /**< as in SuppleClipLayer */
    uint32_t mask;        /**< a mask of the group's (suppleSetMask); 0: none */
    float weight;         /**< 0 leaves the layer out */
    float fadeWeight;     /**< with a fade: where it ends */
    float fadeDuration;   /**< seconds; 0: no fade */
    float speed;          /**< seconds of the clip a second of T, -1000..1000; 0: the clip stands at offset */
    double startTime;     /**< T at which the clip is at offset */
    double offset;        /**< seconds of the clip */
    double fadeStart;
    double referenceTime; /**< additive: 0 is the clip's first pose */
} SupplePlaybackLayer;

/** Options of playback. */
typedef enum SupplePlaybackFlags {
    SUPPLE_PLAYBACK_ROOT_JOINT = 1, /**< as SUPPLE_POSE_ROOT_JOINT */
    SUPPLE_PLAYBACK_TRAVEL = 2      /**< the instance moves by what rootMotion takes out of the first layer's clip:
                                     * placed by T * M, with T of suppleSetTransform and M the movement since the
                                     * layer's startTime, on over the ends of a looping clip. The layer's weight and
                                     * mask make no difference to it */
} SupplePlaybackFlags;

/** Layers are applied in order to the rest pose, as those of SupplePoseDesc. */
typedef struct SupplePlaybackDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePlaybackFlags */
    const SupplePlaybackLayer* layers;
    uint32_t layerCount; /**< at most SUPPLE_MAX_PLAYBACK_LAYERS */
    uint32_t rootMotion; /**< SuppleRootMotionFlags: what is taken out of every layer's clip */
    uint32_t rootJoint;
} SupplePlaybackDesc;

/** For groups with SUPPLE_POSES_PLAYBACK: what an instance plays from the next suppleRecord on, until it is set anew.
 * The array is read during the call. Poses then follow from the group's time alone, on the device; in a frame where
 * nothing is set, nothing is uploaded, and the host's part costs the same for any number of instances.
 * suppleSetTransform and suppleSetMorphWeights go with it. Poses agree with suppleSetPose's but for rounding
 * (docs/playback.md). */
SUPPLE_API SuppleResult suppleSetPlayback(SuppleContext context, SuppleInstance instance,
                                          const SupplePlaybackDesc* playback);
/** Sets T, the time by which the instances of a group with SUPPLE_POSES_PLAYBACK play; 0 at first. It may go any way.
 */
SUPPLE_API SuppleResult suppleSetTime(SuppleContext context, SuppleGroup group, double seconds);

/** A mask for the layers of a group's instances. */
typedef struct SuppleMaskDesc {
    uint32_t structSize;
    uint32_t mask;          /**< its number, 1..SUPPLE_MAX_MASKS */
    const float* jointMask; /**< as in SuppleClipLayer, and so the next; not both null */
    const float* morphMask;
    uint32_t jointMaskCount;
    uint32_t morphMaskCount;
} SuppleMaskDesc;
/** Sets one of the masks of a group with SUPPLE_POSES_PLAYBACK, before layers name it; layers that name it already
 * follow.
 */
SUPPLE_API SuppleResult suppleSetMask(SuppleContext context, SuppleGroup group, const SuppleMaskDesc* mask);

/* ---------------------------------------------------------------------------------------------------- frame */

/** Starts a frame. frame rises by at least one each call; completedFrame is the last frame whose command buffers have
 * all finished, 0 before the first; it never falls. frame - completedFrame must not exceed framesInFlight. Frees what
 * was destroyed and is no longer used, and reads finished timestamps; never waits. */
SUPPLE_API SuppleResult suppleBeginFrame(SuppleContext context, uint64_t frame, uint64_t completedFrame);
/** What was recorded since suppleBeginFrame will never be submitted (a lost swapchain, say): its uploads are due again,
 * its instances have no motion. For suppleBeginFrame it counts as completed. Between this and the next suppleBeginFrame
 * nothing can be recorded. */
SUPPLE_API SuppleResult suppleCancelFrame(SuppleContext context);

/** Stages and accesses on buffers, as synchronization2 has them. */
typedef struct SuppleSyncScope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
} SuppleSyncScope;

/** Records what was created since it was recorded last: static tables, and the barrier behind them. suppleRecord does
 * it too; a call of its own, in a command buffer that is submitted before the others, is needed only where suppleRecord
 * runs on several threads. */
SUPPLE_API SuppleResult suppleRecordUploads(SuppleContext context, VkCommandBuffer commandBuffer);

/** Options of recording. */
typedef enum SuppleRecordFlags {
    SUPPLE_RECORD_TIMINGS = 1,         /**< write GPU timestamps round every pass */
    SUPPLE_RECORD_NO_ENTRY_BARRIER = 2 /**< the host's own barrier has waited for all earlier uses, Supple's too: see
                                        * suppleGetRecordScopes. `before` is ignored */
} SuppleRecordFlags;

/** What is recorded, and between which uses of the host's. */
typedef struct SuppleRecordDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleRecordFlags */
    const SuppleGroup* groups;
    uint32_t groupCount;
    SuppleSyncScope before; /**< earlier uses of the groups' outputs, e.g. the last frame's vertex shader reads, and
                             * what the host has written into them (SupplePoseSource) */
    SuppleSyncScope after;  /**< the coming uses of the outputs; all of Supple's writes are made visible to it. With
                             * stages = 0 no barrier follows the passes; the host puts its own */
} SuppleRecordDesc;

/** Records the passes of the groups, outside a render pass, for the visible instances as they are set now. Between
 * suppleBeginFrame calls each group once, all groups of a view in one call. What is recorded must be submitted, once,
 * in the order of recording on one queue (suppleCancelFrame otherwise). Fails whole: nothing is recorded then. */
SUPPLE_API SuppleResult suppleRecord(SuppleContext context, VkCommandBuffer commandBuffer,
                                     const SuppleRecordDesc* desc);

/** For hosts whose frame graph puts the barriers: `first` is what suppleRecord's commands do at the earliest, `last`
 * what their writes are. Either may be null. The same for every context and frame. */
SUPPLE_API SuppleResult suppleGetRecordScopes(SuppleSyncScope* first, SuppleSyncScope* last);

/** With SUPPLE_CONTEXT_ASYNC_COMPUTE suppleRecord ends with barriers that release the outputs to drawQueueFamily. This
 * gives the matching halves, for the command buffer that draws: put them in one vkCmdPipelineBarrier2, behind a
 * semaphore wait for the compute submission. To be called after the frame's suppleRecord, before the next
 * suppleBeginFrame. Nothing needs to be released back: every frame writes the outputs anew; but compute must wait for
 * the drawing of earlier frames, by a semaphore.
 * use: the stages and accesses of the draws. Fills out with up to *count barriers and sets *count to their number. */
SUPPLE_API SuppleResult suppleGetAcquireBarriers(SuppleContext context, const SuppleGroup* groups, uint32_t groupCount,
                                                 SuppleSyncScope use, VkBufferMemoryBarrier2* out, uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- output */

/** A part of a buffer of Supple's; the handle is Supple's, to read, bind and copy from. */
typedef struct SuppleBufferView {
    VkBuffer buffer; /**< null when the group was made without it */
    VkDeviceSize offset;
    VkDeviceSize size;
    uint32_t stride; /**< bytes an element */
} SuppleBufferView;

/** What a patch is evaluated over, R = rate. Samples are counted row by row; a patch's corners are the domain's.
 * QUAD      (R+1)^2: (i, j) at j (R+1) + i, u = i/R from corner 0 to 1, v = j/R from corner 0 to 3
 * POLAR     the same samples; the row j = R is one point, corner 2
 * TRIANGLE  (R+1)(R+2)/2: rows j = 0..R from the edge 0-1 towards corner 2, each i = 0..R-j
 * PENTAGON  5 R(R+1)/2 + 1: for each edge s-(s+1) rows j = 0..R-1 from the edge towards the centre, each i = 0..R-j-1
 * (the row's last point is the next edge's first); then the centre
 * MESH      not one patch's: SUPPLE_GROUP_INDEXED_MESH */
typedef enum SuppleDomain {
    SUPPLE_DOMAIN_QUAD = 0,
    SUPPLE_DOMAIN_POLAR = 1,
    SUPPLE_DOMAIN_TRIANGLE = 2,
    SUPPLE_DOMAIN_PENTAGON = 3,
    SUPPLE_DOMAIN_MESH = 4
} SuppleDomain;

/** A run of patches of one domain and material; ranges follow each other without gaps. Draw instance i is patch
 * firstPatch + i % patchCount of the instance in slot SuppleGroupOutput.instances[i / patchCount].
 *
 * SUPPLE_GROUP_INDEXED_MESH: all triangles of one material. Draw instance i is the instance in slot instances[i], and
 * an index is a surface vertex within the instance. To shaders that pull vertices it looks like one big patch:
 * patchCount is 1, firstVertex 0, samplesPerPatch the group's vertexCount; firstPatch is 0. Indices are uint32, in the
 * order of the patches of that material (suppleGetPatches), each in the order of its domain's grid in other groups. */
typedef struct SuppleDrawRange {
    uint32_t firstPatch;
    uint32_t patchCount;
    uint32_t material; /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    SuppleDomain domain;
    uint32_t samplesPerPatch;
    uint32_t firstVertex; /**< of the range in an instance's surface vertices */
    uint32_t firstIndex;  /**< in gridIndices: the triangles of one patch, shared by all of the range */
    uint32_t indexCount;
} SuppleDrawRange;

/** Grids of a view's patches; R is the capacity, odd.
 * QUAD   (R+1)^2 samples, as SUPPLE_DOMAIN_QUAD counts them; polar patches too
 * RINGS  of m sides: ring r = 0..(R-1)/2 has m (R - 2r) samples, side by side, from the border inwards */
typedef enum SuppleGrid {
    SUPPLE_GRID_QUAD = 0,
    SUPPLE_GRID_TRIANGLE_RINGS = 1,
    SUPPLE_GRID_QUAD_RINGS = 2,
    SUPPLE_GRID_PENTAGON_RINGS = 3
} SuppleGrid;

/** An indexed indirect draw of a view's group: patches of one material whose samples lie in grids of one capacity.
 * Surface vertex of a draw: gl_VertexIndex + gl_InstanceIndex * verticesPerInstance. Its patch is
 * SuppleGroupOutput.lodPatches[bucket.firstPatch + (vertex - bucket.firstVertex) / samplesPerPatch] with
 * bucket = lodBuckets[index of the draw]. */
typedef struct SuppleLodDraw {
    uint32_t material;            /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    SuppleGrid grid;              /**< how samples are numbered */
    uint32_t capacity;            /**< segments along a side: levels above the capacity before and up to this one */
    uint32_t samplesPerPatch;     /**< surface vertices of one patch */
    uint32_t verticesPerInstance; /**< of whole patches; those of the last that are none are points */
} SuppleLodDraw;

/** Instances drawn at one rate: for each draw range bind `instances` in the place of SuppleGroupOutput.instances and
 * draw its command of `indirect`. */
typedef struct SuppleRate {
    uint32_t rate;              /**< segments along a patch edge: R of SuppleDomain */
    uint32_t firstDrawRange;    /**< in SuppleGroupOutput.drawRanges */
    uint32_t drawRangeCount;    /**< as many at every rate of a group */
    SuppleBufferView instances; /**< uint32 per instance drawn at this rate: its slot, slots rising */
} SuppleRate;

/** The buffers of a group, valid until the group is destroyed or its rate is set. What is counted per instance lies at
 * the instance's slot. Buffers have usage STORAGE, UNIFORM_TEXEL, TRANSFER_SRC and, where it makes sense, TRANSFER_DST,
 * VERTEX, INDEX or INDIRECT. */
typedef struct SuppleGroupOutput {
    uint32_t structSize;
    uint32_t capacity; /**< instances there is room for */
    uint32_t rate;     /**< segments along a patch edge: R of SuppleDomain; of several rates the largest; 0 where
                        * lodDraws are drawn, whose patches have levels */
    SuppleVertexFormat vertexFormat;
    uint32_t patchCount;              /**< per instance */
    uint32_t vertexCount;             /**< surface vertices per instance; 0 where lodDraws are drawn: as many as levels
                                       * ask for, SuppleViewStatistics has their sum */
    uint32_t verticesPerInstance;     /**< >= vertexCount: slot k starts at vertex k * this */
    uint32_t cageVertexCount;         /**< per instance */
    uint32_t cageVerticesPerInstance; /**< >= cageVertexCount: the stride of deformedCage between slots */
    /** Vertex of (slot, patch, sample) with the patch's range r: slot * verticesPerInstance + r.firstVertex +
     * (patch - r.firstPatch) * r.samplesPerPatch + sample. SUPPLE_GROUP_INDEXED_MESH: slot * verticesPerInstance +
     * index. */
    SuppleBufferView surfaceVertices;
    /** With SUPPLE_GROUP_ATTRIBUTES: per surface vertex of one instance, shared by all: float2 uv, linear RGBA in 4 x
     * unorm16. */
    SuppleBufferView attributes;
    SuppleBufferView uvs1; /**< the same for the second UV set, where the cage has one: float2 */
    /** float4 (x, y, z, 1) per cage vertex: slot * cageVerticesPerInstance + vertex. */
    SuppleBufferView deformedCage;
    /** With SUPPLE_GROUP_PATCHES: float4 per coefficient, SUPPLE_PATCH_STRIDE per patch, see SupplePatchInfo. */
    SuppleBufferView patchCoefficients;
    SuppleBufferView gridIndices; /**< uint16, SUPPLE_GROUP_INDEXED_MESH: uint32; see SuppleDrawRange */
    SuppleBufferView indirect;    /**< VkDrawIndexedIndirectCommand per draw range, for the visible instances */
    const SuppleDrawRange* drawRanges;
    uint32_t drawRangeCount;
    VkDeviceSize deviceBytes; /**< device memory held by this group, its share of the asset's tables not counted */
    /** As uvs1, where faces of the cage have trim tiles: float2 (u + 2 * tile, v), where the vertex lies in its face's
     * tile; tile -1 for faces without one (docs/trimming.md). */
    SuppleBufferView faceUvs;
    SuppleBufferView instances; /**< uint32 per visible instance: its slot, slots rising */
    /** With SUPPLE_GROUP_MOTION: float3 per surface vertex, as surfaceVertices: its position in the group's last
     * suppleRecord before this one, at this one's rate; instances that are new (suppleTeleport) have their position of
     * now. In frames that do not record the group nothing moves, and this is not to be read. */
    SuppleBufferView previousPositions;
    /** Per slot (stride bytes): three rows of four floats a joint, of the 3x4 matrix that takes a cage vertex from the
     * bind pose to its place: transform * joint * inverse bind; then, with morph targets, a float weight each. Dual
     * quaternions: see shaders/shared/deform.h. Null with SUPPLE_POSES_CAGE_BUFFER. */
    SuppleBufferView poses;
    /** Groups of a view, PREP, PM and BLEND: surfaceVertices, attributes, uvs1, faceUvs, previousPositions and
     * gridIndices are the view's, drawRanges is null, and the draws are these: draw i has the i-th command of
     * `indirect`. A capacity that no patch has draws no instances. */
    const SuppleLodDraw* lodDraws;
    uint32_t lodDrawCount;       /**< entries of lodDraws and of indirect */
    SuppleBufferView lodBuckets; /**< per draw four uint32: first entry of lodPatches, first surface vertex, patches, -
                                  * ; its offset, and that of lodPatches, is a multiple of 256 */
    SuppleBufferView lodPatches; /**< per patch 64 bytes: uint32 patch (0xFFFFFFFF: none), slot in the low 28 bits,
                                  * first surface vertex, - ; then levels (docs/lod.md) */
    SuppleBufferView bounds; /**< Groups of a view: two float4 a slot: the least corner of a box round the surface and
                              * the level the instance asks for as a whole; the greatest and 1 where a cage vertex is
                              * not finite, else 0 */
    /** The rates that instances may have, rising: several in groups of a view, CATMULL_CLARK and LOOP, whose instances
     * have one each, and whose vertices of every rate lie in the instance's, behind those of the coarser ones. Else
     * one, with all draw ranges and instances. None where lodDraws are drawn. */
    const SuppleRate* rates;
    uint32_t rateCount; /**< entries of rates */
} SuppleGroupOutput;

/** Fills out: where a group's buffers are. Needs no frame; the buffers are filled by suppleRecord. */
SUPPLE_API SuppleResult suppleGetGroupOutput(SuppleContext context, SuppleGroup group, SuppleGroupOutput* out);

/** Classes of patches, and their coefficients in order (docs/prep.md, docs/pm.md). */
typedef enum SupplePatchClass {
    SUPPLE_PATCH_REGULAR = 0,       /**< 16: bicubic, g[i + 4 j] */
    SUPPLE_PATCH_PERTURBED = 1,     /**< 32, p-rep: 16 g, then 16 h */
    SUPPLE_PATCH_POLAR = 2,         /**< 13, P_m: 12 as a bicubic's, then the apex for the whole row j = 3 */
    SUPPLE_PATCH_P3 = 3,            /**< 19, P_m: b004, then for each edge b300 b210 b120 b211 b121 b112 */
    SUPPLE_PATCH_P4 = 4,            /**< 25 */
    SUPPLE_PATCH_P5 = 5,            /**< 31 */
    SUPPLE_PATCH_CATMULL_CLARK = 6, /**< none: a face of the cage once (or twice) subdivided */
    SUPPLE_PATCH_LOOP = 7,          /**< none */
    SUPPLE_PATCH_BLEND = 8,         /**< none: a face of the cage, or of the subdivided cage */
    SUPPLE_PATCH_BLEND_SHARP = 9    /**< none: with sharp edges */
} SupplePatchClass;
#define SUPPLE_PATCH_STRIDE 32
#define SUPPLE_MAX_SIDES 5

/** A patch, as the cage sees it. */
typedef struct SupplePatchInfo {
    uint32_t face; /**< source face of the cage; faces of six and more sides are split, each part a patch */
    SupplePatchClass patchClass;
    uint32_t cornerCount;
    uint32_t corners[SUPPLE_MAX_SIDES]; /**< cage vertices, corner i at corner i of the domain; SUPPLE_NO_VERTEX at
                                         * points that subdivision added */
    uint32_t coefficientCount;
} SupplePatchInfo;

/** Fills out with up to *count patches in device order and sets *count to the number of patches. out may be null. */
SUPPLE_API SuppleResult suppleGetPatches(SuppleContext context, SuppleGroup group, SupplePatchInfo* out,
                                         uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- timings */

/** What a pass cost, for one group and frame. */
typedef struct SuppleTiming {
    const char* pass;  /**< static: upload, attributes, pose (up to three times), deform, vertex, assemble,
                        * patch, evaluate, motion; groups of a view also bounds (twice with OCCLUSION), list, level
                        * (twice), solve (once a view), place. `shortfall` is no pass: it follows solve in frames in
                        * which the view's budget was not enough (SuppleViewStatistics.shortfall), takes no time, and is
                        * in no other */
    SuppleGroup group; /**< of suppleRecord */
    uint64_t frame;
    double gpuBegin; /**< nanoseconds since the context's first timestamp; 0 where the queue has none */
    double gpuEnd;
    double cpuRecord; /**< nanoseconds the host spent recording the pass */
    uint64_t points;  /**< elements the pass wrote, and bytes; both 0 where the device alone knows, as in groups of a */
    uint64_t bytes;   /**< view: SuppleViewStatistics has what the whole view wrote. `shortfall`: instances that are
                       * missing, and the surface vertices, in bytes, that lack; of missing ones the coarsest alone */
} SuppleTiming;

/** The passes of the newest completed frame recorded with SUPPLE_RECORD_TIMINGS. Never blocks: SUPPLE_NOT_READY when
 * there is none. Fills up to *count entries and sets *count to their number. */
SUPPLE_API SuppleResult suppleGetTimings(SuppleContext context, SuppleTiming* out, uint32_t* count);

/** How a pass keeps to its budget, since that was set. */
typedef struct SuppleBudget {
    uint32_t structSize;
    double limit;            /**< nanoseconds of GPU time a frame */
    double latest;           /**< the newest completed frame that was timed */
    double worst;            /**< the largest */
    uint64_t framesMeasured; /**< completed frames recorded with SUPPLE_RECORD_TIMINGS */
    uint64_t framesOver;     /**< of those, frames above the limit */
} SuppleBudget;

/** Gives a pass (all groups together; null: all passes) a limit in nanoseconds of GPU time a frame; 0 takes it away.
 * When a completed frame exceeds it and the one before did not, there is a warning (SUPPLE_MESSAGE_BUDGET). The first
 * frame of a group also uploads its tables: budgets are better set after it. */
SUPPLE_API SuppleResult suppleSetBudget(SuppleContext context, const char* pass, double nanoseconds);
/** SUPPLE_NOT_READY: the pass has no budget. */
SUPPLE_API SuppleResult suppleGetBudget(SuppleContext context, const char* pass, SuppleBudget* out);

#ifdef __cplusplus
}
#endif
#endif
