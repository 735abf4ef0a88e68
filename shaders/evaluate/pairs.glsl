// The parameter pairs (t, 1 - t) of a rate's samples.
BUFFER(readonly, Pairs, kPairBinding, std430, vec2, pairs)

// A rate that is known when the pipeline is made. In the narrow mapping loops over samples are unrolled and weights are
// constants; in the wide one lanes divide by a constant to find their patch and row, which is cheap.
layout(constant_id = kRateConstant) const uint kRate = 0u;
#include "shaders/evaluate/rate.glsl"
uint fixedRate() { return kRate != 0u ? kRate : dispatchRate(); }

// (t, s) = (k / rate, (rate - k) / rate), never 1 - t of a rounded t. `rate` is kRate where that is set.
vec2 parameterPair(uint k, uint rate) {
    precise vec2 p;
    if (kExactDivision) {
        p = vec2(float(k) / float(rate), float(rate - k) / float(rate));
    } else if (kRate != 0u && (kRate & (kRate - 1u)) == 0u) {
        // Powers of two divide without rounding: where the rate is one, and known, so are the pairs.
        float inverse = uintBitsToFloat((127u << 24) - floatBitsToUint(float(kRate)));
        p = vec2(float(k) * inverse, float(kRate - k) * inverse);
    } else {
        p = pairs.at[SUPPLE_FIRST_PAIR(rate) + k];
    }
    return p;
}
