// The buffer of a view (shared/lod.h), read. A pass that writes it defines LOD_WRITE before the include; what it has written
// itself it reads from `lodWords`.
#include "shaders/lod/runs.glsl"

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

// Patches of one draw instance (surface/lod/grid.h).
uint patchesPerDraw(uint samples) { return samples < 64u ? 64u / samples : 1u; }
