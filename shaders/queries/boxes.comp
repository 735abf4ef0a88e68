// Boxes of the deformed cages that queries look at. Narrow mapping: a lane an instance. Wide mapping: a workgroup an instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"

const float kFloatMax = 3.402823466e38;
shared vec3 lows[kMaxLanes], highs[kMaxLanes];

// The box of every step-th vertex from `first` on. Vertices that are not finite are left out.
void boxOf(uint base, uint first, uint step, out vec3 low, out vec3 high) {
    low = vec3(kFloatMax);
    high = vec3(-kFloatMax);
    for (uint v = first; v < push.vertexCount; v += step) {
        vec3 p = cage(base + v).xyz;
        bool usable = finite(p);
        low = usable ? min(low, p) : low;
        high = usable ? max(high, p) : high;
    }
}

void main() {
    uint listed = kWide ? workgroupIndex() : invocationIndex(), lane = gl_LocalInvocationID.x;
    if (listed >= push.instanceCount) return; // wide: the whole workgroup
    uint base = slotOfListed(listed) * push.cageStride, at = 2u * (push.firstBox + listed);
    vec3 low, high;
    boxOf(base, kWide ? lane : 0u, kWide ? gl_WorkGroupSize.x : 1u, low, high);
    if (kWide) {
        lows[lane] = low;
        highs[lane] = high;
        barrier();
        if (lane > 0u) return;
        for (uint k = 1u; k < gl_WorkGroupSize.x; ++k) {
            low = min(low, lows[k]);
            high = max(high, highs[k]);
        }
    }
    boxWords.at[at] = uvec4(floatBitsToUint(low), 0u); // no ray is aimed at it yet
    boxWords.at[at + 1u] = uvec4(floatBitsToUint(high), 0u);
}
