// Size pass: what instances that are seen need at their coarsest, vertices and coefficients, by rank. One lane an instance, between the
// passes that say what is seen and the list pass.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS SizePush
#include "shaders/bounds/cull.glsl"

BUFFER(, Sizes, kSizeBinding, std430, uint, sizes)

void main() {
    uint index = invocationIndex();
    if (index >= push.instanceCount) return;
    uint rank = min(states.at[hostEntry(push.firstEntry + index) & kInstanceSlotMask].x, kSizeRanks);
    if (rank == 0u) return;
    atomicAdd(sizes.at[rank - 1u], push.vertices);
    if (push.poolUnits > 0u) atomicAdd(sizes.at[kSizeRanks + rank - 1u], push.poolUnits);
}
