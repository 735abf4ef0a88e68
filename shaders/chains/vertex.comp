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

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), index = elementOf(item);
    uint base = poolBase(instance);
    uint vertices = meshBase(instance) + header.meshVertices;
    if (kFan == kRegularFan) {
        regularFan(index, base, vertices);
        return;
    }
    uint record = 4u * push.table + 3u * index;
    uint slot = tableWord(record), weights = tableWord(record + 1u), limit = tableWord(record + 2u), words = header.ring + slot;
    vec3 p0 = meshPoint(vertices + ringCorner(tableWord(words), kRingVertex));
    weightedFan(base + limit, base + header.tangents + slot, base + header.faces + slot, words, vertices, p0, weights + 1u,
                tableElement(weights).x, true, true);
}
