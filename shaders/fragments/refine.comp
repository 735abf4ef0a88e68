// One step of the subdivision for all fragments, through the scratch buffer: the form for CPU devices, and for fragments that do
// not fit into workgroup memory. One invocation per cell or point, fragment and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS FragmentPush
#include "shaders/shared/subdivision.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/todays_pool.glsl"
#include "shaders/fragments/net.glsl"
#include "shaders/fragments/scratch.glsl"
#include "shaders/fragments/fragment.glsl"

void writePoint(uint target, vec3 p) {
    scratch.at[lane.instance * header.scratchStride + lane.write + target * lane.fragments + lane.fragment] = vec4(p, 0.0);
}

void refineCell(uint neighbours) {
    Sources targets = unpackSources(tableElement(lane.rows + lane.place));
    vec3 c = point(targets.s[7]);
    vec3 n[8] = pointsOf(unpackSources(tableElement(neighbours + targets.s[7])));
    if (targets.s[0] != kNoTarget) writePoint(targets.s[0], vertexPoint(c, n, 0.0));
    if (kLoop) {
        for (uint k = 0u; k < 6u; ++k) {
            if (targets.s[1u + k] != kNoTarget)
                writePoint(targets.s[1u + k],
                           edgePoint(c, n[k], n[(k + 1u) % 6u], vec3(0.0), n[(k + 5u) % 6u], vec3(0.0), 0.0));
        }
    } else {
        const uint kSlots[5] = uint[5](SUPPLE_SUBDIVISION_QUAD_SLOTS);
        for (uint i = 0u; i < 5u; ++i) {
            uint k = kSlots[i], left = (k + 1u) & 7u, right = (k + 7u) & 7u;
            if (targets.s[1u + i] == kNoTarget) continue;
            if ((k & 1u) != 0u) writePoint(targets.s[1u + i], facePoint(c, n[k], n[left], n[right]));
            else
                writePoint(targets.s[1u + i], edgePoint(c, n[k], n[left], n[(k + 2u) & 7u], n[right], n[(k + 6u) & 7u], 0.0));
        }
    }
}

void main() {
    findLane();
    uvec4 tables = tableElement(lane.record + 2u);
    if (kKind == kInBulk) {
        if (lane.idle) return;
        refineCell(tables.x);
        return;
    }
    uint row = tableWord(lane.list + lane.place);
    vec3 p = refinedPoint(tableElement(lane.rows + row), tables.x, tables.y, lane.fragments, lane.fragment, push.step);
    if (!lane.idle) writePoint(row, p);
}
