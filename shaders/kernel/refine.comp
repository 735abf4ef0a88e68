// One step of the subdivision kernel for all fragments, level by level through the scratch buffer: the form for CPU
// devices, and for fragments that do not fit into shared memory. One invocation a point, fragment and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS KernelPush
#include "shaders/shared/kernel.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/kernel/scratch.glsl"
#include "shaders/kernel/fragment.glsl"

void main() {
    findLane();
    vec3 p = refinedPoint(tableElement(lane.rows + lane.row), lane.neighbours, lane.header, lane.fragments, lane.fragment,
                          push.step);
    if (!lane.idle)
        scratch[lane.instance * push.scratchStride + lane.write + lane.row * lane.fragments + lane.fragment] = vec4(p, 0.0);
}
