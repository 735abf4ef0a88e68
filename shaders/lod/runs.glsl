// Runs and buckets of a view (shared/lod.h): what their words say, for whoever has read them.
#include "shaders/lod/lines.h"
#include "shaders/shared/surface.h"

uint capacityOf(uint index) { return SUPPLE_LOD_CAPACITY(index); }
uint formSamples(uint form, uint capacity) { return formSides(form) * (capacity + 1u) * (capacity + 1u) / 4u; }
// Wide mapping: the records of a bucket that a workgroup of so many lanes takes. It has a lane for each of their lines, or, if one
// record has no more samples than there are lanes, for each of their samples.
uint recordsOfGroup(uint lanes, bool hasLines, uint form, uint capacity) {
    return hasLines ? clamp(lanes / linesOf(form, capacity), 1u, kMaxRecordsPerGroup)
                    : clamp(lanes / formSamples(form, capacity), 1u, kMaxPatchesPerGroup);
}
// The bucket of a run and capacity, where the group's runs begin at `first`.
uint bucketIndex(uint first, uint run, uint c) { return first * kLodBucketStride + (run - first) * kCapacityCount + c; }
// What the first and the second word of a run say.
uint runForm(uint word) { return word & 255u; }
bool runHasLines(uint word) { return (word & kRunHasLines) != 0u; }
uint firstOfGroup(uint word, uint run) { return min(word & kNoDispatch, run); }
