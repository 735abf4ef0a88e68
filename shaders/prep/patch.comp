// Patch pass of p-rep: gathers the coefficients of every patch, for inspection and tests. Evaluation gathers by itself.
// One invocation a patch and instance. Output: 32 float4 a patch, 16 g (i + 4 j), then 16 h (4 e + s).
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#include "shaders/prep/tables.glsl"
#include "shaders/prep/pool.glsl"

layout(constant_id = 3) const bool kPerturbed = false;

layout(set = 0, binding = kPatchCoefficientBinding, std430) writeonly buffer PatchCoefficients { vec4 coefficients[]; };

const uint kFaceEdgeOrder[16] = uint[16](SUPPLE_PREP_FACE_EDGE_ORDER);

void main() {
    uint id = min(invocationIndex(), push.count * push.instanceCount - 1u);
    uint instance = id / push.count;
    uint patchIndex = id - instance * push.count;
    uint record = push.table + patchIndex * (kPerturbed ? kPerturbedElements : kRegularElements);
    uint base = instance * push.poolStride;
    uint target = 32u * (instance * push.patchCount + push.firstPatch + patchIndex);
    for (uint k = 0u; k < 16u; ++k) {
        coefficients[target + k] = vec4(poolVector(base + tableWord(4u * record + k)), 0.0);
        vec3 h = vec3(0.0);
        if (kPerturbed) h = poolVector(base + tableWord(4u * record + 16u + k));
        coefficients[target + 16u + kFaceEdgeOrder[k]] = vec4(h, 0.0);
    }
}
