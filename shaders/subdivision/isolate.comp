// Isolation stage of the subdivision: the vertices of a global step, each a stencil over the vertices of the step before.
// One invocation per vertex and instance, in blocks of vertices with stencils of the same length. Sums are over differences to the
// first entry: the weights sum to 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/subdivision.h"

layout(constant_id = kKindConstant) const uint kNumbers = kHalfWords;

// Pair of numbers i of the row that begins with the word `row`.
uvec2 pairAt(uint row, uint i) {
    if (kNumbers == kHalfWords) {
        uint word = tableWord(row + i);
        return uvec2(halfOf(word, 0u), halfOf(word, 1u));
    }
    return uvec2(tableWord(row + 2u * i), tableWord(row + 2u * i + 1u));
}

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), mesh = meshBase(instance) + push.from, lane = elementOf(item);
    uvec4 block = tableElement(push.table + lane / kBlockLanes);
    // Idle lanes repeat the last row.
    uint row = block.x + block.y * min(lane % kBlockLanes, block.z - 1u);
    uvec2 head = pairAt(row, 0u), vertices = mesh + pairAt(row, 1u);
    uint weights = push.table - head.y;
    vec4 w = uintBitsToFloat(tableElement(weights));
    vec3 first = meshPoint(vertices.x);
    precise vec3 second = meshPoint(vertices.y) - first, sum = w.y * second;
    for (uint i = 1u; i < block.w; ++i) {
        vertices = mesh + pairAt(row, i + 1u);
        if ((i & 1u) == 0u) w = uintBitsToFloat(tableElement(weights + i / 2u));
        vec2 pair = (i & 1u) == 0u ? w.xy : w.zw;
        precise vec3 a = meshPoint(vertices.x) - first, b = meshPoint(vertices.y) - first;
        sum = sum + pair.x * a;
        sum = sum + pair.y * b;
    }
    precise vec3 p = first + sum;
    storePool(poolBase(instance) + push.to + head.x, p);
}
