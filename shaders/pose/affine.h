// Transforms of nodes: as translation, rotation, scale, and as the three rows of a matrix.
#ifndef SUPPLE_POSE_AFFINE_H
#define SUPPLE_POSE_AFFINE_H

#include "shaders/pose/rotation.h"

SUPPLE_SHARED_BEGIN

struct Transform {
    vec3 translation;
    vec4 rotation; // of any length; zero counts as none
    vec3 scale;
};
struct Affine {
    vec4 x, y, z;
};

SUPPLE_SHARED_FUNCTION Affine rowsOf(vec4 x, vec4 y, vec4 z) {
    Affine m;
    m.x = x;
    m.y = y;
    m.z = z;
    return m;
}
SUPPLE_SHARED_FUNCTION Affine identity() {
    return rowsOf(vec4(1.0f, 0.0f, 0.0f, 0.0f), vec4(0.0f, 1.0f, 0.0f, 0.0f), vec4(0.0f, 0.0f, 1.0f, 0.0f));
}

SUPPLE_SHARED_FUNCTION vec4 rowTimes(vec4 row, Affine m) {
    SUPPLE_PRECISE vec4 r = (m.x * row.x + m.y * row.y) + m.z * row.z;
    r.w = r.w + row.w;
    return r;
}
// b, then a.
SUPPLE_SHARED_FUNCTION Affine combined(Affine a, Affine b) {
    SUPPLE_PRECISE Affine m;
    m.x = rowTimes(a.x, b);
    m.y = rowTimes(a.y, b);
    m.z = rowTimes(a.z, b);
    return m;
}

SUPPLE_SHARED_FUNCTION Affine composed(Transform t) {
    vec4 q = t.rotation;
    SUPPLE_PRECISE float squares = dot4(q, q);
    SUPPLE_PRECISE float twice = 2.0f * recip(max(squares, 1e-30f));
    float s = squares > 1e-30f ? twice : 0.0f;
    SUPPLE_PRECISE vec3 d = (vec3(q) * vec3(q)) * s;
    SUPPLE_PRECISE vec3 mixed = (vec3(q) * vec3(q.y, q.z, q.x)) * s; // xy, yz, zx
    SUPPLE_PRECISE vec3 spun = (vec3(q) * q.w) * s;
    SUPPLE_PRECISE Affine m;
    m.x = vec4((1.0f - (d.y + d.z)) * t.scale.x, (mixed.x - spun.z) * t.scale.y, (mixed.z + spun.y) * t.scale.z,
               t.translation.x);
    m.y = vec4((mixed.x + spun.z) * t.scale.x, (1.0f - (d.x + d.z)) * t.scale.y, (mixed.y - spun.x) * t.scale.z,
               t.translation.y);
    m.z = vec4((mixed.z - spun.y) * t.scale.x, (mixed.y + spun.x) * t.scale.y, (1.0f - (d.x + d.y)) * t.scale.z,
               t.translation.z);
    return m;
}

// The point that the matrix takes to p; the point itself if it flattens.
SUPPLE_SHARED_FUNCTION vec3 within(Affine m, vec3 p) {
    vec3 a = vec3(m.x), b = vec3(m.y), c = vec3(m.z);
    SUPPLE_PRECISE vec3 bc = crossed(b, c);
    SUPPLE_PRECISE vec3 ca = crossed(c, a);
    SUPPLE_PRECISE vec3 ab = crossed(a, b);
    SUPPLE_PRECISE float determinant = dot3(a, bc);
    SUPPLE_PRECISE vec3 result = p;
    if (abs(determinant) > 1e-36f) {
        SUPPLE_PRECISE vec3 d = p - vec3(m.x.w, m.y.w, m.z.w);
        result = ((bc * d.x + ca * d.y) + ab * d.z) * wideRecip(determinant);
    }
    return result;
}
SUPPLE_SHARED_FUNCTION bool flattens(Affine m) {
    return !(abs(dot3(vec3(m.x), crossed(vec3(m.y), vec3(m.z)))) > 1e-36f);
}

SUPPLE_SHARED_FUNCTION vec4 rotationOf(Affine m) {
    return nearestRotation(vec3(m.x.x, m.y.x, m.z.x), vec3(m.x.y, m.y.y, m.z.y), vec3(m.x.z, m.y.z, m.z.z));
}

SUPPLE_SHARED_END

#endif
