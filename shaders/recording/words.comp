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
    uint base = local * push.slotStride + push.firstWord, count = push.elementCount * push.keptWords;
    uint place = (push.firstSlot + local) * count, end = min(share * kHashedWords + kHashedWords, count);
    uvec2 sum = uvec2(0u);
    for (uint i = share * kHashedWords + gl_LocalInvocationID.x; i < end; i += gl_WorkGroupSize.x) {
        uint element = i / push.keptWords;
        sum += hashOf(words.at[base + element * push.elementWords + (i - element * push.keptWords)], place + i);
    }
    addTo(push.target, sum);
}
