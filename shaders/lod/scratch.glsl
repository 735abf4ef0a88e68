// An instance's scratch at levels of detail (shared/lod.h). Needs tables.glsl.
BUFFER(, Scratch, kScratchBinding, std430, uint, scratchWords)
uint levelBase(uint instance) { return 4u * instance * header.scratchStride; }

#ifdef WIDE
uint levelWord(uint i) { return scratchWords.at[i]; }
#else
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;
uint levelWord(uint i) { return floatBitsToUint(texelFetch(scratchTexels, int(i >> 2u))[i & 3u]); }
#endif
