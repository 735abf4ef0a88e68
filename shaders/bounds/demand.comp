// Demand pass: the vertices that instances of several rates need, by how far above its threshold each rate is, for the budget
// (shaders/lod/solve.comp). One lane an instance, behind the list pass.
//
// A bin counts while levels are scaled down by fewer bins. It is above that where the level is above the threshold by one bin and
// a sixteenth less than it, so that what is counted is not less than what is drawn. Each step is divided between two bins, so
// that the demand is continuous in levels.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS DemandPush
#include "shaders/bounds/cull.glsl"
#include "shaders/shared/lod.h"

BUFFER(readonly, Bounds, kBoundsBinding, std430, vec4, bounds)
BUFFER(, Words, kViewWordsBinding, std430, uint, words)

void main() {
    uint index = invocationIndex();
    if (index >= push.instanceCount) return;
    uint entry = hostEntry(push.firstEntry + index), slot = entry & kInstanceSlotMask;
    if (states.at[slot].y == 0u) return;
    atomicAdd(words.at[kLodRated], push.vertices[0]);
    uint first = kLodRatedMore + SUPPLE_INSTANCE_PRIORITY(entry) * kRatedBins;
    float octave = log2(max(bounds.at[2u * slot].w, 1e-30));
    for (uint r = 1u; r < push.rateCount; ++r) {
        float at = (octave - log2(float(push.firstRate << (r - 1u)))) * float(kBinsPerOctave) + 1.0625;
        if (!(at > 0.0)) break;
        at = min(at, float(kRatedBins) - 1.5);
        uint bin = uint(at), more = push.vertices[r] - push.vertices[r - 1u];
        uint next = min(uint((at - float(bin)) * float(more)), more);
        atomicAdd(words.at[first + bin], more - next);
        atomicAdd(words.at[first + bin + 1u], next);
    }
}
