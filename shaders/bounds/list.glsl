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

uint quotientUp(uint a, uint b) {
    uint q = a / b;
    return q * b != a ? q + 1u : q;
}
void storeDispatch(uint at, uint elements, uint perGroup) {
    uint groups = quotientUp(elements, perGroup), rows = max(quotientUp(groups, push.maxGroups), 1u);
    uint columns = quotientUp(groups, rows);
    // A loop, so that there is one store: CPU devices compile each as a loop over the lanes.
    [[dont_unroll]] for (uint k = 0u; k < 3u; ++k) argumentWords.at[at + k] = k == 0u ? columns : k == 1u ? rows : 1u;
}

// The lane's run of a window's entries.
uvec2 runOf(uvec4 window) {
    uint lane = gl_LocalInvocationID.x, each = (window.y + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    return window.x + min(uvec2(lane, lane + 1u) * each, window.yy);
}
