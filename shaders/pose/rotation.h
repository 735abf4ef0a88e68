// Rotations as quaternions (x, y, z, w), from additions, multiplications and bits alone (shaders/shared/elementary.h).
#ifndef SUPPLE_POSE_ROTATION_H
#define SUPPLE_POSE_ROTATION_H

#include "shaders/shared/fitted_rotation.h"

SUPPLE_SHARED_BEGIN

// Of any moderate x: the Taylor series about the nearest zero.
SUPPLE_SHARED_FUNCTION float sine(float x) {
    SUPPLE_PRECISE float zero = floor(x * 0.31830988618f + 0.5f);
    SUPPLE_PRECISE float r = (x - zero * 3.140625f) - zero * 9.67653589793e-4f;
    SUPPLE_PRECISE float q = r * r;
    SUPPLE_PRECISE float series =
        1.0f + q * (-1.6666666667e-1f +
                    q * (8.3333333333e-3f + q * (-1.9841269841e-4f + q * (2.7557319224e-6f + q * -2.5052108385e-8f))));
    SUPPLE_PRECISE float value = r * series;
    SUPPLE_PRECISE float odd = zero - 2.0f * floor(0.5f * zero);
    SUPPLE_PRECISE float side = 1.0f - 2.0f * odd;
    SUPPLE_PRECISE float result = side * value;
    return result;
}
SUPPLE_SHARED_FUNCTION float cosine(float x) {
    SUPPLE_PRECISE float shifted = x + 1.57079632679f;
    return sine(shifted);
}

SUPPLE_SHARED_FUNCTION vec4 conjugated(vec4 q) { return vec4(-q.x, -q.y, -q.z, q.w); }

// b, then a.
SUPPLE_SHARED_FUNCTION vec4 turned(vec4 a, vec4 b) {
    SUPPLE_PRECISE vec3 across = crossed(vec3(a), vec3(b));
    SUPPLE_PRECISE vec3 xyz = (vec3(b) * a.w + vec3(a) * b.w) + across;
    SUPPLE_PRECISE float w = a.w * b.w - dot3(vec3(a), vec3(b));
    return vec4(xyz, w);
}

// How far to go along the chord of an arc for the share t of its angle, 0 <= t <= 1; d: cosine of the arc's angle as a
// quaternion, at least 0.5. 8e-7 rad at most beside slerp.
SUPPLE_SHARED_FUNCTION float slerpShare(float t, float d) {
    SUPPLE_PRECISE float s = t - 0.5f;
    SUPPLE_PRECISE float y = s * s;
    SUPPLE_PRECISE float z = 1.0f - d;
    SUPPLE_PRECISE float a =
        7.4518983e-05f + z * (0.66522551f + z * (0.14137051f + z * (0.018982558f + z * 0.032323431f)));
    SUPPLE_PRECISE float b =
        -0.00057003484f + z * (0.0089349691f + z * (0.49702594f + z * (0.24681839f + z * 0.056048453f)));
    SUPPLE_PRECISE float c =
        0.0035089145f + z * (-0.069185898f + z * (0.39374328f + z * (-0.51871574f + z * 1.3088357f)));
    SUPPLE_PRECISE float share = t + ((t * s) * (t - 1.0f)) * (a + y * (b + y * c));
    return share;
}

// Along the shorter way, 0 <= t <= 1, between rotations of unit length. The result's length is not 1.
SUPPLE_SHARED_FUNCTION vec4 slerp(vec4 a, vec4 b, float t) {
    SUPPLE_PRECISE float d = dot4(a, b);
    SUPPLE_PRECISE vec4 from = a;
    SUPPLE_PRECISE vec4 to = b * (d < 0.0f ? -1.0f : 1.0f);
    SUPPLE_PRECISE float cosineOfArc = min(abs(d), 1.0f);
    SUPPLE_PRECISE float part = t;
    if (cosineOfArc < 0.5f) { // more than 120 degrees: one of the halves
        SUPPLE_PRECISE float ofHalf = 2.0f + 2.0f * cosineOfArc;
        SUPPLE_PRECISE float root = rsqrt(ofHalf);
        SUPPLE_PRECISE vec4 middle = (from + to) * root;
        part = t + t;
        if (part > 1.0f) {
            part = part - 1.0f;
            from = middle;
        } else {
            to = middle;
        }
        cosineOfArc = 0.5f * (ofHalf * root);
    }
    SUPPLE_PRECISE float share = slerpShare(part, cosineOfArc);
    SUPPLE_PRECISE vec4 q = from + (to - from) * share;
    return q;
}

// The unit rotation q, t times over, the shorter way; t may be any number.
SUPPLE_SHARED_FUNCTION vec4 turnedTimes(vec4 q, float t) {
    SUPPLE_PRECISE vec4 shorter = q * (q.w < 0.0f ? -1.0f : 1.0f);
    SUPPLE_PRECISE float squared = dot3(vec3(shorter), vec3(shorter));
    SUPPLE_PRECISE float root = rsqrt(max(squared, 1e-30f));
    SUPPLE_PRECISE float size = squared * root; // the sine of half the angle
    SUPPLE_PRECISE float low = min(size, shorter.w);
    SUPPLE_PRECISE float ratio = low * recip(max(size, shorter.w));
    SUPPLE_PRECISE float angle = angleOf(ratio);
    if (size > shorter.w) angle = 1.57079632679f - angle;
    SUPPLE_PRECISE float turn = t * angle;
    SUPPLE_PRECISE float along = sine(turn) * root;
    if (size < 1e-6f) along = t; // too short to divide by its sine
    SUPPLE_PRECISE vec3 axis = vec3(shorter) * along;
    return vec4(axis, cosine(turn));
}

// A rotation by its axis, as long as the tangent of a quarter of its angle.
SUPPLE_SHARED_FUNCTION vec4 quarterTangentTurn(vec3 r) {
    SUPPLE_PRECISE float squares = dot3(r, r);
    SUPPLE_PRECISE float scale = recip(1.0f + squares);
    SUPPLE_PRECISE vec3 axis = r * (scale + scale);
    SUPPLE_PRECISE float w = (1.0f - squares) * scale;
    return vec4(axis, w);
}

SUPPLE_SHARED_END

#endif
