// Which instance an invocation works on. Needs mapping.glsl and push constants with a `window`. Passes before the list is made
// on the device have none; for these INSTANCE_PUSH names where `firstInstance` stands.
LOADED_BUFFER(uint, instanceWord, Instances, kInstanceBinding, usamplerBuffer, kInstanceTexelBinding, x)
// The dispatch's n-th entry of the list, and how many there are.
#ifdef INSTANCE_PUSH
uint instanceEntry(uint n) { return instanceWord(INSTANCE_PUSH.firstInstance + n); }
uint slotOf(uint entry) { return entry & kInstanceSlotMask; }
#else
uint instanceEntry(uint n) { return instanceWord(push.window.firstInstance + n); }
uint slotOf(uint entry) { return min(entry & kInstanceSlotMask, push.window.slots - 1u); }
uint instanceCount() {
    uint count = push.window.instanceCount;
    return (count & kCountOnDevice) != 0u ? min(instanceWord(count & ~kCountOnDevice), push.window.slots) : count;
}
#endif
uint instanceSlot(uint n) { return slotOf(instanceEntry(n)); }
