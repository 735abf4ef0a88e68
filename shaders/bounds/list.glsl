// For the passes that list instances: one workgroup, of which every lane takes a run of entries. LIST_PUSH is the struct of push
// constants.
#include "shaders/bounds/cull.glsl"

layout(set = 0, binding = kBoundsStateTexelBinding) uniform usamplerBuffer stateTexels;
layout(set = 0, binding = kListBinding, std430) buffer List { uint list[]; };
layout(set = 0, binding = kListArgumentBinding, std430) writeonly buffer Arguments { uint argumentWords[]; };
layout(set = 0, binding = kListTableBinding, std430) readonly buffer Table { uvec4 tableElements[]; };
layout(set = 0, binding = kBoundsBinding, std430) readonly buffer Bounds { vec4 bounds[]; };
layout(push_constant) uniform Push { LIST_PUSH push; };

uvec2 state(uint slot) {
    if (kWide) return states[slot];
    return texelFetch(stateTexels, int(slot)).xy;
}

void storeDispatch(uint at, uint elements, uint perGroup) {
    uint groups = elements / perGroup + (elements % perGroup != 0u ? 1u : 0u);
    uint rows = max(groups / push.maxGroups + (groups % push.maxGroups != 0u ? 1u : 0u), 1u);
    argumentWords[at] = groups / rows + (groups % rows != 0u ? 1u : 0u);
    argumentWords[at + 1u] = rows;
    argumentWords[at + 2u] = 1u;
}

// The lane's run of a window's entries.
uvec2 runOf(uvec4 window) {
    uint lane = gl_LocalInvocationID.x, each = (window.y + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    return window.x + min(uvec2(lane, lane + 1u) * each, window.yy);
}
