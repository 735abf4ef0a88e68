// The budget: how far all levels are scaled down so that the vertices of a frame fit, from this frame's histograms alone
// (docs/lod.md, "The budget"), and from that the capacity of each bin. One workgroup.
// Sums are of integers: the answer does not depend on the order in which patches were counted.
//
// Loops with a known number of rounds stay loops: if they are unrolled, lavapipe takes three to five times as long to compile them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define LOD_WRITE
#include "shaders/shared/mapping.glsl"
#include "shaders/lod/lod.glsl"

layout(push_constant) uniform Push { LodSolvePush push; };

shared uint sumHigh[kMaxLanes], sumLow[kMaxLanes];

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
                uint weight = lodWords.at[kLodSplit + (p * kLodForms + f) * kLodBinStride + bin];
                if (weight > 0u)
                    add(sum, weight, formSamples(f, capacityOf(capacityOfBin(bin, scaled))));
            }
        }
        if (push.rated == 0u) continue;
        [[dont_unroll]] for (uint bin = lane; bin < kRatedBins; bin += gl_WorkGroupSize.x) {
            if (float(bin) > scaled) add(sum, lodWords.at[kLodRatedMore + p * kRatedBins + bin], kSplitUnit);
        }
    }
    if (push.rated != 0u && lane == 0u) add(sum, lodWords.at[kLodRated], kSplitUnit);
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

    // Capacities at the solution: from one value for all, for patches are placed by the capacity of their bin, and one that was
    // counted elsewhere has no place. What was counted is cleared for the next frame.
    [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
        if ((push.priorities & (1u << p)) == 0u) continue;
        [[dont_unroll]] for (uint bin = lane; bin < kLodBinStride; bin += gl_WorkGroupSize.x) {
            uint c = 0u;
            if (!tooMany) c = capacityOfBin(bin, SUPPLE_LOD_SCALED(push.elasticity[p], x));
            lodWords.at[kLodCapacities + p * kLodBinStride + bin] = c;
        }
        [[dont_unroll]] for (uint i = lane; i < kLodForms * kLodBinStride; i += gl_WorkGroupSize.x)
            lodWords.at[kLodSplit + p * kLodForms * kLodBinStride + i] = 0u;
        [[dont_unroll]] for (uint i = lane; push.rated != 0u && i < kRatedBins; i += gl_WorkGroupSize.x)
            lodWords.at[kLodRatedMore + p * kRatedBins + i] = 0u;
    }
    if (lane == 0u) {
        lodWords.at[kLodSolution] = floatBitsToUint(x);
        lodWords.at[kLodSolution + 3u] = x > float(kElasticSteps) ? 1u : 0u;
        [[dont_unroll]] for (uint p = 0u; p < kPriorityCount; ++p) {
            float scaled = SUPPLE_LOD_SCALED(push.elasticity[p], x);
            lodWords.at[kLodSolution + 4u + p] =
                floatBitsToUint(tooMany ? 0.0 : x == 0.0 ? 1.0 : exp2(-scaled / float(kBinsPerOctave)));
        }
        lodWords.at[kLodSolution + 8u] = wanted.x << 24u | wanted.y >> 8u;
    }
}
