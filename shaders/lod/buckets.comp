// Where everything lies once patches are counted (count.comp): buckets, draws, dispatches, and what fills up draw instances
// (docs/lod.md, "The budget"). One workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define LOD_WRITE
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/surface.h"
#include "shaders/lod/lod.glsl"

BUFFER(writeonly, LodTargets, kLodBinding, std430, uvec4, lodTargets)
layout(push_constant) uniform Push { LodSolvePush push; };

shared uint sumRecords[kMaxLanes], sumVertices[kMaxLanes];

uint runWord(uint run) { return lodWords.at[kLodRuns + kLodRunWords * run]; }
uint dispatchOf(uint run) { return lodWords.at[kLodRuns + kLodRunWords * run + 1u] >> 16u; }
uint bucketWord(uint run, uint c) {
    uint first = firstOfGroup(lodWords.at[kLodRuns + kLodRunWords * run + 1u], run);
    return SUPPLE_LOD_BUCKETS(push.runs) + 4u * bucketIndex(first, run, c);
}
uint drawWord(uint run, uint c) { return SUPPLE_LOD_DRAWS(push.runs) + kLodDrawWords * (run * kCapacityCount + c); }
// Draw instances are whole: what a bucket may be filled up by.
uint padded(uint count, uint samples) {
    uint n = patchesPerDraw(samples);
    return (count + n - 1u) / n * n;
}
// Wide mapping: workgroups that evaluate so many records of a run with this word.
uint groupsOf(uint word, uint c, uint whole) {
    if (!kWide) return 0u;
    uint each = recordsOfGroup(gl_WorkGroupSize.x, runHasLines(word), runForm(word), capacityOf(c));
    return (whole + each - 1u) / each;
}

// The first `count` of some words; those behind the fourth are 0. CPU devices compile a store as a loop over the lanes, and every
// place in the code by itself: so words take turns in one place.
void storeWords(uint at, uint count, uvec4 words) {
    [[dont_unroll]] for (uint k = 0u; k < count; ++k) {
        uint word = k == 0u ? words.x : k == 1u ? words.y : k == 2u ? words.z : k == 3u ? words.w : 0u;
        lodWords.at[at + k] = word;
    }
}

struct Place {
    uint record, vertex, patches, counted;
};
// What runs take if there is room for all.
Place sizeOf(uint first, uint end) {
    Place sum = Place(0u, 0u, 0u, 0u);
    for (uint run = first; run < end; ++run) {
        uint form = runForm(runWord(run));
        [[dont_unroll]] for (uint c = 0u; c < kCapacityCount; ++c) {
            uint samples = formSamples(form, capacityOf(c)), whole = padded(lodWords.at[drawWord(run, c) + kLodDrawCount], samples);
            sum.record += whole;
            sum.vertex += whole * samples;
        }
    }
    return sum;
}
// Workgroups of a dispatch that stand before the run.
uint groupsBefore(uint run) {
    uint dispatch = dispatchOf(run), groups = 0u;
    if (!kWide) return 0u;
    for (; run > 0u && dispatchOf(run - 1u) == dispatch; --run) {
        uint word = runWord(run - 1u);
        [[dont_unroll]] for (uint c = 0u; c < kCapacityCount; ++c) {
            uint samples = formSamples(runForm(word), capacityOf(c));
            groups += groupsOf(word, c, padded(lodWords.at[drawWord(run - 1u, c) + kLodDrawCount], samples));
        }
    }
    return groups;
}
// Places the buckets of runs one after the other.
void placeRuns(uint first, uint end, inout Place at, uint room) {
    uint group = first < end ? groupsBefore(first) : 0u;
    for (uint run = first; run < end; ++run) {
        if (run > first && dispatchOf(run) != dispatchOf(run - 1u)) group = 0u;
        uint word = runWord(run), bucket = bucketWord(run, 0u);
        [[dont_unroll]] for (uint c = 0u; c < kCapacityCount; ++c, bucket += 4u) {
            uint samples = formSamples(runForm(word), capacityOf(c)), draw = drawWord(run, c) + kLodDrawCount, count = lodWords.at[draw];
            storeWords(bucket, 4u, uvec4(at.record, at.vertex, 0u, group));
            uint whole = padded(count, samples);
            at.counted += count;
            if (whole > (room - at.vertex) / samples) { // only where even levels of 1 are too many
                uint n = patchesPerDraw(samples);
                whole = (room - at.vertex) / (n * samples) * n;
                count = min(count, whole);
                lodWords.at[draw] = count;
            }
            at.record += whole;
            at.vertex += whole * samples;
            at.patches += count;
            group += groupsOf(word, c, whole);
        }
        lodWords.at[bucket] = at.record; // the next run's first, or the end of the group's
    }
}

void writeDraw(uint run, uint c) {
    uint form = runForm(runWord(run)), samples = formSamples(form, capacityOf(c)), draw = drawWord(run, c), bucket = bucketWord(run, c);
    uint count = lodWords.at[draw + kLodDrawCount], whole = padded(count, samples);
    uint record = lodWords.at[bucket], vertex = lodWords.at[bucket + 1u], grid = kLodGrids + 2u * (form * kCapacityCount + c);
    uvec4 words = uvec4(lodWords.at[grid + 1u], whole / patchesPerDraw(samples), lodWords.at[grid], vertex);
    storeWords(draw, 5u, words);
    for (uint i = count; i < whole; ++i) { // empty records: evaluation makes points of them
        uint to = (SUPPLE_LOD_RECORDS(push.runs) + kLodRecordWords * (record + i)) / 4u;
        lodTargets.at[to] = uvec4(kEmptyRecord, 0u, vertex + i * samples, c);
        for (uint k = 1u; k < kLodRecordWords / 4u; ++k) lodTargets.at[to + k] = uvec4(0u);
    }
}
// The words of the dispatch whose first run this is.
void writeDispatch(uint run, uint dispatch) {
    uint end = run + 1u;
    while (end < push.runCount && dispatchOf(end) == dispatch) ++end;
    uint first = bucketWord(run, 0u), last = bucketWord(end - 1u, kCapacityCount - 1u);
    uint firstRecord = lodWords.at[first], endRecord = lodWords.at[last + 4u], recordCount = endRecord - firstRecord;
    uint groupCount = kWide ? lodWords.at[last + 3u] + groupsOf(runWord(end - 1u), kCapacityCount - 1u, endRecord - lodWords.at[last])
                            : (recordCount + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint rows = max((groupCount + push.maxGroups - 1u) / push.maxGroups, 1u);
    uint at = SUPPLE_LOD_DISPATCHES(push.runs) + kLodDispatchWords * dispatch;
    uvec4 words = uvec4((groupCount + rows - 1u) / rows, rows, 1u, firstRecord);
    [[dont_unroll]] for (uint part = 0u; part < 2u; ++part) {
        storeWords(at + 4u * part, 4u, words);
        words = uvec4(recordCount, (first - SUPPLE_LOD_BUCKETS(push.runs)) / 4u, (end - run) * kCapacityCount, groupCount);
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint room = push.room;
    if (push.rated != 0u) room -= min(room, lodWords.at[kLodRated]); // where levels fall short, rates are at their coarsest

    // Each lane places some runs behind those of the lanes before. If there is no room for all, one lane places all of them.
    uint each = (push.runCount + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint first = min(lane * each, push.runCount), end = min(first + each, push.runCount);
    Place own = sizeOf(first, end);
    sumRecords[lane] = own.record;
    sumVertices[lane] = own.vertex;
    barrier();
    Place at = Place(0u, 0u, 0u, 0u);
    uint vertices = 0u;
    [[dont_unroll]] for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) {
        if (i < lane) {
            at.record += sumRecords[i];
            at.vertex += sumVertices[i];
        }
        vertices += sumVertices[i];
    }
    barrier();
    if (vertices > room) {
        first = 0u;
        end = lane == 0u ? push.runCount : 0u;
        at = Place(0u, 0u, 0u, 0u);
    }
    placeRuns(first, end, at, room);
    sumRecords[lane] = at.patches;
    sumVertices[lane] = at.counted;
    memoryBarrierBuffer();
    barrier();

    if (lane == 0u) {
        uint patches = 0u, counted = 0u;
        [[dont_unroll]] for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) {
            patches += sumRecords[i];
            counted += sumVertices[i];
        }
        lodWords.at[kLodSolution + 1u] = vertices > room ? at.vertex : vertices;
        lodWords.at[kLodSolution + 2u] = patches;
        lodWords.at[kLodSolution + 9u] = counted;
        lodWords.at[kLodSolution + 10u] = lodWords.at[kLodHidden];
        lodWords.at[kLodHidden] = 0u;
        if (push.rated != 0u) lodWords.at[kLodRated] = 0u;
    }
    for (uint b = lane; b < push.runCount * kCapacityCount; b += gl_WorkGroupSize.x)
        writeDraw(b / kCapacityCount, b % kCapacityCount);
    for (uint run = lane; run < push.runCount; run += gl_WorkGroupSize.x) {
        uint dispatch = dispatchOf(run);
        if (dispatch >= push.runs) continue; // given back by a group that is gone
        if (run > 0u && dispatchOf(run - 1u) == dispatch) continue;
        writeDispatch(run, dispatch);
    }
}
