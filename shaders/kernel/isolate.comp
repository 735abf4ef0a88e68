// Isolation stage of the subdivision kernel: the vertices of the isolated level, all global steps in one stencil each.
// One invocation a vertex and instance. Summed over differences to the first entry: the weights sum to 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_WRITE_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/surface/cage.glsl"

void main() {
    uint id = min(invocationIndex(), push.count * instanceCount() - 1u);
    uint entry = id / push.count, instance = instanceSlot(entry);
    uvec4 record = tableElement(push.table + (id - entry * push.count));
    uint cageBase = instance * push.cageStride;
    vec3 first = cageVertex(cageBase + record.x);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < record.z; i += 2u) {
        uvec4 entries = tableElement(record.y + i / 2u);
        precise vec3 a = cageVertex(cageBase + entries.x) - first, b = cageVertex(cageBase + entries.z) - first;
        sum = sum + uintBitsToFloat(entries.y) * a;
        sum = sum + uintBitsToFloat(entries.w) * b;
    }
    precise vec3 p = first + sum;
    storePool(instance * push.poolStride + record.w, p);
}
