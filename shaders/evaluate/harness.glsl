// Evaluation of patches, as all schemes do it: which patches a lane works on, what lanes share, where samples are stored.
// Narrow mapping: one lane per patch. Wide mapping: a workgroup takes a few patches. Its lanes load the parts of these patches
// into workgroup memory and then share the samples. With LEVELS, patches are records of a view (docs/lod.md). Without it, all
// patches have the rate of the push constants.
//
// Before the include, a scheme includes tables.glsl and defines
//   kRecordElements   table elements per patch
//   kForm             the form of its grids at levels
//   kParts            wide mapping: parts per patch
//   OWN_WIDE          a macro, if its own evaluateWide() is faster than evaluateWideSamples()
//   CHOOSES_WIDE      a macro, if its own evaluateWide() chooses between that and another way
//   LANE_PATCH        a macro, if evaluatePatch() is there in the wide mapping, too: where a rate has patches enough for all lanes of a
//                     GPU (kLanePatch), a lane takes one, and workgroups have kPatchLanes lanes
// and behind it the functions that are declared here.
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/todays_pool.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/lod/record.glsl"

struct PatchPlace {
    uint record;   // its first table element
    uint base;     // where the coefficients of its instance begin in the pool
    uint vertex;   // its first surface vertex
    uint own;      // the same within its instance; at levels the view has all vertices, and it is the same
    uint capacity; // at levels: segments along a side
    uint capacityIndex;
    bool isNew;    // at levels: its instance has no past
    bool empty;    // at levels: there is no patch; all vertices are at the origin
};

#ifdef LEVELS
PatchPlace placeOf(const LodRecord r) {
    setPast(r.isNew);
    // Frames have the places of their coefficients in turns: every slot has two words.
    bool past = kVertexFormat == kVertexPosition && !r.isNew && push.window.pools != 0u;
    uint pool = poolBaseIn(past ? push.window.pools ^ 1u : push.window.pools, r.slot);
    return PatchPlace(push.table + kRecordElements * r.patchIndex, pool, r.firstVertex, r.firstVertex,
                      r.capacity, r.capacityIndex, r.isNew, r.isEmpty);
}
#else
PatchPlace placeOf(uint item) {
    uint instance = instanceOf(item), element = elementOf(item);
    uint own = push.firstVertex + element * push.samples;
    return PatchPlace(push.table + kRecordElements * element, instance * header.poolStride,
                      instance * push.verticesPerInstance + own, own, 0u, 0u, false, false);
}
#endif

// Instances without a past have today's coefficients as their previous ones.
vec3 coefficient(uint i, bool isNew) {
#ifdef LEVELS
    return kVertexFormat == kVertexPosition && isNew ? todaysVector(i) : poolVector(i);
#else
    return poolVector(i);
#endif
}

#ifndef WIDE
#ifdef LEVELS
void evaluatePatch(const PatchPlace at, uint lodRecord); // with its patterns: recordPattern()

void main() {
    uint record = lodRecordElement(lodRecordOfLane());
    evaluatePatch(placeOf(lodRecordOf(lodElement(record))), record);
}
#else
void evaluatePatch(const PatchPlace at);

void main() { evaluatePatch(placeOf(itemOfLane())); }
#endif
#else

// The patches of a workgroup. To be called by all lanes.
#ifdef LEVELS
Share shareOfGroup() {
    Share share = lodShareOfGroup(kForm);
    loadRecords(share);
    return share;
}
#define PATCH_IN_PLACE(share, place) placeOf(localRecord(place))
#else
Share shareOfGroup() {
    uint total = push.count * instanceCount(), first = workgroupIndex() * push.patchesPerGroup;
    return Share(first, first < total ? min(push.patchesPerGroup, total - first) : 0u, push.samples, push.rate + 1u, 0u);
}
#define PATCH_IN_PLACE(share, place) placeOf(share.first + (place))
#endif

void evaluateWide();
#ifdef LANE_PATCH
layout(constant_id = kLanePatchConstant) const bool kLanePatch = false;
void evaluatePatch(const PatchPlace at);
void evaluateLanePatch() {
    Share share = shareOfGroup();
    if (gl_LocalInvocationID.x < share.count) evaluatePatch(PATCH_IN_PLACE(share, gl_LocalInvocationID.x));
}
#endif
#ifndef OWN_WIDE
void loadPart(uint to, const PatchPlace at, uint part); // a part of a patch into part `to` of the workgroup's memory
void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame);

void evaluateWideSamples() {
    Share share = shareOfGroup();
    for (uint n = gl_LocalInvocationID.x; n < share.count * kParts; n += gl_WorkGroupSize.x) {
        uint place = n / kParts;
        PatchPlace at = PATCH_IN_PLACE(share, place);
        if (!kLod || !at.empty) loadPart(n, at, n - place * kParts);
    }
    barrier();
    for (uint n = gl_LocalInvocationID.x; n < share.count * share.samples; n += gl_WorkGroupSize.x) {
        uint place = n / share.samples, index = n - place * share.samples;
        PatchPlace at = PATCH_IN_PLACE(share, place);
        vec3 position = vec3(0.0);
        Frame frame = Frame(vec3(0.0), vec3(0.0), vec3(0.0));
        if (!kLod || !at.empty) evaluateSample(place, at, index, position, frame);
        storeSurfaceVertex(at.vertex + index, at.own + index, position, frame);
    }
}
#ifndef CHOOSES_WIDE
void evaluateWide() {
#ifdef LANE_PATCH
    if (kLanePatch) {
        evaluateLanePatch();
        return;
    }
#endif
    evaluateWideSamples();
}
#endif
#endif

void main() { evaluateWide(); }
#endif
