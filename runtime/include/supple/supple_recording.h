/**
 * @file supple_recording.h
 * Recording what a host does to a context, so that `supple replay` can do it again: to show a fault to somebody else,
 * or to compare two versions, drivers or devices. supple.h includes this header. docs/recording.md says more.
 */
#ifndef SUPPLE_RECORDING_H
#define SUPPLE_RECORDING_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Options of a recording. */
typedef enum SuppleRecordingFlags {
    /** Characters are named by hashes alone: replaying asks for their files. */
    SUPPLE_RECORDING_WITHOUT_ASSETS = 1,
    /** Every frame's joint palettes, deformed cages and surface vertices are hashed on the device. Replaying compares
     * the hashes. Costs a pass over these buffers (docs/recording.md): see surfaceInterval. */
    SUPPLE_RECORDING_HASHES = 2
} SuppleRecordingFlags;

/** What to record, and where to. */
typedef struct SuppleRecordingDesc {
    uint32_t structSize;
    uint32_t flags; /**< SuppleRecordingFlags */
    /** Appends bytes to the recording, and returns non-zero, or returns 0 if that is not possible: then the recording
     * ends with what it has, and SUPPLE_MESSAGE_RECORDING_ENDED says so. Supple calls it in suppleStartRecording,
     * suppleBeginFrame and suppleStopRecording, and when an asset is created or reloaded, on the thread that called. So
     * what a host has written holds all frames but the newest, if the program crashes. It must not call Supple. */
    int (*write)(const void* bytes, size_t byteCount, void* user);
    void* user; /**< handed to write */
    /** HASHES: surface vertices are hashed in frames whose number is a multiple of this; 0: in all. Palettes and cages
     * are hashed in every frame. */
    uint32_t surfaceInterval;
    uint32_t reserved; /**< 0 */
} SuppleRecordingDesc;

/** Records every call that changes the context, from now on: characters with all that they are made of, descriptions,
 * poses, cameras, frames. Calls that fail change nothing and are left out. So is what the host does itself: buffers
 * that it fills (PALETTE_BUFFER, CAGE_BUFFER), depth pyramids, memory callbacks and budgets.
 *
 * Call it before the context has assets, groups or views, or at any time if the context was created with
 * SUPPLE_CONTEXT_RECORDABLE: then the recording begins with calls that bring about what there is. Not beside other
 * calls of the context, and not in a frame that has recorded groups.
 *
 * A recording of what suppleSetMatrixPose sets takes 64 bytes per joint and call; one of what plays takes next to
 * nothing.
 *
 * Errors: null, unknown flags; the context has assets, groups or views and is not RECORDABLE; it is being recorded
 * already; the open frame has recorded groups; `write` has returned 0; memory. Then nothing is recorded. */
SUPPLE_API SuppleResult suppleStartRecording(SuppleContext context, const SuppleRecordingDesc* desc);
/** Writes what is left, and ends the recording. Hashes of frames that are not completed (suppleBeginFrame) are not in
 * it. suppleDestroyContext does the same. Errors: the context is not being recorded. */
SUPPLE_API SuppleResult suppleStopRecording(SuppleContext context);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_RECORDING_H */
