// Boxes of a tree's inner nodes, of those of their children: a workgroup an instance that has a tree in this turn, and a barrier a
// level.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/tree.glsl"

BUFFER(coherent, Nodes, kTreeBinding, std430, vec4, nodes)

void join(uint first, uint n) {
    uint a = 2u * (first + 2u * n), at = 2u * (first + n);
    vec3 lowA = nodes.at[a].xyz, highA = nodes.at[a + 1u].xyz, lowB = nodes.at[a + 2u].xyz, highB = nodes.at[a + 3u].xyz;
    vec3 apart = (lowB + highB) - (lowA + highA), size = abs(apart);
    uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    nodes.at[at] = vec4(min(lowA, lowB), float(axis | (apart[axis] < 0.0 ? kTreeTurned : 0u)));
    nodes.at[at + 1u] = vec4(max(highA, highB), 0.0);
}

void main() {
    uint place = workgroupIndex();
    if (place >= treesOfTurn()) return; // the whole workgroup
    uint first = firstNode(place);
    for (int level = findMSB(push.pieceCount); level >= 0; --level) {
        // Children are leaves, or of the level before.
        uint begin = 1u << level, end = min(2u * begin, push.pieceCount);
        for (uint n = begin + gl_LocalInvocationID.x; n < end; n += gl_WorkGroupSize.x) join(first, n);
        memoryBarrierBuffer();
        barrier();
    }
}
