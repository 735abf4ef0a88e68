// Quotients, roots, powers and angles from additions, multiplications and bits alone, which every device rounds alike:
// GLSL's own may differ from one pipeline to the next, and where two patches meet they must not. Newton's steps, else
// Chebyshev interpolation; good to 1e-7 of what is to come out at 1. GLSL and C++ share the very code.
#ifndef SUPPLE_SHARED_ELEMENTARY_H
#define SUPPLE_SHARED_ELEMENTARY_H

#include "shaders/shared/portable.h"

#ifdef __cplusplus
#include <bit>
#include <cmath>
#define SUPPLE_PRECISE // -ffp-contract=off
#else
#define SUPPLE_PRECISE precise
#endif

SUPPLE_SHARED_BEGIN

#ifdef __cplusplus
inline uint floatBitsToUint(float x) {
    return std::bit_cast<uint>(x);
}
inline float uintBitsToFloat(uint x) {
    return std::bit_cast<float>(x);
}
using std::floor;
#endif

// Coefficients from the highest power of x down.
#define SUPPLE_HORNER(c) sum = c + x * sum;

// Of a positive number that is no denormal; of 0 it is -127.
SUPPLE_SHARED_FUNCTION float log2Of(float a) {
    // The mantissa lies from sqrt(1/2) to sqrt(2).
    uint bits = floatBitsToUint(a), octave = (bits - 0x3F3504F3u) & 0xFF800000u;
    SUPPLE_PRECISE float x = uintBitsToFloat(bits - octave) - 1.0f;
    SUPPLE_PRECISE float sum = -0.107497893f;
    SUPPLE_HORNER(0.184760332f)
    SUPPLE_HORNER(-0.191388384f)
    SUPPLE_HORNER(0.204857647f)
    SUPPLE_HORNER(-0.239608124f)
    SUPPLE_HORNER(0.288552552f)
    SUPPLE_HORNER(-0.360696554f)
    SUPPLE_HORNER(0.480898529f)
    SUPPLE_HORNER(-0.721347332f)
    SUPPLE_HORNER(1.44269502f)
    SUPPLE_PRECISE float result = float(int(octave)) * (1.0f / 8388608.0f) + x * sum;
    return result;
}

// For -127 <= a < 128.
SUPPLE_SHARED_FUNCTION float exp2Of(float a) {
    SUPPLE_PRECISE float whole = floor(a + 0.5f);
    SUPPLE_PRECISE float x = a - whole;
    SUPPLE_PRECISE float sum = 0.000154531634f;
    SUPPLE_HORNER(0.00133908633f)
    SUPPLE_HORNER(0.00961808302f)
    SUPPLE_HORNER(0.0555035695f)
    SUPPLE_HORNER(0.240226507f)
    SUPPLE_HORNER(0.693147182f)
    SUPPLE_HORNER(1.0f)
    return uintBitsToFloat(floatBitsToUint(sum) + (uint(int(whole)) << 23u));
}

// The angle whose tangent is a, 0 <= a <= 1.
SUPPLE_SHARED_FUNCTION float angleOf(float a) {
    SUPPLE_PRECISE float x = a * a;
    SUPPLE_PRECISE float sum = -0.00238699722f;
    SUPPLE_HORNER(0.0135077713f)
    SUPPLE_HORNER(-0.0358715393f)
    SUPPLE_HORNER(0.0625016913f)
    SUPPLE_HORNER(-0.0865688026f)
    SUPPLE_HORNER(0.110337645f)
    SUPPLE_HORNER(-0.142785683f)
    SUPPLE_HORNER(0.199997395f)
    SUPPLE_HORNER(-0.333333313f)
    SUPPLE_PRECISE float result = a + a * (x * sum);
    return result;
}

// For angles up to a quarter turn.
SUPPLE_SHARED_FUNCTION float sineOf(float a) {
    SUPPLE_PRECISE float x = a * a;
    SUPPLE_PRECISE float sum = 2.63475636e-06f;
    SUPPLE_HORNER(-0.000198227397f)
    SUPPLE_HORNER(0.0083332425f)
    SUPPLE_HORNER(-0.166666657f)
    SUPPLE_PRECISE float result = a + a * (x * sum);
    return result;
}
SUPPLE_SHARED_FUNCTION float cosineOf(float a) {
    SUPPLE_PRECISE float x = a * a;
    SUPPLE_PRECISE float sum = -2.62975163e-07f;
    SUPPLE_HORNER(2.47745793e-05f)
    SUPPLE_HORNER(-0.00138886517f)
    SUPPLE_HORNER(0.0416666605f)
    SUPPLE_HORNER(-0.5f)
    SUPPLE_HORNER(1.0f)
    return sum;
}

#undef SUPPLE_HORNER

// 1 / x for 2^-100 < |x| < 2^100; the relative error is below 1.5 * 2^-24.
SUPPLE_SHARED_FUNCTION float recip(float x) {
    SUPPLE_PRECISE float y = uintBitsToFloat(0x7EF311C7u - floatBitsToUint(x));
    y = y * (2.0f - x * y);
    y = y * (2.0f - x * y);
    y = y + y * (1.0f - x * y);
    return y;
}

// 1 / sqrt(x) for 2^-100 < x < 2^100; the relative error is below 1.7 * 2^-24.
SUPPLE_SHARED_FUNCTION float rsqrt(float x) {
    SUPPLE_PRECISE float y = uintBitsToFloat(0x5F375A86u - (floatBitsToUint(x) >> 1u));
    SUPPLE_PRECISE float h = 0.5f * x;
    y = y * (1.5f - (h * y) * y);
    y = y * (1.5f - (h * y) * y);
    y = y + y * (0.5f - (h * y) * y);
    return y;
}

// The power of two that takes |x| into [1, 2). A product with it is exact. For 2^-126 <= |x| < 2^127.
SUPPLE_SHARED_FUNCTION float broughtDown(float x) {
    return uintBitsToFloat((254u - ((floatBitsToUint(x) >> 23u) & 255u)) << 23u);
}

// 1 / x of any size between 2^-126 and 2^126.
SUPPLE_SHARED_FUNCTION float wideRecip(float x) {
    float scale = broughtDown(x);
    SUPPLE_PRECISE float result = recip(x * scale) * scale;
    return result;
}

SUPPLE_SHARED_END

#endif
