// The classes of bicubic patches and their records.
#include "shaders/surface/net.glsl"

// Levels have the code of regular patches by itself: a pipeline of it is created in four fifths of the time.
#ifdef REGULAR
const uint kClass = kRegularPatch;
#else
layout(constant_id = kKindConstant) const uint kClass = kRegularPatch;
#endif
layout(constant_id = kCornerNormalsConstant) const bool kCornerNormals = false; // smooth one-face corners of p-rep: Du x Dv vanishes there

// The corner that a bicubic coefficient is an offset from: itself where it is one, as is the apex all along row 3.
uint cornerOf(uint k) {
    if (kClass == kPolarPatch && k > 12u) return k;
    return (k & 12u) / 8u * 12u + (k & 3u) / 2u * 3u;
}

const uint kRecordElements = (kClass == kPerturbedPatch ? 3u : 2u) + (kCornerNormals ? 1u : 0u);
