// Colliders of springs and cloths, where a pose has them.
#ifndef SUPPLE_POSE_COLLIDERS_H
#define SUPPLE_POSE_COLLIDERS_H

#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "shaders/shared/pose.h"

SUPPLE_SHARED_BEGIN

struct PosedCollider {
    vec4 point, way; // as the scratch memory has them (shaders/shared/pose.h)
};
// A collider with such flags, whose two elements a table has, in a frame.
SUPPLE_SHARED_FUNCTION PosedCollider colliderThrough(Affine m, uint flags, vec4 point, vec4 end) {
    SUPPLE_PRECISE vec3 a = through(m, vec3(point));
    SUPPLE_PRECISE vec3 way = through(m, vec3(end)) - a;
    float squares = dot3(way, way);
    SUPPLE_PRECISE float scale = 0.0f;
    if (squares > 1e-20f) scale = recip(squares);
    if ((flags & kColliderPlane) != 0u) {
        way = direction(directionThrough(m, vec3(end)));
        scale = -1.0f;
    }
    SUPPLE_PRECISE float radius = point.w;
    if ((flags & kColliderInside) != 0u) radius = -max(radius, 1e-6f);
    SUPPLE_PRECISE PosedCollider posed;
    posed.point = vec4(a, radius);
    posed.way = vec4(way, scale);
    return posed;
}

SUPPLE_SHARED_END

#endif
