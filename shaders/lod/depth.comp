// How far the chains of exact patches go in each instance of a window: as far as its finest patch has samples. Instances are listed by
// depth, for what makes it (chains/chain.comp). One workgroup, of which every lane takes a run of entries, so that lists are the same
// every time. Behind the solver.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_WRITE_ONLY
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/shared/chains.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/lod/lod.glsl"
#include "shaders/lod/levels.glsl"

const uint kMostGroups = 65535u; // in x: every device takes so many

shared uvec4 countsOf[kMaxLanes];

// A segment is 1 / level long, or more; but one that grows from nothing lies in the cone of the last cell (chains/chain_level.glsl).
uint depthOf(uint i, uint entry) {
    uint instance = slotOf(entry);
    float level = push.levels != 0u ? levelOfEntry(i) : uintBitsToFloat(levelWord(levelBase(instance) + header.depths));
    level = clamp(level * uintBitsToFloat(lodWord(kLodSolution + 4u + SUPPLE_INSTANCE_PRIORITY(entry))), 1.0, 63.0);
    // A level above 2^(n - 1), up to 2^n, gives n.
    return clamp((floatBitsToUint(level) - 1u >> 23u) - 126u, kFirstDepth - 1u, kFirstDepth + kDepths - 1u);
}
uvec4 depthsOf(uint depth) {
    return uvec4(greaterThanEqual(uvec4(depth), kFirstDepth + uvec4(0u, 1u, 2u, 3u)));
}

void storeDispatch(uint at, uint lanes) {
    uint groups = (lanes + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x, rows = max((groups + kMostGroups - 1u) / kMostGroups, 1u);
    scratchWords.at[at] = (groups + rows - 1u) / rows;
    scratchWords.at[at + 1u] = rows;
    scratchWords.at[at + 2u] = 1u;
}

void main() {
    if (isFurtherWorkgroup()) return;
    uint lane = gl_LocalInvocationID.x, entries = instanceCount(), each = (entries + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * each, entries), end = min(begin + each, entries);
    uvec4 own = uvec4(0u);
    for (uint i = begin; i < end; ++i) own += depthsOf(depthOf(i, instanceEntry(i)));
    countsOf[lane] = own;
    barrier();
    uvec4 places = uvec4(0u), counts = uvec4(0u);
    [[dont_unroll]] for (uint l = 0u; l < gl_WorkGroupSize.x; ++l) {
        uvec4 one = countsOf[l];
        places += l < lane ? one : uvec4(0u);
        counts += one;
    }
    for (uint i = begin; i < end; ++i) {
        uint entry = instanceEntry(i), instance = slotOf(entry), depth = depthOf(i, entry);
        pool.at[poolBase(instance) + header.depth] = vec4(float(depth), 0.0, 0.0, 0.0);
        uvec4 listed = depthsOf(depth);
        [[dont_unroll]] for (uint d = 0u; d < kDepths; ++d) {
            if (listed[d] != 0u) scratchWords.at[levelBase(places[d]) + header.depths + kDepthEntries + d] = entry;
        }
        places += listed;
    }
    for (uint d = lane; d < kDepths; d += gl_WorkGroupSize.x) {
        scratchWords.at[header.depths + kDepthCounts + d] = counts[d];
        storeDispatch(header.depths + kDepthDispatches + 3u * d, tableElement(header.depthLanes)[d] * counts[d]);
    }
}
