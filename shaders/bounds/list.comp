// List pass: the instances that are seen, in the host's order, the arguments of what is dispatched and drawn for them, and where
// they have their coefficients. Those places alone depend on which group comes first.
// One workgroup; every lane takes a run of entries, so that places in lists follow from counts alone and are the same every time.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define PUSH_CONSTANTS ListPush
#include "shaders/bounds/list.glsl"
#include "shaders/shared/lod.h"

BUFFER(, Words, kViewWordsBinding, std430, uint, words)
#ifdef TASKS // counts of all groups side by side, behind the sizes: one copy takes them to the host
BUFFER(, Sizes, kSizeBinding, std430, uint, sizes)
void storeCounts(uint at, uint words[5]) {
    [[unroll]] for (uint i = 0u; i < 5u; ++i) sizes.at[at + i] = words[i];
}
#else
BUFFER(readonly, Sizes, kSizeBinding, std430, uint, sizes)
void storeCounts(uint, uint[5]) {}
#endif

shared uvec4 countsOf[kMaxLanes]; // with a past, new, left out, occluded
shared uint sumsOf[kMaxLanes];
shared uint localThreshold;
shared uint firstPool; // of a window's instances

uint saturatingSum(uint a, uint b) { return a + min(b, ~a); }

// What is seen with a state up to this one has no room: whole bins of sizes go, the smallest first, so that all that is left
// fits at its coarsest. Every group of the view finds the same. `need`: where sizes of what they need begin.
uint threshold(uint need, uint room) {
    uint lane = gl_LocalInvocationID.x, each = (kSizeRanks + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * each, kSizeRanks), end = min(begin + each, kSizeRanks), own = 0u; // the largest first
    for (uint i = begin; i < end; ++i) own = saturatingSum(own, sizes.at[need + kSizeRanks - 1u - i]);
    sumsOf[lane] = own;
    if (lane == 0u) localThreshold = 0u;
    barrier();
    uint before = 0u;
    for (uint l = 0u; l < lane; ++l) before = saturatingSum(before, sumsOf[l]);
    if (before <= room && saturatingSum(before, own) > room) {
        uint i = begin;
        for (uint sum = before; i < end; ++i) {
            sum = saturatingSum(sum, sizes.at[need + kSizeRanks - 1u - i]);
            if (sum > room) break;
        }
        localThreshold = kSizeRanks - i;
    }
    barrier();
    uint found = localThreshold;
    barrier(); // the next call writes it
    return found;
}

// The entry with kInstanceIsNew as it is now.
uint withPast(uint entry, uvec2 state) { return state.y != 0u ? entry : entry | kInstanceIsNew; }

// One of: seen and with a past, seen and new, left out, occluded; none where it is not seen anyway.
uvec4 kind(uint entry, uvec2 state, uint leftOut) {
    if (state.x == 0u) return uvec4(0u, 0u, 0u, state.y == kOccluded ? 1u : 0u);
    if (state.x <= leftOut) return uvec4(0u, 0u, 1u, 0u);
    return (withPast(entry, state) & kInstanceIsNew) != 0u ? uvec4(0u, 1u, 0u, 0u) : uvec4(1u, 0u, 0u, 0u);
}

// Whether a group sees it that reads the coefficients which this one constructs.
bool isWanted(uint slot) {
    uint found = 0u;
    [[dont_unroll]] for (uint k = 1u; k <= min(push.sharers, kMaxSharers); ++k) found |= state(push.sharerStride * k + slot).x;
    return found != 0u;
}
void clearWanted(uint slot) {
    [[dont_unroll]] for (uint k = 1u; k <= min(push.sharers, kMaxSharers); ++k) states.at[push.sharerStride * k + slot].x = 0u;
}

// Lists what a window constructs, and counts it. `counts`: what it draws.
uint listConstructed(uvec4 window, uvec2 run, uint leftOut, uvec4 counts) {
    if (push.sharers == 0u) return counts.x + counts.y;
    uint lane = gl_LocalInvocationID.x, own = 0u;
    for (uint i = run.x; i < run.y; ++i) {
        uint entry = hostEntry(i), slot = entry & kInstanceSlotMask;
        uvec4 one = kind(entry, state(slot), leftOut);
        own += one.x + one.y > 0u || isWanted(slot) ? 1u : 0u;
    }
    sumsOf[lane] = own;
    barrier();
    uint place = push.constructed + window.z, count = 0u;
    [[dont_unroll]] for (uint l = 0u; l < gl_WorkGroupSize.x; ++l) {
        place += l < lane ? sumsOf[l] : 0u;
        count += sumsOf[l];
    }
    for (uint i = run.x; i < run.y; ++i) {
        uint entry = hostEntry(i), slot = entry & kInstanceSlotMask;
        uvec4 one = kind(entry, state(slot), leftOut);
        if (one.x + one.y > 0u || isWanted(slot)) {
            list.at[place] = (slot - window.z) | (entry & ~kInstanceSlotMask);
            ++place;
        }
        clearWanted(slot);
    }
    barrier(); // the next window writes the sums
    return count;
}

void storeHeader(uint at, uvec4 counts, uint listed) {
    [[dont_unroll]] for (uint k = 0u; k < 5u; ++k) { // see storeDispatch()
        uint word = k == 0u ? counts.x + counts.y : k == 1u ? counts.x : k == 2u ? listed : k == 3u ? counts.z : counts.w;
        argumentWords.at[at + k] = word;
    }
}

// Lanes share the arguments of a window, of which so many instances are drawn and constructed.
void storeArguments(uint drawn, uint constructed, uint window) {
    for (uint i = gl_LocalInvocationID.x; i < push.argumentCount; i += gl_WorkGroupSize.x) {
        uvec4 argument = tableElements.at[push.windowCount + i];
        uint instances = argument.z == kCountWindow ? drawn : constructed;
        if (argument.z == kCountWindow || argument.z == kCountConstructed)
            storeDispatch(argument.w + push.argumentStride * window, argument.x * instances, argument.y);
    }
}

void main() {
    if (isFurtherWorkgroup()) return;
    uint lane = gl_LocalInvocationID.x;
    uvec4 total = uvec4(0u);
    uint listed = 0u, leftOut = 0u;
    if (push.room != kRoomForAll) {
        [[dont_unroll]] for (uint k = 0u; k < 2u; ++k)
            leftOut = max(leftOut, threshold(k * kSizeRanks, k == 0u ? push.room : push.poolRoom));
    }
    for (uint w = 0u; w < push.windowCount; ++w) {
        uvec4 window = tableElements.at[w];
        uvec2 run = runOf(window);
        uvec4 own = uvec4(0u);
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i);
            own += kind(entry, state(entry & kInstanceSlotMask), leftOut);
        }
        countsOf[lane] = own;
        barrier();
        uvec4 before = uvec4(0u), counts = uvec4(0u);
        [[dont_unroll]] for (uint l = 0u; l < gl_WorkGroupSize.x; ++l) {
            uvec4 one = countsOf[l];
            before += l < lane ? one : uvec4(0u);
            counts += one;
        }
        if (lane == 0u) {
            uint units = push.poolUnits * (counts.x + counts.y);
            firstPool = units > 0u ? atomicAdd(words.at[kLodPoolEnd], units) : 0u;
        }
        barrier();
        uint constructed = listConstructed(window, run, leftOut, counts);

        uint all = push.all + total.x + total.y + before.x + before.y;
        uvec2 places = window.w + uvec2(before.x, counts.x + before.y);
        uint pool = firstPool + push.poolUnits * (before.x + before.y);
        for (uint i = run.x; i < run.y; ++i) {
            uint entry = hostEntry(i), slot = entry & kInstanceSlotMask;
            uvec2 now = state(slot);
            uvec4 one = kind(entry, now, leftOut);
            bool drawn = one.x + one.y > 0u;
            if (drawn) {
                list.at[all] = slot;
                ++all;
                uint place = one.x != 0u ? places.x : places.y;
                list.at[place] = (slot - window.z) | (withPast(entry, now) & ~kInstanceSlotMask);
                list.at[place + push.levels] = floatBitsToUint(bounds.at[2u * slot].w);
                places += one.xy;
                if (push.poolUnits > 0u) list.at[push.pools + 2u * slot] = pool;
                pool += push.poolUnits;
            }
            states.at[slot].y = one.x != 0u ? kDrawnWithPast : drawn ? kDrawn : 0u;
        }
        if (lane == 0u) {
            storeHeader(kListHeaderWords * (w + 1u), counts, window.y);
            argumentWords.at[kListHeaderWords * (w + 1u) + kConstructedWord] = constructed;
        }
        storeArguments(counts.x + counts.y, constructed, w);
        total += counts;
        listed += window.y;
    }
    if (lane == 0u) {
        storeHeader(0u, total, listed);
        storeCounts(push.counts, uint[](total.x + total.y, total.x, listed, total.z, total.w));
    }
}
