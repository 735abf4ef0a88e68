// How many patches of each run take each capacity, once the budget is solved. One workgroup a run. What was counted by bin is
// cleared for the next frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define LOD_WRITE
#include "shaders/shared/mapping.glsl"
#include "shaders/lod/lod.glsl"

layout(push_constant) uniform Push { LodSolvePush push; };

shared uint counts[kCapacityCount];

void main() {
    uint lane = gl_LocalInvocationID.x, run = workgroupIndex();
    for (uint c = lane; c < kCapacityCount; c += gl_WorkGroupSize.x) counts[c] = 0u;
    barrier();
    [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
        if (run >= push.runCount || (push.priorities & (1u << p)) == 0u) continue;
        uint first = SUPPLE_LOD_COUNTS(push.runs) + (run * kPriorityCount + p) * kCountBins;
        uint capacities = kLodCapacities + p * kLodBinStride + kFirstCountBin;
        [[dont_unroll]] for (uint bin = lane; bin < kCountBins; bin += gl_WorkGroupSize.x) {
            uint count = lodWords.at[first + bin];
            if (count > 0u) {
                atomicAdd(counts[min(lodWords.at[capacities + bin], kCapacityCount - 1u)], count);
                lodWords.at[first + bin] = 0u;
            }
        }
    }
    barrier();
    uint draws = SUPPLE_LOD_DRAWS(push.runs) + kLodDrawWords * kCapacityCount * run;
    for (uint c = lane; run < push.runCount && c < kCapacityCount; c += gl_WorkGroupSize.x)
        lodWords.at[draws + kLodDrawWords * c + kLodDrawCount] = counts[c];
}
