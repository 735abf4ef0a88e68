// What rays meet, as hosts have it: a lane a ray. The lane that owns the least t says which piece of which instance it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/hit.glsl"

void main() {
    uint number = invocationIndex();
    if (number >= push.rayCount) return;
    uvec2 found = best.at[number];
    if (found.x == kNothingMet || found.y == kNothingMet) {
        if (push.writesMisses != 0u) storeMiss(number);
        return;
    }
    uint lanes = push.pieceCount * push.instanceCount, lane = found.y - push.firstLane;
    if (lane >= lanes) return; // another window's
    uint listed = lane / push.pieceCount, pieceNumber = lane - listed * push.pieceCount, slot = slotOfListed(listed);
    Ray ray = rayOf(number);
    Piece own = pieceOf(pieceNumber, slot);
    vec3 c[kPieceCoefficients], turned[kPieceCoefficients];
    loadCoefficients(own, c);
    turned = c;
    turnTo(ray, own.first, turned);
    vec3 low, high;
    loadBox(listed, low, high);
    // Rounding may differ between kernels: so a little more is let in than the pick has, round the point that it found.
    float distance = uintBitsToFloat(found.x) * ray.unit, slack = 2.0 * toleranceFor(low, high, ray.origin);
    Met met = meet(own.kind, turned, 0.999999 * distance - slack, 1.000001 * distance + slack, distance, slack, 0.0);
    storeHit(number, found.x, slot, pieceNumber, own, c, ray.along, met.at);
}
