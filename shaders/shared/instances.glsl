// Which instance an invocation works on. Needs mapping.glsl and push constants with a `window`; INSTANCE_PUSH names where
// else `firstInstance` and `instanceCount` stand.
#ifndef INSTANCE_PUSH
#define INSTANCE_PUSH push.window
#endif
LOADED_BUFFER(uint, instanceWord, Instances, kInstanceBinding, usamplerBuffer, kInstanceTexelBinding, x)
// The dispatch's n-th entry of the list, and how many there are.
uint instanceEntry(uint n) { return instanceWord(INSTANCE_PUSH.firstInstance + n); }
uint instanceCount() {
    return (INSTANCE_PUSH.instanceCount & kCountOnDevice) != 0u ? instanceWord(INSTANCE_PUSH.instanceCount & ~kCountOnDevice)
                                                       : INSTANCE_PUSH.instanceCount;
}
uint instanceSlot(uint n) { return instanceEntry(n) & kInstanceSlotMask; }
