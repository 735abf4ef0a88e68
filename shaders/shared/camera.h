// From where levels are measured, and how fine they are (docs/lod.md).
#ifndef SUPPLE_SHARED_CAMERA_H
#define SUPPLE_SHARED_CAMERA_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

struct LodCamera {
    float position[3];
    float focal;       // pixels a unit at distance 1; orthographic: pixels a unit
    float nearest;     // nothing counts as nearer
    float errorScale;  // 3/4 / chord error in pixels; 0: lengths alone count
    float lengthScale; // 1 / length of an edge in pixels
    uint orthographic;
};

SUPPLE_SHARED_END

#endif
