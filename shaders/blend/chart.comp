// Chart stage of the blending surface: the coefficients of a local geometry, a constant matrix times its ring (docs/blend.md).
// One invocation a chart and instance. Summed over differences to the vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/blend.h"

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), mesh = meshBase(instance);
    uvec4 record = tableElement(push.table + elementOf(item));
    vec3 vertex = meshPoint(mesh + record.x);
    uint points = tableElement(record.z).x;
    precise vec3 sum[9];
    for (uint row = 0u; row < 9u; ++row) sum[row] = vec3(0.0);
    for (uint i = 0u; i < points; ++i) {
        precise vec3 d = meshPoint(mesh + tableWord(record.y + i)) - vertex;
        uint at = record.z + 1u + 3u * i;
        vec4 a = uintBitsToFloat(tableElement(at)), b = uintBitsToFloat(tableElement(at + 1u));
        float w[9] = float[9](a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, uintBitsToFloat(tableElement(at + 2u).x));
        for (uint row = 0u; row < 9u; ++row) {
            precise vec3 next = sum[row] + w[row] * d;
            sum[row] = next;
        }
    }
    uint target = poolBase(instance) + record.w;
    precise vec3 origin = vertex + sum[0];
    storePool(target, origin);
    for (uint row = 1u; row < 9u; ++row) storePool(target + row, sum[row]);
}
