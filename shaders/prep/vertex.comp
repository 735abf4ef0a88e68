// Vertex stage of p-rep: limit point, spoke tangents, face coefficients (equations (2) to (4), corrected as docs/prep.md).
// One invocation a cage vertex and instance. Interior vertices of valence 4 have
// their weights as constants.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/prep.h"

layout(constant_id = kKindConstant) const uint kFan = kManyFan;

#include "shaders/surface/ring.glsl"
vec3 ringDiagonal(uint word, uint cageBase, vec3 p0) {
    precise vec3 d = ringPoint(word, kRingFarCorner, cageBase) - p0;
    return d;
}
#include "shaders/surface/vertex.glsl"

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), index = elementOf(item);
    uint base = poolBase(instance), cageBase = instance * header.cageStride;
    if (kFan == kRegularFan) {
        regularFan(index, base, cageBase);
        return;
    }
    uint record = 4u * push.table + 2u * index;
    uint slot = tableWord(record), weights = tableWord(record + 1u), words = header.ring + slot;
    uint vertex = ringCorner(tableWord(words), kRingVertex);
    uint tangent = base + header.tangents + slot, face = base + header.faces + slot;
    uint header = tableElement(weights).x;
    bool boundary = (header & kBoundaryClass) != 0u;
    uint sectors = header & ~kBoundaryClass;
    vec3 normal = weightedFan(base + vertex, tangent, face, words, cageBase, meshPoint(cageBase + vertex), weights + 1u,
                              sectors, boundary, kFan == kFewFan);
    if (boundary) pool.at[face + sectors] = vec4(normal, 0.0); // a normal, no position: shared/prep.h
}
