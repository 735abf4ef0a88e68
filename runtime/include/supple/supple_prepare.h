/**
 * @file supple_prepare.h
 * Characters that are read, and whose tables are built, before a context needs them: on any thread, without a device.
 * supple.h includes this header.
 */
#ifndef SUPPLE_PREPARE_H
#define SUPPLE_PREPARE_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A group that will be made of a character. */
typedef struct SupplePlannedGroup {
    /** As it will be given to suppleCreateGroup. asset, capacity, view and instancesOf do not matter here. vertexFormat
     * matters to suppleMakePipelines alone: there that of a group of a view must be the view's. */
    const SuppleGroupDesc* desc;
    uint32_t inView;    /**< 1: the group will belong to a view */
    uint32_t viewFlags; /**< SuppleViewFlags of that view; 0 without one */
} SupplePlannedGroup;

/** What to prepare. All pointers are needed during the call only. */
typedef struct SupplePrepareDesc {
    uint32_t structSize;
    /** The mapping of the context that will make the groups (suppleGetMapping): tables of the other mapping are of no
     * use there. AUTO is WIDE, the mapping of GPUs. */
    SuppleMapping mapping;
    const SuppleAssetDesc* asset;     /**< the file, which may be cooked, or the arrays; `prepared` must be null */
    const SupplePlannedGroup* groups; /**< groupCount of them; their order does not matter */
    uint32_t groupCount;
    SuppleLogFunction log; /**< optional: errors, and warnings about the file */
    void* logUser;
    /** How far packing may move a vertex from where a clip has it, as a part of the extent, 0..0.1: 1e-4 suits most
     * games (docs/playback.md). Clips then take a fifth to a ninth of the memory on the device. 0: they stay as they
     * are. Clips that are packed already stay, too. Packing takes a while: let cooked files keep it. */
    float clipError;
    /** How far a clip's coarse twin may be from the clip, in the same unit, 0..0.1: 1e-2 suits clips that are streamed
     * (SuppleAssetDesc.clipPoolBytes, docs/playback.md), others need no twin. 0: clips get none. Twins take 0.4 to 0.5
     * of what packed clips do, in addition. Errors: it is not 0 and not more than clipError. */
    float coarseClipError;
} SupplePrepareDesc;

/** Reads a character and builds what its groups will need: skin tables, the tables of each scheme, and the tables of
 * clips if a group is to play (SUPPLE_POSES_PLAYBACK). Needs no context and no device. Any number of threads may call
 * it at the same time, also while others use contexts.
 *
 * What comes out never changes. Give it to suppleCreateAsset (SuppleAssetDesc.prepared) of any number of contexts: then
 * that call, and suppleCreateGroup for the groups that were planned, only copy. A group that was not planned, or that
 * differs from the plan in what its tables depend on (scheme, flags, options, uvInterpolation, flags of the view; of
 * CATMULL_CLARK, LOOP, BLEND and FRAGMENTS the rate, but tables of the former two serve some lower ones;
 * of CATMULL_CLARK and LOOP the mapping), works as well: suppleCreateGroup builds what is missing, and says so
 * (SUPPLE_MESSAGE_NOT_PREPARED). Pipelines need the context: suppleMakePipelines.
 *
 * Errors: what suppleCreateAsset refuses of a file, and suppleCreateGroup of a description or a character. `*out` is
 * null then. */
SUPPLE_API SuppleResult supplePrepare(const SupplePrepareDesc* desc, SupplePrepared* out);
/** Makes the pipelines that groups of the character will need in this context, and those of their views, so that
 * suppleCreateGroup and suppleCreateView only find them. Any thread may call it at any time between suppleCreateContext
 * and suppleDestroyContext, beside all other calls of the context and beside itself. Frames are recorded meanwhile as
 * ever. If another thread needs a pipeline that is being made, it waits for that one. Pipelines stay until the context
 * is destroyed.
 *
 * groups: groupCount of them, as they were or might have been prepared; tables that were not are built and thrown away.
 * The rate of a group counts; suppleSetRate needs no other pipelines. SuppleContextDesc.runJobs, the allocator and the
 * log function are called on this thread, perhaps while they are called on others too, and pipelineCache must not be
 * VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED.
 *
 * Drivers may still do something at a pipeline's first dispatch: suppleRecordWarmUp.
 * Errors: null; what suppleCreateGroup refuses of a description or a character; memory, or the device is lost. What
 * could be made stays. */
SUPPLE_API SuppleResult suppleMakePipelines(SuppleContext context, SupplePrepared prepared,
                                            const SupplePlannedGroup* groups, uint32_t groupCount);
/** Turns what was prepared into the bytes of a cooked file: `supple cook` writes them to a disk. They go wherever bytes
 * of a glTF file go (SuppleAssetDesc.bytes), and nothing is parsed or built then: bytes are checked and copied. Every
 * little-endian machine can read them, and they can be kept in an archive of the host's. Only this version of the
 * format can be read: a game cooks its characters when it is built, from files that it keeps.
 *
 * What the file has are the character with its clips and images, and the tables of the groups that were planned. Tables
 * of CATMULL_CLARK and LOOP are for one mapping: a file for both is made by preparing twice, the second time from the
 * bytes of the first.
 *
 * madeBy: optional; the command that makes the file, which messages about a file of another version quote.
 * out: null, or room for *byteCount bytes. *byteCount becomes the size of the file. Reads what was prepared alone, so
 * any threads may call it at the same time. SUPPLE_ERROR_ARGUMENT: prepared or byteCount is null, or there is too
 * little room. */
SUPPLE_API SuppleResult suppleSavePrepared(SupplePrepared prepared, const char* madeBy, void* out, size_t* byteCount);
/** Null does nothing. Assets that were made of it keep what they need. */
SUPPLE_API void suppleDestroyPrepared(SupplePrepared prepared);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_PREPARE_H */
