// What turns a limb so that its end comes to a goal, and a joint so that a ray from it passes one. All in model space, by
// additions, multiplications and bits alone. GLSL and C++ share the very code.
#ifndef SUPPLE_POSE_LIMBS_H
#define SUPPLE_POSE_LIMBS_H

#include "shaders/pose/affine.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION vec3 direction(vec3 v) {
    SUPPLE_PRECISE vec3 result = v * rsqrt(max(dot3(v, v), 1e-30f));
    return result;
}
// What of v lies across the unit vector n.
SUPPLE_SHARED_FUNCTION vec3 acrossFrom(vec3 v, vec3 n) {
    SUPPLE_PRECISE vec3 result = v - n * dot3(v, n);
    return result;
}
// A vector turned by a unit quaternion.
SUPPLE_SHARED_FUNCTION vec3 turnedVector(vec4 q, vec3 v) {
    SUPPLE_PRECISE vec3 t = crossed(vec3(q), v) * 2.0f;
    SUPPLE_PRECISE vec3 result = (v + t * q.w) + crossed(vec3(q), t);
    return result;
}
SUPPLE_SHARED_FUNCTION vec3 through(Affine m, vec3 p) {
    SUPPLE_PRECISE vec3 q = vec3((m.x.x * p.x + m.x.y * p.y) + (m.x.z * p.z + m.x.w),
                                 (m.y.x * p.x + m.y.y * p.y) + (m.y.z * p.z + m.y.w),
                                 (m.z.x * p.x + m.z.y * p.y) + (m.z.z * p.z + m.z.w));
    return q;
}

// From a to b, unit vectors that are not opposite.
SUPPLE_SHARED_FUNCTION vec4 turnFromTo(vec3 a, vec3 b) {
    SUPPLE_PRECISE float w = 1.0f + dot3(a, b);
    return unit(vec4(crossed(a, b), w));
}
// u to v, and m, across u, to n, across v. Where a turn would be more than a quarter, half a turn comes first: so none is
// ill-conditioned.
SUPPLE_SHARED_FUNCTION vec4 frameTurn(vec3 u, vec3 m, vec3 v, vec3 n) {
    bool back = dot3(u, v) < 0.0f;
    SUPPLE_PRECISE vec3 from = u * (back ? -1.0f : 1.0f);
    vec4 q = turnFromTo(from, v);
    if (back) q = turned(q, vec4(m, 0.0f));
    vec3 k = turnedVector(q, m);
    back = dot3(k, n) < 0.0f;
    from = k * (back ? -1.0f : 1.0f);
    vec4 p = turnFromTo(from, n);
    if (back) p = turned(p, vec4(v, 0.0f));
    return turned(p, q);
}

// The part w, 0..1, of a unit rotation, the shorter way.
SUPPLE_SHARED_FUNCTION vec4 partOfTurn(vec4 q, float w) {
    SUPPLE_PRECISE vec4 shorter = q * (q.w < 0.0f ? -1.0f : 1.0f);
    SUPPLE_PRECISE vec4 part = vec4(vec3(shorter) * w, 1.0f + (shorter.w - 1.0f) * w);
    return unit(part);
}
// No more than an angle of which half has that cosine and sine.
SUPPLE_SHARED_FUNCTION vec4 limitedTurn(vec4 q, float cosineOfHalf, float sineOfHalf) {
    SUPPLE_PRECISE vec4 shorter = q * (q.w < 0.0f ? -1.0f : 1.0f);
    SUPPLE_PRECISE float k = sineOfHalf * rsqrt(max(dot3(vec3(shorter), vec3(shorter)), 1e-30f));
    SUPPLE_PRECISE vec4 most = vec4(vec3(shorter) * k, cosineOfHalf);
    if (shorter.w < cosineOfHalf) shorter = most;
    return shorter;
}

// Turns about the root and the middle of a limb, of the models of both, and where its end comes to.
struct LimbTurns {
    vec4 root, middle;
    vec3 end;
};
// Joints a, b, c; the hinge: the axis about which b bends, a unit vector; the pole: a point towards which b points, and how
// much it counts; soft: the part of the limb's length from which on it comes to the goal ever more slowly, so that it is
// never quite straight.
SUPPLE_SHARED_FUNCTION LimbTurns bentLimb(vec3 a, vec3 b, vec3 c, vec3 goal, vec3 hinge, vec3 pole, float poleWeight,
                                          float soft) {
    SUPPLE_PRECISE vec3 ab = b - a;
    SUPPLE_PRECISE vec3 bc = c - b;
    SUPPLE_PRECISE float squares1 = dot3(ab, ab);
    SUPPLE_PRECISE float squares2 = dot3(bc, bc);
    SUPPLE_PRECISE float perLength1 = rsqrt(max(squares1, 1e-20f));
    SUPPLE_PRECISE float perLength2 = rsqrt(max(squares2, 1e-20f));
    SUPPLE_PRECISE float length1 = squares1 * perLength1;
    SUPPLE_PRECISE float length2 = squares2 * perLength2;
    SUPPLE_PRECISE vec3 u = ab * perLength1;
    SUPPLE_PRECISE vec3 v = bc * perLength2;
    // The plane of the bend; where the limb is nearly straight, the hinge's.
    SUPPLE_PRECISE vec3 bend = crossed(u, v);
    SUPPLE_PRECISE float sineSquared = dot3(bend, bend);
    SUPPLE_PRECISE float bent = min(max((sineSquared - 4e-4f) * 104.166667f, 0.0f), 1.0f);
    SUPPLE_PRECISE vec3 ofHinge = acrossFrom(hinge, u);
    bend = bend * rsqrt(max(sineSquared, 1e-12f));
    if (dot3(bend, ofHinge) < 0.0f) bend = -bend;
    SUPPLE_PRECISE vec3 m = bend * bent + ofHinge * (1.0f - bent);
    m = direction(acrossFrom(m, u));
    vec3 mOfMiddle = direction(acrossFrom(m, v));
    // How far the end is from the root.
    SUPPLE_PRECISE vec3 way = goal - a;
    SUPPLE_PRECISE float squares = dot3(way, way);
    SUPPLE_PRECISE float perDistance = rsqrt(max(squares, 1e-20f));
    SUPPLE_PRECISE float distance = squares * perDistance;
    SUPPLE_PRECISE vec3 n = way * perDistance;
    if (squares < 1e-16f) n = direction(c - a);
    SUPPLE_PRECISE float reach = length1 + length2;
    SUPPLE_PRECISE float near = reach * soft;
    SUPPLE_PRECISE float gap = reach - near;
    SUPPLE_PRECISE float beyond = (distance - near) * recip(max(gap, 1e-12f));
    SUPPLE_PRECISE float slowed = near + gap * (beyond * recip(1.0f + max(beyond, 0.0f)));
    if (distance > near) distance = slowed;
    SUPPLE_PRECISE float difference = length1 - length2;
    SUPPLE_PRECISE float least = abs(difference) * 1.0001f + reach * 1e-4f;
    distance = max(distance, least);
    SUPPLE_PRECISE float along = (difference * reach + distance * distance) * (0.5f * recip(distance));
    SUPPLE_PRECISE float heightSquared = max(squares1 - along * along, 0.0f);
    SUPPLE_PRECISE float height = heightSquared * rsqrt(max(heightSquared, 1e-20f));
    // Where the middle goes: towards the pole, or as the pose bends.
    SUPPLE_PRECISE vec3 toPole = acrossFrom(pole - a, n);
    SUPPLE_PRECISE vec3 asPosed = acrossFrom(crossed(n, m), n);
    SUPPLE_PRECISE float poleSquared = dot3(toPole, toPole);
    toPole = toPole * rsqrt(max(poleSquared, 1e-20f));
    SUPPLE_PRECISE float counts = poleWeight * min((poleSquared * 1e4f) * recip(max(reach * reach, 1e-20f)), 1.0f);
    SUPPLE_PRECISE vec3 e = asPosed * (1.0f - counts) + toPole * counts;
    if (dot3(e, e) < 1e-6f) e = asPosed;
    e = direction(e);
    e = direction(acrossFrom(e, n));
    SUPPLE_PRECISE vec3 normal = crossed(e, n);
    SUPPLE_PRECISE vec3 middle = a + (n * along + e * height);
    LimbTurns turns;
    SUPPLE_PRECISE vec3 end = a + n * distance;
    SUPPLE_PRECISE vec3 upper = middle - a;
    SUPPLE_PRECISE vec3 lower = end - middle;
    vec3 u2 = direction(upper), v2 = direction(lower);
    turns.root = frameTurn(u, m, u2, normal);
    turns.middle = frameTurn(v, mOfMiddle, v2, normal);
    turns.end = end;
    return turns;
}

// 1 where the goal is ahead, 0 where it is behind: a head gives up instead of changing sides in a frame. It begins to at 120
// degrees between where the eye looks in the pose and the goal, and has at 160.
SUPPLE_SHARED_FUNCTION float aheadWeight(vec3 forward, vec3 toGoal) {
    SUPPLE_PRECISE float ahead = (dot3(forward, toGoal) + 0.93969262f) * 2.2743161f;
    return min(max(ahead, 0.0f), 1.0f);
}

// The rotation about a joint after which the ray from the eye along `forward`, a unit vector, passes the goal; none if there
// is no such rotation: the goal lies inside of the eye's sphere. `up` is what half a turn is made about.
SUPPLE_SHARED_FUNCTION vec4 aimedTurn(vec3 joint, vec3 eye, vec3 forward, vec3 goal, vec3 up) {
    SUPPLE_PRECISE vec3 o = eye - joint;
    SUPPLE_PRECISE vec3 r = goal - joint;
    SUPPLE_PRECISE float ahead = dot3(o, forward);
    SUPPLE_PRECISE float squares = dot3(r, r);
    SUPPLE_PRECISE float discriminant = (ahead * ahead + squares) - dot3(o, o);
    SUPPLE_PRECISE float s = discriminant * rsqrt(max(discriminant, 1e-20f)) - ahead;
    SUPPLE_PRECISE vec3 p = o + forward * s;
    vec3 a = direction(p), b = direction(r);
    vec3 across = direction(acrossFrom(up, a));
    bool back = dot3(a, b) < -0.999f;
    SUPPLE_PRECISE vec3 from = a * (back ? -1.0f : 1.0f);
    vec4 q = turnFromTo(from, b);
    if (back) q = turned(q, vec4(across, 0.0f));
    if (!(discriminant > squares * 1e-4f && s > 0.0f)) q = noTurn();
    return q;
}

SUPPLE_SHARED_END

#endif
