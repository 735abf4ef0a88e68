// Isolation stage of the subdivision: the vertices of a global step, each a stencil over the vertices of the step before.
// One invocation per vertex and instance. Sums are over differences to the first entry: the weights sum to 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"

void main() {
    uint item = itemOfLane(), instance = instanceOf(item);
    uint row = elementOf(item);
    uvec4 record = tableElement(push.table + row);
    uint weightList = tableWord(4u * (push.table + push.count) + row);
    vec3 first = vertexAt(instance, record.x);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < record.z; i += 2u) { // two at a time: most lists have 3, 5, or 8
        uvec4 four = tableElement(record.y + i / 4u);
        vec4 weights = uintBitsToFloat(tableElement(weightList + i / 4u));
        bool later = (i & 2u) != 0u;
        uvec2 vertices = later ? four.zw : four.xy;
        vec2 w = later ? weights.zw : weights.xy;
        precise vec3 a = vertexAt(instance, vertices.x) - first, b = vertexAt(instance, vertices.y) - first;
        sum = sum + w.x * a;
        sum = sum + w.y * b;
    }
    precise vec3 p = first + sum;
    storePool(instance * push.poolStride + record.w, p);
}
