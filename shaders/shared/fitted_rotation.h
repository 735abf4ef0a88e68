// The rotation that is nearest to a matrix, from additions, multiplications and bits alone. GLSL and C++ share the very code.
#ifndef SUPPLE_SHARED_FITTED_ROTATION_H
#define SUPPLE_SHARED_FITTED_ROTATION_H

#include "shaders/shared/vectors.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION vec4 noTurn() { return vec4(0.0f, 0.0f, 0.0f, 1.0f); }

// The quaternion at unit length; a zero one counts as no rotation.
SUPPLE_SHARED_FUNCTION vec4 unit(vec4 q) {
    SUPPLE_PRECISE float size = max(largestOf(abs(vec3(q))), abs(q.w));
    SUPPLE_PRECISE vec4 scaled = q * broughtDown(size); // so that squares neither vanish nor overflow
    if (!(size > 1e-30f)) scaled = noTurn();
    SUPPLE_PRECISE vec4 result = scaled * rsqrt(dot4(scaled, scaled));
    return result;
}

// The symmetric m times itself, brought down to a trace in [1, 2) before.
SUPPLE_SHARED_FUNCTION mat4 squared(mat4 m) {
    SUPPLE_PRECISE float trace = (m[0][0] + m[1][1]) + (m[2][2] + m[3][3]);
    float scale = broughtDown(trace);
    SUPPLE_PRECISE vec4 a = m[0] * scale;
    SUPPLE_PRECISE vec4 b = m[1] * scale;
    SUPPLE_PRECISE vec4 c = m[2] * scale;
    SUPPLE_PRECISE vec4 d = m[3] * scale;
    float ab = dot4(a, b), ac = dot4(a, c), ad = dot4(a, d), bc = dot4(b, c), bd = dot4(b, d), cd = dot4(c, d);
    return mat4(vec4(dot4(a, a), ab, ac, ad), vec4(ab, dot4(b, b), bc, bd), vec4(ac, bc, dot4(c, c), cd),
                vec4(ad, bd, cd, dot4(d, d)));
}

// The column with the largest diagonal entry.
SUPPLE_SHARED_FUNCTION vec4 largestColumn(mat4 m) {
    vec4 column = m[0];
    float largest = m[0][0];
    if (m[1][1] > largest) {
        largest = m[1][1];
        column = m[1];
    }
    if (m[2][2] > largest) {
        largest = m[2][2];
        column = m[2];
    }
    if (m[3][3] > largest) {
        column = m[3];
    }
    return column;
}

// The rotation R that has most in common with the matrix m of these columns: trace(R^T m) is largest. It is the eigenvector
// of the largest eigenvalue of Davenport's form, found by squaring: the others fade. A matrix of zeros gives no turn.
// `turnsMirrors`: for a matrix that mirrors, the rotation of -m.
SUPPLE_SHARED_FUNCTION vec4 fittedRotation(vec3 x, vec3 y, vec3 z, bool turnsMirrors) {
    SUPPLE_PRECISE float size = largestOf(max(max(abs(x), abs(y)), abs(z)));
    SUPPLE_PRECISE float scale = broughtDown(size);
    SUPPLE_PRECISE vec3 a = x * scale;
    SUPPLE_PRECISE vec3 b = y * scale;
    SUPPLE_PRECISE vec3 c = z * scale;
    SUPPLE_PRECISE vec3 ab = crossed(a, b);
    SUPPLE_PRECISE float determinant = dot3(ab, c);
    float side = turnsMirrors && determinant < 0.0f ? -1.0f : 1.0f;
    a = a * side;
    b = b * side;
    c = c * side;
    SUPPLE_PRECISE float aa = dot3(a, a);
    SUPPLE_PRECISE float bb = dot3(b, b);
    SUPPLE_PRECISE float cc = dot3(c, c);
    SUPPLE_PRECISE float bend = max(abs(dot3(a, b)), max(abs(dot3(a, c)), abs(dot3(b, c))));
    SUPPLE_PRECISE float skew = max(bend, max(abs(bb - aa), abs(cc - aa)));
    // Nearly a rotation times a factor f: the other three eigenvalues lie near -f, and form + f leaves little of their
    // vectors. Else the form is raised by more than its smallest eigenvalue, and squared until the others have faded.
    bool even = determinant * side > 0.0f && skew <= 1e-3f * aa;
    SUPPLE_PRECISE float squares = max((aa + bb) + cc, 1e-30f);
    SUPPLE_PRECISE float length = squares * rsqrt(squares);
    SUPPLE_PRECISE float raised = length * (even ? 0.57735027f : 1.7320509f);
    // trace(R(q)^T m), (x, y, z, w)
    SUPPLE_PRECISE float xy = b.x + a.y;
    SUPPLE_PRECISE float xz = c.x + a.z;
    SUPPLE_PRECISE float yz = c.y + b.z;
    SUPPLE_PRECISE float xw = b.z - c.y;
    SUPPLE_PRECISE float yw = c.x - a.z;
    SUPPLE_PRECISE float zw = a.y - b.x;
    SUPPLE_PRECISE vec4 diagonal = vec4((a.x - b.y) - c.z, (b.y - a.x) - c.z, (c.z - b.y) - a.x, (a.x + b.y) + c.z) + raised;
    mat4 form = mat4(vec4(diagonal.x, xy, xz, xw), vec4(xy, diagonal.y, yz, yw), vec4(xz, yz, diagonal.z, zw),
                     vec4(xw, yw, zw, diagonal.w));
    int rounds = even ? 1 : 10;
    for (int i = 0; i < rounds; ++i) {
        form = squared(form);
    }
    vec4 q = unit(largestColumn(form));
    SUPPLE_PRECISE vec4 sharper = vec4(dot4(form[0], q), dot4(form[1], q), dot4(form[2], q), dot4(form[3], q));
    if (!(size > 1e-30f)) sharper = noTurn();
    return unit(sharper);
}

// The polar factor of the matrix with these columns, that is, the nearest rotation; as skinning/rotation.h has it. A
// mirroring matrix is turned about: all of a mirrored skeleton turns alike.
SUPPLE_SHARED_FUNCTION vec4 nearestRotation(vec3 x, vec3 y, vec3 z) { return fittedRotation(x, y, z, true); }

SUPPLE_SHARED_END

#endif
