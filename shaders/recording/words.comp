// Adds up the hashes of words that instances have. A workgroup takes a share of one instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/recording/hash.glsl"

layout(push_constant) uniform Push { SlotHashPush push; };

void main() {
    uint entry = workgroupIndex() / push.shares, share = workgroupIndex() % push.shares;
    bool counted = (push.entryCount & kCountOnDevice) != 0u;
    uint entries = counted ? list.at[push.entryCount & ~kCountOnDevice] : push.entryCount;
    if (entry >= min(entries, push.mostEntries)) return; // the whole workgroup
    uint local = (list.at[push.firstEntry + entry] & kInstanceSlotMask) - push.firstListed;
    uint base = local * push.slotStride + push.firstWord;
    uint place = (push.firstSlot + local) * push.elementCount * push.keptWords;
    uint first = share * kHashedElements, end = min(first + kHashedElements, push.elementCount);
    uvec2 sum = uvec2(0u);
    for (uint i = first + gl_LocalInvocationID.x; i < end; i += gl_WorkGroupSize.x) {
        for (uint k = 0u; k < push.keptWords; ++k) {
            sum += hashOf(words.at[base + i * push.elementWords + k], place + i * push.keptWords + k);
        }
    }
    addTo(push.target, sum);
}
