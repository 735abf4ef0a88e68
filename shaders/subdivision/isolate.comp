// Isolation stage of the subdivision: the vertices of a global step, each a stencil over the vertices of the step before.
// One invocation per vertex and instance. Sums are over differences to the first entry: the weights sum to 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"

void main() {
    uint item = itemOfLane(), instance = instanceOf(item);
    uvec4 record = tableElement(push.table + elementOf(item));
    vec3 first = vertexAt(instance, record.x);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < record.z; i += 2u) {
        uvec4 entries = tableElement(record.y + i / 2u);
        precise vec3 a = vertexAt(instance, entries.x) - first, b = vertexAt(instance, entries.z) - first;
        sum = sum + uintBitsToFloat(entries.y) * a;
        sum = sum + uintBitsToFloat(entries.w) * b;
    }
    precise vec3 p = first + sum;
    storePool(instance * push.poolStride + record.w, p);
}
