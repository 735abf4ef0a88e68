// Levels before the budget, in an instance's scratch (shared/lod.h).
#define LOD_CAMERA push.camera
#include "shaders/lod/measure.glsl"

layout(set = 0, binding = kScratchBinding, std430) buffer Scratch { uint scratchWords[]; };
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;

uint levelBase(uint instance) { return 4u * instance * push.scratchStride; }

uint levelWord(uint i) {
    if (kWide) return scratchWords[i];
    return floatBitsToUint(texelFetch(scratchTexels, int(i >> 2u))[i & 3u]);
}

// The one level of an instance, where it has one.
float levelOfEntry(uint entry) { return uintBitsToFloat(instanceWord(push.window.firstInstance + entry + push.levels)); }
