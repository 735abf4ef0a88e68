// The classes of bicubic patches and their records.
layout(constant_id = 3) const uint kClass = kRegularPatch;
layout(constant_id = 5) const bool kCornerNormals = false; // smooth one-face corners of p-rep: Du x Dv vanishes there

uint recordElements() { return (kClass == kPerturbedPatch ? 8u : 4u) + (kCornerNormals ? 1u : 0u); }
