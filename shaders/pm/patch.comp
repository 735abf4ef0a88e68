// Patch pass of P_m: the 6 m + 1 coefficients of every patch in the order of docs/pm.md, for inspection and tests: b004, then
// b300 b210 b120 b211 b121 b112 a sector. One invocation a patch and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/pm/pm.glsl"

layout(set = 0, binding = kPatchCoefficientBinding, std430) writeonly buffer PatchCoefficients { vec4 coefficients[]; };

void main() {
    uint id = min(invocationIndex(), push.count * push.instanceCount - 1u);
    uint instance = id / push.count;
    uint patchIndex = id - instance * push.count, base = instance * push.poolStride;
    uint record = push.table + kSides * patchIndex;
    uint target = kPatchStride * (instance * push.patchCount + push.firstPatch + patchIndex);
    uint inner = base + tableElement(record).w;
    coefficients[target] = vec4(poolVector(inner), 0.0);
    for (uint i = 0u; i < kSides; ++i) {
        uvec4 border = base + tableElement(record + i);
        uint to = target + 1u + 6u * i, from = inner + 1u + 3u * i;
        coefficients[to] = vec4(poolVector(border.x), 0.0);
        coefficients[to + 1u] = vec4(poolVector(border.y), 0.0);
        coefficients[to + 2u] = vec4(poolVector(border.z), 0.0);
        for (uint k = 0u; k < 3u; ++k) coefficients[to + 3u + k] = vec4(poolVector(from + k), 0.0);
    }
}
