// Puts the patches of a frame into their buckets: levels after the budget, and the record evaluation works from
// (docs/lod.md, "The idea" and "The budget"). One invocation a patch and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/surface/tables.glsl"
#include "shaders/lod/runs.glsl"
#include "shaders/lod/levels.glsl"

// The view's buffer by elements (lod.glsl has it by words): a record is four stores. All that writes goes through one binding. If the
// buffer were bound twice, synchronization validation would see groups read what others write.
BUFFER(coherent, Lod, kLodBinding, std430, uvec4, lodElements)
#ifdef WIDE
uint lodWord(uint i) { return lodElements.at[i >> 2u][i & 3u]; }
#else
layout(set = 0, binding = kLodTexelBinding) uniform usamplerBuffer lodTexels;
uint lodWord(uint i) { return texelFetch(lodTexels, int(i >> 2u))[i & 3u]; }
#endif
// Takes `count` places behind those that the bucket with this element has given (LodBucket::cursor); the first of them.
uint takePlaces(uint element, uint count) { return atomicAdd(lodElements.at[element].z, count); }

// On GPUs a workgroup takes its places together, if there are not too many buckets to have a word each.
const uint kMaxTaken = 64u * kCapacityCount;
shared uint taken[kMaxTaken];

// a = (L - 1) / 2 and 1 / L, as bits.
uvec2 levelPair(float level) {
    precise float a = (level - 1.0) * 0.5, inverse = 1.0 / level;
    return floatBitsToUint(vec2(a, inverse));
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint bucketCount = header.runCount * kCapacityCount;
    bool together = kWide && bucketCount <= kMaxTaken;
    if (together) {
        for (uint i = lane; i < bucketCount; i += gl_WorkGroupSize.x) taken[i] = 0u;
        barrier();
    }
    uint item = itemOfLane(), patchIndex = elementOf(item), listed = entryOf(item);
    uint instance = slotOf(listed), priority = SUPPLE_INSTANCE_PRIORITY(listed);
    uint words = levelBase(instance), at = words + header.edgeCount + kLodPatchLevelWords * patchIndex;
    uint bin = levelWord(at);
    vec2 own = uintBitsToFloat(uvec2(levelWord(at + 1u), levelWord(at + 2u)));
    uvec4 edges = tableElement(header.levelPatches + 2u * patchIndex), more = tableElement(header.levelPatches + 2u * patchIndex + 1u);
    bool drawn = invocationIndex() < itemCount() && bin != kNoBin;
    uint capacity = 0u;
    if (drawn) capacity = min(lodWord(kLodCapacities + priority * kLodBinStride + min(bin, kLodBins - 1u)), kCapacityCount - 1u);

    uint local = more.y * kCapacityCount + capacity, run = push.window.firstRun;
    uint groups = firstOfGroup(lodWord(kLodRuns + kLodRunWords * run + 1u), run);
    uint firstBucket = SUPPLE_LOD_BUCKETS(push.runs) + 4u * bucketIndex(groups, run, 0u), bucket = firstBucket + 4u * local;
    uint place = 0u;
    if (together) {
        if (drawn) place = atomicAdd(taken[local], 1u);
        barrier();
        for (uint i = lane; i < bucketCount; i += gl_WorkGroupSize.x) {
            uint n = taken[i];
            if (n > 0u) taken[i] = takePlaces(firstBucket / 4u + i, n);
        }
        barrier();
        place += taken[local];
    } else if (drawn) {
        place = takePlaces(bucket / 4u, 1u);
    }
    if (!drawn || place >= lodWord(bucket + 4u) - lodWord(bucket)) return;

    uint form = runForm(lodWord(kLodRuns + kLodRunWords * (run + more.y))), sides = formSides(form);
    float scale = uintBitsToFloat(lodWord(kLodSolution + 4u + priority));
    precise float level[5];
    float largest = 1.0;
    for (uint k = 0u; k < 5u; ++k) {
        level[k] = 1.0;
        if (k < sides) {
            float before = push.levels != 0u ? own.x : uintBitsToFloat(levelWord(words + (k < 4u ? edges[k] : more.x)));
            precise float scaled = scale * before;
            level[k] = clamp(scaled, 1.0, 63.0);
            largest = max(largest, level[k]);
        }
    }
    own = clamp(own * scale, 1.0, 63.0);
    float most = max(largest, max(own.x, own.y));
    // Edges' in one place for all forms: division is not exact, and both sides of a border need the same quotient.
    uvec2 pairs[6], ofEdges[5];
    for (uint k = 0u; k < 5u; ++k) ofEdges[k] = levelPair(level[k]);
    if (form == kLodQuadForm) {
        // Three and more as soon as an edge has them: the first inner row keeps its distance from the border.
        float least = min(3.0, most);
        pairs[0] = levelPair(max(max(level[0], level[2]), max(own.x, least)));
        pairs[1] = levelPair(max(max(level[1], level[3]), max(own.y, least)));
        for (uint k = 0u; k < 4u; ++k) pairs[2u + k] = ofEdges[k];
    } else {
        pairs[0] = levelPair(most);
        for (uint k = 0u; k < 5u; ++k) pairs[1u + k] = ofEdges[k];
    }
    uint samples = formSamples(form, capacityOf(capacity));
    uint to = (SUPPLE_LOD_RECORDS(push.runs) + kLodRecordWords * (lodWord(bucket) + place)) / 4u;
#ifndef TASKS // an address knows no length; what the solver has found a place for fits
    if (to + kLodRecordWords / 4u > uint(lodElements.at.length())) return;
#endif
    lodElements.at[to] = uvec4(patchIndex, (push.window.firstSlot + instance) | (listed & kInstanceIsNew),
                               lodWord(bucket + 1u) + place * samples, capacity);
    for (uint k = 0u; k < 3u; ++k) lodElements.at[to + k + 1u] = uvec4(pairs[2u * k], pairs[2u * k + 1u]);
}
