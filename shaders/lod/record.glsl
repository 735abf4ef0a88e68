// Evaluation at levels of detail: what a lane or a workgroup takes of a dispatch, and the records of the patches
// (shared/lod.h). Needs tables.glsl.
#include "shaders/lod/lod.glsl"
#include "shaders/lod/pattern.glsl"

layout(constant_id = 6) const bool kLod = false; // records of a view, else all patches at one rate

struct LodRecord {
    uint patchIndex; // in device order, or kEmptyRecord
    uint slot;       // of the window
    bool isNew;
    uint firstVertex;
    uint capacityIndex, capacity;
    vec2 pairs[6];
};

LodRecord lodRecord(uint index) {
    uint at = (kLodRecords + kLodRecordWords * index) / 4u;
    uvec4 head = lodElement(at);
    LodRecord r;
    r.patchIndex = head.x;
    r.slot = (head.y & kInstanceSlotMask) - push.firstSlot;
    r.isNew = (head.y & kInstanceIsNew) != 0u;
    r.firstVertex = head.z;
    r.capacityIndex = head.w;
    r.capacity = capacityOf(head.w);
    for (uint k = 0u; k < 3u; ++k) {
        vec4 two = uintBitsToFloat(lodElement(at + 1u + k));
        r.pairs[2u * k] = two.xy;
        r.pairs[2u * k + 1u] = two.zw;
    }
    return r;
}

// The record of a lane, in the narrow mapping. Idle lanes repeat the last.
uint lodRecordOfLane() {
    uint at = kLodDispatches + 8u * push.dispatch;
    return lodWord(at + 3u) + min(invocationIndex(), lodWord(at + 4u) - 1u);
}

// What a workgroup takes, in the wide mapping: some records of one bucket.
struct LodShare {
    uint firstRecord, recordCount, samples;
};
LodShare lodShareOfGroup(uint form) {
    uint at = kLodDispatches + 8u * push.dispatch;
    uint end = lodWord(at + 3u) + lodWord(at + 4u), first = lodWord(at + 5u), count = lodWord(at + 6u);
    LodShare share = LodShare(0u, 0u, 1u);
    if (workgroupIndex() >= lodWord(at + 7u)) return share;
    uint b = count - 1u; // the last bucket that begins at or before this group, and is not empty
    while (b > 0u && lodWord(kLodBuckets + 4u * (first + b) + 3u) > workgroupIndex()) --b;
    uint bucket = kLodBuckets + 4u * (first + b);
    uint next = b + 1u < count ? lodWord(bucket + 4u) : end;
    share.samples = formSamples(form, capacityOf((first + b) % kCapacityCount));
    uint each = clamp(gl_WorkGroupSize.x / share.samples, 1u, kMaxPatchesPerGroup);
    share.firstRecord = lodWord(bucket) + (workgroupIndex() - lodWord(bucket + 3u)) * each;
    share.recordCount = share.firstRecord < next ? min(each, next - share.firstRecord) : 0u;
    return share;
}
