// One step of the subdivision kernel for all fragments, level by level through the scratch buffer: the form for CPU
// devices, and for fragments that do not fit into shared memory. One invocation a
// point, fragment and instance.
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
    uint row = tableWord(lane.list + lane.place);
    uvec4 packedRow = tableElement(lane.rows + row);
    vec3 p;
    if (kKind == kPlainFaceRows) {
        p = facePoint(unpackSources(packedRow));
    } else if (kKind == kPlainEdgeRows) {
        p = edgePoint(unpackSources(packedRow), 0.0);
    } else {
        uvec4 tables = tableElement(lane.record + 2u);
        if (kKind == kPlainVertexRows) {
            Sources sources = unpackSources(packedRow), around = sources;
            if (!kLoop) around = unpackSources(tableElement(tables.x + sources.s[0]));
            p = vertexPoint(sources, around, 0.0);
        } else {
            p = refinedPoint(packedRow, tables.x, tables.y, lane.fragments, lane.fragment, push.step);
        }
    }
    if (!lane.idle)
        scratch[lane.instance * push.scratchStride + lane.write + row * lane.fragments + lane.fragment] = vec4(p, 0.0);
}
