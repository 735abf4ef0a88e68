// Vertex stage of p-rep: limit point, spoke tangents, face coefficients (SMI 2008, eqs. (2)-(4), corrected as docs/prep.md).
// One invocation a cage vertex and instance. kRegular: interior vertices of valence 4, with the weights as constants.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_WRITE_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/surface/cage.glsl"
#include "shaders/shared/prep.h"

layout(constant_id = 3) const uint kRegular = 0u;

vec3 ringSpoke(uint words, uint k, uint cageBase) { return cageVertex(cageBase + tableWord(words + 2u * k)); }
vec3 ringDiagonal(uint words, uint k, uint cageBase, vec3 p0) {
    precise vec3 d = cageVertex(cageBase + tableWord(words + 2u * k + 1u)) - p0;
    return d;
}
#include "shaders/surface/vertex.glsl"

void main() {
    uint id = min(invocationIndex(), push.count * instanceCount() - 1u);
    uint entry = id / push.count, instance = instanceSlot(entry);
    uvec4 record = tableElement(push.table + (id - entry * push.count));
    uint base = instance * push.poolStride, cageBase = instance * push.cageStride;
    uint words = push.ring + 2u * record.y;
    uint limit = base + record.x, tangent = base + push.tangents + record.y, face = base + push.faces + record.y;
    vec3 p0 = cageVertex(cageBase + record.x);
    if (kRegular != 0u) {
        regularFan(limit, tangent, face, words, cageBase, p0);
        return;
    }
    uint header = tableElement(record.z).x;
    bool boundary = (header & kBoundaryClass) != 0u;
    uint sectors = header & ~kBoundaryClass;
    vec3 normal = weightedFan(limit, tangent, face, words, cageBase, p0, record.z + 1u, sectors, boundary);
    if (boundary) pool[face + sectors] = vec4(normal, 0.0); // a normal, no position: shared/prep.h
}
