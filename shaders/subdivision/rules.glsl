// The rules of Catmull-Clark and Loop on a fragment, and their limits (docs/subdivision.md). From the includer: `point(i)`,
// the fragment's point of spiral index i on the level that is read.
//
// Every operand is added to its mirror image before anything is scaled, so that all fragments that have a point compute
// the same bits for it.

// With LOOP_RULES the rules are Loop's.
#ifdef LOOP_RULES
const bool kLoop = true;
#else
layout(constant_id = kLoopConstant) const bool kLoop = false;
#endif

struct Sources {
    uint s[8];
};

Sources unpackSources(uvec4 row) {
    return Sources(uint[8](row.x & 0xFFFFu, row.x >> 16, row.y & 0xFFFFu, row.y >> 16, row.z & 0xFFFFu, row.z >> 16,
                           row.w & 0xFFFFu, row.w >> 16));
}

#include "shaders/subdivision/sharpness.glsl"

vec3 blended(float sharpness, vec3 smoothPoint, vec3 creasePoint) {
    precise vec3 mixed = smoothPoint + sharpness * (creasePoint - smoothPoint);
    if (sharpness >= 1.0) return creasePoint;
    return sharpness > 0.0 ? mixed : smoothPoint;
}

// Two opposite pairs of corners.
vec3 facePoint(vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 p = ((a + b) + (c + d)) * 0.25;
    return p;
}

// The ends, then Catmull-Clark: the far corners of the faces on the left, then on the right; Loop: one on either side.
vec3 edgePoint(vec3 a, vec3 b, vec3 left0, vec3 left1, vec3 right0, vec3 right1, float sharpness) {
    precise vec3 ends = a + b;
    precise vec3 p;
    if (kLoop) p = (3.0 * ends + (left0 + right0)) * 0.125;
    else p = (6.0 * ends + ((left0 + left1) + (right0 + right1))) * 0.0625;
    precise vec3 crease = ends * 0.5;
    return blended(sharpness, p, crease);
}

// The neighbours counter-clockwise from the axis on.
vec3 vertexPoint(vec3 c, vec3 n[8], float sharpness) {
    precise vec3 axis, p;
    if (kLoop) {
        axis = n[0] + n[3];
        precise vec3 sides = (n[1] + n[2]) + (n[4] + n[5]);
        p = (10.0 * c + (sides + axis)) * 0.0625;
    } else {
        axis = n[0] + n[4];
        precise vec3 edges = axis + (n[2] + n[6]);
        precise vec3 diagonals = (n[1] + n[5]) + (n[3] + n[7]);
        p = (36.0 * c + (6.0 * edges + diagonals)) * 0.015625;
    }
    precise vec3 crease = 0.75 * c + axis * 0.125;
    return blended(sharpness, p, crease);
}

vec3[8] pointsOf(Sources n) {
    vec3 p[8];
    for (uint k = 0u; k < 8u; ++k) p[k] = !kLoop || k < 6u ? point(n.s[k]) : vec3(0.0);
    return p;
}

// The centre of the next level. The sums are over offsets from `c`, that of this level; `first` and `second`: the points on the
// two spokes of a crease.
vec3 nextCentre(vec3 c, vec3 spokeSum, vec3 faceSum, vec2 weights, float smoothShare, float creaseShare, vec3 first, vec3 second) {
    precise vec3 offset = vec3(0.0);
    if (smoothShare > 0.0) offset = smoothShare * (weights.x * spokeSum + weights.y * faceSum);
    if (creaseShare > 0.0) {
        precise vec3 ends = (first - c) + (second - c);
        offset = offset + creaseShare * (0.125 * ends);
    }
    precise vec3 p = c + offset;
    return p;
}

// The same, by the weights of its spoke and face points and its step (smooth, crease, first and second spoke).
vec3 centrePoint(uint spokes, vec2 weights, float smoothShare, float creaseShare, uint first, uint second) {
    const uint stride = kLoop ? 1u : 2u;
    vec3 c = point(0u);
    precise vec3 spokeSum = vec3(0.0), faceSum = vec3(0.0);
    for (uint k = 0u; k < spokes; ++k) {
        precise vec3 spoke = point(1u + stride * k) - c;
        spokeSum = spokeSum + spoke;
        if (!kLoop) {
            precise vec3 face = point(2u + stride * k) - c;
            faceSum = faceSum + face;
        }
    }
    vec3 a = vec3(0.0), b = vec3(0.0);
    if (creaseShare > 0.0) {
        a = point(1u + stride * first);
        b = point(1u + stride * second);
    }
    return nextCentre(c, spokeSum, faceSum, weights, smoothShare, creaseShare, a, b);
}

vec3 crossProduct(vec3 a, vec3 b) {
    precise vec3 n = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return n;
}
