// What a few rays meet first: a lane a piece of a surface and instance. There are two dispatches. The first finds the least t of
// each ray, the second the first lane that has it; most lanes are done there when their box has been looked at.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"

void main() {
    uint lanes = push.pieceCount * push.instanceCount, id = invocationIndex(), block = id / max(lanes, 1u), lane = id - block * lanes;
    uint firstRay = push.firstRay + block * kRaysPerLane, endRay = min(firstRay + kRaysPerLane, push.rayCount);
    if (firstRay >= push.rayCount) return;
    uint listed = lane / push.pieceCount, number = lane - listed * push.pieceCount;
    vec3 low = boxes.at[2u * (push.firstBox + listed)].xyz, high = boxes.at[2u * (push.firstBox + listed) + 1u].xyz;
    float size = length(high - low);
    if (!(size >= 0.0) || low.x > high.x) return;
    vec3 lowOfAll = low, highOfAll = high;
    grow(lowOfAll, highOfAll, push.reach);
    // Rays that the instance may be met by, then those that the piece may.
    uint asked = 0u;
    for (uint r = firstRay; r < endRay; ++r) {
        Ray ray = rayOf(r);
        if (ray.sound && mayMeet(ray, lowOfAll, highOfAll)) asked |= 1u << (r - firstRay);
    }
    if (asked == 0u) return;
    Piece own = pieceOf(number, slotOfListed(listed));
    vec3 ownLow, ownHigh;
    boxOf(own, ownLow, ownHigh);
    for (uint r = firstRay; r < endRay; ++r) {
        if ((asked >> (r - firstRay) & 1u) == 0u) continue;
        Ray ray = rayOf(r);
        uint least = best.at[r].x;
        if (push.work == kFindOwner && least == kNothingMet) continue;
        // No farther than what has been found.
        if (least != kNothingMet) ray.to = min(ray.to, uintBitsToFloat(least) * ray.unit * 1.000001);
        if (push.work == kFindOwner) ray.from = max(ray.from, uintBitsToFloat(least) * ray.unit * 0.999999);
        if (!mayMeet(ray, ownLow, ownHigh)) continue;
        vec3 c[kPieceCoefficients];
        loadCoefficients(own, c);
        turnTo(ray, own.first, c);
        ray = rayOf(r); // the whole range, so that both dispatches find the same point
        Met met = meet(own.kind, c, ray.from, ray.to, ray.from, toleranceFor(low, high, ray.origin), 0.0);
        if (met.distance < 0.0) continue;
        uint t = floatBitsToUint(met.distance / ray.unit);
        if (push.work == kFindLeast) atomicMin(best.at[r].x, t);
        else if (t == least) atomicMin(best.at[r].y, push.firstLane + lane);
    }
}
