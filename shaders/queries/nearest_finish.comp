// Nearest points, as hosts have them: a lane a place. The lane that owns the point says which piece of which instance it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/hit.glsl"
#include "shaders/queries/nearest.glsl"

void main() {
    uint number = invocationIndex();
    if (number >= push.rayCount) return;
    uint owner = best.at[number].y;
    if (owner == kNothingMet) {
        if (push.writesMisses != 0u) storeMiss(number);
        return;
    }
    uint lane = owner - push.firstLane;
    if (lane >= push.pieceCount * push.instanceCount) return; // another window's
    uint listed = lane / push.pieceCount, pieceNumber = lane - listed * push.pieceCount, slot = slotOfListed(listed);
    Place place = placeOf(number);
    Piece own = pieceOf(pieceNumber, slot);
    vec3 c[kPieceCoefficients];
    loadFrom(own, place.position, c);
    Near near = nearestOf(own.kind, c);
    vec3 outwards = jetAt(own.kind, c, near.at).position; // from the place to the point
    loadCoefficients(own, c);
    storeHit(number, floatBitsToUint(sqrt(near.square)), slot, pieceNumber, own, c, outwards, near.at);
}
