// Which points are nearest to some places: a lane a piece of a surface and instance. There are three dispatches. The first bounds
// how far the nearest point of all is, by boxes alone. The second finds the least distance: few pieces come near enough to be looked
// at. The third finds the first lane that comes as near (tieOf).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/nearest.glsl"

// Whether all vertices of a piece are numbers: a box leaves out those that are not.
bool isFinite(const Piece own) {
    for (uint k = 0u; k < own.vertexCount; ++k) {
        if (!finite(vertexOf(own, k).xyz)) return false;
    }
    return true;
}

void main() {
    uint lanes = push.pieceCount * push.instanceCount, id = invocationIndex(), block = id / max(lanes, 1u), lane = id - block * lanes;
    uint first = push.firstRay + block * kRaysPerLane, end = min(first + kRaysPerLane, push.rayCount);
    if (first >= push.rayCount) return;
    uint listed = lane / push.pieceCount, number = lane - listed * push.pieceCount;
    vec3 low, high;
    loadBox(listed, low, high);
    float size = length(high - low);
    if (!(size >= 0.0) || low.x > high.x) return;
    vec3 lowOfAll = low, highOfAll = high;
    grow(lowOfAll, highOfAll, push.reach);
    // Places that the instance may be near enough to, then those that the piece may.
    uint asked = 0u;
    for (uint p = first; p < end; ++p) {
        Place place = placeOf(p);
        uint least = best.at[p].x;
        float within = least == kNothingMet ? place.most : min(place.most, uintBitsToFloat(least) + tieOf(low, high));
        if (place.sound && leastDistance(place.position, lowOfAll, highOfAll) <= within) asked |= 1u << (p - first);
    }
    if (asked == 0u) return;
    Piece own = pieceOf(number, slotOfListed(listed));
    vec3 ownLow, ownHigh;
    boxOf(own, ownLow, ownHigh);
    if (push.work == kFindBound && !isFinite(own)) return;
    for (uint p = first; p < end; ++p) {
        if ((asked >> (p - first) & 1u) == 0u) continue;
        Place place = placeOf(p);
        if (push.work == kFindBound) {
            atomicMin(best.at[p].x, floatBitsToUint(mostDistance(place.position, ownLow, ownHigh)));
            continue;
        }
        float least = uintBitsToFloat(best.at[p].x), within = min(place.most, least + tieOf(low, high));
        if (leastDistance(place.position, ownLow, ownHigh) > within) continue;
        vec3 c[kPieceCoefficients];
        loadFrom(own, place.position, c);
        float distance = sqrt(nearestOf(own.kind, c).square);
        if (!(distance <= within)) continue;
        if (push.work == kFindLeast) atomicMin(best.at[p].x, floatBitsToUint(distance));
        else atomicMin(best.at[p].y, push.firstLane + lane);
    }
}
