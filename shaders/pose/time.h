// Seconds as the sum of two floats, the first of which is the nearest to the sum: 48 bits, so that a phase is right after
// days. The sums and products are exact but for the last bit of the low part (Dekker 1971, Knuth); without `precise` a
// compiler would cancel them away. GLSL and C++ share the very code, as of all headers of this folder.
#ifndef SUPPLE_POSE_TIME_H
#define SUPPLE_POSE_TIME_H

#include "shaders/shared/vectors.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION vec2 exactSum(float a, float b) {
    SUPPLE_PRECISE float sum = a + b;
    SUPPLE_PRECISE float rest = sum - a;
    SUPPLE_PRECISE float error = (a - (sum - rest)) + (b - rest);
    return vec2(sum, error);
}

// |a| >= |b|, or a sum to which b adds little.
SUPPLE_SHARED_FUNCTION vec2 renormalized(float a, float b) {
    SUPPLE_PRECISE float sum = a + b;
    SUPPLE_PRECISE float error = b - (sum - a);
    return vec2(sum, error);
}

SUPPLE_SHARED_FUNCTION vec2 halves(float a) {
    SUPPLE_PRECISE float scaled = 4097.0f * a;
    SUPPLE_PRECISE float high = scaled - (scaled - a);
    SUPPLE_PRECISE float low = a - high;
    return vec2(high, low);
}

SUPPLE_SHARED_FUNCTION vec2 exactProduct(float a, float b) {
    SUPPLE_PRECISE float product = a * b;
    vec2 x = halves(a), y = halves(b);
    SUPPLE_PRECISE float error = ((x.x * y.x - product) + x.x * y.y + x.y * y.x) + x.y * y.y;
    return vec2(product, error);
}

SUPPLE_SHARED_FUNCTION vec2 timeSum(vec2 a, vec2 b) {
    vec2 sum = exactSum(a.x, b.x);
    SUPPLE_PRECISE float low = sum.y + (a.y + b.y);
    return renormalized(sum.x, low);
}

SUPPLE_SHARED_FUNCTION vec2 timeProduct(vec2 a, float b) {
    vec2 product = exactProduct(a.x, b);
    SUPPLE_PRECISE float low = product.y + a.y * b;
    return renormalized(product.x, low);
}

SUPPLE_SHARED_FUNCTION bool earlier(vec2 a, vec2 b) { return SUPPLE_SELECT(a.x == b.x, a.y < b.y, a.x < b.x); }
SUPPLE_SHARED_FUNCTION vec2 lastTwo(vec4 v) { return vec2(v.z, v.w); }

// A weight that goes from `from` to `to` during some seconds; `since` when it began to. No seconds: it stands.
SUPPLE_SHARED_FUNCTION float fadedWeight(float from, float to, float seconds, float since) {
    SUPPLE_PRECISE float faded = since * recip(max(seconds, 1e-30f));
    SUPPLE_PRECISE float weight = from + (to - from) * faded;
    if (since >= seconds) weight = to;
    if (since <= 0.0f || !(seconds > 0.0f)) weight = from;
    return weight;
}

// A time that runs on, as a time in the clip, 0 <= time < duration, and the number of whole loops before it.
struct LoopTime {
    vec2 time;
    float loops;
};
SUPPLE_SHARED_FUNCTION LoopTime loopTime(vec2 time, vec2 duration) {
    LoopTime result;
    result.time = vec2(0.0f);
    result.loops = 0.0f;
    if (duration.x > 0.0f) {
        SUPPLE_PRECISE vec2 rest = time;
        SUPPLE_PRECISE float loops = 0.0f;
        SUPPLE_PRECISE float rate = recip(max(duration.x, 1e-30f));
        for (int i = 0; i < 2; ++i) { // of very many loops the first quotient is some off
            SUPPLE_PRECISE float whole = floor(rest.x * rate);
            rest = timeSum(rest, timeProduct(duration, -whole));
            loops = loops + whole;
        }
        if (earlier(rest, vec2(0.0f))) {
            rest = timeSum(rest, duration);
            loops = loops - 1.0f;
        }
        if (!earlier(rest, duration)) {
            rest = timeSum(rest, -duration);
            loops = loops + 1.0f;
        }
        result.time = rest;
        result.loops = loops;
    }
    return result;
}

SUPPLE_SHARED_END

#endif
