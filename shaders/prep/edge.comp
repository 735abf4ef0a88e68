// Edge stage of p-rep: the four coefficients of the bi-5 perturbation (SMI 2008, section 4, corrected as docs/prep.md).
// The perturbation belongs to the edge: both patches read the same words. One invocation a perturbed edge and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/prep/tables.glsl"
#include "shaders/prep/pool.glsl"

// As in the vertex stage: no -0 in the pool.
void store(uint i, vec3 v) {
    precise vec3 canonical = v + 0.0;
    pool[i] = vec4(canonical, 0.0);
}

// Near and far roles: the same formula serves both ends, cn and cf = cos(2 pi / n) at the near and the far end.
vec3 nearCoefficient0(float cn, float cf, vec3 An, vec3 tn, vec3 tf, vec3 Sn) {
    precise vec3 r = 0.075 * ((((-2.0 * cf / cn) * An + (4.0 + (2.0 * cf - 6.0) / cn) * tn) - 4.0 * tf) + (3.0 / cn) * Sn);
    return r;
}

vec3 nearCoefficient1(float cn, float cf, vec3 An, vec3 tn, vec3 tf, vec3 Af, vec3 Sn, vec3 Sf, vec3 hn, vec3 hf) {
    precise vec3 points = ((4.0 * cf) * An + (12.0 - 8.0 * cn) * tn) + ((6.0 + 6.0 * cn - 4.0 * cf) * tf + (2.0 * cn) * Af);
    precise vec3 r = ((1.0 - 0.6 * cn - 0.4 * cf) * hn + (0.6 * cn) * hf) + 0.03 * (points - (6.0 * Sn + 3.0 * Sf));
    return r;
}

void main() {
    uint id = min(invocationIndex(), push.count * push.instanceCount - 1u);
    uint instance = id / push.count;
    uint record = push.table + 3u * (id - instance * push.count);
    uint base = instance * push.poolStride;
    uvec4 curve = base + tableElement(record);
    uvec4 sums = base + tableElement(record + 1u);
    uvec4 edge = tableElement(record + 2u);

    vec3 A = poolVector(curve.x), tA = poolVector(curve.y), tB = poolVector(curve.z), B = poolVector(curve.w);
    precise vec3 SA = poolVector(sums.x) + poolVector(sums.y);
    float cA = uintBitsToFloat(edge.x), cB = uintBitsToFloat(edge.y);
    vec3 h20, h30, h21, h31;
    if ((edge.w & kMixedEdge) != 0u) { // <n, 4>
        precise vec3 h = 0.075 * ((((6.0 - 6.0 / cA) * tA - 2.0 * A) - 4.0 * tB) + (3.0 / cA) * SA);
        precise vec3 far = (2.0 * cA) * B - (2.0 * cA) * tB;
        precise vec3 r = (1.0 - 0.4 * cA) * h +
                         0.03 * (((2.0 * cA) * A + (12.0 - 6.0 * cA) * tA) + (((2.0 * cA) * tB + (2.0 * cA) * B) - 6.0 * SA));
        precise vec3 q = h + 0.03 * ((6.0 * tA + far) - 3.0 * SA);
        h20 = h;
        h30 = h;
        h21 = r;
        h31 = q;
    } else { // <n0, n1>
        precise vec3 SB = poolVector(sums.z) + poolVector(sums.w);
        h20 = nearCoefficient0(cA, cB, A, tA, tB, SA);
        h30 = nearCoefficient0(cB, cA, B, tB, tA, SB);
        h21 = nearCoefficient1(cA, cB, A, tA, tB, B, SA, SB, h20, h30);
        h31 = nearCoefficient1(cB, cA, B, tB, tA, A, SB, SA, h30, h20);
    }
    uint swap = (edge.w & kReversedEdge) != 0u ? 1u : 0u;
    uint h = base + edge.z;
    store(h + (0u ^ swap), h20);
    store(h + (1u ^ swap), h30);
    store(h + (2u ^ swap), h21);
    store(h + (3u ^ swap), h31);
}
