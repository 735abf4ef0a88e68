// Patch pass of bicubic patches: gathers the coefficients of every patch, for inspection and tests. Evaluation gathers by itself.
// One invocation per patch and instance. Output: kPatchStride float4 per patch: 16 g (i + 4 j). Perturbed patches then have 16 h
// (4 e + s). Polar patches have 13 g, because their last row is one point.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS PatchPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/bicubic.glsl"
#ifdef FAN_RECORDS
#include "shaders/surface/corner.glsl"
#include "shaders/surface/fan_record.glsl"
vec3 netVector(uint base, uint record, uint k) {
    uint kind = SUPPLE_NET_KIND(k);
    Corner c = cornerOfPatch(base, record, SUPPLE_NET_CORNER(k));
    return kind == kNetPoint ? c.point : kind == kNetTangent ? c.next : kind == kNetNextTangent ? c.last : c.face;
}
#else
vec3 netVector(uint base, uint record, uint k) {
    return poolVector(base + netIndex(netRecord(record), kClass == kPolarPatch, k));
}
#endif

BUFFER(writeonly, PatchCoefficients, kPatchCoefficientBinding, std430, vec4, coefficients)

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), patchIndex = elementOf(item), base = poolBase(instance);
    uint record = push.table + patchIndex * kRecordElements;
    uint target = kPatchStride * (instance * header.patchCount + push.firstPatch + patchIndex);
    for (uint k = 0u; k < 16u; ++k) {
        bool past = kClass == kPolarPatch && k > 12u;
        uint corner = cornerOf(k);
        vec3 g = vec3(0.0);
        if (!past) g = netVector(base, record, corner);
        if (!past && k != corner) g += netVector(base, record, k);
        coefficients.at[target + k] = vec4(g, 0.0);
        vec3 h = vec3(0.0);
        if (kClass == kPerturbedPatch) h = poolVector(base + perturbationIndex(tableElement(record + 2u), k));
        coefficients.at[target + 16u + SUPPLE_PREP_FACE_EDGE(k)] = vec4(h, 0.0);
    }
}
