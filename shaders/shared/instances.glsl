// Which instance an invocation works on. Needs mapping.glsl and push constants with `firstInstance`.
layout(set = 0, binding = kInstanceBinding, std430) readonly buffer Instances { uint instanceEntries[]; };
layout(set = 0, binding = kInstanceTexelBinding) uniform usamplerBuffer instanceTexels;

uint instanceWord(uint i) {
    if (kWide) return instanceEntries[i];
    return texelFetch(instanceTexels, int(i)).x;
}
// The dispatch's n-th entry of the list, and how many there are.
uint instanceEntry(uint n) { return instanceWord(push.firstInstance + n); }
uint instanceCount() {
    return (push.instanceCount & kCountOnDevice) != 0u ? instanceWord(push.instanceCount & ~kCountOnDevice)
                                                       : push.instanceCount;
}
uint instanceSlot(uint n) { return instanceEntry(n) & kInstanceSlotMask; }
