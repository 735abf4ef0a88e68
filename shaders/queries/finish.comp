// Hits as hosts have them: a lane a ray. The lane that owns the least t says which piece of which instance it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"

BUFFER(writeonly, Hits, kHitBinding, std430, uvec4, hits)

const uint kNoFace = 0xFFFFFFFFu, kNoHit = 0xFFFFFFFFu, kHitBack = 1u;

void storeMiss(uint number) {
    hits.at[4u * number] = uvec4(floatBitsToUint(1.0 / 0.0), kNoHit, 0u, 0u);
    hits.at[4u * number + 1u] = uvec4(kNoFace, 0u, 0u, 0u);
    hits.at[4u * number + 2u] = uvec4(0u);
    hits.at[4u * number + 3u] = uvec4(0u);
}

// The handle of a place in a piece: face, side, and two numbers as bits.
uvec4 handleOf(uint number, uint kind, vec2 at) {
    uint first = kPieceElements * number;
    vec4 part = uintBitsToFloat(piece(first + 1u)), low = uintBitsToFloat(piece(first + 2u)), high = uintBitsToFloat(piece(first + 4u));
    uvec4 diagonal = piece(first + 3u), other = piece(first + 5u);
    vec2 p = part.xy + part.z * at, numbers;
    uint side = diagonal.z;
    if (kind == kTrianglePiece) {
        numbers = low.xy + p.x * low.zw + p.y * high.zw;
    } else if (p.x >= p.y) {
        numbers = low.xy + (p.x - p.y) * low.zw + p.y * uintBitsToFloat(diagonal.xy);
    } else {
        side = diagonal.w;
        numbers = high.xy + (p.y - p.x) * high.zw + p.x * uintBitsToFloat(other.xy);
    }
    numbers = clamp(numbers, vec2(0.0), vec2(1.0));
    return uvec4(piece(first).x, side, floatBitsToUint(numbers));
}

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
    uint listed = lane / push.pieceCount, ownPiece = lane - listed * push.pieceCount, slot = slotOfListed(listed);
    Ray ray = rayOf(number);
    Piece own = pieceOf(ownPiece, listed);
    vec3 c[kPieceCoefficients], turned[kPieceCoefficients];
    loadCoefficients(own, c);
    turned = c;
    turnTo(ray, own.first, turned);
    vec3 low = boxes.at[2u * (push.firstBox + listed)].xyz, high = boxes.at[2u * (push.firstBox + listed) + 1u].xyz;
    // Rounding may differ between kernels: so a little more is let in than the pick has, round the point that it found.
    float distance = uintBitsToFloat(found.x) * ray.unit, slack = 2.0 * toleranceFor(low, high, ray.origin);
    Met met = meet(own.kind, turned, 0.999999 * distance - slack, 1.000001 * distance + slack, slack);
    Jet jet = jetAt(own.kind, c, met.at);
    vec3 normal = cross(jet.du, jet.dv), position = jet.position + own.first;
    float longest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    normal = longest > 0.0 ? normalize(normal / longest) : vec3(0.0);
    if (cage(own.base + piece(own.vertices).x).w < 0.0) normal = -normal; // a pose that mirrors
    uint flags = dot(normal, ray.along) > 0.0 ? kHitBack : 0u;
    hits.at[4u * number] = uvec4(found.x, push.group, push.firstSlot + slot, flags);
    hits.at[4u * number + 1u] = handleOf(ownPiece, own.kind, met.at);
    hits.at[4u * number + 2u] = uvec4(floatBitsToUint(position), 0u);
    hits.at[4u * number + 3u] = uvec4(floatBitsToUint(normal), 0u);
}
