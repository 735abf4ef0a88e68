// Limit points and normals of all fragments' samples, from the last level in the scratch buffer. One invocation a sample,
// fragment and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS KernelPush
#include "shaders/shared/kernel.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/kernel/scratch.glsl"
#include "shaders/kernel/fragment.glsl"
#include "shaders/kernel/samples.glsl"

void main() {
    findLane();
    uint at = lane.rows + 2u * lane.place;
    uvec4 around = tableElement(at), place = tableElement(at + 1u);
    vec3 position, normal;
    if (kKind == kPlainSamples)
        limitPoint(place.x, unpackSources(around), 0.0, false, position, normal);
    else
        limitSample(around, place, tableElement(lane.record + 2u).y, lane.fragments, lane.fragment, push.step, position,
                    normal);
    uint patchIndex = tableWord(lane.list + (place.z & ~kRightSide) * lane.fragments + lane.fragment);
    if (!lane.idle && patchIndex != kNoPatch)
        storeSurfaceVertex(lane.instance * push.verticesPerInstance + patchIndex * push.samples + place.w, position,
                           unitNormal(normal));
}
