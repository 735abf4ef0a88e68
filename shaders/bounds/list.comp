// List pass: the instances that are seen, in the host's order, and the arguments of what is dispatched and drawn for them.
// One workgroup; every lane takes a run of entries, so that places follow from counts alone and are the same every time.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/bounds/cull.glsl"

layout(set = 0, binding = kBoundsStateTexelBinding) uniform usamplerBuffer stateTexels;
layout(set = 0, binding = kListBinding, std430) writeonly buffer List { uint list[]; };
layout(set = 0, binding = kListArgumentBinding, std430) writeonly buffer Arguments { uint argumentWords[]; };
layout(set = 0, binding = kListTableBinding, std430) readonly buffer Table { uvec4 tableElements[]; };
layout(set = 0, binding = kBoundsBinding, std430) readonly buffer Bounds { vec4 bounds[]; };
layout(set = 0, binding = kSizeBinding, std430) readonly buffer Sizes { uint sizes[]; };
layout(push_constant) uniform Push { ListPush push; };

shared uvec4 countsOf[kMaxLanes]; // with a past, new, left out, occluded
shared uint sumsOf[kMaxLanes];
shared uint sharedThreshold;
shared uint rateCountsOf[kMaxRates * kMaxLanes];

uint saturatingSum(uint a, uint b) { return a + min(b, ~a); }

// What is seen with a state up to this one has no room: whole bins of sizes go, the smallest first, so that all that is left
// fits at its coarsest. Every group of the view finds the same.
uint threshold() {
    uint lane = gl_LocalInvocationID.x, each = (kSizeRanks + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * each, kSizeRanks), end = min(begin + each, kSizeRanks), own = 0u; // the largest first
    for (uint i = begin; i < end; ++i) own = saturatingSum(own, sizes[kSizeRanks - 1u - i]);
    sumsOf[lane] = own;
    if (lane == 0u) sharedThreshold = 0u;
    barrier();
    uint before = 0u;
    for (uint l = 0u; l < lane; ++l) before = saturatingSum(before, sumsOf[l]);
    if (before <= push.room && saturatingSum(before, own) > push.room) {
        uint i = begin;
        for (uint sum = before; i < end; ++i) {
            sum = saturatingSum(sum, sizes[kSizeRanks - 1u - i]);
            if (sum > push.room) break;
        }
        sharedThreshold = kSizeRanks - i;
    }
    barrier();
    return sharedThreshold;
}

uvec2 state(uint slot) {
    if (kWide) return states[slot];
    return texelFetch(stateTexels, int(slot)).xy;
}

// The entry with kInstanceIsNew as it is now.
uint withPast(uint entry, uvec2 state) { return state.y != 0u ? entry : entry | kInstanceIsNew; }

// One of: seen and with a past, seen and new, left out, occluded; none where it is not seen anyway.
uvec4 kind(uint entry, uvec2 state, uint leftOut) {
    if (state.x == 0u) return uvec4(0u);
    if (state.x == kOccluded) return uvec4(0u, 0u, 0u, 1u);
    if (state.x <= leftOut) return uvec4(0u, 0u, 1u, 0u);
    return (withPast(entry, state) & kInstanceIsNew) != 0u ? uvec4(0u, 1u, 0u, 0u) : uvec4(1u, 0u, 0u, 0u);
}

bool isDrawn(uvec2 state, uint leftOut) { return state.x > leftOut && state.x != kOccluded; }

void storeHeader(uint at, uvec4 counts, uint listed) {
    argumentWords[at] = counts.x + counts.y;
    argumentWords[at + 1u] = counts.x;
    argumentWords[at + 2u] = listed;
    argumentWords[at + 3u] = counts.z;
    argumentWords[at + 4u] = counts.w;
}

void storeDispatch(uint at, uint elements, uint perGroup) {
    uint groups = elements / perGroup + (elements % perGroup != 0u ? 1u : 0u);
    uint rows = max(groups / push.maxGroups + (groups % push.maxGroups != 0u ? 1u : 0u), 1u);
    argumentWords[at] = groups / rows + (groups % rows != 0u ? 1u : 0u);
    argumentWords[at + 1u] = rows;
    argumentWords[at + 2u] = 1u;
}

// Lanes share the arguments of a window, of all of its instances or of those at a rate.
void storeArguments(uint which, uint instances, uint window) {
    for (uint i = gl_LocalInvocationID.x; i < push.argumentCount; i += gl_WorkGroupSize.x) {
        uvec4 argument = tableElements[push.windowCount + i];
        if (argument.z == which)
            storeDispatch(argument.w + push.argumentStride * window, argument.x * instances, argument.y);
    }
}

uint rateOf(uint slot) {
    float level = bounds[2u * slot].w;
    uint rate = 0u;
    while (rate + 1u < push.rateCount && float(push.firstRate << rate) < level) ++rate;
    return rate;
}

// The lane's run of a window's entries.
uvec2 runOf(uvec4 window) {
    uint lane = gl_LocalInvocationID.x, each = (window.y + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    return window.x + min(uvec2(lane, lane + 1u) * each, window.yy);
}

// The lists of all rates, before anything is noted as seen.
void listRates(uint leftOut) {
    uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x;
    uint totals[kMaxRates];
    uvec2 places[kMaxRates];
    for (uint r = 0u; r < kMaxRates; ++r) totals[r] = 0u;
    for (uint w = 0u; w < push.windowCount; ++w) {
        uvec4 window = tableElements[w];
        uvec2 run = runOf(window);
        for (uint r = 0u; r < push.rateCount; ++r) rateCountsOf[r * lanes + lane] = 0u;
        for (uint i = run.x; i < run.y; ++i) {
            uint slot = hostEntry(i) & kInstanceSlotMask;
            if (isDrawn(state(slot), leftOut)) rateCountsOf[rateOf(slot) * lanes + lane] += 1u;
        }
        barrier();
        for (uint r = 0u; r < push.rateCount; ++r) {
            uint before = 0u, count = 0u;
            for (uint l = 0u; l < lanes; ++l) {
                if (l == lane) before = count;
                count += rateCountsOf[r * lanes + l];
            }
            uint list = push.rateLists + r * push.rateStride;
            places[r] = list + before + uvec2(totals[r], window.w);
            totals[r] += count;
            if (lane == 0u) argumentWords[push.rateCounts + r * push.windowCount + w] = count;
            storeArguments(kCountRate + r, count, w);
        }
        barrier();
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i), slot = entry & kInstanceSlotMask;
            uvec2 now = state(slot);
            if (!isDrawn(now, leftOut)) continue;
            uint rate = rateOf(slot);
            list[places[rate].x] = slot;
            list[places[rate].y] = (slot - window.z) | (withPast(entry, now) & ~kInstanceSlotMask);
            places[rate] += 1u;
        }
    }
    for (uint i = lane; i < push.drawCount; i += lanes) {
        uvec4 draw = tableElements[push.windowCount + push.argumentCount + i];
        uint at = push.firstDraw + 5u * i;
        argumentWords[at] = draw.x;
        argumentWords[at + 1u] = draw.z * totals[draw.w];
        argumentWords[at + 2u] = draw.y;
        argumentWords[at + 3u] = 0u;
        argumentWords[at + 4u] = 0u;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uvec4 total = uvec4(0u);
    uint listed = 0u, leftOut = push.room != kRoomForAll ? threshold() : 0u;
    if (push.rateCount > 0u) listRates(leftOut);
    for (uint w = 0u; w < push.windowCount; ++w) {
        uvec4 window = tableElements[w];
        uvec2 run = runOf(window);
        uvec4 own = uvec4(0u);
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i);
            own += kind(entry, state(entry & kInstanceSlotMask), leftOut);
        }
        countsOf[lane] = own;
        barrier();
        uvec4 before = uvec4(0u), counts = uvec4(0u);
        for (uint l = 0u; l < gl_WorkGroupSize.x; ++l) {
            if (l == lane) before = counts;
            counts += countsOf[l];
        }
        barrier();

        uint all = push.all + total.x + total.y + before.x + before.y;
        uvec2 places = window.w + uvec2(before.x, counts.x + before.y);
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i), slot = entry & kInstanceSlotMask;
            uvec2 now = state(slot);
            uvec4 one = kind(entry, now, leftOut);
            bool drawn = one.x + one.y > 0u;
            if (drawn) {
                list[all] = slot;
                ++all;
                uint place = one.x != 0u ? places.x : places.y;
                list[place] = (slot - window.z) | (withPast(entry, now) & ~kInstanceSlotMask);
                list[place + push.levels] = floatBitsToUint(bounds[2u * slot].w);
                places += one.xy;
            }
            states[slot].y = drawn ? 1u : 0u;
        }
        if (lane == 0u) storeHeader(kListHeaderWords * (w + 1u), counts, window.y);
        storeArguments(kCountWindow, counts.x + counts.y, w);
        total += counts;
        listed += window.y;
    }
    if (lane == 0u) storeHeader(0u, total, listed);
}
