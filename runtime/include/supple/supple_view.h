/**
 * @file supple_view.h
 * Level of detail: views, cameras, budgets and culling. supple.h includes this header.
 *
 * A group that belongs to a view is drawn with as many triangles as the view's camera needs. Every edge has a
 * real-valued level, which both patches at it take from its boundary curve alone. So there are no cracks. Levels and
 * patterns move continuously, so there are no pops, and nothing changes while the camera only turns.
 *
 * All groups of a view write into the view's surface vertices. What they want in a frame is counted before anything is
 * written. If it does not fit, one continuous factor scales all levels down (docs/lod.md).
 *
 * Subdivision has no real-valued levels. Each of its instances takes one of several rates, and changes from one to the
 * next at once.
 */
#ifndef SUPPLE_VIEW_H
#define SUPPLE_VIEW_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_PRIORITY_COUNT 4u           /**< see suppleSetPriority */
#define SUPPLE_MAX_VIEW_VERTICES 50331648u /**< see SuppleViewDesc.maxVertices */

/* ---------------------------------------------------------------------------------------------------- view */

/** What a view writes besides surface vertices, for all its groups, and what it leaves out. */
typedef enum SuppleViewFlags {
    SUPPLE_VIEW_MOTION = 1,     /**< write where every surface vertex was in the frame before */
    SUPPLE_VIEW_ATTRIBUTES = 2, /**< write surface attributes, every frame anew */
    SUPPLE_VIEW_UVS1 = 4,       /**< with ATTRIBUTES: second UV sets */
    SUPPLE_VIEW_FACE_UVS = 8,   /**< with ATTRIBUTES: where vertices lie in the trim tiles of their faces */
    SUPPLE_VIEW_CULL = 16,      /**< instances that the camera does not see are deformed, but get no surface */
    SUPPLE_VIEW_OCCLUSION = 32, /**< with CULL: neither do those behind a depth pyramid, see suppleSetDepthPyramid */
    /** Leave out patches of PREP and PM that surely show the camera their backs, except those of double-sided
     * materials. For hosts that draw counter-clockwise triangles only, and from this camera only. Patches of other
     * schemes stay. */
    SUPPLE_VIEW_BACK_FACES = 64
} SuppleViewFlags;

/** How much a view may write. */
typedef struct SuppleViewDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleViewFlags */
    /** Surface vertices per frame, of all groups; memory is reserved for them. 1024 to SUPPLE_MAX_VIEW_VERTICES. Each
     * run of patches reserves 192 vertices of padding. suppleCreateGroup fails if none would remain.
     * A view has room for 256 runs of patches. A group takes one run for each class of its patches, material and window
     * of its instances, a window being as many as the device can bind of every buffer. CATMULL_CLARK and LOOP take no
     * runs; a view has at most 256 groups of these. */
    uint32_t maxVertices;
    SuppleVertexFormat vertexFormat; /**< of all groups */
    /** By priority, 0..1. Over budget, levels are multiplied by factor^elasticity: 1 scales fully, 0 protects. Where
     * other priorities have come down to 2^-8 by theirs, all are scaled further down alike. All zero: 1, 1/2, 1/4, 0.
     */
    float elasticities[SUPPLE_PRIORITY_COUNT];
} SuppleViewDesc;

/** Creates a view without groups. */
SUPPLE_API SuppleResult suppleCreateView(SuppleContext context, const SuppleViewDesc* desc, SuppleView* out);
/** The handle is dead at once. The view's groups keep what they need. They are drawn and culled as before, from the
 * camera that was set last. The depth pyramid goes: from the next suppleRecord on nothing is occluded. */
SUPPLE_API SuppleResult suppleDestroyView(SuppleContext context, SuppleView view);

/** Sets the priority of an instance of a view's group: 0..SUPPLE_PRIORITY_COUNT-1, 0 at first. It selects the
 * elasticity (SuppleViewDesc.elasticities). */
SUPPLE_API SuppleResult suppleSetPriority(SuppleContext context, SuppleInstance instance, uint32_t priority);

/* ---------------------------------------------------------------------------------------------------- camera */

/** Options of a camera. */
typedef enum SuppleCameraFlags {
    SUPPLE_CAMERA_ORTHOGRAPHIC = 1 /**< pixelsPerUnit holds everywhere; position matters to `farthest` only */
} SuppleCameraFlags;

/** From where levels are measured, and how fine they are. */
typedef struct SuppleCameraDesc {
    uint32_t structSize;
    uint32_t flags;      /**< SuppleCameraFlags */
    float position[3];   /**< in the space of the surface vertices */
    float pixelsPerUnit; /**< of a unit length at unit distance: viewport height / (2 tan(field of view / 2)) */
    float nearest;       /**< nothing counts as nearer than this, 0 = 0.01 */
    float chordError;    /**< pixels between an edge and its segments, 0 = 0.25 */
    float smallestEdge;  /**< pixels: segments are not made shorter, 0 = 3 */
    float edgeLength;    /**< pixels: segments have this length, whatever the error; 0: by the two above */
    /** Surface vertices per frame, of all groups. Those of CATMULL_CLARK and LOOP count too, though they lie in the
     * groups' own memory. The budget is at most the view's maxVertices and, like it, includes 192 per run of patches:
     * if no more than these remain, no patches are drawn. 0: maxVertices, and CATMULL_CLARK and LOOP have no budget. */
    uint32_t vertexBudget;
    /** CULL: what lies outside is not seen. Column-major, depth 0..w (or reversed, or without end). All zero:
     * everything is inside. Shadow maps need a larger volume, with everything that casts a shadow into the picture. */
    float viewProjection[16];
    float farthest;       /**< CULL: what is farther from position is not seen; 0: no limit */
    float smallestRadius; /**< CULL: pixels: what is smaller is not seen */
    float direction[3];   /**< BACK_FACES with ORTHOGRAPHIC: where the camera looks, of any length; else not used */
} SuppleCameraDesc;

/** Moves a view's camera. It stands until it is set again. A view needs a camera before its groups are recorded. Shadow
 * passes and mirrors draw what the main camera chose: with other levels the surface would shadow itself. */
SUPPLE_API SuppleResult suppleSetCamera(SuppleContext context, SuppleView view, const SuppleCameraDesc* camera);

/* ---------------------------------------------------------------------------------------------------- occlusion */

/** Options of a depth pyramid. */
typedef enum SuppleDepthPyramidFlags {
    SUPPLE_DEPTH_REVERSED = 1 /**< near is 1, far is 0 */
} SuppleDepthPyramidFlags;

/** A depth picture and smaller ones of it, as the mip levels of an image. Mip level 0 has width x height texels. Each
 * further one has half as many, rounded down, at least 1. In a mip level of w x h texels, texel (x, y) holds the
 * farthest depth (the largest; REVERSED: the smallest) of everything that the rectangle from (x/w, y/h) to
 * ((x+1)/w, (y+1)/h) of the picture touches. Mip level 0 may be smaller than the picture.
 * shaders/supple_depth_pyramid.comp makes one. */
typedef struct SuppleDepthPyramidDesc {
    uint32_t structSize;
    uint32_t flags;        /**< SuppleDepthPyramidFlags */
    VkImageView imageView; /**< 2D, R32_SFLOAT, mip levels from 0 on, of an image with usage SAMPLED */
    VkImageLayout layout;  /**< while suppleRecord's commands run: GENERAL, SHADER_READ_ONLY_OPTIMAL or
                            * READ_ONLY_OPTIMAL */
    uint32_t width;        /**< of mip level 0 */
    uint32_t height;
    uint32_t mipLevels;       /**< of imageView: 1 to as many as there can be; more of them find more hidden */
    float viewProjection[16]; /**< of the picture, as in SuppleCameraDesc; x and y -1..1 from texel 0 to the last */
} SuppleDepthPyramidDesc;

/** SUPPLE_VIEW_OCCLUSION: sets what can hide instances, from the next suppleRecord on, until it is set again. Null, as
 * at first: nothing hides. An instance is hidden if the box round its surface lies behind the pyramid everywhere. A box
 * that reaches out of the picture or behind the eye is never hidden. With the depth of the frame before, an instance
 * that comes into view appears a frame late. With the depth of this frame's occluders it does not.
 *
 * The image is the host's. suppleRecord samples it in compute shaders only. `before` must name the writes into it (or
 * they come before the first scope of suppleGetRecordScopes), and the next writes must wait for compute shaders. When
 * it is sampled, queueFamily must own it, also with SUPPLE_CONTEXT_ASYNC_COMPUTE: share it concurrently, or transfer
 * it. The image and its image view must live until the frames that were recorded with them are complete; setting
 * another pyramid does not change that. Before you destroy them, set another pyramid, or null. */
SUPPLE_API SuppleResult suppleSetDepthPyramid(SuppleContext context, SuppleView view,
                                              const SuppleDepthPyramidDesc* pyramid);

/* ---------------------------------------------------------------------------------------------------- levels */

/** Grids of a view's patches; R is the capacity, odd.
 * QUAD   (R+1)^2 samples, as SUPPLE_DOMAIN_QUAD counts them; polar patches too
 * RINGS  of m sides: ring r = 0..(R-1)/2 has m (R - 2r) samples, side by side, from the border inwards */
typedef enum SuppleGrid {
    SUPPLE_GRID_QUAD = 0,
    SUPPLE_GRID_TRIANGLE_RINGS = 1,
    SUPPLE_GRID_QUAD_RINGS = 2,
    SUPPLE_GRID_PENTAGON_RINGS = 3
} SuppleGrid;

/** An indexed indirect draw of a group with levels: patches of one material whose grids have one capacity. The surface
 * vertex is gl_VertexIndex + gl_InstanceIndex * verticesPerInstance. Its patch is SuppleLevelOutput.patches[
 * bucket.firstPatch + (vertex - bucket.firstVertex) / samplesPerPatch], with bucket = buckets[index of the draw]. */
typedef struct SuppleLevelDraw {
    uint32_t material;        /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    SuppleGrid grid;          /**< how samples are numbered */
    uint32_t capacity;        /**< segments along a side: for levels above the next smaller capacity, up to this */
    uint32_t samplesPerPatch; /**< surface vertices of one patch */
    uint32_t
        verticesPerInstance; /**< per draw instance, of whole patches. If the last ones are none, they are points */
} SuppleLevelDraw;

/** SUPPLE_TESSELLATION_LEVELS: what is drawn. Draw i has the i-th command of `indirect`. If no patch has the capacity
 * of a draw, it draws no instances. How many vertices are written, levels decide: SuppleViewStatistics has their sum.
 * Valid until the group is destroyed. */
typedef struct SuppleLevelOutput {
    uint32_t structSize;
    uint32_t drawCount; /**< entries of draws, indirect and buckets */
    const SuppleLevelDraw* draws;
    SuppleBufferRange indices;  /**< uint16, the view's */
    SuppleBufferRange indirect; /**< VkDrawIndexedIndirectCommand per draw */
    SuppleBufferRange buckets; /**< four uint32 per draw: first entry of patches, first surface vertex, patch count, - .
                                * Its offset and that of patches are multiples of 256 */
    SuppleBufferRange patches; /**< 64 bytes per patch: uint32 patch (0xFFFFFFFF: none), slot in the low 28 bits, first
                                * surface vertex, - ; then levels (docs/lod.md) */
} SuppleLevelOutput;

/** Fills out. Errors: the group has another tessellation (SuppleGroupInfo.tessellation). */
SUPPLE_API SuppleResult suppleGetLevelOutput(SuppleContext context, SuppleGroup group, SuppleLevelOutput* out);

/** Bounds of the instances of a view's group. out gets a buffer of two float4 per slot: the least corner of a box round
 * the surface, and the level that the instance asks for as a whole; the greatest corner, and 1 if a cage vertex is not
 * finite, else 0. Errors: the group belongs to no view. */
SUPPLE_API SuppleResult suppleGetInstanceBounds(SuppleContext context, SuppleGroup group, SuppleBufferRange* out);

/* ---------------------------------------------------------------------------------------------------- statistics */

/** What a view drew. */
typedef struct SuppleViewStatistics {
    uint32_t structSize;
    /** 1: scaling down by elasticity is not enough. All priorities are then scaled further down alike. If even the
     * coarsest levels do not fit, whole instances are missing, the smallest first. */
    uint32_t shortfall;
    uint64_t frame; /**< of suppleBeginFrame */
    float
        levelScales[SUPPLE_PRIORITY_COUNT]; /**< by priority: the factor that levels were scaled by, 1 within budget */
    uint32_t vertexCount;           /**< surface vertices written; CATMULL_CLARK and LOOP only with a vertexBudget */
    uint32_t wantedVertexCount;     /**< what would be written without a budget, up to a few per cent more; missing
                                     * instances count at their coarsest */
    uint32_t patchCount;            /**< drawn */
    uint32_t instanceCount;         /**< visible instances of the view's groups */
    uint32_t drawnInstanceCount;    /**< those that are seen and not missing */
    uint32_t droppedInstanceCount;  /**< seen, but missing for lack of room */
    uint32_t occludedInstanceCount; /**< not seen because of OCCLUSION alone */
    uint32_t backFaceCount;         /**< patches of drawn instances that BACK_FACES left out */
} SuppleViewStatistics;

/** Statistics of the newest completed frame. SUPPLE_NOT_READY: there is none. Never blocks. */
SUPPLE_API SuppleResult suppleGetViewStatistics(SuppleContext context, SuppleView view, SuppleViewStatistics* out);

#ifdef __cplusplus
}
#endif
#endif
