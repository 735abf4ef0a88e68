/**
 * @file supple_direct.h
 * Evaluation while drawing: the host's vertex or mesh shader evaluates patches from their coefficients, and no surface
 * vertices are stored. supple.h includes this header; docs/direct.md says when it pays and shows how it is used. The
 * shader includes supple_patch.glsl, whose positions have the very bits of stored vertices.
 */
#ifndef SUPPLE_DIRECT_H
#define SUPPLE_DIRECT_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What supple_patch.glsl must know of a draw range. Its struct of the same name has the same words: hand them over as
 * push constants, or in a buffer (uints without padding). All patches of a range have one class. */
typedef struct SupplePatchRange {
    uint32_t patchClass;              /**< SupplePatchClass: REGULAR, PERTURBED, POLAR, P3, P4 or P5 */
    uint32_t firstRecord;             /**< in SuppleDirectOutput.tables */
    uint32_t recordElements;          /**< elements of a patch there */
    uint32_t tangents;                /**< among the coefficients of an instance: the first tangent */
    uint32_t faces;                   /**< the first face coefficient */
    uint32_t coefficientsPerInstance; /**< from slot to slot */
    uint32_t rate;                    /**< segments along a patch edge */
    uint32_t firstPair;               /**< in SuppleDirectOutput.tables: the parameters of samples at this rate */
    uint32_t patchCount;              /**< as in SuppleDrawRange */
    uint32_t firstVertex;             /**< as in SuppleDrawRange: of what attributes have an entry for */
    uint32_t samplesPerPatch;         /**< as in SuppleDrawRange */
    uint32_t firstSlot; /**< 0. With SUPPLE_GROUP_WINDOWS the host writes the first slot of the window that it draws */
} SupplePatchRange;

/** What the patches of a surface are evaluated from. All of it, arrays too, is valid until the group is destroyed or
 * made anew, or its rate is set. While its memory is given back (SuppleGroupDesc.keepUnseenFrames), the buffer of
 * coefficients is null. */
typedef struct SuppleDirectOutput {
    uint32_t structSize;
    /** The layout of tables and coefficients. It must be SUPPLE_PATCH_LAYOUT of the supple_patch_layout.h that the
     * host's shaders were compiled with. It rises when a record, or the order of coefficients, changes. Then the
     * shaders must be compiled anew with this version's includes. */
    uint32_t layout;
    uint32_t rangeCount;            /**< SuppleGridOutput.drawRangeCount */
    const SupplePatchRange* ranges; /**< one for each of SuppleGridOutput.drawRanges, in their order */
    SuppleBufferRange tables;       /**< uint4 per element. Static: the group's first frames upload it */
    /** float4 (x, y, z, -) per coefficient: slot * coefficientsPerInstance + index. suppleRecord writes those of
     * visible instances. With SUPPLE_GROUP_WINDOWS they can be bound for one window, as vertices are. */
    SuppleBufferRange coefficients;
} SuppleDirectOutput;

/** Fills out. May be called at any time. The draws are those of SuppleGridOutput. Errors: a stale handle; no such
 * surface; SuppleSurfaceInfo.tessellation is not SUPPLE_TESSELLATION_DIRECT. */
SUPPLE_API SuppleResult suppleGetDirectOutput(SuppleContext context, SuppleGroup group, uint32_t surface,
                                              SuppleDirectOutput* out);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_DIRECT_H */
