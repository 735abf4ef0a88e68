// Hits of triangles become points of the surface: a lane a hit. The triangle says which face of the cage was met. The ray
// comes near to some points of that face: the one nearest to the triangle's hit is taken.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/hit.glsl"

BUFFER(readonly, Triangles, kTriangleBinding, std430, uint, triangles)

// How far from its ray a point may lie, as a part of the size of the vertices round it: triangles reach beyond the surface.
const float kMostBeside = 0.1;
// A point that is beside the ray counts as if it were so many times as far behind the triangle.
const float kBesideWeight = 16.0;

// How many triangles a patch of the run has.
uint trianglesOf(uint run) {
    uint domain = run & 0xFFu, steps = run >> kTriangleStepsShift & 0xFFu, own = run >> kTriangleRateShift;
    uint r = own > 0u ? own : (push.rate + (1u << steps) - 1u) >> steps;
    return domain == kQuadDomain ? 2u * r * r : domain == kPolarDomain ? 2u * r * r - r : domain == kTriangleDomain ? r * r : domain == kPentagonDomain ? 5u * r * r : 1u;
}

// The face that a triangle is of, or kNoFace.
uint faceOf(uint surface, uint geometry, uint primitive) {
    if (surface >= triangles.at[kTriangleSurfaces]) return kNoFace;
    uint ranges = triangles.at[kTriangleHeaderWords + 2u * surface], count = triangles.at[kTriangleHeaderWords + 2u * surface + 1u];
    if (geometry >= count) return kNoFace;
    uint run = triangles.at[ranges + 2u * geometry], runs = triangles.at[ranges + 2u * geometry + 1u];
    for (uint k = 0u; k < runs; ++k, run += kTriangleRunWords) {
        uint each = trianglesOf(triangles.at[run]), patches = triangles.at[run + 1u];
        if (primitive / each < patches) return triangles.at[triangles.at[run + 2u] + primitive / each];
        primitive -= each * patches;
    }
    return kNoFace;
}

void main() {
    uint number = invocationIndex();
    if (number >= push.rayCount) return;
    uvec4 first = floatBitsToUint(rays.at[2u * (push.firstTriangle + number)]), second = floatBitsToUint(rays.at[2u * (push.firstTriangle + number) + 1u]);
    uint slot = first.z - push.firstSlot;
    if (first.x != push.group || slot >= push.instanceCount) return;
    uint face = faceOf(first.y, first.w, second.x);
    Ray ray = rayOf(number);
    float near = uintBitsToFloat(second.y) * ray.unit;
    if (face >= triangles.at[kTriangleFaces] || !ray.sound || !(abs(near) < kFarthest)) return;
    uint ofFace = triangles.at[kTriangleFacePieces] + 2u * face, firstPiece = triangles.at[ofFace], pieces = triangles.at[ofFace + 1u];
    float least = 3e38;
    uint bestPiece = 0u;
    Met best = Met(-1.0, vec2(0.0), 0.0);
    for (uint k = 0u; k < pieces; ++k) {
        Piece own = pieceOf(firstPiece + k, slot);
        vec3 low, high, c[kPieceCoefficients];
        boxOf(own, low, high);
        loadCoefficients(own, c);
        turnTo(ray, own.first, c);
        Met met = meet(own.kind, c, ray.from, ray.to, near, kMostBeside * length(high - low), kBesideWeight);
        float cost = abs(met.distance - near) + kBesideWeight * sqrt(met.across);
        if (met.distance < 0.0 || !(cost < least)) continue;
        least = cost;
        best = met;
        bestPiece = firstPiece + k;
    }
    if (best.distance < 0.0) return;
    Piece own = pieceOf(bestPiece, slot);
    vec3 c[kPieceCoefficients];
    loadCoefficients(own, c);
    storeHit(number, floatBitsToUint(best.distance / ray.unit), slot, bestPiece, own, c, ray.along, best.at);
}
