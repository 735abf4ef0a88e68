// For the passes that list instances: one workgroup, of which every lane takes a run of entries. Needs PUSH_CONSTANTS.
#include "shaders/bounds/cull.glsl"

BUFFER(, List, kListBinding, std430, uint, list)
BUFFER(writeonly, Arguments, kListArgumentBinding, std430, uint, argumentWords)
BUFFER(readonly, Table, kListTableBinding, std430, uvec4, tableElements)
BUFFER(readonly, Bounds, kBoundsBinding, std430, vec4, bounds)

#ifdef WIDE
uvec2 state(uint slot) { return states.at[slot]; }
#else
layout(set = 0, binding = kBoundsStateTexelBinding) uniform usamplerBuffer stateTexels;
uvec2 state(uint slot) { return texelFetch(stateTexels, int(slot)).xy; }
#endif

void storeDispatch(uint at, uint elements, uint perGroup) {
    uint groups = elements / perGroup + (elements % perGroup != 0u ? 1u : 0u);
    uint rows = max(groups / push.maxGroups + (groups % push.maxGroups != 0u ? 1u : 0u), 1u);
    argumentWords.at[at] = groups / rows + (groups % rows != 0u ? 1u : 0u);
    argumentWords.at[at + 1u] = rows;
    argumentWords.at[at + 2u] = 1u;
}

// The lane's run of a window's entries.
uvec2 runOf(uvec4 window) {
    uint lane = gl_LocalInvocationID.x, each = (window.y + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    return window.x + min(uvec2(lane, lane + 1u) * each, window.yy);
}
