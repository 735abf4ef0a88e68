// Evaluation at levels of detail: what a lane or a workgroup takes of a dispatch, and the records of the patches
// (shared/lod.h). Needs tables.glsl.
#include "shaders/lod/lod.glsl"
#include "shaders/lod/pattern.glsl"

// Before the include: kForm, of the grids.

// Records of a view, else all patches at one rate. A macro: what either does without need not be compiled when a pipeline
// is made.
#ifdef LEVELS
const bool kLod = true;
#else
const bool kLod = false;
#endif
layout(constant_id = kLinesConstant) const bool kLines = false; // wide mapping: lanes take lines of samples (kRunHasLines)

struct LodRecord {
    uint patchIndex; // of the range
    bool isEmpty;
    uint slot;       // of the window
    bool isNew;
    uint firstVertex;
    uint capacityIndex, capacity;
};

#ifdef LEVELS
uint lodRecordElement(uint index) { return (SUPPLE_LOD_RECORDS(push.runs) + kLodRecordWords * index) / 4u; }
uint lodDispatchWord() { return SUPPLE_LOD_DISPATCHES(push.runs) + kLodDispatchWords * (push.window.firstRun + push.run); }
// Whatever the words are, the record names a patch, a slot, vertices and a grid that there are. That of an empty one is any patch.
LodRecord lodRecordOf(uvec4 head) {
    LodRecord r;
    r.patchIndex = min(head.x - push.firstPatch, push.count - 1u);
    r.isEmpty = head.x == kEmptyRecord;
    r.slot = min((head.y & kInstanceSlotMask) - push.window.firstSlot, push.window.slots - 1u);
    r.isNew = (head.y & kInstanceIsNew) != 0u;
    r.capacityIndex = min(head.w, kCapacityCount - 1u);
    r.capacity = capacityOf(r.capacityIndex);
    r.firstVertex = min(head.z, push.vertices - formSamples(kForm, r.capacity));
    return r;
}
#endif
// Pattern k of a record, whose elements begin at `element`.
LodPattern recordPattern(uint element, uint k, uint capacityIndex) {
    vec4 two = uintBitsToFloat(lodElement(element + 1u + k / 2u));
    return lodPattern((k & 1u) == 0u ? two.xy : two.zw, capacityIndex);
}

// Directions along a side of a grid of rows and inwards, as those along u and v.
void turnBack(uint side, inout vec3 along, inout vec3 inwards) {
    bool isUpright = (side & 1u) != 0u;
    float signU = SELECT(side == 1u || side == 2u, -1.0, 1.0), signV = SELECT(side >= 2u, -1.0, 1.0);
    vec3 u = signU * SELECT3(isUpright, inwards, along), v = signV * SELECT3(isUpright, along, inwards);
    along = u;
    inwards = v;
}

// A sample of a ring grid (surface/lod/grid.h): its ring, the side of it, and the place along the side, counted from the
// patch's corner.
struct RingSample {
    uint ring, side, k;
};
RingSample ringSample(uint m, uint capacity, uint index) {
    uint ring = 0u;
    for (; ring < (capacity + 1u) / 2u && ringStart(m, ring + 1u, capacity) <= index; ++ring) {}
    uint at = index - ringStart(m, ring, capacity), each = capacity - 2u * ring, side = at / each;
    return RingSample(ring, side, ring + at - side * each);
}
// Weights of corner `side`, of the next corner and of the centre, from the pair along the ring's side, which on the border is
// the edge's own, and from the ring's place across.
vec3 ringWeights(vec2 along, float t) {
    precise vec3 w = vec3(along.y - t, along.x - t, 2.0 * t);
    return w;
}

#ifdef LEVELS
// The record of a lane, in the narrow mapping. Idle lanes repeat the last.
uint lodRecordOfLane() {
    uint at = lodDispatchWord();
    return lodWord(at + 3u) + min(invocationIndex(), lodWord(at + 4u) - 1u);
}

#endif

// Wide mapping: what a workgroup takes of a dispatch. At levels, some records of one bucket.
struct Share {
    uint first, count, samples, side, capacityIndex;
};
#ifdef LEVELS
Share lodShareOfGroup(uint form) {
    uint at = lodDispatchWord();
    uint end = lodWord(at + 3u) + lodWord(at + 4u), first = lodWord(at + 5u), count = min(lodWord(at + 6u), push.runs * kCapacityCount);
    Share share = Share(0u, 0u, 1u, 1u, 0u);
    if (workgroupIndex() >= lodWord(at + 7u)) return share;
    uint buckets = SUPPLE_LOD_BUCKETS(push.runs) + 4u * first;
    uint b = 0u, past = count; // the last bucket that begins at or before this group, and is not empty
    while (past - b > 1u) {
        uint middle = (b + past) / 2u;
        if (lodWord(buckets + 4u * middle + 3u) <= workgroupIndex()) b = middle;
        else past = middle;
    }
    uint bucket = buckets + 4u * b;
    uint next = b + 1u < count ? lodWord(bucket + 4u) : end;
    share.capacityIndex = b % kCapacityCount;
    uint capacity = capacityOf(share.capacityIndex);
    share.samples = formSamples(form, capacity);
    share.side = capacity + 1u; // of a grid of rows
    uint each = recordsOfGroup(gl_WorkGroupSize.x, kLines, form, capacity);
    share.first = lodWord(bucket) + (workgroupIndex() - lodWord(bucket + 3u)) * each;
    share.count = share.first < next ? min(each, next - share.first) : 0u;
    return share;
}
#endif

#if defined(WIDE) && defined(LEVELS)
// The records of a workgroup and their patterns, in workgroup memory. The latter in two parts: one is integers.
const uint kMostRecords = kLines ? kMaxRecordsPerGroup : kMaxPatchesPerGroup;
shared uvec4 localHeads[kMostRecords];
shared uvec2 localPatternBits[6u * kMostRecords];
shared vec2 localPatternWidths[6u * kMostRecords];

// To be called by all lanes. Records have the capacity of their bucket: lanes count lines and samples by it, and their loops must end
// whatever the records' own words are.
void loadRecords(Share share) {
    for (uint n = gl_LocalInvocationID.x; n < 6u * share.count; n += gl_WorkGroupSize.x) {
        uint place = n / 6u, k = n - 6u * place, at = lodRecordElement(share.first + place);
        LodPattern p = recordPattern(at, k, share.capacityIndex);
        localPatternBits[n] = uvec2(p.full, p.fresh);
        localPatternWidths[n] = vec2(p.part, p.inverse);
        if (k == 0u) localHeads[place] = uvec4(lodElement(at).xyz, share.capacityIndex);
    }
    barrier();
}
// Of the record in a place, without its pairs.
LodRecord localRecord(uint place) { return lodRecordOf(localHeads[place]); }
LodPattern localPattern(uint place, uint k) {
    uvec2 bits = localPatternBits[6u * place + k];
    vec2 widths = localPatternWidths[6u * place + k];
    return LodPattern(bits.x, bits.y, widths.x, widths.y);
}
vec2 localPair(uint place, uint k, uint i, uint capacity) { return lodPair(localPattern(place, k), i, capacity); }

// The line of a lane where grids have rows: side n, or one of those inside, of which patches have two fewer than samples along a side.
// Lines inside come first, those of all patches. Sides begin with a subgroup of 32 lanes where there is room for that: fewer subgroups
// then do both.
struct QuadLine {
    uint place;
    uint n; // from 0
    bool isSide;
};
QuadLine quadLineOfLane(Share share) {
    uint lines = share.side - 2u, inside = share.count * lines, lane = gl_LocalInvocationID.x;
    if (lane < inside) {
        uint place = lane / lines;
        return QuadLine(place, lane - place * lines, false);
    }
    uint sides = (inside + 31u) & ~31u;
    if (sides + 4u * share.count > gl_WorkGroupSize.x) sides = inside;
    return QuadLine(lane < sides ? share.count : (lane - sides) / 4u, (lane - sides) & 3u, true);
}
// The line of a lane where grids have rings: line n of as many as a sector of a patch has.
struct RingLine {
    uint place, sector, n, lines;
};
RingLine ringLineOfLane(Share share) {
    uint lines = ringLines(share.side - 1u), each = formSides(kForm) * lines, place = gl_LocalInvocationID.x / each;
    uint n = gl_LocalInvocationID.x - place * each, sector = n / lines;
    return RingLine(place, sector, n - sector * lines, lines);
}

// Parameters of a sample on a border are the edge's, else the patch's own. At a corner they are 0 and 1 themselves.
vec2 lodU(uint place, uint capacity, uint i, uint j) {
    if (i == 0u) return vec2(0.0, 1.0);
    if (i == capacity) return vec2(1.0, 0.0);
    return localPair(place, j == 0u ? 2u : j == capacity ? 4u : 0u, i, capacity);
}
vec2 lodV(uint place, uint capacity, uint i, uint j) {
    if (j == 0u) return vec2(0.0, 1.0);
    if (j == capacity) return vec2(1.0, 0.0);
    return localPair(place, i == capacity ? 3u : i == 0u ? 5u : 1u, j, capacity);
}
vec3 ringWeights(uint place, uint capacity, RingSample s, out vec2 along) {
    along = localPair(place, s.ring == 0u ? 1u + s.side : 0u, s.k, capacity);
    return ringWeights(along, localPair(place, 0u, s.ring, capacity).x);
}
#endif
