// Vertex stage of exact Catmull-Clark patches: limit point, tangents and face coefficients of a plain vertex, as uniform bicubic
// B-splines have them (docs/catmull_clark.md). One invocation a run of faces between creases and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/chains.h"

layout(constant_id = kKindConstant) const uint kFan = kRegularFan;

#include "shaders/surface/ring.glsl"
vec3 ringDiagonal(uint word, uint meshBase, vec3 p0) {
    precise vec3 d = ringPoint(word, kRingFarCorner, meshBase) - p0;
    return d;
}
#include "shaders/surface/vertex.glsl"

// Points of level 1, by the smooth rules. The fan has loaded all that they are made of.
void storePoints(RegularFacets f, uint record, uint base) {
    uint at = base + tableWord(record), made = tableWord(record + 1u);
    precise vec3 edges = (f.e[0] + f.e[2]) + (f.e[1] + f.e[3]), diagonals = (f.d[0] + f.d[2]) + (f.d[1] + f.d[3]);
    precise vec3 vertex = f.p0 + (6.0 * edges + diagonals) * (1.0 / 64.0);
    if ((made & 1u) != 0u) storePool(at++, vertex);
    for (uint k = 0u; k < 4u; ++k) {
        uint before = (k + 3u) & 3u, behind = (k + 1u) & 3u;
        precise vec3 sides = (f.e[before] + f.e[behind]) + (f.d[before] + f.d[k]);
        precise vec3 edge = f.p0 + (6.0 * f.e[k] + sides) * (1.0 / 16.0);
        if ((made & 1u << (kFanEdges + k)) != 0u) storePool(at++, edge);
    }
    for (uint k = 0u; k < 4u; ++k) {
        precise vec3 face = f.p0 + ((f.e[k] + f.e[(k + 1u) & 3u]) + f.d[k]) * 0.25;
        if ((made & 1u << (kFanFaces + k)) != 0u) storePool(at++, face);
    }
}

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), index = elementOf(item);
    uint base = poolBase(instance);
    uint vertices = meshBase(instance) + header.meshVertices;
    if (kFan == kRegularFan) {
        regularFan(push.from + index, base, vertices);
        return;
    }
    if (kFan == kPointsFan) { // the first of all
        RegularFacets facets = regularFacets(index, vertices);
        storeRegular(facets, index, base);
        storePoints(facets, 4u * push.table + 2u * index, base);
        return;
    }
    uint record = 4u * push.table + 3u * index;
    uint slot = tableWord(record), weights = tableWord(record + 1u), limit = tableWord(record + 2u), words = header.ring + slot;
    vec3 p0 = meshPoint(vertices + ringCorner(tableWord(words), kRingVertex));
    weightedFan(base + limit, base + header.tangents + slot, base + header.faces + slot, words, vertices, p0, weights + 1u,
                tableElement(weights).x, true, true);
}
