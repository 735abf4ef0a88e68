// The subdivision in workgroup memory: a workgroup takes a fragment, refines it step by step between two regions, and writes
// limit points and frames of its sectors. One workgroup per fragment and instance.
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

layout(constant_id = kWorkgroupPointsConstant) const uint kLocalPoints = 341u; // of the last two steps together

// Components apart: neighbouring lanes read neighbouring words.
shared float localX[kLocalPoints], localY[kLocalPoints], localZ[kLocalPoints];
uint region; // of the step that is read

vec3 point(uint i) { return vec3(localX[region + i], localY[region + i], localZ[region + i]); }

#include "shaders/fragments/fragment.glsl"
#include "shaders/fragments/samples.glsl"

void writePoint(uint at, vec3 p) {
    localX[at] = p.x;
    localY[at] = p.y;
    localZ[at] = p.z;
}

void main() {
    // Workgroups past the last repeat it: all lanes must meet at the barriers.
    uint item = min(workgroupIndex(), itemCount() - 1u), entry = entryOf(item), instance = slotOf(entry);
    setPast(push.today != 0u && (entry & kInstanceIsNew) != 0u);
    uvec4 record = tableElement(push.table + elementOf(item));
    uint classHeader = record.x, fragment = record.y;
    uvec4 head = tableElement(classHeader), last = tableElement(classHeader + 2u);
    uint patches = tableElement(classHeader + 1u).x;
    uint fragments = head.x, levels = classHeader + kClassHeaderElements;

    // Even steps begin at 0, odd ones at the other end: so the last two fit into the memory whatever their sizes.
    uint count = tableElement(levels).z;
    for (uint i = gl_LocalInvocationID.x; i < count; i += gl_WorkGroupSize.x)
        writePoint(i, netPoint(instance * header.poolStride + tableWord(head.z + i * fragments + fragment), entry,
                               kVertexFormat == kVertexPosition));
    region = 0u;
    barrier();
    for (uint step = 1u; step <= push.step; ++step) {
        uvec4 level = tableElement(levels + step);
        uint target = region == 0u ? kLocalPoints - level.z : 0u;
        uint neighbours = tableElement(levels + step - 1u).y;
        for (uint i = gl_LocalInvocationID.x; i < level.z; i += gl_WorkGroupSize.x)
            writePoint(target + i,
                       refinedPoint(tableElement(level.x + i), neighbours, classHeader, fragments, fragment, step));
        barrier();
        region = target;
    }
    for (uint i = gl_LocalInvocationID.x; i < last.w; i += gl_WorkGroupSize.x) {
        uint at = last.z + 2u * i;
        uvec4 row = tableElement(at + 1u);
        vec3 position;
        Frame frame;
        limitSample(tableElement(at), row, classHeader, fragments, fragment, push.step, position, frame);
        uint patchIndex = tableWord(patches + (row.z & kSectorMask) * fragments + fragment);
        uint own = push.firstVertex + patchIndex * push.samples + row.w;
        if (patchIndex != kNoPatch)
            storeSurfaceVertex(instance * push.verticesPerInstance + own, own, position, frame);
    }
}
