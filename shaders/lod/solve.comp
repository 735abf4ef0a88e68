// The budget: how far all levels are scaled down so that the vertices of a frame fit, from this frame's histograms alone
// (docs/lod.md, "The budget"), and from that where everything lies: capacities, buckets, indirect arguments. One workgroup.
// Sums are of integers: the answer does not depend on the order in which patches were counted.
//
// Loops with a known number of rounds stay loops: if they are unrolled, lavapipe takes three to five times as long to compile them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define LOD_WRITE
#define PUSH_CONSTANTS LodSolvePush
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/surface.h"
#include "shaders/lod/lod.glsl"

layout(set = 0, binding = kLodBinding, std430) writeonly buffer LodTargets { uvec4 lodTargets[]; };
layout(push_constant) uniform Push { LodSolvePush push; };

shared uint sumHigh[kMaxLanes], sumLow[kMaxLanes];
shared uint counts[kMaxRuns * kCapacityCount];

// The smallest capacity that patches of a bin, and of the one below it, fit into when levels are scaled by
// 2^(-scaled / kBinsPerOctave). A sixteenth of a bin guards the rounding of log2 and exp2.
uint capacityOfBin(uint bin, float scaled) {
    precise float level = exp2(((float(bin) + 1.0625) - scaled) / float(kBinsPerOctave) - float(kOctavesBelow));
    uint index = 0u; // no branches: unrolled, those are much to compile
    [[dont_unroll]] for (uint i = 0u; i + 1u < kCapacityCount; ++i) index += float(capacityOf(i)) < level ? 1u : 0u;
    return index;
}

void add(inout uvec2 sum, uint a, uint b) { // sum (high, low) + a * b
    uint high, low, carry;
    umulExtended(a, b, high, low);
    sum.y = uaddCarry(sum.y, low, carry);
    sum.x += high + carry;
}
bool above(uvec2 a, uvec2 b) { return a.x > b.x || (a.x == b.x && a.y > b.y); }
float toFloat(uvec2 a) { return float(a.x) * 4294967296.0 + float(a.y); }
uvec2 minus(uvec2 a, uvec2 b) {
    uint borrow;
    uint low = usubBorrow(a.y, b.y, borrow);
    return uvec2(a.x - b.x - borrow, low);
}

// Vertices that the split histogram asks for at a step, in units of 1 / kSplitUnit: an upper bound of what is written.
uvec2 demand(float x) {
    uint lane = gl_LocalInvocationID.x;
    uvec2 sum = uvec2(0u);
    [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
        if ((push.priorities & (1u << p)) == 0u) continue;
        float scaled = SUPPLE_LOD_SCALED(push.elasticity[p], x);
        [[dont_unroll]] for (uint f = 0u; f < kLodForms; ++f) {
            if ((push.forms & (1u << f)) == 0u) continue;
            [[dont_unroll]] for (uint bin = lane; bin < kLodBinStride; bin += gl_WorkGroupSize.x) {
                uint weight = lodWords[kLodSplit + (p * kLodForms + f) * kLodBinStride + bin];
                if (weight > 0u)
                    add(sum, weight, formSamples(f, capacityOf(capacityOfBin(bin, scaled))));
            }
        }
        if (push.rated == 0u) continue;
        [[dont_unroll]] for (uint bin = lane; bin < kRatedBins; bin += gl_WorkGroupSize.x) {
            if (float(bin) > scaled) add(sum, lodWords[kLodRatedMore + p * kRatedBins + bin], kSplitUnit);
        }
    }
    if (push.rated != 0u && lane == 0u) add(sum, lodWords[kLodRated], kSplitUnit);
    sumHigh[lane] = sum.x;
    sumLow[lane] = sum.y;
    barrier();
    uvec2 total = uvec2(0u);
    [[dont_unroll]] for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) {
        uint carry;
        total.y = uaddCarry(total.y, sumLow[i], carry);
        total.x += sumHigh[i] + carry;
    }
    barrier();
    return total;
}

// Draw instances are whole: what a bucket may be filled up by.
uint padded(uint count, uint samples) {
    uint n = patchesPerDraw(samples);
    return (count + n - 1u) / n * n;
}
// Where the bucket of a run and capacity stands.
uint bucketIndex(uint run, uint c) { return bucketIndex(lodWords[kLodRuns + run], run, c); }
uint bucketWord(uint run, uint c) { return kLodBuckets + 4u * bucketIndex(run, c); }
uint dispatchOf(uint run) { return lodWords[kLodRuns + run] >> 16u; }
uint patchesPerGroup(uint samples) { return clamp(gl_WorkGroupSize.x / samples, 1u, kMaxPatchesPerGroup); }

void main() {
    uint lane = gl_LocalInvocationID.x;
    uvec2 limit = uvec2(0u);
    add(limit, push.limit, kSplitUnit);

    // What is wanted; then both ends of the search, the last step only where the first is over; then the middles. One loop, so
    // that the code of demand() is there once.
    int low = -1, high = int(kBudgetSteps), step = 0;
    uvec2 wanted = uvec2(0u), over = wanted, fits = wanted;
    bool tooMany = false, searching = true; // of patches, each at level 1
    for (uint turn = 0u; searching; ++turn) {
        uvec2 d = demand(float(step));
        bool tooMuch = above(d, limit);
        if (turn == 0u) {
            wanted = d;
            step = low;
        } else {
            if (tooMuch) {
                low = step;
                over = d;
            } else {
                high = step;
                fits = d;
            }
            tooMany = turn == 2u && tooMuch;
            searching = turn == 1u ? tooMuch : high - low > 1;
            step = turn == 1u ? high : (low + high) >> 1;
        }
    }
    float x = 0.0;
    if (tooMany) x = float(kBudgetSteps);
    else if (above(over, limit)) x = float(high) + toFloat(minus(over, limit)) / toFloat(minus(over, fits));

    uint buckets = push.runCount * kCapacityCount;
    for (uint i = lane; i < buckets; i += gl_WorkGroupSize.x) counts[i] = 0u;
    barrier();
    // Capacities at the solution, and exact counts by them: from one value, for patches are placed by the capacity of their
    // bin, and one that was counted elsewhere has no place. What was counted is cleared for the next frame.
    [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
        if ((push.priorities & (1u << p)) == 0u) continue;
        [[dont_unroll]] for (uint bin = lane; bin < kLodBinStride; bin += gl_WorkGroupSize.x) {
            uint c = 0u;
            if (!tooMany) c = capacityOfBin(bin, SUPPLE_LOD_SCALED(push.elasticity[p], x));
            lodWords[kLodCapacities + p * kLodBinStride + bin] = c;
            for (uint run = 0u; run < push.runCount; ++run) {
                uint at = kLodCounts + (run * kPriorityCount + p) * kLodBinStride + bin, count = lodWords[at];
                if (count > 0u) {
                    atomicAdd(counts[run * kCapacityCount + c], count);
                    lodWords[at] = 0u;
                }
            }
        }
        [[dont_unroll]] for (uint i = lane; i < kLodForms * kLodBinStride; i += gl_WorkGroupSize.x)
            lodWords[kLodSplit + p * kLodForms * kLodBinStride + i] = 0u;
        [[dont_unroll]] for (uint i = lane; push.rated != 0u && i < kRatedBins; i += gl_WorkGroupSize.x)
            lodWords[kLodRatedMore + p * kRatedBins + i] = 0u;
    }
    barrier();

    // Where buckets begin. One lane: there are some hundred, and their counts lie in workgroup memory.
    if (lane == 0u) {
        uint room = push.room;
        if (push.rated != 0u) { // where levels fall short, rates are at their coarsest
            room -= min(room, lodWords[kLodRated]);
            lodWords[kLodRated] = 0u;
        }
        uint record = 0u, vertex = 0u, group = 0u, patches = 0u, counted = 0u, last = kEmptyRecord;
        for (uint run = 0u; run < push.runCount; ++run) {
            uint form = lodWords[kLodRuns + run] & 255u, dispatch = dispatchOf(run);
            if (dispatch != last) {
                group = 0u;
                last = dispatch;
            }
            uint at = bucketWord(run, 0u);
            [[dont_unroll]] for (uint c = 0u; c < kCapacityCount; ++c, at += 4u) {
                uint b = run * kCapacityCount + c, samples = formSamples(form, capacityOf(c));
                lodWords[at] = record;
                lodWords[at + 1u] = vertex;
                lodWords[at + 2u] = 0u;
                lodWords[at + 3u] = group;
                uint whole = padded(counts[b], samples), each = patchesPerGroup(samples);
                counted += counts[b];
                if (whole > (room - vertex) / samples) { // only where even levels of 1 are too many
                    uint n = patchesPerDraw(samples);
                    whole = (room - vertex) / (n * samples) * n;
                    counts[b] = min(counts[b], whole);
                }
                record += whole;
                vertex += whole * samples;
                group += (whole + each - 1u) / each;
                patches += counts[b];
            }
            lodWords[at] = record; // the next run's first, or the end of the group's
        }
        lodWords[kLodSolution] = floatBitsToUint(x);
        lodWords[kLodSolution + 1u] = vertex;
        lodWords[kLodSolution + 2u] = patches;
        lodWords[kLodSolution + 3u] = x > float(kElasticSteps) ? 1u : 0u;
        [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
            float scaled = SUPPLE_LOD_SCALED(push.elasticity[p], x);
            lodWords[kLodSolution + 4u + p] =
                floatBitsToUint(tooMany ? 0.0 : x == 0.0 ? 1.0 : exp2(-scaled / float(kBinsPerOctave)));
        }
        lodWords[kLodSolution + 8u] = wanted.x << 24u | wanted.y >> 8u;
        lodWords[kLodSolution + 9u] = counted;
        lodWords[kLodSolution + 10u] = lodWords[kLodHidden];
        lodWords[kLodHidden] = 0u;
    }
    memoryBarrierBuffer();
    barrier();

    for (uint b = lane; b < buckets; b += gl_WorkGroupSize.x) {
        uint run = b / kCapacityCount, c = b - run * kCapacityCount;
        uint form = lodWords[kLodRuns + run] & 255u, samples = formSamples(form, capacityOf(c));
        uint perDraw = patchesPerDraw(samples), whole = padded(counts[b], samples);
        uint at = bucketWord(run, c), record = lodWords[at], vertex = lodWords[at + 1u];
        uint grid = kLodGrids + 2u * (form * kCapacityCount + c), draw = kLodDraws + 5u * b;
        lodWords[draw] = lodWords[grid + 1u];
        lodWords[draw + 1u] = whole / perDraw;
        lodWords[draw + 2u] = lodWords[grid];
        lodWords[draw + 3u] = vertex;
        lodWords[draw + 4u] = 0u;
        for (uint i = counts[b]; i < whole; ++i) { // empty records: evaluation makes points of them
            uint to = (kLodRecords + kLodRecordWords * (record + i)) / 4u;
            lodTargets[to] = uvec4(kEmptyRecord, 0u, vertex + i * samples, c);
            for (uint k = 1u; k < kLodRecordWords / 4u; ++k) lodTargets[to + k] = uvec4(0u);
        }
    }
    for (uint run = lane; run < push.runCount; run += gl_WorkGroupSize.x) {
        uint dispatch = dispatchOf(run);
        if (dispatch >= kMaxRuns) continue; // given back by a group that is gone
        if (run > 0u && dispatchOf(run - 1u) == dispatch) continue;
        uint end = run + 1u;
        while (end < push.runCount && dispatchOf(end) == dispatch) ++end;
        uint first = bucketWord(run, 0u), last = bucketWord(end - 1u, kCapacityCount - 1u);
        uint samples = formSamples(lodWords[kLodRuns + end - 1u] & 255u, capacityOf(kCapacityCount - 1u));
        uint firstRecord = lodWords[first], whole = padded(counts[end * kCapacityCount - 1u], samples);
        uint recordCount = lodWords[last] + whole - firstRecord;
        uint each = patchesPerGroup(samples);
        uint groupCount = kWide ? lodWords[last + 3u] + (whole + each - 1u) / each
                                : (recordCount + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
        uint rows = max((groupCount + push.maxGroups - 1u) / push.maxGroups, 1u);
        uint at = kLodDispatches + 8u * dispatch;
        lodWords[at] = groupCount > 0u ? (groupCount + rows - 1u) / rows : 0u;
        lodWords[at + 1u] = rows;
        lodWords[at + 2u] = 1u;
        lodWords[at + 3u] = firstRecord;
        lodWords[at + 4u] = recordCount;
        lodWords[at + 5u] = bucketIndex(run, 0u);
        lodWords[at + 6u] = (end - run) * kCapacityCount;
        lodWords[at + 7u] = groupCount;
    }
}
