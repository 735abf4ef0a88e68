// The deform pass: push constants and the layout of its static table.
//
// Table (uvec4 elements): one record a cage vertex and one more, then the influences, two an element.
//   vertex     (x, y, z as float bits; first influence element); a vertex's influences end where the next one's begin
//   influences (joint, weight bits, joint, weight bits); an odd list is filled up with weight 0
#ifndef SUPPLE_SHARED_DEFORM_H
#define SUPPLE_SHARED_DEFORM_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0. Every table is bound twice: GPUs load it as a storage buffer, CPU devices as texels.
SUPPLE_SHARED_CONST kDeformTableBinding = 0u;
SUPPLE_SHARED_CONST kDeformTableTexelBinding = 1u;
SUPPLE_SHARED_CONST kPaletteBinding = 2u;
SUPPLE_SHARED_CONST kPaletteTexelBinding = 3u;
SUPPLE_SHARED_CONST kDeformedCageBinding = 4u;

struct DeformPush {
    uint vertexCount;
    uint instanceCount; // of this window
    uint jointCount;
    uint cageStride; // vertices an instance in the deformed cage
};

SUPPLE_SHARED_END

#endif
