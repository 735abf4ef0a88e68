// Between the two ends of an instance with update rates: matrices straight, rotations straight and made unit.
#ifndef SUPPLE_POSE_STRAIGHT_H
#define SUPPLE_POSE_STRAIGHT_H

#include "shaders/pose/affine.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION vec4 straight(vec4 a, vec4 b, float part) {
    SUPPLE_PRECISE vec4 between = a + (b - a) * part;
    return between;
}
SUPPLE_SHARED_FUNCTION Affine straight(Affine a, Affine b, float part) {
    return rowsOf(straight(a.x, b.x, part), straight(a.y, b.y, part), straight(a.z, b.z, part));
}
// The shorter way.
SUPPLE_SHARED_FUNCTION vec4 straightRotation(vec4 a, vec4 b, float part) {
    SUPPLE_PRECISE vec4 nearer = b;
    if (dot4(a, b) < 0.0f) nearer = -b;
    return unit(straight(a, nearer, part));
}

SUPPLE_SHARED_END

#endif
