// An instance's scratch at levels of detail (shared/lod.h). Needs tables.glsl.
layout(set = 0, binding = kScratchBinding, std430) buffer Scratch { uint scratchWords[]; };
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;

uint levelBase(uint instance) { return 4u * instance * header.scratchStride; }

uint levelWord(uint i) {
    if (kWide) return scratchWords[i];
    return floatBitsToUint(texelFetch(scratchTexels, int(i >> 2u))[i & 3u]);
}
