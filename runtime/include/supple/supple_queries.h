/**
 * @file supple_queries.h
 * Queries on the device: what rays meet first, or which points are nearest to some places, among the instances of some
 * groups, as they are posed in this frame. The device reads no surface vertices and the host waits for nothing.
 * supple.h includes this header; docs/surface_points.md shows how it is used.
 *
 * A hit is a point of a surface (SuppleSurfacePoint) on an instance, with its position and normal. It lies on the limit
 * of the surface, as points of point sets do, so it is the same at every rate and level of detail. Groups with
 * SUPPLE_SCHEME_CAGE are met too.
 */
#ifndef SUPPLE_QUERIES_H
#define SUPPLE_QUERIES_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_NO_HIT 0xFFFFFFFFu    /**< SuppleHit.group: the ray meets nothing, or nothing is near the place */
#define SUPPLE_MAX_QUERY_RAYS 65536u /**< SuppleQueryPoolDesc.rayCount */

/** Memory and pipelines for the queries of some groups: one batch of rays or places a frame. */
typedef struct SuppleQueryPool {
    uint64_t id; /**< 0 is never a valid handle */
} SuppleQueryPool;

/** A ray, in the coordinates of surface vertices (suppleSetOrigin). It is met at origin + t * direction, from tMin to
 * tMax. The direction need not have a length of 1. tMin below 0 means 0, and tMax may be infinite. If a number is not
 * finite otherwise, or the direction has no length, this ray meets nothing. */
typedef struct SuppleRay {
    float origin[3];    /**< where it begins */
    float tMin;         /**< nothing is met before */
    float direction[3]; /**< where it goes */
    float tMax;         /**< nothing is met behind */
} SuppleRay;

/** A place that the nearest point is asked for, in the coordinates of surface vertices. If a coordinate is not finite,
 * or mostDistance is below 0 or no number, this place has none. */
typedef struct SupplePlace {
    float position[3];  /**< x, y, z */
    float mostDistance; /**< nothing farther is found; may be infinite. The less, the less is searched */
} SupplePlace;

/** SuppleHit.flags. */
typedef enum SuppleHitFlags {
    SUPPLE_HIT_BACK = 1, /**< the surface is met from behind; the place lies behind the surface */
    SUPPLE_HIT_FLAGS_MAX_ENUM = 0x7FFFFFFF
} SuppleHitFlags;

/** What a ray meets first, from either side, or the point that is nearest to a place: 64 bytes, on the device as for
 * the host. Misses: what a ray that meets nothing has, and a place with nothing near. */
typedef struct SuppleHit {
    /** Along the ray, in lengths of its direction; or the distance from the place. Infinity if it is a miss. */
    float t;
    uint32_t group;           /**< number of the group in SuppleQueryPoolDesc.groups, or SUPPLE_NO_HIT */
    uint32_t slot;            /**< of the instance, in its group */
    uint32_t flags;           /**< SuppleHitFlags */
    SuppleSurfacePoint point; /**< where on the cage: face SUPPLE_NO_FACE if it is a miss */
    float position[3];        /**< in the coordinates of surface vertices */
    float reserved;           /**< 0 */
    float normal[3];          /**< of unit length, outwards; zero if the surface has none there */
    float reservedToo;        /**< 0 */
} SuppleHit;

/** What a tracer of a group's triangles, be it hardware, says that a ray has met: 32 bytes. */
typedef struct SuppleTriangleHit {
    uint32_t group;   /**< number of the group in SuppleQueryPoolDesc.groups, or SUPPLE_NO_HIT: the ray meets nothing */
    uint32_t surface; /**< of the group */
    uint32_t slot;    /**< of the instance */
    uint32_t geometry;  /**< draw range of the surface: geometryIndex, if it was built as suppleGetRayGeometry says */
    uint32_t primitive; /**< triangle of that range: primitiveIndex */
    float t;            /**< along the ray, in lengths of its direction */
    float reserved[2];  /**< not looked at: barycentrics, say */
} SuppleTriangleHit;

/** SuppleQueryPoolDesc.flags. */
typedef enum SuppleQueryPoolFlags {
    SUPPLE_QUERY_POOL_NEAREST = 1, /**< frames may ask for nearest points too: two pipelines more */
    SUPPLE_QUERY_POOL_FLAGS_MAX_ENUM = 0x7FFFFFFF
} SuppleQueryPoolFlags;

/** What a pool is for. Pointers are needed during the call only. */
typedef struct SuppleQueryPoolDesc {
    uint32_t structSize;
    uint32_t flags;            /**< SuppleQueryPoolFlags */
    const SuppleGroup* groups; /**< groupCount of them, each once: hits name them by number */
    uint32_t groupCount;       /**< 1 and more */
    uint32_t rayCount;         /**< how many rays or places a frame has at most: 1 to SUPPLE_MAX_QUERY_RAYS */
} SuppleQueryPoolDesc;

/** Filled by suppleGetQueryOutput. */
typedef struct SuppleQueryOutput {
    uint32_t structSize;
    uint32_t rayCount;      /**< as in the description */
    SuppleBufferRange hits; /**< SuppleHit, one a ray or place, in their order */
} SuppleQueryOutput;

/** SuppleQueryDesc.flags. */
typedef enum SuppleQueryFlags {
    SUPPLE_QUERY_READ_BACK = 1, /**< for suppleReadHits: hits are copied to where the host reads them */
    SUPPLE_QUERY_FLAGS_MAX_ENUM = 0x7FFFFFFF
} SuppleQueryFlags;

/** What suppleRecordQueries is asked. Pointers are needed during the call only. */
typedef struct SuppleQueryDesc {
    uint32_t structSize;
    uint32_t flags;            /**< SuppleQueryFlags */
    const SuppleGroup* groups; /**< optional: groupCount of the pool's. Null: those that this frame has recorded */
    uint32_t groupCount;       /**< 0 without groups */
    uint32_t rayCount;         /**< how many rays, or places; 0: nothing is recorded */
    const SuppleRay* hostRays; /**< rays of the host; or null */
    /** Or rays of the device, from its offset on, a multiple of 4: a buffer with VK_BUFFER_USAGE_TRANSFER_SRC_BIT.
     * They lie 32 bytes apart, whatever its stride says. */
    SuppleBufferRange rays;
    /** Optional: what the rays have met of triangles that were drawn at a rate, one for each ray. Then rays are not
     * cast. A hit is the point of the triangle's face that the ray comes nearest to, near that t. It may lie beside its
     * ray, as triangles reach beyond the surface at silhouettes. If there is no such triangle, or no such point,
     * nothing is met. Only surfaces of SUPPLE_TESSELLATION_GRIDS and INDEXED_MESH have triangles to name. */
    const SuppleTriangleHit* hostTriangles;
    SuppleBufferRange triangles; /**< or those of the device, as rays */
    /** What wrote the device's rays, triangles and places, and what used the hits of earlier frames. */
    SuppleSyncScope before;
    SuppleSyncScope after; /**< what reads the hits on the device */
    /** Instead of rays: places of the host that the nearest points are asked for. If several points are equally near
     * (their distances differ by less than a millionth of the instance's size), the first group, instance and face has
     * the one that is found. */
    const SupplePlace* hostPlaces;
    SuppleBufferRange places; /**< or those of the device, 16 bytes apart, else as rays */
} SuppleQueryDesc;

/** Makes a pool: all memory and all pipelines that its queries need, so that recording allocates nothing.
 *
 * Each group's surfaces become pieces: polynomials of its cage's vertices, which no pose changes. They are shared by
 * all instances and made anew by each pool; docs/surface_points.md says how long that takes and what they take.
 *
 * Device memory besides (SuppleMemoryUse.scratch, streams): 136 bytes a ray, and 64 bytes a ray and frame in flight
 * that the host reads; of each group 32 bytes an instance. If rayCount is above 16, each group has a tree over its
 * pieces too: 64 bytes a piece for each instance that is looked at at the same time. Those are all instances of its
 * capacity, if 64 MiB are enough for them. Otherwise rays go through them in turns.
 *
 * suppleSetCapacity and suppleReloadAsset make a group's part of the pool anew. A group that is destroyed leaves the
 * pool; the others keep their numbers.
 *
 * Errors: a stale handle; unknown flags; no groups, or one twice; no rays or too many; what suppleCreatePointSet
 * refuses of a group; pieces that hang on more than 4096 vertices or need more memory than the device binds; more
 * pieces on all instances than 32 bits number; memory. SUPPLE_ERROR_UNSUPPORTED if the library was built with
 * SUPPLE_WITH_CPU=OFF. `out->id` is 0 then. */
SUPPLE_API SuppleResult suppleCreateQueryPool(SuppleContext context, const SuppleQueryPoolDesc* desc,
                                              SuppleQueryPool* out);
/** Its buffers stay until all frames that may use them are complete. */
SUPPLE_API SuppleResult suppleDestroyQueryPool(SuppleContext context, SuppleQueryPool pool);
/** Where the hits of a pool are on the device. They stay there as long as the pool. */
SUPPLE_API SuppleResult suppleGetQueryOutput(SuppleContext context, SuppleQueryPool pool, SuppleQueryOutput* out);

/** Records what rays meet or what is nearest to places, once a frame at most: behind suppleRecord of the groups, in the
 * same frame and queue, outside of render passes. Instances take part that suppleRecord deforms in this frame: hidden
 * ones do not, nor those that it leaves out as their view does not see them (SUPPLE_VIEW_CULL without
 * SUPPLE_GROUP_POSE_UNSEEN), nor groups that wait for their uploads. Parts that an instance hides are met.
 *
 * A pool is used by one thread at a time. If `desc->groups` names the groups that this thread has recorded, other
 * threads may record other groups of the pool meanwhile. Without names, no other thread may record a group of the pool.
 *
 * Errors: a stale handle; unknown flags; more rays than the pool is for; more than one of the four kinds of rays and
 * places, or none; rays beyond the range; places in a pool without SUPPLE_QUERY_POOL_NEAREST, or with triangles; a
 * group that the pool lacks, or that no suppleRecord of this frame has; a second call for this frame. */
SUPPLE_API SuppleResult suppleRecordQueries(SuppleContext context, VkCommandBuffer commandBuffer, SuppleQueryPool pool,
                                            const SuppleQueryDesc* desc);

/** Copies the hits of the newest completed frame (suppleBeginFrame) that recorded queries of the pool with
 * SUPPLE_QUERY_READ_BACK. `*count` is what out has room for, and becomes the number of rays of that frame; out may be
 * null to ask for it. frame, which may be null, gets that frame. SUPPLE_NOT_READY: there is no such frame, and *count
 * is 0. SUPPLE_INCOMPLETE: out is full. Never waits. */
SUPPLE_API SuppleResult suppleReadHits(SuppleContext context, SuppleQueryPool pool, SuppleHit* out, uint32_t* count,
                                       uint64_t* frame);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_QUERIES_H */
