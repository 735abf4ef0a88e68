// Patch pass of P_m: the 6 m + 1 coefficients of every patch in the order of docs/pm.md, for inspection and tests: b004, then
// b300 b210 b120 b211 b121 b112 a sector. One invocation a patch and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS PatchPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/pm/pm.glsl"
#include "shaders/pm/record.glsl"

BUFFER(writeonly, PatchCoefficients, kPatchCoefficientBinding, std430, vec4, coefficients)

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), patchIndex = elementOf(item), base = poolBase(instance);
    uint record = push.table + SUPPLE_PM_RECORD_ELEMENTS(kSides) * patchIndex;
    uint target = kPatchStride * (instance * header.patchCount + push.firstPatch + patchIndex);
    uint inner = base + centreIndex(record, kSides), tangents = base + header.tangents;
    vec3 centre = poolVector(inner);
    coefficients.at[target] = vec4(centre, 0.0);
    for (uint i = 0u; i < kSides; ++i) {
        uint n = (i + 1u) % kSides;
        uint to = target + 1u + 6u * i, from = inner + 1u + 3u * i;
        vec3 v = poolVector(base + pointIndex(record, i)), next = poolVector(base + pointIndex(record, n));
        coefficients.at[to] = vec4(v, 0.0);
        coefficients.at[to + 1u] = vec4(v + poolVector(tangents + SUPPLE_SPOKE(spokeWord(record, i))), 0.0);
        coefficients.at[to + 2u] = vec4(next + poolVector(tangents + SUPPLE_NEXT_SPOKE(spokeWord(record, n))), 0.0);
        coefficients.at[to + 3u] = vec4(v + poolVector(from), 0.0);
        coefficients.at[to + 4u] = vec4(next + poolVector(from + 1u), 0.0);
        coefficients.at[to + 5u] = vec4(centre + poolVector(from + 2u), 0.0);
    }
}
