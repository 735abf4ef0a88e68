/**
 * @file supple_view.h
 * Level of detail: views, cameras, budgets and culling. supple.h includes this header.
 *
 * A view is a camera with the groups it sees. Such a group is drawn with as many triangles as the camera needs. Every
 * patch edge has a level, a real number that says how many segments it gets. Both patches at an edge compute the level
 * from the edge's curve alone, so there are no cracks. Levels and samples change continuously, so there are no pops.
 * Nothing changes while the camera only turns.
 *
 * All groups of a view write into the view's surface vertices. Before a frame writes any, it counts how many they want.
 * If these do not fit, a factor that changes continuously scales all levels down (docs/lod.md).
 *
 * Subdivision by refinement (FRAGMENTS) has no such levels per edge. Each instance is drawn at one of several rates,
 * and jumps from one to the next, which may be seen.
 */
#ifndef SUPPLE_VIEW_H
#define SUPPLE_VIEW_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_PRIORITY_COUNT 4u           /**< see suppleSetPriority */
#define SUPPLE_MAX_VIEW_VERTICES 50331648u /**< see SuppleViewDesc.maxVertices */
#define SUPPLE_MAX_VIEW_RUNS 65472u        /**< see SuppleViewDesc.maxRuns */

/* ---------------------------------------------------------------------------------------------------- view */

/** What a view writes besides surface vertices, for all its groups, and what it leaves out. */
typedef enum SuppleViewFlags {
    SUPPLE_VIEW_MOTION = 1,     /**< write where every surface vertex was in the frame before */
    SUPPLE_VIEW_ATTRIBUTES = 2, /**< write surface attributes, every frame anew */
    SUPPLE_VIEW_UVS1 = 4,       /**< with ATTRIBUTES: second UV sets */
    SUPPLE_VIEW_FACE_UVS = 8,   /**< with ATTRIBUTES: where vertices lie in the trim tiles of their faces */
    /** Instances that the camera does not see get no vertices. Those that are out of its sight in any pose of their
     * clips are not even posed (see SUPPLE_GROUP_POSE_UNSEEN). When they come back, they have no motion in their first
     * frame, as instances that were hidden. */
    SUPPLE_VIEW_CULL = 16,
    SUPPLE_VIEW_OCCLUSION = 32, /**< with CULL: nor do those that suppleSetDepthPyramid hides */
    /** Leave out patches that surely show the camera only their backs, unless their material is double-sided. Use it
     * only if you draw front faces (counter-clockwise) alone, and from this camera alone. Irregular patches of
     * CATMULL_CLARK and LOOP stay, and all of BLEND. */
    SUPPLE_VIEW_BACK_FACES = 64,
    /** With ATTRIBUTES: write tangents. */
    SUPPLE_VIEW_TANGENTS = 128
} SuppleViewFlags;

/** How much a view may write. */
typedef struct SuppleViewDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleViewFlags */
    /** Surface vertices per frame, of all groups: 1024 to SUPPLE_MAX_VIEW_VERTICES. Their memory is reserved at once.
     * A run of patches is the patches of a group that have one class (SupplePatchClass), one material and one window of
     * instances. A window is as many instances as the device can bind of every buffer. Each run reserves 192 vertices
     * of padding. suppleCreateGroup fails if no vertices or no runs (maxRuns) would remain. */
    uint32_t maxVertices;
    SuppleVertexFormat vertexFormat; /**< of all groups */
    /** 0..1, by priority (suppleSetPriority). Over budget, levels are multiplied by factor^elasticity: 1 scales fully,
     * 0 protects. If a factor of 2^-8 is not enough, all priorities are scaled further down alike. All zero means the
     * default: 1, 1/2, 1/4, 0. */
    float elasticities[SUPPLE_PRIORITY_COUNT];
    /** Runs of patches that there is room for, up to SUPPLE_MAX_VIEW_RUNS, of 9 KB each; rounded up to a multiple
     * of 64. 0: as many as maxVertices has padding for, at most 1024, and at most a quarter of what the device can
     * bind. A character takes a run per class and material, about three to six. FRAGMENTS and POLYGONS take no runs,
     * but a view has at most as many groups of these. */
    uint32_t maxRuns;
    /** Bytes of patch coefficients that the groups with levels (SUPPLE_TESSELLATION_LEVELS) share, reserved at once;
     * with MOTION twice; rounded down to a multiple of 256, at least that. Instances that are drawn in a frame have
     * theirs in it, and no others. Those that find no room are missing, as those that find no room for vertices, and
     * droppedInstanceCount counts them: of instances that are equally large to a 64th octave of pixels, all or none.
     * suppleCreateGroup fails if an instance has more than that. A group that a frame of its view leaves out has no
     * motion in the next one. 0: each group has memory for the coefficients of as many instances as its capacity, or
     * memoryBytes decides. */
    uint64_t coefficientBytes;
    /** 0, or the bytes of device memory that the view's buffers have together: vertices with all that flags ask for,
     * lists and coefficients, but not what the device's alignment adds. Vertices and lists take what maxVertices and
     * maxRuns need. If coefficientBytes is 0, coefficients get what remains, as much of it as the device can bind. */
    uint64_t memoryBytes;
} SuppleViewDesc;

/** Creates a view without groups. Errors: unknown flags, or flags without the one that they go with; maxVertices below
 * 1024 or more than the device can bind (the log names the most), coefficientBytes below 256 or more than that;
 * memoryBytes below what all of it takes (the log names it); an elasticity outside of 0..1; memory. */
SUPPLE_API SuppleResult suppleCreateView(SuppleContext context, const SuppleViewDesc* desc, SuppleView* out);
/** The handle is dead at once. The view's groups keep what they need. They are drawn and culled as before, from the
 * camera that was set last. The depth pyramid is dropped: from the next suppleRecord on it hides nothing. */
SUPPLE_API SuppleResult suppleDestroyView(SuppleContext context, SuppleView view);

/** Sets the priority of an instance of a view's group: 0..SUPPLE_PRIORITY_COUNT-1, 0 at first. It selects the
 * elasticity (SuppleViewDesc.elasticities). With the default elasticities, priority 3 is scaled down last. Errors: the
 * group belongs to no view. */
SUPPLE_API SuppleResult suppleSetPriority(SuppleContext context, SuppleInstance instance, uint32_t priority);

/* ---------------------------------------------------------------------------------------------------- camera */

/** Options of a camera. */
typedef enum SuppleCameraFlags {
    SUPPLE_CAMERA_ORTHOGRAPHIC = 1 /**< pixelsPerUnit holds at every distance; only `farthest` uses position */
} SuppleCameraFlags;

/** From where levels are measured, and how fine they are. All values must be finite, and lengths not negative. */
typedef struct SuppleCameraDesc {
    uint32_t structSize;
    uint32_t flags;      /**< SuppleCameraFlags */
    float position[3];   /**< in the space of the surface vertices */
    float pixelsPerUnit; /**< above 0: pixels of a unit length at distance 1: viewport height / (2 tan(fovY / 2)) */
    float nearest;       /**< a distance: nothing counts as nearer than this, 0 = 0.01 */
    float chordError;    /**< pixels between an edge's curve and its segments, 0 = 0.25 */
    float smallestEdge;  /**< pixels: segments are not made shorter, 0 = 3 */
    float edgeLength;    /**< pixels: segments have this length, whatever the error; 0: the two above decide */
    /** Surface vertices per frame, of all groups. Those of FRAGMENTS count too, though they lie in the
     * groups' own memory. The budget is at most the view's maxVertices. Like maxVertices it includes 192 per run of
     * patches: if it is no more than these, no patches are drawn. 0: the budget is maxVertices, and FRAGMENTS have
     * none. */
    uint32_t vertexBudget;
    /** CULL: what lies outside its volume is not seen. Column-major, depth 0..w (also reversed, or with an infinite far
     * plane). All zero: everything is inside. If you draw shadow maps, give a larger volume, which holds everything
     * that casts a shadow into the picture. */
    float viewProjection[16];
    float farthest;       /**< CULL: what is farther from position is not seen; 0: no limit */
    float smallestRadius; /**< CULL: pixels; 0: no limit. An instance is not seen if the sphere round its
                           * box (suppleGetInstanceBounds) has a smaller radius */
    float direction[3]; /**< BACK_FACES with ORTHOGRAPHIC: where the camera looks, of any length but 0; else not used */
} SuppleCameraDesc;

/** Sets a view's camera, from the next suppleRecord on, until it is set again. A view needs a camera before its groups
 * are recorded. Draw shadows and mirrors with the vertices that the main camera chose: with levels of its own, a
 * shadow pass would make the surface shadow itself. Errors: unknown flags; a value is not finite; pixelsPerUnit is not
 * above 0; another length is negative; direction is zero where it is used. */
SUPPLE_API SuppleResult suppleSetCamera(SuppleContext context, SuppleView view, const SuppleCameraDesc* camera);

/* ---------------------------------------------------------------------------------------------------- occlusion */

/** Options of a depth pyramid. */
typedef enum SuppleDepthPyramidFlags {
    SUPPLE_DEPTH_REVERSED = 1 /**< near is 1, far is 0 */
} SuppleDepthPyramidFlags;

/** A depth picture and smaller copies of it, as the mip levels of an image. Mip level 0 has width x height texels, and
 * may be smaller than the picture. Each further mip level has half the width and half the height, rounded down, at
 * least 1. In a mip level of w x h texels, texel (x, y) holds the farthest depth (the largest; REVERSED: the smallest)
 * of all pixels that the rectangle from (x/w, y/h) to ((x+1)/w, (y+1)/h) of the picture touches.
 * shaders/supple_depth_pyramid.comp makes one. */
typedef struct SuppleDepthPyramidDesc {
    uint32_t structSize;
    uint32_t flags;        /**< SuppleDepthPyramidFlags */
    VkImageView imageView; /**< 2D, R32_SFLOAT, mip levels from 0 on, of an image with usage SAMPLED */
    VkImageLayout layout;  /**< while suppleRecord's commands run: GENERAL, SHADER_READ_ONLY_OPTIMAL or
                            * READ_ONLY_OPTIMAL */
    uint32_t width;        /**< of mip level 0 */
    uint32_t height;
    uint32_t mipLevels;       /**< of imageView: 1 to a full chain; with more of them, more is found hidden */
    float viewProjection[16]; /**< of the picture, as in SuppleCameraDesc: x and y are -1 at the outer edges of the
                               * first texels, and 1 at those of the last ones */
} SuppleDepthPyramidDesc;

/** Views with SUPPLE_VIEW_OCCLUSION: sets the depths that can hide instances, from the next suppleRecord on, until it
 * is set again. Null, as at first: nothing is hidden. An instance is hidden if the box round its surface lies behind
 * these depths everywhere. A box that reaches out of the picture or behind the eye is never hidden. If the depths are
 * those of the frame before, an instance that comes into view may appear a frame late. If they are those of this
 * frame's occluders, it does not.
 *
 * The image is the host's. suppleRecord reads it in compute shaders only. `before` of suppleRecord must name the writes
 * into it (or the host's own barrier covers them: suppleGetRecordScopes), and the next writes must wait for compute
 * shaders. queueFamily must own the image while it is read, also with SUPPLE_CONTEXT_ASYNC_COMPUTE: use concurrent
 * sharing or transfer the ownership. The image and its image view must live until all frames that were recorded with
 * them are complete, even if you set another pyramid. Before you destroy them, set another pyramid, or null.
 * Errors: the view lacks SUPPLE_VIEW_OCCLUSION; unknown flags; imageView is null; another layout; a size or a number of
 * mip levels that no image of the device has; viewProjection is not finite. */
SUPPLE_API SuppleResult suppleSetDepthPyramid(SuppleContext context, SuppleView view,
                                              const SuppleDepthPyramidDesc* pyramid);

/* ---------------------------------------------------------------------------------------------------- levels */

/** How the samples of a view's patches are numbered. R is the capacity (SuppleLevelDraw), an odd number.
 * QUAD   (R+1)^2 samples, as SUPPLE_DOMAIN_QUAD counts them; polar patches too
 * RINGS  of m sides: ring r = 0..(R-1)/2, from the border inwards, has m (R - 2r) samples, one side after another */
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
    uint32_t capacity;        /**< the most segments along a side; patches of lower levels are in draws of less */
    uint32_t samplesPerPatch; /**< surface vertices of one patch */
    /** Surface vertices of one draw instance, which is several whole patches. In the last draw instance the patches
     * that are missing collapse to points. */
    uint32_t verticesPerInstance;
} SuppleLevelDraw;

/** SUPPLE_TESSELLATION_LEVELS: what is drawn. For draw i, draw command i of `indirect`. If no patch has its capacity in
 * a frame, the command draws no instances. Levels decide how many vertices are written: SuppleViewStatistics has the
 * number. All of it, arrays too, is valid until the group is destroyed or made anew.
 * Groups of a view have the same `indices` and `patches`. Their commands lie in one buffer, and so do their buckets. So
 * one call can draw several groups (docs/integration.md). */
typedef struct SuppleLevelOutput {
    uint32_t structSize;
    uint32_t drawCount; /**< entries of draws, indirect and buckets */
    const SuppleLevelDraw* draws;
    SuppleBufferRange indices;  /**< uint16, the view's */
    SuppleBufferRange indirect; /**< VkDrawIndexedIndirectCommand per draw */
    SuppleBufferRange buckets;  /**< four uint32 per draw: first entry of patches, first surface vertex, patch count,
                                 * unused. Its offset and that of patches are multiples of 256 */
    SuppleBufferRange patches;  /**< 64 bytes per patch: uint32 patch (0xFFFFFFFF: none), slot in the low 28 bits, first
                                 * surface vertex, unused; then levels (docs/lod.md) */
} SuppleLevelOutput;

/** Fills out. Errors: no such surface, or it has another tessellation (SuppleSurfaceInfo.tessellation). */
SUPPLE_API SuppleResult suppleGetLevelOutput(SuppleContext context, SuppleGroup group, uint32_t surface,
                                             SuppleLevelOutput* out);

/* ---------------------------------------------------------------------------------------------------- bounds */

/** Bounds of the instances of a view's group, or of a group with SUPPLE_GROUP_BOUNDS. out gets a buffer of two float4
 * per slot, in the space of the surface vertices. The first has the least corner of a box round the surface, and in w
 * the level that the instance asks for as a whole (without a view: 0). The second has the greatest corner, and in w 1
 * if a cage vertex is not finite, else 0. suppleRecord writes the boxes of visible instances that it poses. Errors: the
 * group has no bounds. */
SUPPLE_API SuppleResult suppleGetInstanceBounds(SuppleContext context, SuppleGroup group, SuppleBufferRange* out);

/** Groups with SUPPLE_GROUP_BOUNDS: the box of an instance in the newest completed frame (suppleBeginFrame) that
 * recorded the group, as suppleGetInstanceBounds has it on the device. frame, which may be null, gets that frame.
 * SUPPLE_NOT_READY: there is no such frame, the instance was not visible in it, or it did not exist yet. Never waits.
 * If a cage vertex is not finite, the box holds the others only; without any, min is greater than max. Errors: the
 * group was created without SUPPLE_GROUP_BOUNDS. */
SUPPLE_API SuppleResult suppleReadInstanceBounds(SuppleContext context, SuppleInstance instance, SuppleBounds* out,
                                                 uint64_t* frame);

/* ---------------------------------------------------------------------------------------------------- statistics */

/** What a view drew. */
typedef struct SuppleViewStatistics {
    uint32_t structSize;
    /** 1: scaling down by elasticity was not enough, so all priorities were scaled further down alike. If even the
     * coarsest levels did not fit, or the coefficients, whole instances are missing: of the priorities with the largest
     * elasticity first, and in each the smallest first. 0: it was enough. */
    uint32_t shortfall;
    uint64_t frame; /**< of suppleBeginFrame */
    /** By priority: the factor that levels were multiplied by; 1 within the budget. */
    float levelScales[SUPPLE_PRIORITY_COUNT];
    uint32_t vertexCount;           /**< surface vertices written; FRAGMENTS only with a vertexBudget */
    uint32_t wantedVertexCount;     /**< what would be written without a budget, or up to a few per cent more than that.
                                     * Missing instances count at their coarsest */
    uint32_t patchCount;            /**< drawn */
    uint32_t instanceCount;         /**< visible instances of the view's groups */
    uint32_t drawnInstanceCount;    /**< those that are seen and not missing */
    uint32_t droppedInstanceCount;  /**< seen, but missing for lack of room */
    uint32_t occludedInstanceCount; /**< hidden by the depth pyramid, and by nothing else */
    uint32_t backFaceCount;         /**< patches of drawn instances that BACK_FACES left out */
    uint32_t hiddenPatchCount;      /**< patches of drawn instances that suppleSetPartVisible left out */
    /** Visible instances that were not posed, as they surely are out of sight; instanceCount has them too. */
    uint32_t unposedInstanceCount;
    uint64_t coefficientBytes; /**< of SuppleViewDesc.coefficientBytes: those that the drawn instances took */
} SuppleViewStatistics;

/** Statistics of the newest completed frame that recorded the view. SUPPLE_NOT_READY: there is none. Never waits. */
SUPPLE_API SuppleResult suppleGetViewStatistics(SuppleContext context, SuppleView view, SuppleViewStatistics* out);

#ifdef __cplusplus
}
#endif
#endif
