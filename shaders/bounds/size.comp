// Size pass: the vertices that instances which are seen need at their coarsest, by rank. One lane an instance, between the
// passes that say what is seen and the list pass.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/bounds/cull.glsl"

layout(set = 0, binding = kSizeBinding, std430) buffer Sizes { uint sizes[]; };
layout(push_constant) uniform Push { SizePush push; };

void main() {
    uint index = invocationIndex();
    if (index >= push.instanceCount) return;
    uint rank = min(states[hostEntry(push.firstEntry + index) & kInstanceSlotMask].x, kSizeRanks);
    if (rank > 0u) atomicAdd(sizes[rank - 1u], push.vertices);
}
