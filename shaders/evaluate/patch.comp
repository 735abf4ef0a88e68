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
#endif

BUFFER(writeonly, PatchCoefficients, kPatchCoefficientBinding, std430, vec4, coefficients)

#ifdef FAN_RECORDS
// Each corner is made once, for the four coefficients round it.
void storeNet(uint base, uint record, uint target) {
    for (uint corner = 0u; corner < 4u; ++corner) {
        Corner c = cornerOfPatch(base, record, corner);
        for (uint k = 0u; k < 16u; ++k) {
            if (SUPPLE_NET_CORNER(k) != corner) continue;
            uint kind = SUPPLE_NET_KIND(k);
            vec3 g = c.point;
            if (kind != kNetPoint) g += kind == kNetTangent ? c.next : kind == kNetNextTangent ? c.last : c.face;
            coefficients.at[target + k] = vec4(g, 0.0);
        }
    }
}
#else
void storeNet(uint base, uint record, uint target) {
    NetRecord net = netRecord(record);
    for (uint k = 0u; k < 16u; ++k) {
        bool past = kClass == kPolarPatch && k > 12u;
        uint corner = cornerOf(k);
        vec3 g = vec3(0.0);
        if (!past) g = poolVector(base + netIndex(net, kClass == kPolarPatch, corner));
        if (!past && k != corner) g += poolVector(base + netIndex(net, kClass == kPolarPatch, k));
        coefficients.at[target + k] = vec4(g, 0.0);
    }
}
#endif
void storePerturbation(uint base, uvec4 edges, uint target) {
    for (uint k = 0u; k < 16u; ++k) {
        vec3 h = vec3(0.0);
        if (kClass == kPerturbedPatch) h = poolVector(base + perturbationIndex(edges, k));
        coefficients.at[target + SUPPLE_PREP_FACE_EDGE(k)] = vec4(h, 0.0);
    }
}

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), patchIndex = elementOf(item), base = poolBase(instance);
    uint record = push.table + patchIndex * kRecordElements;
    uint target = kPatchStride * (instance * header.patchCount + push.firstPatch + patchIndex);
    storeNet(base, record, target);
    storePerturbation(base, kClass == kPerturbedPatch ? tableElement(record + 2u) : uvec4(0u), target + 16u);
}
