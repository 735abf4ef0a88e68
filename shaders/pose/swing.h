// The tail of a joint that swings, by the numbers of VRMC_springBone 1.0: a step of Verlet's, then colliders, each of which
// moves it and leaves its distance from the joint. By additions, multiplications and bits alone.
#ifndef SUPPLE_POSE_SWING_H
#define SUPPLE_POSE_SWING_H

#include "shaders/pose/affine.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION vec3 directionThrough(Affine m, vec3 v) {
    SUPPLE_PRECISE vec3 result = vec3(dot3(vec3(m.x), v), dot3(vec3(m.y), v), dot3(vec3(m.z), v));
    return result;
}
// A direction of unit length; the other if v has none, or comes from numbers that a host has made absurd.
SUPPLE_SHARED_FUNCTION vec3 directionOr(vec3 v, vec3 other) {
    float squares = dot3(v, v);
    bool sound = squares > 1e-24f && squares < 1e24f;
    SUPPLE_PRECISE vec3 result = v * rsqrt(SUPPLE_SELECT(sound, squares, 1.0f));
    return sound ? result : other;
}
// A unit vector that m takes to v's direction; the other if m flattens.
SUPPLE_SHARED_FUNCTION vec3 directionWithin(Affine m, vec3 v, vec3 other) {
    vec3 a = vec3(m.x), b = vec3(m.y), c = vec3(m.z);
    SUPPLE_PRECISE vec3 bc = crossed(b, c);
    SUPPLE_PRECISE vec3 ca = crossed(c, a);
    SUPPLE_PRECISE vec3 ab = crossed(a, b);
    SUPPLE_PRECISE vec3 way = (bc * v.x + ca * v.y) + ab * v.z;
    SUPPLE_PRECISE vec3 mirrored = -way;
    if (dot3(a, bc) < 0.0f) way = mirrored;
    return directionOr(way, other);
}
// From a to b, unit vectors; where they are opposite it turns less.
SUPPLE_SHARED_FUNCTION vec4 swingTurn(vec3 a, vec3 b) {
    SUPPLE_PRECISE float w = max(1.0f + dot3(a, b), 1e-3f);
    return unit(vec4(crossed(a, b), w));
}
// What a rigid transform undoes.
SUPPLE_SHARED_FUNCTION Affine undone(Affine m) {
    SUPPLE_PRECISE vec3 back = -((vec3(m.x) * m.x.w + vec3(m.y) * m.y.w) + vec3(m.z) * m.z.w);
    return rowsOf(vec4(m.x.x, m.y.x, m.z.x, back.x), vec4(m.x.y, m.y.y, m.z.y, back.y),
                  vec4(m.x.z, m.y.z, m.z.z, back.z));
}
// A velocity of the world, in the frame that m, a rigid transform, places.
SUPPLE_SHARED_FUNCTION vec3 worldVelocity(Affine m, vec3 v) {
    SUPPLE_PRECISE vec3 within = (vec3(m.x) * v.x + vec3(m.y) * v.y) + vec3(m.z) * v.z;
    return within;
}
// A direction of the world, in the frame that m places.
SUPPLE_SHARED_FUNCTION vec3 worldDirection(Affine m, vec3 v) { return directionOr(worldVelocity(m, v), v); }

// Where a tail swings to: `stiffness` and `pull` of a step, `kept` of the way that it came.
SUPPLE_SHARED_FUNCTION vec3 swungTail(vec3 tail, vec3 before, vec3 axis, float stiffness, float kept, vec3 pull) {
    SUPPLE_PRECISE vec3 next = ((tail + (tail - before) * kept) + axis * stiffness) + pull;
    return next;
}

// A tail of some radius, moved by a collider as the scratch memory has it (shaders/shared/pose.h).
SUPPLE_SHARED_FUNCTION vec3 pushedOut(vec3 tail, float radius, vec4 point, vec4 way) {
    SUPPLE_PRECISE vec3 q = tail - vec3(point);
    SUPPLE_PRECISE float along = dot3(q, vec3(way));
    SUPPLE_PRECISE float t = min(max(along * max(way.w, 0.0f), 0.0f), 1.0f);
    SUPPLE_PRECISE vec3 n = q - vec3(way) * t;
    float squares = dot3(n, n);
    bool inside = point.w < 0.0f, plane = way.w < 0.0f;
    SUPPLE_PRECISE float least = point.w + radius;
    SUPPLE_PRECISE float most = max(-point.w - radius, 0.0f);
    float reach = SUPPLE_SELECT(inside, most, least);
    SUPPLE_PRECISE float limit = reach * reach;
    SUPPLE_PRECISE vec3 moved = (vec3(point) + vec3(way) * t) + n * (reach * rsqrt(max(squares, 1e-20f)));
    SUPPLE_PRECISE float above = along - radius;
    SUPPLE_PRECISE vec3 lifted = tail - vec3(way) * above;
    bool hits = SUPPLE_SELECT(plane, above < 0.0f, SUPPLE_SELECT(inside, squares > limit, squares < limit));
    if (plane) moved = lifted;
    return hits ? moved : tail;
}

SUPPLE_SHARED_END

#endif
