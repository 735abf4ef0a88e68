// Nearest points, as hosts have them: a lane a place. The lane that owns the point says which face of which instance it is, by the
// first of its pieces that come near enough. Of these the nearest has the point.
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
    vec3 c[kPieceCoefficients];
    Near near = Near(3e38, vec2(0.0));
    uint face = piece(kPieceElements * pieceNumber).x, nearest = pieceNumber;
    for (uint k = pieceNumber; k < push.pieceCount && piece(kPieceElements * k).x == face; ++k) {
        Piece other = pieceOf(k, slot);
        vec3 low, high;
        boxOf(other, low, high);
        if (k > pieceNumber && leastDistance(place.position, low, high) > sqrt(near.square)) continue;
        loadFrom(other, place.position, c);
        Near found = nearestOf(other.kind, c);
        if (found.square < 0.999999 * near.square) { // else the first of two
            near = found;
            nearest = k;
        }
    }
    pieceNumber = nearest;
    Piece own = pieceOf(pieceNumber, slot);
    loadCoefficients(own, c);
    vec3 outwards = jetAt(own.kind, c, near.at).position + (own.first - place.position); // from the place to the point
    storeHit(number, floatBitsToUint(sqrt(near.square)), slot, pieceNumber, own, c, outwards, near.at);
}
