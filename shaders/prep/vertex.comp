// Vertex stage of p-rep: limit point, spoke tangents, face coefficients (equations (2) to (4), corrected as docs/prep.md). With
// FAN_RECORDS it stores what these are made of (shared/prep.h). One invocation a cage vertex and instance. Interior vertices of
// valence 4 have their weights as constants.
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

#ifdef FAN_RECORDS
void storeRecord(uint base, uint vertex, vec3 p0, Fan fan) {
    uint at = base + kFanRecordElements * vertex;
    pool.at[at] = vec4(p0, fan.x.x);
    pool.at[at + 1u] = vec4(fan.x.yz, fan.e1.xy);
    pool.at[at + 2u] = vec4(fan.e1.z, fan.e2);
}
#endif

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), index = elementOf(item);
    uint base = poolBase(instance), cageBase = instance * header.cageStride;
    if (kFan == kRegularFan) {
#ifdef FAN_RECORDS
        RegularFacets f = regularFacets(index, cageBase);
        storeRecord(base, f.vertex, f.p0, fanOfRegular(f.e, f.d));
#else
        regularFan(index, base, cageBase);
#endif
        return;
    }
    uint record = 4u * push.table + 2u * index;
    uint slot = tableWord(record), weights = tableWord(record + 1u), words = header.ring + slot;
    uint vertex = ringCorner(tableWord(words), kRingVertex);
    vec3 p0 = meshPoint(cageBase + vertex);
    uint facets = tableElement(weights).x, sectors = facets & ~kBoundaryClass;
    bool boundary = (facets & kBoundaryClass) != 0u, few = kFan == kFewFan;
#ifdef FAN_RECORDS
    storeRecord(base, vertex, p0, fanOf(words, cageBase, p0, weights + 1u, boundary ? sectors + 1u : sectors, few));
#else
    uint tangent = base + header.tangents + slot, face = base + header.faces + slot;
    vec3 normal = weightedFan(base + vertex, tangent, face, words, cageBase, p0, weights + 1u, sectors, boundary, few);
    if (boundary) pool.at[face + sectors] = vec4(normal, 0.0); // a normal, no position: shared/prep.h
#endif
}
