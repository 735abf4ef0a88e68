// Products of vectors in one order of additions. GLSL and C++ share the very code: in C++ the vectors are glm's.
#ifndef SUPPLE_SHARED_VECTORS_H
#define SUPPLE_SHARED_VECTORS_H

#include "shaders/shared/elementary.h"
#include "shaders/shared/portable.h"

#ifdef __cplusplus
#include <glm/glm.hpp>
#include <glm/integer.hpp>
#endif

SUPPLE_SHARED_BEGIN

#ifdef __cplusplus
using glm::abs;
using glm::bitCount;
using glm::clamp;
using glm::findLSB;
using glm::findMSB;
using glm::mat4;
using glm::max;
using glm::min;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
#endif

SUPPLE_SHARED_FUNCTION float sum4(vec4 v) {
    SUPPLE_PRECISE float s = (v.x + v.y) + (v.z + v.w);
    return s;
}
SUPPLE_SHARED_FUNCTION float dot3(vec3 a, vec3 b) {
    SUPPLE_PRECISE float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}
SUPPLE_SHARED_FUNCTION float dot4(vec4 a, vec4 b) {
    SUPPLE_PRECISE float d = (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
    return d;
}
SUPPLE_SHARED_FUNCTION vec3 crossed(vec3 a, vec3 b) {
    SUPPLE_PRECISE vec3 c = vec3(a.y, a.z, a.x) * vec3(b.z, b.x, b.y) - vec3(a.z, a.x, a.y) * vec3(b.y, b.z, b.x);
    return c;
}
SUPPLE_SHARED_FUNCTION float largestOf(vec3 v) { return max(max(v.x, v.y), v.z); }

SUPPLE_SHARED_END

#endif
