// Runs and buckets of a view (shared/lod.h): what their words say, for whoever has read them.
#include "shaders/shared/lod.h"

uint capacityOf(uint index) { return SUPPLE_LOD_CAPACITY(index); }
uint formSides(uint form) { return form == kLodTriangleForm ? 3u : form == kLodPentagonForm ? 5u : 4u; }
uint formSamples(uint form, uint capacity) { return formSides(form) * (capacity + 1u) * (capacity + 1u) / 4u; }
// The bucket of a run and capacity, where the group's runs begin at `first`.
uint bucketIndex(uint first, uint run, uint c) { return first * kLodBucketStride + (run - first) * kCapacityCount + c; }
// What the first and the second word of a run say.
uint runForm(uint word) { return word & 255u; }
uint firstOfGroup(uint word, uint run) { return min(word & kNoDispatch, run); }
