// Edge stage of p-rep: the four coefficients of the bi-5 perturbation (equations (8) and (9), corrected as docs/prep.md).
// The perturbation belongs to the edge: both patches read the same words. It is linear in six vectors, with weights that
// depend on the two valences only. One invocation a perturbed edge and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/prep.h"

// Relative to A, which keeps cancellation small: the weights of a row sum to zero (SA and SB are sums of two points), so
// that the weight of A itself never appears.
vec3 weighted(float w[6], vec3 tA, vec3 tB, vec3 B, vec3 SA, vec3 SB) {
    precise vec3 r = (w[3] * B + (w[1] * tA + w[2] * tB)) + (w[4] * SA + w[5] * SB);
    return r;
}

void main() {
    uint item = itemOfLane(), index = elementOf(item);
    uvec4 record = tableElement(push.table + index); // A, its spoke, B, its spoke
    uint base = poolBase(instanceOf(item)), tangents = base + header.tangents, faces = base + header.faces;
    uint weights = header.edgeClasses + kEdgeClassElements * SUPPLE_PREP_EDGE_CLASS(record.x, record.z);
    uint target = base + header.inner + 4u * index;

    vec3 tA = poolVector(tangents + SUPPLE_SPOKE(record.y));
    precise vec3 B = poolVector(base + SUPPLE_POINT(record.z)) - poolVector(base + SUPPLE_POINT(record.x));
    precise vec3 tB = B + poolVector(tangents + SUPPLE_SPOKE(record.w));
    precise vec3 SA = poolVector(faces + SUPPLE_SPOKE(record.y)) + poolVector(faces + SUPPLE_NEXT_SPOKE(record.y));
    precise vec3 SB =
        (B + poolVector(faces + SUPPLE_NEXT_SPOKE(record.w))) + (B + poolVector(faces + SUPPLE_SPOKE(record.w)));
    vec4 w[6];
    for (uint k = 0u; k < 6u; ++k) w[k] = uintBitsToFloat(tableElement(weights + k));
    for (uint row = 0u; row < 4u; ++row)
        storePool(target + row,
                  weighted(float[6](w[0][row], w[1][row], w[2][row], w[3][row], w[4][row], w[5][row]), tA, tB, B, SA, SB));
    // Edges without a perturbation have these zeros. They lie behind all others.
    if (index == 0u)
        for (uint k = 0u; k < 4u; ++k) pool.at[base + header.inner + 4u * push.count + k] = vec4(0.0);
}
