// Isolation stage of the subdivision: the vertices of a global step, each a stencil over the vertices of the step before.
// One invocation per vertex and instance. Sums are over differences to the first entry: the weights sum to 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/subdivision.h"

layout(constant_id = kKindConstant) const uint kNumbers = kHalfWords;

uvec2 halvesOf(uint word) { return uvec2(halfOf(word, 0u), halfOf(word, 1u)); }
// Two numbers of a list that begins with the word `list`.
uvec2 pairAt(uint list, uint pair) {
    if (kNumbers == kHalfWords) return halvesOf(tableWord(list + pair));
    return uvec2(tableWord(list + 2u * pair), tableWord(list + 2u * pair + 1u));
}
// Where the vertices of a row begin, its number, and where its weights lie.
uvec3 rowAt(uint row) {
    if (kNumbers == kHalfWords) {
        uvec4 two = tableElement(push.table + row / 2u);
        return (row & 1u) == 0u ? uvec3(two.x, halvesOf(two.y)) : uvec3(two.z, halvesOf(two.w));
    }
    uint word = 4u * push.table + 3u * row;
    return uvec3(tableWord(word), tableWord(word + 1u), tableWord(word + 2u));
}

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), mesh = meshBase(instance) + push.from;
    uvec3 row = rowAt(elementOf(item));
    uvec2 begin = pairAt(row.x, 0u); // pairs, and the first vertex
    vec3 first = meshPoint(mesh + begin.y);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < begin.x; ++i) {
        uvec2 vertices = mesh + pairAt(row.x, i + 1u);
        vec4 weights = uintBitsToFloat(tableElement(push.table - row.z + i / 2u));
        vec2 w = (i & 1u) == 0u ? weights.xy : weights.zw;
        precise vec3 a = meshPoint(vertices.x) - first, b = meshPoint(vertices.y) - first;
        sum = sum + w.x * a;
        sum = sum + w.y * b;
    }
    precise vec3 p = first + sum;
    storePool(poolBase(instance) + push.to + row.y, p);
}
