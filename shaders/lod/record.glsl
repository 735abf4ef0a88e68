// Evaluation at levels of detail: what a lane or a workgroup takes of a dispatch, and the records of the patches
// (shared/lod.h). Needs tables.glsl.
#include "shaders/lod/lod.glsl"
#include "shaders/lod/pattern.glsl"

// Records of a view, else all patches at one rate. A macro: what either does without need not be compiled when a pipeline
// is made.
#ifdef LEVELS
const bool kLod = true;
#else
const bool kLod = false;
#endif

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

// Parameters of a sample on a border are the edge's, else the patch's own. At a corner they are 0 and 1 themselves.
vec2 lodU(LodRecord r, uint i, uint j) {
    if (i == 0u) return vec2(0.0, 1.0);
    if (i == r.capacity) return vec2(1.0, 0.0);
    vec2 level = j == 0u ? r.pairs[2] : j == r.capacity ? r.pairs[4] : r.pairs[0];
    return lodPair(lodPattern(level, r.capacityIndex), i, r.capacity);
}
vec2 lodV(LodRecord r, uint i, uint j) {
    if (j == 0u) return vec2(0.0, 1.0);
    if (j == r.capacity) return vec2(1.0, 0.0);
    vec2 level = i == r.capacity ? r.pairs[3] : i == 0u ? r.pairs[5] : r.pairs[1];
    return lodPair(lodPattern(level, r.capacityIndex), j, r.capacity);
}

// A sample of a ring grid (surface/lod/grid.h): its ring, the side of it, and the place along the side, counted from the
// patch's corner.
struct RingSample {
    uint ring, side, k;
};
// Samples before a ring of a patch of m sides, and before a side of the ring.
uint ringStart(uint m, uint ring, uint capacity) { return m * ring * (capacity + 1u - ring); }
uint ringSideStart(uint m, uint ring, uint side, uint capacity) {
    return ringStart(m, ring, capacity) + side * (capacity - 2u * ring);
}
RingSample ringSample(uint m, uint capacity, uint index) {
    uint ring = 0u;
    while (ringStart(m, ring + 1u, capacity) <= index) ++ring;
    uint at = index - ringStart(m, ring, capacity), each = capacity - 2u * ring, side = at / each;
    return RingSample(ring, side, ring + at - side * each);
}
// Weights of corner `side`, of the next corner and of the centre, from the pair along the ring's side, which on the border is
// the edge's own, and from the ring's place across.
vec3 ringWeights(vec2 along, float t) {
    precise vec3 w = vec3(along.y - t, along.x - t, 2.0 * t);
    return w;
}
vec3 ringWeights(LodRecord r, RingSample s, out vec2 along) {
    vec2 level = s.ring == 0u ? r.pairs[1u + s.side] : r.pairs[0];
    along = lodPair(lodPattern(level, r.capacityIndex), s.k, r.capacity);
    return ringWeights(along, lodPair(lodPattern(r.pairs[0], r.capacityIndex), s.ring, r.capacity).x);
}

// The record of a lane, in the narrow mapping. Idle lanes repeat the last.
uint lodRecordOfLane() {
    uint at = kLodDispatches + 8u * push.dispatch;
    return lodWord(at + 3u) + min(invocationIndex(), lodWord(at + 4u) - 1u);
}

// What a workgroup takes, in the wide mapping: some records of one bucket.
struct LodShare {
    uint firstRecord, recordCount, samples, side;
};
LodShare lodShareOfGroup(uint form) {
    uint at = kLodDispatches + 8u * push.dispatch;
    uint end = lodWord(at + 3u) + lodWord(at + 4u), first = lodWord(at + 5u), count = lodWord(at + 6u);
    LodShare share = LodShare(0u, 0u, 1u, 1u);
    if (workgroupIndex() >= lodWord(at + 7u)) return share;
    uint b = count - 1u; // the last bucket that begins at or before this group, and is not empty
    while (b > 0u && lodWord(kLodBuckets + 4u * (first + b) + 3u) > workgroupIndex()) --b;
    uint bucket = kLodBuckets + 4u * (first + b);
    uint next = b + 1u < count ? lodWord(bucket + 4u) : end;
    uint capacity = capacityOf(b % kCapacityCount);
    share.samples = formSamples(form, capacity);
    share.side = capacity + 1u; // of a grid of rows
    uint each = clamp(gl_WorkGroupSize.x / share.samples, 1u, kMaxPatchesPerGroup);
    share.firstRecord = lodWord(bucket) + (workgroupIndex() - lodWord(bucket + 3u)) * each;
    share.recordCount = share.firstRecord < next ? min(each, next - share.firstRecord) : 0u;
    return share;
}
