// The buffer of a view (shared/lod.h), read. A pass that writes it defines LOD_WRITE before the include; what it has written
// itself it reads from `lodWords`.
#include "shaders/shared/lod.h"

#ifdef LOD_WRITE
BUFFER(coherent, Lod, kLodBinding, std430, uint, lodWords)
#else
BUFFER(readonly, Lod, kLodBinding, std430, uint, lodWords)
#endif
BUFFER(readonly, LodElements, kLodBinding, std430, uvec4, lodElements)

#ifdef WIDE
uvec4 lodElement(uint i) { return lodElements.at[i]; }
uint lodWord(uint i) { return lodWords.at[i]; }
#else
layout(set = 0, binding = kLodTexelBinding) uniform usamplerBuffer lodTexels;
uvec4 lodElement(uint i) { return texelFetch(lodTexels, int(i)); }
uint lodWord(uint i) { return texelFetch(lodTexels, int(i >> 2u))[i & 3u]; }
#endif

uint capacityOf(uint index) { return SUPPLE_LOD_CAPACITY(index); }
uint formSides(uint form) { return form == kLodTriangleForm ? 3u : form == kLodPentagonForm ? 5u : 4u; }
uint formSamples(uint form, uint capacity) { return formSides(form) * (capacity + 1u) * (capacity + 1u) / 4u; }
// The bucket of a run and capacity, where the group's runs begin at `first`.
uint bucketIndex(uint first, uint run, uint c) { return first * kLodBucketStride + (run - first) * kCapacityCount + c; }
// What the first and the second word of a run say.
uint runForm(uint word) { return word & 255u; }
uint firstOfGroup(uint word, uint run) { return min(word & kNoDispatch, run); }
// Patches of one draw instance (surface/lod/grid.h).
uint patchesPerDraw(uint samples) { return samples < 64u ? 64u / samples : 1u; }
