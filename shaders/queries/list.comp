// Lists the instances that rays are aimed at, in their order, and says how many workgroups the kernels behind have. One workgroup, of
// which every lane takes a run of instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"

const uint kMostGroups = 65535u; // in x: every device takes so many

shared uint counts[kMaxLanes];

bool isAimedAt(uint listed) { return boxWords.at[2u * (push.firstBox + listed)].w != 0u; }
void storeDispatch(uint at, uint groups, uint count) {
    uint rows = max((groups + kMostGroups - 1u) / kMostGroups, 1u);
    boxWords.at[at] = uvec4((groups + rows - 1u) / rows, rows, 1u, count);
}
uint groupsFor(uint lanes) { return lanes / gl_WorkGroupSize.x + (lanes % gl_WorkGroupSize.x != 0u ? 1u : 0u); }

void main() {
    if (isFurtherWorkgroup()) return;
    uint lane = gl_LocalInvocationID.x, each = (push.instanceCount + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * each, push.instanceCount), end = min(begin + each, push.instanceCount), own = 0u;
    for (uint i = begin; i < end; ++i) own += isAimedAt(i) ? 1u : 0u;
    counts[lane] = own;
    barrier();
    uint place = 0u, count = 0u;
    [[dont_unroll]] for (uint l = 0u; l < gl_WorkGroupSize.x; ++l) {
        place += l < lane ? counts[l] : 0u;
        count += counts[l];
    }
    for (uint i = begin; i < end; ++i) {
        if (isAimedAt(i)) boxWords.at[2u * (push.firstBox + place++) + 1u].w = i;
    }
    if (lane == 0u) storeDispatch(push.firstDispatch, groupsFor(count * push.pieceCount), count);
    // Trees are made and asked for so many instances at a time.
    for (uint turn = lane; turn < push.turns; turn += gl_WorkGroupSize.x) {
        uint instances = min(count - min(turn * push.treeCount, count), push.treeCount), at = push.firstDispatch + 1u + kTreeDispatches * turn;
        storeDispatch(at, groupsFor(instances * push.pieceCount), instances);
        storeDispatch(at + 1u, instances, instances);
        storeDispatch(at + 2u, instances > 0u ? groupsFor(push.rayCount) : 0u, instances);
    }
}
