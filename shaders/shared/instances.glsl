// Which instance an invocation works on. Needs mapping.glsl and push constants with `firstInstance`.
layout(set = 0, binding = kInstanceBinding, std430) readonly buffer Instances { uint instanceEntries[]; };
layout(set = 0, binding = kInstanceTexelBinding) uniform usamplerBuffer instanceTexels;

// The dispatch's n-th entry of the list.
uint instanceEntry(uint n) {
    if (kWide) return instanceEntries[push.firstInstance + n];
    return texelFetch(instanceTexels, int(push.firstInstance + n)).x;
}
uint instanceSlot(uint n) { return instanceEntry(n) & kInstanceSlotMask; }
