// Vertex stage of P_m: limit point v, tangent points t_j, face coefficients f_j of a sector (docs/pm.md, (13)-(16)).
// One invocation a sector and instance. Without creases the outputs are linear in the ring with weights that depend on
// the sector's kind alone; creased sectors are computed as the equations stand.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/mesh.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/pm.h"

layout(constant_id = kKindConstant) const uint kFan = kManyFan;

#include "shaders/surface/ring.glsl"
// Q_j = (p_3j+1 + p_3j+2) / 2; exact where the two are one vertex.
vec3 ringDiagonal(uint word, uint cageBase, vec3 p0) {
    precise vec3 a = ringPoint(word, kRingFarCorner, cageBase) - p0;
    precise vec3 b = ringPoint(word, kRingOtherCorner, cageBase) - p0;
    precise vec3 d = (a + b) * 0.5;
    return d;
}
#include "shaders/surface/vertex.glsl"
#include "shaders/pm/alphas.glsl"

const bool kVariable = kFan == kVariableFan;

// (14), relative to p: a, b are the alphas of the edges to x and y. `rim`: the weight of what is added between two sharp edges.
vec3 creasedFace(float a, float b, float rim, vec3 x, vec3 y, vec3 q) {
    precise vec3 r = (((1.0 - a) * b) * 0.5 * x + (a * (1.0 - b)) * 0.5 * y) + (a * b * 0.25) * ((x + y) + q) + rim * (x + y);
    return r;
}

// An edge of a sector as the instance has it. `sharp`: how sharp it is beside a rim, 0..1; of variable sectors alone. `rim`: of
// the others alone.
struct Spoke {
    float alpha, cosine, sine, sharp, rim;
};
Spoke spokeOf(uint element, uint instance) {
    uvec4 words = tableElement(element);
    vec4 w = uintBitsToFloat(words);
    if (!kVariable) return Spoke(w.x, w.y, w.z, 0.0, w.w);
    float alpha = alphaOfSet(instance, words.w & kAlphaSetMask);
    bool isOwn = alpha < 0.0, isGiven = isOwn && (words.w & kGivenAlpha) != 0u;
    if (isOwn) alpha = w.x;
    precise float sharp = 1.0 - 1.5 * alpha;
    return Spoke(alpha, w.y, w.z, isGiven ? 0.0 : max(min(sharp, 1.0), 0.0), 0.0);
}

// The part of a rim's weight that all edges of a sector make: it vanishes where a third one is sharp.
float smoothProduct(uint element, uint edges, uint instance) {
    precise float product = 1.0;
    for (uint j = 0u; kVariable && j < edges; ++j) {
        precise float smoothPart = 1.0 - spokeOf(element + j, instance).sharp;
        product = product * smoothPart;
    }
    return product;
}
// The rim's weight of the facet between two edges.
float rimBetween(Spoke a, Spoke b, float product) {
    if (!kVariable) return a.rim;
    if (a.sharp == 0.0 || b.sharp == 0.0) return 0.0;
    precise float rim = (1.0 / 6.0) * a.sharp * b.sharp * (product / ((1.0 - a.sharp) * (1.0 - b.sharp)));
    return rim;
}

// The tangent where an open sector ends, relative to p: of its edge alone, or of the smooth curve through p.
vec3 endTangent(vec3 spoke, bool ownEnds, uint element, uint cageBase, vec3 p0) {
    uvec4 end = ownEnds ? tableElement(element) : uvec4(0u, floatBitsToUint(1.0 / 3.0), 0u, 0u);
    precise vec3 t = uintBitsToFloat(end.y) * spoke;
    if (end.x == 0u) return t;
    precise vec3 other = ringSpoke(tableWord(header.ring + end.x - 1u), cageBase) - p0;
    precise vec3 through = t - uintBitsToFloat(end.z) * other;
    return through;
}

void creasedFan(uint limit, uint tangent, uint face, uint words, uint cageBase, vec3 p0, uint weights, uint instance) {
    uvec4 header = tableElement(weights);
    bool open = (header.x & kOpenSector) != 0u, corner = (header.x & kCornerSector) != 0u;
    bool straight = (header.x & kStraightSector) != 0u, ownEnds = (header.x & kOwnEndsSector) != 0u;
    uint facets = header.x & kSectorFacets, edges = open ? facets + 1u : facets;
    float limitScale = uintBitsToFloat(header.y), tangentScale = uintBitsToFloat(header.z);

    // Sums over the edges inside: of f_j, and of e_j = (f_j + f_j-1) / 2 with cosines and sines.
    precise vec3 sum = vec3(0.0), cosines = vec3(0.0), sines = vec3(0.0);
    precise float sineSum = 0.0;
    vec3 firstSpoke = vec3(0.0), firstFace = vec3(0.0), lastSpoke = vec3(0.0), lastDiagonal = vec3(0.0), lastFace = vec3(0.0);
    float product = smoothProduct(weights + 1u, edges, instance);
    Spoke before = Spoke(0.0, 0.0, 0.0, 0.0, 0.0); // edge k - 1
    for (uint k = 0u; k <= facets; ++k) { // a closed sector's last round is its first edge again
        uint j = k < edges ? k : 0u;
        uint word = tableWord(words + j);
        precise vec3 spoke = ringSpoke(word, cageBase) - p0;
        Spoke w = spokeOf(weights + 1u + j, instance);
        if (k == 0u) {
            firstSpoke = spoke;
        } else {
            vec3 f = creasedFace(before.alpha, w.alpha, rimBetween(before, w, product), lastSpoke, spoke, lastDiagonal);
            sum = sum + f;
            if (k == 1u) {
                firstFace = f;
            } else {
                precise vec3 e = (lastFace + f) * 0.5;
                cosines = cosines + before.cosine * e;
                sines = sines + before.sine * e;
                sineSum = sineSum + before.sine;
            }
            lastFace = f;
        }
        lastSpoke = spoke;
        lastDiagonal = ringDiagonal(word, cageBase, p0);
        before = w;
    }
    precise vec3 x, e1, e2;
    vec3 first = vec3(0.0), last = vec3(0.0);
    if (open) {
        first = endTangent(firstSpoke, ownEnds, weights + 1u + edges, cageBase, p0);
        last = endTangent(lastSpoke, ownEnds, weights + 2u + edges, cageBase, p0);
        // Written as weightedFan sums it, so that both sides of a hard edge get the same bits.
        x = corner ? vec3(0.0) : (1.0 / 6.0) * firstSpoke + (1.0 / 6.0) * lastSpoke;
        e1 = corner || straight ? first : (firstSpoke - lastSpoke) * (1.0 / 6.0);
        e2 = corner ? last : tangentScale * (sines - sineSum * x);
        if (straight) x = vec3(0.0);
    } else {
        // Edge 0 lies between the last facet and the first.
        precise vec3 e = (lastFace + firstFace) * 0.5;
        x = limitScale * sum;
        e1 = tangentScale * (cosines + before.cosine * e);
        e2 = tangentScale * (sines + before.sine * e);
    }
    // A pinned sector's v moves to the vertex, and all else with it: the offsets stay.
    storeLimit(limit, p0, (header.x & kPinnedSector) != 0u ? vec3(0.0) : x);
    vec3 near = firstSpoke;
    for (uint k = 0u; k < edges; ++k) {
        Spoke w = spokeOf(weights + 1u + k, instance);
        precise vec3 t = e1 * w.cosine + e2 * w.sine;
        storePool(tangent + k, t);
        if (k < facets) { // once more: v was not known above
            uint n = k + 1u == edges ? 0u : k + 1u;
            precise vec3 far = ringSpoke(tableWord(words + n), cageBase) - p0;
            Spoke next = spokeOf(weights + 1u + n, instance);
            vec3 diagonal = ringDiagonal(tableWord(words + k), cageBase, p0);
            vec3 f = creasedFace(w.alpha, next.alpha, rimBetween(w, next, product), near, far, diagonal);
            storeOffset(face + k, f, x);
            near = far;
        }
    }
    if (open) {
        storeOffset(tangent, first, x);
        storeOffset(tangent + facets, last, x);
    }
}

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), index = elementOf(item);
    uint base = poolBase(instance), cageBase = instance * header.cageStride;
    if (kFan == kRegularFan) {
        regularFan(index, base, cageBase);
        return;
    }
    uint record = 4u * push.table + 3u * index;
    uint slot = tableWord(record), weights = tableWord(record + 1u), words = header.ring + slot;
    uint limit = base + tableWord(record + 2u), tangent = base + header.tangents + slot, face = base + header.faces + slot;
    vec3 p0 = ringPoint(tableWord(words), kRingVertex, cageBase);
    if (kFan != kCreasedFan && !kVariable) {
        uint header = tableElement(weights).x;
        weightedFan(limit, tangent, face, words, cageBase, p0, weights + 1u, header & ~kOpenSector,
                    (header & kOpenSector) != 0u, kFan == kFewFan);
    } else {
        creasedFan(limit, tangent, face, words, cageBase, p0, weights, instance);
    }
}
