// The line between two knots of a packed clip. A knot in between is kept as how far it is off that line. GLSL and C++ share
// the very code.
#ifndef SUPPLE_POSE_KNOTS_H
#define SUPPLE_POSE_KNOTS_H

#include "shaders/shared/vectors.h"

SUPPLE_SHARED_BEGIN

// The whole numbers nearest to the line from `a` to `b`, of at most 20 bits, `frame` of `frames` frames behind a.
SUPPLE_SHARED_FUNCTION vec3 onLine(vec3 a, vec3 b, uint frame, uint frames) {
    SUPPLE_PRECISE float share = float(frame) * recip(float(frames));
    SUPPLE_PRECISE vec3 at = (a + (b - a) * share) + 0.5f;
    return floor(at);
}

SUPPLE_SHARED_END

#endif
