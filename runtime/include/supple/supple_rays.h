/**
 * @file supple_rays.h
 * What a host builds acceleration structures from: where the triangles of a group's instances are, as addresses on the
 * device. supple.h includes this header; docs/ray_tracing.md shows how it is used.
 *
 * Supple writes vertices and indices. Structures, their memory, when they are built and when they are updated are the
 * host's. Vertices have the instances' transforms in them, so instances of a top-level structure have the identity.
 */
#ifndef SUPPLE_RAYS_H
#define SUPPLE_RAYS_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The triangles of one material and one part: a VkAccelerationStructureGeometryKHR. */
typedef struct SuppleRayRange {
    uint32_t firstIndex;    /**< in the indices; 4 * firstIndex is VkAccelerationStructureBuildRangeInfoKHR's
                               primitiveOffset */
    uint32_t triangleCount; /**< primitiveCount */
    uint32_t material;      /**< index among the file's materials, or SUPPLE_NO_MATERIAL */
    uint32_t part;          /**< of the asset: suppleGetPartInfo */
} SuppleRayRange;

/** Filled by suppleGetRayGeometry. Addresses and arrays are valid until the group is destroyed or made anew. Where
 * vertices are changes too when SuppleGroupInfo.surfaceVersion rises: while their memory is given back
 * (SuppleGroupDesc.keepUnseenFrames), the address is 0. */
typedef struct SuppleRayGeometry {
    uint32_t structSize;
    /** R32G32B32_SFLOAT: the position, with which every vertex begins */
    VkFormat format;
    /** Where slot 0 begins. The vertices of slot s begin s * instanceStride bytes behind it: give that address for
     * vertexData, and leave firstVertex 0. A frame that records the group writes those of its visible instances. Before
     * its first frame a slot holds nothing that could be built from. */
    VkDeviceAddress vertices;
    VkDeviceSize vertexStride;     /**< bytes: 12, 16 or 24 (SuppleVertexFormat) */
    VkDeviceSize instanceStride;   /**< bytes from slot to slot */
    VkDeviceAddress indices;       /**< uint32, of one whole instance: all instances share them */
    SuppleBufferRange indexBuffer; /**< the same indices, to bind and to copy */
    uint32_t maxVertex;            /**< the largest index */
    uint32_t triangleCount;        /**< of all ranges */
    uint32_t rangeCount;           /**< entries of ranges */
    /** One for each of SuppleGridOutput.drawRanges, in their order. So the geometryIndex of a hit is the number of a
     * draw range. With SUPPLE_TESSELLATION_GRIDS, primitiveIndex is a triangle of the patch firstPatch + primitiveIndex
     * / (indexCount / 3) of that range, and primitiveIndex % (indexCount / 3) says which: the draw range's own indices
     * have its corners. */
    const SuppleRayRange* ranges;
} SuppleRayGeometry;

/** Fills out, for one surface of a group with SUPPLE_GROUP_RAY_TRACING. May be called at any time. The first
 * suppleRecord or suppleRecordUploads of the group uploads the indices. suppleRecord writes the vertices: name
 * VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR with VK_ACCESS_2_SHADER_READ_BIT in its `after`, and the
 * stage in its `before`. Errors: a stale handle; no such surface; the group lacks that flag. */
SUPPLE_API SuppleResult suppleGetRayGeometry(SuppleContext context, SuppleGroup group, uint32_t surface,
                                             SuppleRayGeometry* out);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_RAYS_H */
