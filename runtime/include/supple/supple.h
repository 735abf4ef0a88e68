/**
 * @file supple.h
 * Animated control cages to smooth surfaces, on Vulkan compute. C99.
 *
 * Supple loads a character (glTF/GLB, OBJ or arrays), poses its instances, deforms the control cage, and evaluates a
 * smooth surface over it. It records all of this into the host's command buffer. The host gets surface vertices, grid
 * indices and indirect draw arguments. Every pass is measured.
 *
 * Supple does not create a Vulkan instance or device, submit, wait, draw, decode images, open windows or link a loader.
 *
 * This header is in the order of use. supple_view.h (level of detail, culling) and supple_playback.h (layers of clips,
 * root motion, clips that the device plays) are for hosts that need them. This header includes both at its end.
 *
 * Structs
 *   - Structs begin with structSize, the sizeof of the caller's header. Zero in any other field means the default.
 *     Later versions add fields at the end only. Missing trailing fields read as zero. Unknown trailing fields must be
 *     zero, and come back as zero. Structs without structSize never change.
 *   - Matrices are column-major float[16] for column vectors. Space is right-handed with +Y up, as in glTF. Angles are
 *     radians, times are seconds.
 *   - Pointers in a description are read during the call only, unless a comment says otherwise.
 *
 * Handles
 *   - A handle has an index and a generation. A stale or foreign handle gives SUPPLE_ERROR_ARGUMENT, never a crash.
 *   - You may destroy while frames are in flight. suppleBeginFrame frees the memory when you tell it that the last
 *     frame that used it is complete.
 *
 * Errors
 *   - Functions return SUPPLE_OK or what went wrong. The log callback gets the reason in one line, with an id that is
 *     the same in all versions. A call that fails has done nothing, unless its comment says otherwise.
 *   - After SUPPLE_ERROR_DEVICE_LOST, every call that needs the device gives it again. Destroying still works.
 *
 * Threads
 *   - One thread at a time uses a context and everything made from it. There are two exceptions between
 *     suppleBeginFrame calls. Functions that set and query instances may run at the same time for different groups. So
 *     may suppleRecord, for different groups into different command buffers, once suppleRecordUploads has been recorded
 *     for the frame. The log callback is then called from those threads.
 *   - Different contexts are independent.
 *
 * Recording
 *   - creates no Vulkan object and allocates no memory. It binds the compute pipeline, descriptor set 0 and push
 *     constants of the given command buffer. The host rebinds its own compute state afterwards.
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
#define SUPPLE_VERSION_MINOR 2 /**< rises when something is added */
#define SUPPLE_VERSION_PATCH 0
/** One number that rises with every version. */
#define SUPPLE_VERSION (SUPPLE_VERSION_MAJOR * 1000000 + SUPPLE_VERSION_MINOR * 1000 + SUPPLE_VERSION_PATCH)

#define SUPPLE_BIND_POSE 0xFFFFFFFFu   /**< clip index: the cage as modelled, without morph targets */
#define SUPPLE_REST_POSE 0xFFFFFFFEu   /**< clip index: the file's node transforms and morph weights */
#define SUPPLE_NO_MATERIAL 0xFFFFFFFFu /**< faces without a material */
#define SUPPLE_NO_JOINT 0xFFFFFFFFu    /**< the parent of a root joint */
#define SUPPLE_NO_VERTEX 0xFFFFFFFFu   /**< a patch corner that is no vertex of the cage */
#define SUPPLE_NO_IMAGE 0xFFFFFFFFu
#define SUPPLE_NO_TRIM_TILE 0xFFFFFFFFu
#define SUPPLE_MAX_TRIM_TILES 1024u
#define SUPPLE_MAX_RATE 64u            /**< segments along a patch edge */
#define SUPPLE_MAX_FRAMES_IN_FLIGHT 4u /**< see suppleBeginFrame */
#define SUPPLE_MAX_TIMINGS 4096u       /**< entries per frame: passes x groups. Further entries are not timed */

/** A context borrows the host's device. Assets, groups and views belong to one context. */
typedef struct SuppleContext_T* SuppleContext;
/** A character as loaded: cage, skeleton, clips, materials. */
typedef struct SuppleAsset {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleAsset;
/** Instances of one asset with one scheme and the same options. They go through each pass together. */
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
    SUPPLE_INCOMPLETE = 2,         /**< the array was too small; it was filled as far as it went */
    SUPPLE_ERROR_ARGUMENT = -1,    /**< a rule of this header was broken */
    SUPPLE_ERROR_ASSET = -2,       /**< malformed file or cage, or the scheme cannot take it */
    SUPPLE_ERROR_UNSUPPORTED = -3, /**< the device lacks something that suppleQueryRequirements lists */
    SUPPLE_ERROR_LIMIT = -4,       /**< a limit of the device or of this header is exceeded */
    SUPPLE_ERROR_HOST_MEMORY = -5,
    SUPPLE_ERROR_DEVICE_MEMORY = -6,
    SUPPLE_ERROR_DEVICE_LOST = -7,
    SUPPLE_ERROR_VULKAN = -8
} SuppleResult;

/** SUPPLE_VERSION of the library that is running. */
SUPPLE_API uint32_t suppleGetVersion(void);
/** The name of a result, in static storage. */
SUPPLE_API const char* suppleResultString(SuppleResult result);

/** ERROR: the call failed. WARNING: something is left out, mended or over its budget. INFO: worth knowing. */
typedef enum SuppleSeverity { SUPPLE_SEVERITY_INFO, SUPPLE_SEVERITY_WARNING, SUPPLE_SEVERITY_ERROR } SuppleSeverity;

/** What a message is about. Numbers keep their meaning. New ones may come. */
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
    SUPPLE_MESSAGE_DEVICE_UNSUITED = 300,  /**< see suppleQueryRequirements */
    SUPPLE_MESSAGE_FEATURE_DISABLED = 301, /**< the device has it, but the host did not enable it */
    SUPPLE_MESSAGE_LIMIT = 302,
    SUPPLE_MESSAGE_HOST_MEMORY = 400,
    SUPPLE_MESSAGE_DEVICE_MEMORY = 401,
    SUPPLE_MESSAGE_DEVICE_LOST = 402,
    SUPPLE_MESSAGE_VULKAN = 403,
    SUPPLE_MESSAGE_BUDGET = 500 /**< a pass took longer than suppleSetBudget allows */
} SuppleMessage;

/** Called on the thread that called Supple. text is one line, valid during the call. */
typedef void (*SuppleLogFunction)(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

/* ---------------------------------------------------------------------------------------------------- device */

/** What a device must have. Feature structs have their sType set and a null pNext, so a host can chain them into
 * VkDeviceCreateInfo. Only what Supple needs is VK_TRUE. No device extensions are needed. */
typedef struct SuppleRequirements {
    uint32_t structSize;
    uint32_t apiVersion; /**< lowest VkPhysicalDeviceProperties::apiVersion */
    VkPhysicalDeviceVulkan12Features features12;
    VkPhysicalDeviceVulkan13Features features13;
    char reason[256]; /**< the first thing that the device lacks; empty if it has all */
} SuppleRequirements;

/** Fills out. SUPPLE_OK: the device is suitable. SUPPLE_ERROR_UNSUPPORTED: out->reason says what it lacks. */
SUPPLE_API SuppleResult suppleQueryRequirements(VkInstance instance, VkPhysicalDevice physicalDevice,
                                                PFN_vkGetInstanceProcAddr getInstanceProcAddr, SuppleRequirements* out);

/* ---------------------------------------------------------------------------------------------------- context */

/** How lanes share the work. AUTO: NARROW on CPU devices (one lane per patch, texel-buffer loads), WIDE on GPUs (many
 * lanes per patch, coefficients in workgroup memory). Positions agree bit for bit. */
typedef enum SuppleMapping {
    SUPPLE_MAPPING_AUTO = 0,
    SUPPLE_MAPPING_NARROW = 1,
    SUPPLE_MAPPING_WIDE = 2
} SuppleMapping;

/** Options of a context. */
typedef enum SuppleContextFlags {
    SUPPLE_CONTEXT_DEBUG_UTILS = 1,  /**< the host enabled VK_EXT_debug_utils: label passes, name objects */
    SUPPLE_CONTEXT_ASYNC_COMPUTE = 2 /**< outputs go from queueFamily to drawQueueFamily */
} SuppleContextFlags;

/** A piece of the host's device memory. */
typedef struct SuppleMemory {
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void* mapped;     /**< if HOST_VISIBLE was required: the byte at offset, mapped until freed. Else ignored */
    void* allocation; /**< the host's own, for example a VmaAllocation */
} SuppleMemory;

/** Where device memory comes from. Called on the calling thread while contexts, assets, groups and views are created
 * and destroyed, and by suppleBeginFrame; never while recording. */
typedef struct SuppleMemoryCallbacks {
    /** Fills out and returns VK_SUCCESS, or returns the reason. The memory is for buffers (linear). Its type must be in
     * requirements->memoryTypeBits and have all of `required` and, if possible, `preferred`. name is for statistics,
     * valid during the call. */
    VkResult (*allocate)(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                         VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user);
    /** Called once per successful allocate. By then no buffer is bound to the memory and no frame uses it. */
    void (*free)(const SuppleMemory* memory, void* user);
    void* user;
} SuppleMemoryCallbacks;

/** The host's device, and how Supple uses it. */
typedef struct SuppleContextDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleContextFlags */
    /** Borrowed, as all handles here: must outlive the context. */
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    /** Created with what suppleQueryRequirements asks for. */
    VkDevice device;
    uint32_t queueFamily; /**< of the command buffers given to suppleRecord; must support compute */
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkPipelineCache pipelineCache;          /**< optional */
    const VkAllocationCallbacks* allocator; /**< optional; used for every object, must outlive the context */
    uint32_t framesInFlight;                /**< 1..SUPPLE_MAX_FRAMES_IN_FLIGHT, 0 = 2 */
    SuppleMapping mapping;
    SuppleLogFunction log; /**< optional */
    void* logUser;
    /** Optional: the pNext chain that was given to vkCreateDevice. If a feature that Supple needs is not enabled in it,
     * the call fails and names it, instead of undefined behaviour later. Read during the call. */
    const void* enabledFeatures;
    const SuppleMemoryCallbacks* memory; /**< optional; copied. Null: vkAllocateMemory */
    uint32_t drawQueueFamily;            /**< with SUPPLE_CONTEXT_ASYNC_COMPUTE: see suppleGetAcquireBarriers */
} SuppleContextDesc;

/** Loads the device's functions. Almost no pipeline is compiled here: see suppleCreateGroup. Errors: a requirement that
 * the device lacks or the host has not enabled, no compute in queueFamily, memory. */
SUPPLE_API SuppleResult suppleCreateContext(const SuppleContextDesc* desc, SuppleContext* out);
/** Also frees all assets, groups and views. No command buffer that uses them may be pending. Null is allowed. */
SUPPLE_API void suppleDestroyContext(SuppleContext context);

/* ---------------------------------------------------------------------------------------------------- assets */

/** P_m's own crease control. alpha belongs to the edge vertex -> toward, at its end `vertex`, and lies in (0, 1]: 2/3
 * is smooth, smaller is sharper. It overrides what follows from a crease's sharpness there. */
typedef struct SuppleCreaseScalar {
    uint32_t vertex;
    uint32_t toward;
    float alpha;
} SuppleCreaseScalar;

/** A control cage given as arrays (copied). Polygons are counter-clockwise seen from outside. Sharpness is that of
 * OpenSubdiv and USD: 0 is smooth, 10 and more infinitely sharp. */
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
    uint32_t holeCount; /**< faces that shape their neighbours but are not drawn */
    const uint32_t* holes;
    const uint32_t* faceTrimTiles; /**< optional: per face a trim tile or SUPPLE_NO_TRIM_TILE; see SuppleTrimDomain */
} SuppleCageDesc;

/** Options of reading a file. */
typedef enum SuppleAssetFlags {
    SUPPLE_ASSET_PAIR_QUADS = 1 /**< plain triangles: merge consecutive pairs into quads */
} SuppleAssetFlags;

/** The content of a file, from the host's own file system. */
typedef struct SuppleFileBytes {
    const void* bytes;
    size_t byteCount;
    void* handle; /**< the host's */
} SuppleFileBytes;
/** The host's file system: how the external files of an asset (buffers, images) are found. */
typedef struct SuppleFiles {
    /** Fills out and returns non-zero, or returns 0 if there is no such file. The bytes must stay valid until release.
     * path is relative to the asset and percent-decoded. It has forward slashes, and no "..", "." or scheme. Called on
     * the thread that calls suppleCreateAsset, before that returns. */
    int (*read)(const char* path, SuppleFileBytes* out, void* user);
    void (*release)(SuppleFileBytes* bytes, void* user); /**< optional; called once per successful read */
    void* user;
} SuppleFiles;

/** Either a file in memory (bytes) or a cage as arrays. Everything is copied before the call returns. */
typedef struct SuppleAssetDesc {
    uint32_t structSize;
    uint32_t flags;    /**< SuppleAssetFlags */
    const char* name;  /**< optional; begins every message about the asset */
    const void* bytes; /**< .glb or .gltf; .obj if `name` ends so */
    size_t byteCount;
    const char* baseDirectory; /**< where the external files of a .gltf lie; null allows none */
    const SuppleFiles* files;  /**< optional: asked instead of baseDirectory; needed during the call only */
    const SuppleCageDesc* cage;
} SuppleAssetDesc;

/** What an asset holds. Counts are those of the control cage after welding. */
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
    const char* name;     /**< lives as long as the asset; empty if the file has none */
    float weight;         /**< the file's */
    uint32_t vertexCount; /**< cage vertices that it moves */
} SuppleMorphTargetInfo;

/** Trimming: the surface exists where a channel of an image is at least a cutoff. The host's fragment shaders must test
 * this in every pass that draws the surface, shadows too. docs/trimming.md has the test as a GLSL include. */
typedef enum SuppleTrimDomain {
    SUPPLE_TRIM_NONE = 0, /**< the material is whole */
    SUPPLE_TRIM_UV = 1,   /**< the image lies on a UV set: SuppleVertexStreams.attributes or uvs1 */
    SUPPLE_TRIM_FACE = 2  /**< the image is a strip of tiles; a face has one of them: SuppleVertexStreams.faceUvs */
} SuppleTrimDomain;

/** How a lookup outside of 0..1 goes on, as samplers have it. */
typedef enum SuppleWrap { SUPPLE_WRAP_REPEAT = 0, SUPPLE_WRAP_CLAMP = 1, SUPPLE_WRAP_MIRROR = 2 } SuppleWrap;

/** Only what decides where the surface is. Shading is the host's. */
typedef struct SuppleMaterialInfo {
    uint32_t structSize;
    const char* name; /**< lives as long as the asset */
    uint32_t doubleSided;
    /** The file's own trim. Without one, alphaMode MASK with a texture counts as a trim; the lookup is then multiplied
     * by trimFactor and by the alpha of the color attribute. */
    SuppleTrimDomain trimDomain;
    uint32_t trimImage;   /**< or SUPPLE_NO_IMAGE */
    uint32_t trimUvSet;   /**< 0 or 1 */
    uint32_t trimChannel; /**< 0..3: red, green, blue, alpha */
    float trimCutoff;
    float trimFactor;       /**< 1; with MASK the alpha of the base color */
    uint32_t trimTiles;     /**< FACE: tiles in the image */
    SuppleWrap trimWrap[2]; /**< along u and v */
} SuppleMaterialInfo;

/** An image as the file holds it. Decoding is the host's. */
typedef struct SuppleImageInfo {
    uint32_t structSize;
    const char* name;     /**< this and what follows live as long as the asset */
    const char* mimeType; /**< "image/png", "image/jpeg" or empty */
    const void* bytes;    /**< null if the image is missing */
    size_t byteCount;
} SuppleImageInfo;

/** Refuses malformed files and arrays. What only a surface cannot take (a non-manifold edge, a face that is no quad) is
 * refused by suppleCreateGroup, so that the cage alone can still be used. */
SUPPLE_API SuppleResult suppleCreateAsset(SuppleContext context, const SuppleAssetDesc* desc, SuppleAsset* out);
/** The handle is dead at once. The asset's groups keep what they need. */
SUPPLE_API SuppleResult suppleDestroyAsset(SuppleContext context, SuppleAsset asset);
/** Fills out. */
SUPPLE_API SuppleResult suppleGetAssetInfo(SuppleContext context, SuppleAsset asset, SuppleAssetInfo* out);
/** Fills out. Errors: clip is not below SuppleAssetInfo.clipCount. */
SUPPLE_API SuppleResult suppleGetClipInfo(SuppleContext context, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out);
/** Fills out. Joints have the order of the file's skin. Errors: joint is not below jointCount. */
SUPPLE_API SuppleResult suppleGetJointInfo(SuppleContext context, SuppleAsset asset, uint32_t joint,
                                           SuppleJointInfo* out);
/** Fills out. Errors: target is not below morphTargetCount. */
SUPPLE_API SuppleResult suppleGetMorphTargetInfo(SuppleContext context, SuppleAsset asset, uint32_t target,
                                                 SuppleMorphTargetInfo* out);
/** Fills out. Materials have the order of the file. Errors: material is not below materialCount. */
SUPPLE_API SuppleResult suppleGetMaterialInfo(SuppleContext context, SuppleAsset asset, uint32_t material,
                                              SuppleMaterialInfo* out);
/** Fills out. Images have the order of the file. Errors: image is not below imageCount. */
SUPPLE_API SuppleResult suppleGetImageInfo(SuppleContext context, SuppleAsset asset, uint32_t image,
                                           SuppleImageInfo* out);

/* ---------------------------------------------------------------------------------------------------- groups */

/** How the deformed cage becomes a surface. docs/schemes.md says which one to choose. */
typedef enum SuppleScheme {
    SUPPLE_SCHEME_AUTO = 0, /**< P_m */
    SUPPLE_SCHEME_PREP = 1, /**< p-rep: quads, G1 at any valence, one patch per face; creases are ignored */
    SUPPLE_SCHEME_PM = 2,   /**< P_m: any polygons, polar fans, creases; G1 except at creases, one patch per facet */
    SUPPLE_SCHEME_CATMULL_CLARK = 3, /**< subdivision: any polygons, semi-sharp creases; the limit itself */
    SUPPLE_SCHEME_LOOP = 4, /**< subdivision: triangles (larger faces are split into them), semi-sharp creases */
    /** Charts blended: any polygons (if not all are quads, the cage is subdivided once). Interpolates the cage's
     * vertices. Edges are either sharp or smooth. */
    SUPPLE_SCHEME_BLEND = 5,
    SUPPLE_SCHEME_CAGE = 100 /**< the deformed cage alone, of any polygons: no patches, no surface vertices */
} SuppleScheme;

/** DEFAULT scales the tangents of irregular vertices as docs/prep.md derives it. PRINTED does as the paper prints. */
typedef enum SuppleTangentMode { SUPPLE_TANGENTS_DEFAULT = 0, SUPPLE_TANGENTS_PRINTED = 1 } SuppleTangentMode;
/** A boundary vertex that has one face: SHARP passes through it, SMOOTH rounds it. */
typedef enum SuppleCornerRule { SUPPLE_CORNERS_SHARP = 0, SUPPLE_CORNERS_SMOOTH = 1 } SuppleCornerRule;
/** Options of SUPPLE_SCHEME_PREP. */
typedef struct SupplePrepOptions {
    uint32_t structSize;
    SuppleTangentMode tangentMode;
    SuppleCornerRule cornerRule;
} SupplePrepOptions;

/** What a sharp edge is. CUT: two sheets meet in it. CURVE: a narrow ridge, as in the paper. */
typedef enum SuppleCreaseMode { SUPPLE_CREASES_CUT = 0, SUPPLE_CREASES_CURVE = 1 } SuppleCreaseMode;
/** Options of SUPPLE_SCHEME_BLEND. */
typedef struct SuppleBlendOptions {
    uint32_t structSize;
    SuppleCreaseMode creaseMode;
    float sharpThreshold; /**< edges of this sharpness and more are sharp; 0 = 1 */
} SuppleBlendOptions;

/** Layout of a surface vertex. Positions have the same bits in both. */
typedef enum SuppleVertexFormat {
    SUPPLE_VERTEX_16 = 0, /**< float3 position, octahedral normal in 2 x snorm16 (x in the low half) */
    SUPPLE_VERTEX_24 = 1  /**< float3 position, float3 normal */
} SuppleVertexFormat;

/** How several joints move one vertex. DUAL_QUATERNION keeps the girth of a limb that twists or bends. Joints may scale
 * and shear. A vertex of one joint moves as with LINEAR. */
typedef enum SuppleSkinning { SUPPLE_SKINNING_LINEAR = 0, SUPPLE_SKINNING_DUAL_QUATERNION = 1 } SuppleSkinning;

/** Who deforms the instances. The host fills a BUFFER source on the device for all visible instances, in any frame it
 * likes: `before` of suppleRecord then names its writes, and its next writes wait for the compute shaders that
 * suppleRecord recorded. Supple's functions refuse what a source leaves to the host. */
typedef enum SupplePoseSource {
    SUPPLE_POSES_SET = 0,            /**< suppleSetClipPose, suppleSetPose, suppleSetMatrixPose, ... */
    SUPPLE_POSES_PALETTE_BUFFER = 1, /**< SuppleGroupInfo.poses: joint palettes and morph weights */
    SUPPLE_POSES_CAGE_BUFFER = 2,    /**< SuppleGroupInfo.deformedCage: cage vertices, for example of a cloth solver */
    SUPPLE_POSES_PLAYBACK = 3        /**< suppleSetPlayback: clips that the device plays by the group's time */
} SupplePoseSource;

/** What a group writes besides surface vertices, and how. */
typedef enum SuppleGroupFlags {
    SUPPLE_GROUP_PATCHES = 1,    /**< also write the patch coefficients, for inspection */
    SUPPLE_GROUP_ATTRIBUTES = 2, /**< also write the static surface attributes: UVs, color, face UVs */
    SUPPLE_GROUP_MOTION = 4,     /**< also write where every surface vertex was in the frame before */
    /** PREP and PM without a view: an instance is one indexed mesh, which stores samples on the borders of patches
     * once. Positions have the same bits as in other groups. Along creases and boundaries, and with ATTRIBUTES along
     * their seams, each side has vertices of its own. See SuppleDrawRange. */
    SUPPLE_GROUP_INDEXED_MESH = 8,
    /** Groups of a view: one level per instance instead of one per edge. It follows from the instance's bounds and from
     * the longest edge and the sharpest bend of the cage's bind pose. */
    SUPPLE_GROUP_ONE_LEVEL = 32
} SuppleGroupFlags;

/** How the surface of a group is made, and how many instances it has room for. */
typedef struct SuppleGroupDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleGroupFlags */
    SuppleAsset asset;
    uint32_t capacity; /**< instances that can exist at a time, 1 or more */
    SuppleScheme scheme;
    /** Segments along a patch edge, 1..SUPPLE_MAX_RATE; 0 = 8.
     * CATMULL_CLARK and LOOP: segments along an edge of the cage, rounded up to a power of two. A patch has half of
     * them, or a quarter if the cage of Catmull-Clark has faces that are no quads: see SuppleGridOutput.rate.
     * BLEND on a cage with faces that are no quads: likewise, but rounded up to even. */
    uint32_t rate;
    SuppleVertexFormat vertexFormat;
    SuppleSkinning skinning;
    SupplePoseSource poseSource; /**< PALETTE_BUFFER needs linear skinning */
    /** Optional: the group belongs to this view and is drawn at its levels of detail: see supple_view.h. vertexFormat
     * and flags (except ONE_LEVEL) are then the view's. PREP, PM and BLEND have levels and take no rate:
     * SuppleLevelOutput. With CATMULL_CLARK and LOOP every instance has the rate that its level asks for, and `rate` is
     * the largest: SuppleGridOutput.rates. Their vertices are the group's own. They use none of the view's
     * maxVertices, but count in SuppleCameraDesc.vertexBudget. */
    SuppleView view;
    const SupplePrepOptions* prep;   /**< null: the defaults; other schemes ignore it */
    const SuppleBlendOptions* blend; /**< the same */
} SuppleGroupDesc;

/** Creates a group without instances. Compiles the pipelines that no earlier group has needed: create one group of each
 * kind while loading, with a pipeline cache. Errors: a cage that the scheme cannot take, limits of the device or of the
 * view, memory. */
SUPPLE_API SuppleResult suppleCreateGroup(SuppleContext context, const SuppleGroupDesc* desc, SuppleGroup* out);
/** Also destroys its instances. The handle is dead at once. The memory is freed when the frames that used the group are
 * complete (suppleBeginFrame). */
SUPPLE_API SuppleResult suppleDestroyGroup(SuppleContext context, SuppleGroup group);
/** Changes the rate from the next suppleRecord on; query suppleGetGridOutput anew. rate is at most the rate that the
 * group was created with. CATMULL_CLARK, LOOP, BLEND and SUPPLE_GROUP_INDEXED_MESH take that rate alone. Groups with
 * levels take none. */
SUPPLE_API SuppleResult suppleSetRate(SuppleContext context, SuppleGroup group, uint32_t rate);

/* ---------------------------------------------------------------------------------------------------- instances */

/** Creates an instance in the bind pose, visible, with the identity transform. It gets the lowest free slot.
 * SUPPLE_ERROR_LIMIT: the group is full. Earlier frames may still read what a destroyed instance left in the slot; that
 * is not touched before they end. */
SUPPLE_API SuppleResult suppleCreateInstance(SuppleContext context, SuppleGroup group, SuppleInstance* out);
/** The instance is gone from the next suppleRecord on. */
SUPPLE_API SuppleResult suppleDestroyInstance(SuppleContext context, SuppleInstance instance);
/** visible: 0 or 1. A hidden instance costs nothing on the device and is not drawn. What is set for it stays. */
SUPPLE_API SuppleResult suppleSetVisible(SuppleContext context, SuppleInstance instance, uint32_t visible);
/** The next suppleRecord treats the instance as new: its previous positions are its positions, so it has no motion.
 * Instances that were not visible in the group's last suppleRecord are new without this call. */
SUPPLE_API SuppleResult suppleTeleport(SuppleContext context, SuppleInstance instance);
/** Places an instance: an affine float[16] (last row 0, 0, 0, 1), applied after the pose. Surface vertices come out in
 * the space that it maps to. A mirroring transform turns the winding and with it the normals. */
SUPPLE_API SuppleResult suppleSetTransform(SuppleContext context, SuppleInstance instance, const float* transform);

/* ---------------------------------------------------------------------------------------------------- poses */

/** Poses stand until they are set again. What crosses to the device: with SUPPLE_POSES_SET, the poses of the slots in
 * use, every frame. A pose is 48 bytes per joint; with dual quaternions, 64 bytes per joint and 48 more. Morph targets
 * add 4 bytes each, rounded up to 16. If instances came, went, were hidden, shown or teleported, then in this frame and
 * the next one 8 bytes per visible instance and 20 per draw range cross, too (with SUPPLE_CONTEXT_ASYNC_COMPUTE in
 * every frame). */

/** Poses an instance from a clip at a time (clamped to the clip). clip may be SUPPLE_BIND_POSE or SUPPLE_REST_POSE.
 * What the clip does not animate is as in the rest pose. Layers of clips: suppleSetPose in supple_playback.h. */
SUPPLE_API SuppleResult suppleSetClipPose(SuppleContext context, SuppleInstance instance, uint32_t clip, double time);
/** Poses an instance from the host's own animation: jointCount model-space joint matrices (float[16] each), in the
 * order of the skin's joints. Supple applies the inverse bind matrices. Morph weights are the file's. */
SUPPLE_API SuppleResult suppleSetMatrixPose(SuppleContext context, SuppleInstance instance, const float* jointMatrices,
                                            uint32_t jointCount);
/** Sets an instance's morph weights (morphTargetCount values). They stand, whatever its poses say. Null: the weights of
 * the poses again. */
SUPPLE_API SuppleResult suppleSetMorphWeights(SuppleContext context, SuppleInstance instance, const float* weights,
                                              uint32_t morphTargetCount);

/* ---------------------------------------------------------------------------------------------------- frame */

/** Starts a frame. frame rises by at least one per call. completedFrame is the last frame whose command buffers have
 * all finished, 0 before the first; it never falls. frame - completedFrame must not exceed framesInFlight. Frees what
 * was destroyed and is no longer used, and reads finished timestamps. Never waits. */
SUPPLE_API SuppleResult suppleBeginFrame(SuppleContext context, uint64_t frame, uint64_t completedFrame);
/** What was recorded since suppleBeginFrame will never be submitted (for example because the swapchain is lost). Its
 * uploads are due again, its instances have no motion. For suppleBeginFrame the frame counts as completed. Nothing can
 * be recorded until the next suppleBeginFrame. */
SUPPLE_API SuppleResult suppleCancelFrame(SuppleContext context);

/** Stages and accesses on buffers, as in synchronization2. */
typedef struct SuppleSyncScope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
} SuppleSyncScope;

/** Records the upload of what was created since the last upload: static tables, and the barrier behind them.
 * suppleRecord does this too. Only hosts that call suppleRecord on several threads need this call, in a command buffer
 * that is submitted before the others. */
SUPPLE_API SuppleResult suppleRecordUploads(SuppleContext context, VkCommandBuffer commandBuffer);

/** Options of recording. */
typedef enum SuppleRecordFlags {
    SUPPLE_RECORD_TIMINGS = 1, /**< write GPU timestamps round every pass */
    /** The host's own barrier has waited for all earlier uses, Supple's too: see suppleGetRecordScopes. `before` is
     * ignored. */
    SUPPLE_RECORD_NO_ENTRY_BARRIER = 2
} SuppleRecordFlags;

/** What is recorded, and between which uses of the host's. */
typedef struct SuppleRecordDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleRecordFlags */
    const SuppleGroup* groups;
    uint32_t groupCount;
    SuppleSyncScope before; /**< earlier uses of the outputs (for example the last frame's vertex shader reads), and the
                             * host's writes into them (SupplePoseSource) */
    SuppleSyncScope after;  /**< the coming uses of the outputs: all of Supple's writes become visible to them. If
                             * stages = 0, no barrier follows the passes; the host places its own */
} SuppleRecordDesc;

/** Records the passes of the groups, outside a render pass, for the visible instances as they are set now. Each group
 * may be recorded once between suppleBeginFrame calls, and all groups of a view in one call. What is recorded must be
 * submitted once, in the order of recording, on one queue; else call suppleCancelFrame. If the call fails, nothing is
 * recorded. */
SUPPLE_API SuppleResult suppleRecord(SuppleContext context, VkCommandBuffer commandBuffer,
                                     const SuppleRecordDesc* desc);

/** For hosts whose frame graph places the barriers. `first`: the earliest accesses of suppleRecord's commands. `last`:
 * their writes. Either may be null. They are the same for every context and frame. */
SUPPLE_API SuppleResult suppleGetRecordScopes(SuppleSyncScope* first, SuppleSyncScope* last);

/** With SUPPLE_CONTEXT_ASYNC_COMPUTE, suppleRecord ends with barriers that release the outputs to drawQueueFamily. This
 * call gives the matching halves for the command buffer that draws: put them in one vkCmdPipelineBarrier2, behind a
 * semaphore wait for the compute submission. Call it after the frame's suppleRecord and before the next
 * suppleBeginFrame. Release nothing back, because every frame writes the outputs anew. But compute must wait, by a
 * semaphore, for the drawing of earlier frames.
 * use: the stages and accesses of the draws. Fills out with up to *count barriers and sets *count to their number. */
SUPPLE_API SuppleResult suppleGetAcquireBarriers(SuppleContext context, const SuppleGroup* groups, uint32_t groupCount,
                                                 SuppleSyncScope use, VkBufferMemoryBarrier2* out, uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- output */

/** Where a group's buffers are. These calls need no frame; suppleRecord fills the buffers. Buffers are valid until the
 * group is destroyed. Data per instance lies at the instance's slot. Buffers have usage STORAGE, UNIFORM_TEXEL and
 * TRANSFER_SRC, and, as needed, TRANSFER_DST, VERTEX, INDEX or INDIRECT. */

/** A part of one of Supple's buffers, to read, bind and copy from. */
typedef struct SuppleBufferRange {
    VkBuffer buffer; /**< null: the group was created without it */
    VkDeviceSize offset;
    VkDeviceSize size;
    uint32_t stride; /**< bytes per element */
} SuppleBufferRange;

/** How the surface of a group becomes vertices. It follows from the group's description. */
typedef enum SuppleTessellation {
    SUPPLE_TESSELLATION_NONE = 0,         /**< SUPPLE_SCHEME_CAGE: there are no surface vertices */
    SUPPLE_TESSELLATION_GRIDS = 1,        /**< a grid of samples per patch: SuppleGridOutput */
    SUPPLE_TESSELLATION_INDEXED_MESH = 2, /**< one mesh per instance: SuppleGridOutput */
    SUPPLE_TESSELLATION_RATES = 3,        /**< views, subdivision: grids, a rate per instance: SuppleGridOutput */
    SUPPLE_TESSELLATION_LEVELS = 4        /**< views, other schemes: SuppleLevelOutput in supple_view.h */
} SuppleTessellation;

/** What every group has. */
typedef struct SuppleGroupInfo {
    uint32_t structSize;
    SuppleTessellation tessellation;
    uint32_t capacity;                /**< instances that it has room for */
    uint32_t patchCount;              /**< per instance */
    uint32_t cageVertexCount;         /**< per instance */
    uint32_t cageVerticesPerInstance; /**< >= cageVertexCount: the stride of deformedCage between slots */
    /** float4 (x, y, z, 1) per cage vertex: slot * cageVerticesPerInstance + vertex. */
    SuppleBufferRange deformedCage;
    /** Per slot (stride bytes): per joint three rows of four floats, the 3x4 matrix transform * joint * inverse bind,
     * which takes a cage vertex from the bind pose to its place; then a float weight per morph target. Dual
     * quaternions: see shaders/shared/deform.h. Null with SUPPLE_POSES_CAGE_BUFFER. */
    SuppleBufferRange poses;
    SuppleBufferRange
        instances; /**< uint32 per visible instance (in a view: per instance seen): its slot, slots rising */
    /** SUPPLE_GROUP_PATCHES: float4 per coefficient, SUPPLE_PATCH_STRIDE per patch; see SupplePatchInfo. */
    SuppleBufferRange patchCoefficients;
    VkDeviceSize deviceBytes; /**< device memory that the group holds, without its share of the asset's tables */
} SuppleGroupInfo;

/** Fills out. */
SUPPLE_API SuppleResult suppleGetGroupInfo(SuppleContext context, SuppleGroup group, SuppleGroupInfo* out);

/** The buffers of surface vertices: what a sample carries. SuppleGridOutput and SuppleLevelDraw say which vertex
 * belongs to which patch. The first two have a run of vertices per slot. The others are static: all instances of the
 * group use one run. In groups with levels all streams belong to the view: every frame writes them anew, one entry per
 * vertex. */
typedef struct SuppleVertexStreams {
    uint32_t structSize;
    SuppleVertexFormat vertexFormat;
    SuppleBufferRange vertices; /**< in vertexFormat */
    /** MOTION: float3, the vertex's position in the group's last suppleRecord before this one, at the rate of now. For
     * new instances (suppleTeleport) it is the position of now. In frames that do not record the group nothing moves:
     * do not read this. */
    SuppleBufferRange previousPositions;
    SuppleBufferRange attributes; /**< ATTRIBUTES: float2 uv, linear RGBA in 4 x unorm16 */
    SuppleBufferRange uvs1;       /**< ATTRIBUTES, if the cage has a second UV set: float2 */
    /** ATTRIBUTES, if faces of the cage have trim tiles: float2 (u + 2 * tile, v), where the vertex lies in the tile of
     * its face; tile -1 for faces without one (docs/trimming.md). */
    SuppleBufferRange faceUvs;
} SuppleVertexStreams;

/** Fills out. Errors: SUPPLE_TESSELLATION_NONE. */
SUPPLE_API SuppleResult suppleGetVertexStreams(SuppleContext context, SuppleGroup group, SuppleVertexStreams* out);

/** The shape that a patch is sampled over, R = rate. Samples are counted row by row. The patch's corners are the
 * domain's.
 * QUAD      (R+1)^2: (i, j) at j (R+1) + i, u = i/R from corner 0 to 1, v = j/R from corner 0 to 3
 * POLAR     the same samples; the row j = R is one point, corner 2
 * TRIANGLE  (R+1)(R+2)/2: rows j = 0..R from the edge 0-1 towards corner 2, each i = 0..R-j
 * PENTAGON  5 R(R+1)/2 + 1: for each edge s-(s+1) rows j = 0..R-1 from the edge towards the centre, each i = 0..R-j-1
 * (the row's last point is the next edge's first); then the centre
 * MESH      a whole instance: SUPPLE_TESSELLATION_INDEXED_MESH */
typedef enum SuppleDomain {
    SUPPLE_DOMAIN_QUAD = 0,
    SUPPLE_DOMAIN_POLAR = 1,
    SUPPLE_DOMAIN_TRIANGLE = 2,
    SUPPLE_DOMAIN_PENTAGON = 3,
    SUPPLE_DOMAIN_MESH = 4
} SuppleDomain;

/** The patches of one domain and one material. Ranges follow each other without gaps. Draw instance i is patch
 * firstPatch + i % patchCount of the instance in slot instances[i / patchCount].
 *
 * INDEXED_MESH: all triangles of one material. Draw instance i is the instance in slot instances[i], and an index is a
 * surface vertex within the instance. Shaders that pull vertices see one big patch: patchCount is 1, firstVertex and
 * firstPatch are 0, samplesPerPatch is the group's vertexCount. Triangles have the order of the patches of that
 * material (suppleGetPatches), and within a patch the order of its domain's grid. */
typedef struct SuppleDrawRange {
    uint32_t firstPatch;
    uint32_t patchCount;
    uint32_t material; /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    SuppleDomain domain;
    uint32_t samplesPerPatch;
    uint32_t firstVertex; /**< of the range, among the surface vertices of an instance */
    uint32_t firstIndex;  /**< in SuppleGridOutput.indices: the triangles of one patch, used by all of the range */
    uint32_t indexCount;
} SuppleDrawRange;

/** What is drawn at one rate. Per draw range: bind `instances` and draw the range's command of `indirect`. */
typedef struct SuppleRate {
    uint32_t rate;               /**< segments along a patch edge: R of SuppleDomain */
    uint32_t firstDrawRange;     /**< in SuppleGridOutput.drawRanges */
    uint32_t drawRangeCount;     /**< the same at every rate of a group */
    SuppleBufferRange instances; /**< uint32 per instance drawn at this rate: its slot, slots rising */
} SuppleRate;

/** Tessellation GRIDS, INDEXED_MESH and RATES: what is drawn. Valid until the group is destroyed or its rate is set. */
typedef struct SuppleGridOutput {
    uint32_t structSize;
    uint32_t rate;        /**< segments along a patch edge: R of SuppleDomain. RATES: the largest */
    uint32_t vertexCount; /**< surface vertices per instance. RATES: of all rates, those of coarser ones first */
    uint32_t verticesPerInstance; /**< >= vertexCount: slot k starts at vertex k * this */
    /** Vertex of (slot, patch, sample), with the patch's range r: slot * verticesPerInstance + r.firstVertex +
     * (patch - r.firstPatch) * r.samplesPerPatch + sample. INDEXED_MESH: slot * verticesPerInstance + index. */
    const SuppleDrawRange* drawRanges;
    uint32_t drawRangeCount;
    uint32_t rateCount;         /**< entries of rates */
    const SuppleRate* rates;    /**< rates rising. RATES: each instance has one of them. Else one, with all ranges */
    SuppleBufferRange indices;  /**< uint16; INDEXED_MESH: uint32. See SuppleDrawRange */
    SuppleBufferRange indirect; /**< VkDrawIndexedIndirectCommand per draw range, for the visible instances */
} SuppleGridOutput;

/** Fills out. Errors: the group has another tessellation (SuppleGroupInfo.tessellation). */
SUPPLE_API SuppleResult suppleGetGridOutput(SuppleContext context, SuppleGroup group, SuppleGridOutput* out);

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
    uint32_t face; /**< source face of the cage. Faces of six and more sides are split, each part is a patch */
    SupplePatchClass patchClass;
    uint32_t cornerCount;
    uint32_t corners[SUPPLE_MAX_SIDES]; /**< cage vertices, corner i at corner i of the domain. Points that subdivision
                                         * added: SUPPLE_NO_VERTEX */
    uint32_t coefficientCount;
} SupplePatchInfo;

/** Fills out with up to *count patches in device order, and sets *count to the number of patches. out may be null. */
SUPPLE_API SuppleResult suppleGetPatches(SuppleContext context, SuppleGroup group, SupplePatchInfo* out,
                                         uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- timings */

/** What a pass cost, for one group and frame. */
typedef struct SuppleTiming {
    /** Static: upload, attributes, pose (up to three times), deform, vertex, assemble, patch, evaluate, motion. Groups
     * of a view also have bounds (twice with OCCLUSION), list, level (twice), solve (once per view) and place. An entry
     * `shortfall` is no pass: it follows solve in frames in which the view's budget was not enough
     * (SuppleViewStatistics.shortfall), and only in those. It takes no time. */
    const char* pass;
    SuppleGroup group; /**< of suppleRecord */
    uint64_t frame;
    double gpuBegin; /**< nanoseconds since the context's first timestamp; 0 if the queue has no timestamps */
    double gpuEnd;
    double cpuRecord; /**< nanoseconds that the host spent on recording the pass */
    /** Elements that the pass wrote, and bytes. Both are 0 if only the device knows, as in groups of a view:
     * SuppleViewStatistics has what the whole view wrote. `shortfall`: instances that are missing, and bytes of surface
     * vertices that lack; missing instances count at their coarsest. */
    uint64_t points;
    uint64_t bytes; /**< see points */
} SuppleTiming;

/** The passes of the newest completed frame that was recorded with SUPPLE_RECORD_TIMINGS. SUPPLE_NOT_READY: there is
 * none. Never blocks. Fills out with up to *count entries and sets *count to their number. */
SUPPLE_API SuppleResult suppleGetTimings(SuppleContext context, SuppleTiming* out, uint32_t* count);

/** How a pass keeps to its budget, since that was set. */
typedef struct SuppleBudget {
    uint32_t structSize;
    double limit;            /**< nanoseconds of GPU time per frame */
    double latest;           /**< the newest completed frame that was timed */
    double worst;            /**< the largest */
    uint64_t framesMeasured; /**< completed frames that were recorded with SUPPLE_RECORD_TIMINGS */
    uint64_t framesOver;     /**< measured frames above the limit */
} SuppleBudget;

/** Gives a pass (all groups together; null: all passes) a limit in nanoseconds of GPU time per frame. 0 removes it. If
 * a completed frame exceeds it and the frame before did not, there is a warning (SUPPLE_MESSAGE_BUDGET). The first
 * frame of a group also uploads its tables, so set budgets after it. */
SUPPLE_API SuppleResult suppleSetBudget(SuppleContext context, const char* pass, double nanoseconds);
/** Fills out. SUPPLE_NOT_READY: the pass has no budget. */
SUPPLE_API SuppleResult suppleGetBudget(SuppleContext context, const char* pass, SuppleBudget* out);

#ifdef __cplusplus
}
#endif

#include "supple_playback.h" /* IWYU pragma: export */
#include "supple_view.h"     /* IWYU pragma: export */
#endif
