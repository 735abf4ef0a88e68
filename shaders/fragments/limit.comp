// Limit points and frames of all fragments' samples, from the last step in the scratch buffer. One invocation per strip or
// sample, fragment and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS FragmentPush
#include "shaders/shared/subdivision.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/todays_pool.glsl"
#include "shaders/fragments/net.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/fragments/scratch.glsl"
#include "shaders/fragments/fragment.glsl"
#include "shaders/fragments/samples.glsl"

void writeSample(uint patchIndex, uint sampleIndex, vec3 position, Frame frame) {
    uint own = push.firstVertex + patchIndex * push.samples + sampleIndex;
    storeSurfaceVertex(lane.instance * push.verticesPerInstance + own, own, position, frame);
}

// Along the strip, with the three columns round the sample at hand.
void limitStrip() {
    uvec4 strip = tableElement(lane.rows + lane.place);
    uint patchIndex = tableWord(lane.list + strip.z * lane.fragments + lane.fragment);
    bool drawn = !lane.idle && patchIndex != kNoPatch;
    vec3 before[3], here[3], behind[3];
    uvec4 place = uvec4(0u), next = uvec4(0u);
    for (uint i = 0u; i < strip.y; ++i) {
        before = here;
        here = behind;
        place = next;
        next = tableElement(strip.x + i);
        behind = vec3[3](point(next.x & 0xFFFFu), point(next.x >> 16), point(next.y & 0xFFFFu));
        vec3 n[8];
        if (kLoop) {
            vec3 round[6] = vec3[6](behind[1], here[2], before[2], before[1], here[0], behind[0]);
            for (uint k = 0u; k < 6u; ++k)
                n[k] = place.z == 0u ? round[k] : place.z == 1u ? round[(k + 1u) % 6u] : round[(k + 2u) % 6u];
        } else {
            n = vec3[8](behind[1], behind[2], here[2], before[2], before[1], before[0], here[0], behind[0]);
        }
        vec3 position;
        Frame frame;
        limitPoint(here[1], n, 0.0, false, kLoop ? 6u - place.z : 0u, position, frame);
        if (drawn && i >= 2u && place.z != kNoSample) writeSample(patchIndex, place.y >> 16, position, frame);
    }
}

void main() {
    findLane();
    setPast(push.today != 0u && (lane.listed & kInstanceIsNew) != 0u);
    if (kKind == kInBulk) {
        limitStrip();
        return;
    }
    uint at = lane.rows + 2u * lane.place;
    uvec4 around = tableElement(at), place = tableElement(at + 1u);
    vec3 position;
    Frame frame;
    limitSample(around, place, tableElement(lane.record + 2u).y, lane.fragments, lane.fragment, push.step, position, frame);
    uint patchIndex = tableWord(lane.list + (place.z & kSectorMask) * lane.fragments + lane.fragment);
    if (!lane.idle && patchIndex != kNoPatch) writeSample(patchIndex, place.w, position, frame);
}
