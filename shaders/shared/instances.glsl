// Which instance an invocation works on. Needs mapping.glsl and push constants with `firstInstance`.
layout(set = 0, binding = kInstanceBinding, std430) readonly buffer Instances { uint instanceSlots[]; };
layout(set = 0, binding = kInstanceTexelBinding) uniform usamplerBuffer instanceTexels;

// The slot of the dispatch's n-th instance.
uint instanceSlot(uint n) {
    if (kWide) return instanceSlots[push.firstInstance + n];
    return texelFetch(instanceTexels, int(push.firstInstance + n)).x;
}
