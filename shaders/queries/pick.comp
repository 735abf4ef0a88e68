// What a few rays meet first: a lane a piece of a surface and instance that rays are aimed at. There are two dispatches. The first
// finds the least t of each ray, the second the first lane that has it; most lanes are done there when their box has been looked at.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"

// The rays that the piece may be met by, a bit each.
uint raysAt(const Piece own, vec3 low, vec3 high) {
    vec3 ownLow, ownHigh;
    boxOf(own, ownLow, ownHigh);
    uint asked = 0u;
    for (uint r = 0u; r < push.rayCount; ++r) {
        uint least = best.at[r].x;
        Ray ray = upTo(rayOf(r), least);
        bool isOpen = ray.sound && (push.work == kFindLeast || least != kNothingMet);
        if (push.work == kFindOwner) ray.from = max(ray.from, uintBitsToFloat(least) * ray.unit * 0.999999);
        if (isOpen && mayMeet(ray, ownLow, ownHigh, toleranceFor(low, high, ray.origin))) asked |= 1u << r;
    }
    return asked;
}

void main() {
    uint id = invocationIndex(), place = id / push.pieceCount, number = id - place * push.pieceCount;
    if (place >= boxWords.at[push.firstDispatch].w) return;
    uint listed = boxWords.at[2u * (push.firstBox + place) + 1u].w, lane = listed * push.pieceCount + number;
    vec3 low, high, c[kPieceCoefficients];
    loadBox(listed, low, high);
    Piece own = pieceOf(number, slotOfListed(listed));
    uint asked = raysAt(own, low, high);
    if (asked == 0u) return;
    loadCoefficients(own, c);
    for (; asked != 0u; asked &= asked - 1u) {
        uint r = uint(findLSB(asked));
        Ray ray = rayOf(r); // the whole of it, so that both dispatches find the same point
        uint t = firstMet(ray, own, c, low, high);
        if (t == kNothingMet) continue;
        if (push.work == kFindLeast) atomicMin(best.at[r].x, t);
        else if (t == best.at[r].x) atomicMin(best.at[r].y, push.firstLane + lane);
    }
}
