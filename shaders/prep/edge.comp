// Edge stage of p-rep: the four coefficients of the bi-5 perturbation (equations (8) and (9), corrected as docs/prep.md).
// The perturbation belongs to the edge: both patches read the same words. It is linear in six vectors, with weights that
// depend on the two valences only. One invocation a perturbed edge and instance. With FAN_RECORDS the offsets of the ends are made of
// what the pool has of fans.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/prep.h"
#ifdef FAN_RECORDS
#include "shaders/surface/corner.glsl"
#include "shaders/surface/fan_record.glsl"
#endif

// Relative to A, which keeps cancellation small: the weights of a row sum to zero (SA and SB are sums of two points), so
// that the weight of A itself never appears.
vec3 weighted(float w[6], vec3 tA, vec3 tB, vec3 B, vec3 SA, vec3 SB) {
    precise vec3 r = (w[3] * B + (w[1] * tA + w[2] * tB)) + (w[4] * SA + w[5] * SB);
    return r;
}

// What an end of the edge has: its limit point, and the offsets of its tangent along the edge and of the faces on both sides.
struct EdgeEnd {
    vec3 point, tangent, face, otherFace;
};
struct Edge {
    EdgeEnd a, b;
    uint edgeClass;
};
#ifdef FAN_RECORDS
// `word`: where its turn is. `far`: the edge's other end. Then the corners of a face behind `far`, and those of the other face before it.
EdgeEnd edgeEnd(FanRecord r, uint word, vec3 far, vec3 across, vec3 last, vec3 otherNext, vec3 otherAcross) {
    vec4 turn = uintBitsToFloat(tableElement(word & kTurnMask));
    return EdgeEnd(limitOf(r), spokeTangent(r, turn.xy), faceOffset(r, far, across, last),
                   faceOffset(r, otherNext, otherAcross, far));
}
Edge loadEdge(uint base, uint index) {
    uvec4 ends = tableElement(push.table + 2u * index), others = tableElement(push.table + 2u * index + 1u);
    FanRecord a = fanRecord(base, SUPPLE_POINT(ends.x)), b = fanRecord(base, SUPPLE_POINT(ends.z));
    vec3 behindB = fanVertex(base, others.x), beforeA = fanVertex(base, others.y);
    vec3 behindA = fanVertex(base, others.z), beforeB = fanVertex(base, others.w);
    return Edge(edgeEnd(a, ends.y, b.p0, behindB, beforeA, behindA, beforeB),
                edgeEnd(b, ends.w, a.p0, behindA, beforeB, behindB, beforeA), SUPPLE_PREP_EDGE_CLASS(ends.x, ends.z));
}
#else
EdgeEnd edgeEnd(uint base, uint point, uint spoke) {
    uint tangents = base + header.tangents, faces = base + header.faces;
    return EdgeEnd(poolVector(base + SUPPLE_POINT(point)), poolVector(tangents + SUPPLE_SPOKE(spoke)),
                   poolVector(faces + SUPPLE_SPOKE(spoke)), poolVector(faces + SUPPLE_NEXT_SPOKE(spoke)));
}
Edge loadEdge(uint base, uint index) {
    uvec4 record = tableElement(push.table + index);
    return Edge(edgeEnd(base, record.x, record.y), edgeEnd(base, record.z, record.w), SUPPLE_PREP_EDGE_CLASS(record.x, record.z));
}
#endif

void main() {
    uint item = itemOfLane(), index = elementOf(item), base = poolBase(instanceOf(item));
    Edge edge = loadEdge(base, index);
    uint weights = header.edgeClasses + kEdgeClassElements * edge.edgeClass, target = base + header.inner + 4u * index;

    precise vec3 B = edge.b.point - edge.a.point;
    precise vec3 tB = B + edge.b.tangent;
    precise vec3 SA = edge.a.face + edge.a.otherFace;
    precise vec3 SB = (B + edge.b.otherFace) + (B + edge.b.face);
    vec4 w[6];
    for (uint k = 0u; k < 6u; ++k) w[k] = uintBitsToFloat(tableElement(weights + k));
    for (uint row = 0u; row < 4u; ++row)
        storePool(target + row, weighted(float[6](w[0][row], w[1][row], w[2][row], w[3][row], w[4][row], w[5][row]),
                                         edge.a.tangent, tB, B, SA, SB));
    // Edges without a perturbation have these zeros. They lie behind all others.
    if (index == 0u)
        for (uint k = 0u; k < 4u; ++k) pool.at[base + header.inner + 4u * push.count + k] = vec4(0.0);
}
