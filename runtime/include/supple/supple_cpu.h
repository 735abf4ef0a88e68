/**
 * @file supple_cpu.h
 * The same surfaces on the CPU: for dedicated servers, build servers and physics cooking. It needs no context, no
 * device and no Vulkan loader. supple.h does not include this header; a library that was built with SUPPLE_WITH_CPU=OFF
 * lacks its functions. docs/cpu.md shows how it is used.
 *
 * The order is that of the device: what no pose changes is made once (SuppleCpuGroup), the coefficients of a deformed
 * cage when it has been posed (SuppleCpuPose, suppleCpuBuildPose), then any number of points or whole grids are
 * evaluated. Positions equal those of the device within 1e-6 of the character's extent.
 *
 * Threads: any thread may call any of these functions at any time, with two exceptions. A pose that is built must not
 * be used by another thread meanwhile, and what is destroyed must not be in use. Functions that take jobs call them on
 * the calling thread, and the host's threads run the jobs; results have the same bits however many threads there are.
 *
 * Jobs take up to 40 KiB of stack each (x86-64).
 *
 * Errors go to the log function of the group's description, on the calling thread. Null handles and null pointers give
 * SUPPLE_ERROR_ARGUMENT. Handles are pointers: do not use one once it is destroyed.
 */
#ifndef SUPPLE_CPU_H
#define SUPPLE_CPU_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The surfaces of a group (SuppleGroupDesc), one for each scheme that its parts have. Nothing in it changes. */
typedef struct SuppleCpuGroup_T* SuppleCpuGroup;
/** The coefficients of one deformed cage. It keeps what it needs of its group. */
typedef struct SuppleCpuPose_T* SuppleCpuPose;

/** The host's threads, as in SuppleContextDesc. */
typedef struct SuppleCpuJobs {
    SuppleRunJobsFunction run; /**< null: all on the calling thread */
    void* user;                /**< handed to run */
} SuppleCpuJobs;

/** What to evaluate. All pointers but log are needed during the call only. */
typedef struct SuppleCpuGroupDesc {
    uint32_t structSize;
    uint32_t reserved;       /**< 0 */
    SupplePrepared prepared; /**< the character: glTF, OBJ, arrays or a cooked file (supplePrepare) */
    /** Schemes and their options. flags, capacity, asset, view and what else is about instances and vertices does not
     * matter here. All schemes but CAGE have evaluators; FRAGMENTS have none where creases are semi-sharp or end
     * inside, as what they draw there hangs on the rate. If the group was planned when the character was prepared,
     * nothing is built twice. */
    const SuppleGroupDesc* group;
    /** Optional; called until the group and its poses are destroyed. It is called on the threads that call these
     * functions, so on several at the same time if they are called on several. */
    SuppleLogFunction log;
    void* logUser; /**< handed to log */
} SuppleCpuGroupDesc;

/** Filled by suppleCpuGetGroupInfo. */
typedef struct SuppleCpuGroupInfo {
    uint32_t structSize;
    uint32_t cageVertexCount; /**< of the whole character, as SuppleAssetInfo has it */
    uint32_t faceCount;       /**< of the cage; points name them */
    uint32_t surfaceCount;    /**< one for each scheme */
} SuppleCpuGroupInfo;

/** A whole grid of one surface, filled by suppleCpuGetGridInfo. */
typedef struct SuppleCpuGridInfo {
    uint32_t structSize;
    SuppleScheme scheme;  /**< never AUTO */
    uint32_t patchCount;  /**< of the surface, as suppleCpuGetPatches lists them */
    uint32_t vertexCount; /**< of the grid */
    uint32_t indexCount;  /**< of its triangles: three each */
} SuppleCpuGridInfo;

/** Makes the surfaces of a group. What follows from the character alone is computed here, so do it while loading.
 * Errors: what suppleCreateGroup refuses of a description or a character; a scheme without an evaluator; memory. `*out`
 * is null then. */
SUPPLE_API SuppleResult suppleCpuCreateGroup(const SuppleCpuGroupDesc* desc, SuppleCpuGroup* out);
/** Null does nothing. Its poses stay valid. */
SUPPLE_API void suppleCpuDestroyGroup(SuppleCpuGroup group);
/** How large the arrays of this group are. */
SUPPLE_API SuppleResult suppleCpuGetGroupInfo(SuppleCpuGroup group, SuppleCpuGroupInfo* out);

/** Memory for the coefficients of one deformed cage. It must be built before it is evaluated. */
SUPPLE_API SuppleResult suppleCpuCreatePose(SuppleCpuGroup group, SuppleCpuPose* out);
/** Null does nothing. */
SUPPLE_API void suppleCpuDestroyPose(SuppleCpuPose pose);
/** Makes the coefficients of a deformed cage, in place of those before.
 *
 * cage: x, y, z of vertexCount vertices, each `stride` bytes (12 and more, a multiple of 4) behind the one before; all
 * of the character's, in its order, morphed and skinned, as the pass *deform* makes them. jobs: optional. Errors:
 * another number of vertices; a coordinate that is not finite or beyond SUPPLE_MAX_COORDINATE; a job that was not run;
 * memory. But for the first two the pose is not built then. */
SUPPLE_API SuppleResult suppleCpuBuildPose(SuppleCpuPose pose, const float* cage, size_t stride, uint32_t vertexCount,
                                           const SuppleCpuJobs* jobs);

/** Evaluates points, in any order and of any faces.
 *
 * Where derivatives hang on the direction that the point is come to from (an extraordinary corner, the apex of a polar
 * fan), those of a place beside it are given: 2^-30 of a face away with CATMULL_CLARK, LOOP and FRAGMENTS, 2^-10 with
 * PM and BLEND. So it is 2^-10 of a face away where du and dv are parallel, at the corner of a face alone between the
 * two halves of a crease; with PREP du and dv are given as they are there. Second derivatives have no limit at an
 * extraordinary corner: 2^-30 of a face away they may be large. The position is always that of the point.
 *
 * points, out: `count` of them. jobs: optional.
 * Errors: a pose that is not built; a face that does not exist or is a hole; a side that does not exist; numbers that
 * are not finite or not within the face. What is in out is undefined then. The log names the first such point. */
SUPPLE_API SuppleResult suppleCpuEvaluatePoints(SuppleCpuPose pose, const SuppleSurfacePoint* points, uint32_t count,
                                                SuppleSurfaceJet* out, const SuppleCpuJobs* jobs);

/** Fills out and count: the patches of a surface, as suppleGetPatches lists those of the device. Faces and corners are
 * numbers of the whole character's cage. *count: the room in out, then how many patches there are. out: null to learn
 * that alone.
 *
 * Returns SUPPLE_INCOMPLETE if not all of them fit. Errors: no such surface. */
SUPPLE_API SuppleResult suppleCpuGetPatches(SuppleCpuGroup group, uint32_t surface, SupplePatchInfo* out,
                                            uint32_t* count);

/** How large a grid is. rate: segments along a patch edge, 1..SUPPLE_MAX_RATE, as in SuppleGridOutput; where a scheme
 * subdivides the cage first, that is half of SuppleGroupDesc.rate or a quarter. */
SUPPLE_API SuppleResult suppleCpuGetGridInfo(SuppleCpuGroup group, uint32_t surface, uint32_t rate,
                                             SuppleCpuGridInfo* out);
/** The triangles of a grid, counter-clockwise seen from outside, as numbers of its vertices. The same for all poses.
 * Vertices on the borders of patches come once for each patch, at positions that differ by rounding: up to 5e-7 of the
 * character's extent. Who needs a closed mesh welds them by the corners of patches (suppleCpuGetPatches), or by
 * distance. out, count: as many as SuppleCpuGridInfo.indexCount. Another count is an error. */
SUPPLE_API SuppleResult suppleCpuGetGridIndices(SuppleCpuGroup group, uint32_t surface, uint32_t rate, uint32_t* out,
                                                uint32_t count);
/** Evaluates all patches of a surface at a rate, in the order of the device: patch after patch, as suppleCpuGetPatches
 * lists them, each with the samples of its domain (SuppleDomain). POLYGONS: the flat triangles and their own normals,
 * in the domain of triangles at any rate; the device shares their vertices at rate 1, and has the normals of the file.
 *
 * positions: x, y, z of vertexCount vertices. normals: optional; of unit length, or zero where the surface has none.
 * vertexCount: SuppleCpuGridInfo.vertexCount. jobs: optional.
 * Errors: a pose that is not built; no such surface; a rate that is out of range; another number of vertices; a job
 * that was not run; memory. */
SUPPLE_API SuppleResult suppleCpuEvaluateGrid(SuppleCpuPose pose, uint32_t surface, uint32_t rate, float* positions,
                                              float* normals, uint32_t vertexCount, const SuppleCpuJobs* jobs);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_CPU_H */
