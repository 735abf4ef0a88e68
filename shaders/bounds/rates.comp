// Rates pass: which rate each instance takes of those that its group has, by its level as the budget scales it, and lists,
// counts, dispatches and draws of every rate. One workgroup; what is drawn the list pass has found.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define PUSH_CONSTANTS RatesPush
#include "shaders/bounds/list.glsl"
#include "shaders/shared/lod.h"

BUFFER(, Words, kViewWordsBinding, std430, uint, words)

// The demand pass does not tell levels above this apart.
const float kMostOverRate = exp2(float(kRatedBins - 4u) / float(kBinsPerOctave));

shared uint countsOf[kMaxRates * kMaxLanes];

uint rateOf(uint entry) {
    float level = bounds.at[2u * (entry & kInstanceSlotMask)].w, scale = 1.0;
    uint priority = SUPPLE_INSTANCE_PRIORITY(entry), rate = 0u;
    if (push.counted != 0u) scale = uintBitsToFloat(words.at[kLodSolution + 4u + priority]);
    for (; rate + 1u < push.rateCount; ++rate) {
        float enough = float(push.firstRate << rate);
        if (!(scale * min(level, kMostOverRate * enough) > enough)) break;
    }
    return rate;
}

// `first`: entry of the rate's list.
void storeDraw(uint i, uvec4 draw, uint instances, uint first) {
    uint at = push.firstDraw + 5u * i;
    argumentWords.at[at] = draw.x;
    argumentWords.at[at + 1u] = draw.z * instances;
    argumentWords.at[at + 2u] = draw.y;
    argumentWords.at[at + 3u] = 0u;
    argumentWords.at[at + 4u] = draw.z * first;
}

bool isDrawn(uint entry) { return state(entry & kInstanceSlotMask).y != 0u; }
bool shows(uint entry, uint part) {
    if ((entry & kInstanceHidesParts) == 0u) return true;
    uint mask = push.masks + (entry & kInstanceSlotMask) * push.maskWords + 1u;
    return (list.at[mask + part / 32u] >> (part & 31u) & 1u) == 0u;
}

// List `number` of every rate: those of all `entries` that show the part. And the draws that read it.
void listPart(uint number, uint entries) {
    uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x, each = (entries + lanes - 1u) / lanes;
    uint part = tableElements.at[push.windowCount + push.argumentCount + push.drawCount + number - 1u].x;
    uint first = (1u + number) * push.capacity;
    uvec2 run = min(uvec2(lane, lane + 1u) * each, uvec2(entries));
    uint totals[kMaxRates], places[kMaxRates];
    for (uint r = 0u; r < push.rateCount; ++r) countsOf[r * lanes + lane] = 0u;
    for (uint i = run.x; i < run.y; ++i) {
        uint entry = hostEntry(i);
        if (isDrawn(entry) && shows(entry, part)) countsOf[rateOf(entry) * lanes + lane] += 1u;
    }
    barrier();
    for (uint r = 0u; r < push.rateCount; ++r) {
        uint before = 0u, count = 0u;
        [[dont_unroll]] for (uint l = 0u; l < lanes; ++l) {
            if (l == lane) before = count;
            count += countsOf[r * lanes + l];
        }
        places[r] = push.rateLists + r * push.rateStride + first + before;
        totals[r] = count;
    }
    barrier();
    for (uint i = run.x; i < run.y; ++i) {
        uint entry = hostEntry(i);
        if (!isDrawn(entry) || !shows(entry, part)) continue;
        uint rate = rateOf(entry);
        list.at[places[rate]] = entry & kInstanceSlotMask;
        places[rate] += 1u;
    }
    for (uint i = lane; i < push.drawCount; i += lanes) {
        uvec4 draw = tableElements.at[push.windowCount + push.argumentCount + i];
        if (draw.w >> kDrawListShift == number) storeDraw(i, draw, totals[draw.w & ((1u << kDrawListShift) - 1u)], first);
    }
}

void main() {
    if (isFurtherWorkgroup()) return;
    uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x, entries = 0u;
    uint totals[kMaxRates];
    uvec2 places[kMaxRates];
    for (uint r = 0u; r < kMaxRates; ++r) totals[r] = 0u;
    for (uint w = 0u; w < push.windowCount; ++w) {
        uvec4 window = tableElements.at[w];
        uvec2 run = runOf(window);
        entries += window.y;
        for (uint r = 0u; r < push.rateCount; ++r) countsOf[r * lanes + lane] = 0u;
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i);
            if (state(entry & kInstanceSlotMask).y != 0u) countsOf[rateOf(entry) * lanes + lane] += 1u;
        }
        barrier();
        for (uint r = 0u; r < push.rateCount; ++r) {
            uint before = 0u, count = 0u;
            [[dont_unroll]] for (uint l = 0u; l < lanes; ++l) {
                if (l == lane) before = count;
                count += countsOf[r * lanes + l];
            }
            uint list = push.rateLists + r * push.rateStride;
            places[r] = list + before + uvec2(totals[r], window.w);
            totals[r] += count;
            if (lane == 0u) argumentWords.at[push.rateCounts + r * push.windowCount + w] = count;
            for (uint i = lane; i < push.argumentCount; i += lanes) {
                uvec4 argument = tableElements.at[push.windowCount + i];
                if (argument.z == kCountRate + r)
                    storeDispatch(argument.w + push.argumentStride * w, argument.x * count, argument.y);
            }
        }
        barrier();
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i), slot = entry & kInstanceSlotMask, drawn = state(slot).y;
            if (drawn == 0u) continue;
            uint rate = rateOf(entry), flags = entry & ~kInstanceSlotMask;
            list.at[places[rate].x] = slot;
            list.at[places[rate].y] = (slot - window.z) | flags | (drawn == kDrawnWithPast ? 0u : kInstanceIsNew);
            places[rate] += 1u;
        }
    }
    for (uint i = lane; i < push.drawCount; i += lanes) {
        uvec4 draw = tableElements.at[push.windowCount + push.argumentCount + i];
        if (draw.w >> kDrawListShift == 0u) storeDraw(i, draw, totals[draw.w], 0u);
    }
    for (uint number = 1u; number <= push.partCount; ++number) listPart(number, entries);
    if (lane == 0u && push.counted != 0u) {
        for (uint r = 0u; r < push.rateCount; ++r) atomicAdd(words.at[kLodSolution + 1u], totals[r] * push.vertices[r]);
    }
}
