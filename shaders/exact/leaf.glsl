// A leaf of an irregular quad: uniform bicubic B-splines, where creases are other weights (docs/exact.md, (1) and (2)).
#include "shaders/subdivision/sharpness.glsl"

struct LeafWeights {
    vec4 w, d; // of the four points in one direction, and their derivatives
};

// 2^n of a small integer.
float powerOfTwo(float n) { return uintBitsToFloat(uint(127 + int(n)) << 23u); }

// (1): the weight that a point across a crease of this sharpness keeps, and its derivative.
vec2 sharpWeight(float sharpness, float x) {
    if (sharpness >= kEndlessSharpness) return vec2(0.0);
    precise float n = floor(sharpness), f = sharpness - n, scale = powerOfTwo(n);
    precise float a = max(0.0, 1.0 - x * scale), b = max(0.0, 1.0 - x * (2.0 * scale));
    precise float value = ((1.0 - f) * (a * a * a) + 0.5 * f * (b * b * b)) / (6.0 * scale);
    return vec2(value, -0.5 * ((1.0 - f) * (a * a) + f * (b * b)));
}

// (2), at x of 0..1.
LeafWeights leafWeights(float x, float sharpness) {
    precise float t = x, s = 1.0 - x;
    precise float tt = t * t, ss = s * s;
    precise vec4 w = vec4(ss * s * (1.0 / 6.0), (1.0 + 3.0 * (s + ss * t)) * (1.0 / 6.0),
                          (1.0 + 3.0 * (t + tt * s)) * (1.0 / 6.0), tt * t * (1.0 / 6.0));
    vec4 d = vec4(-0.5 * ss, 1.5 * tt - 2.0 * t, 2.0 * s - 1.5 * ss, 0.5 * tt);
    if (sharpness > 0.0) {
        vec2 kept = sharpWeight(sharpness, x);
        precise float value = w.x - kept.x;
        float slope = d.x - kept.y;
        precise vec4 creased = vec4(kept.x, w.y + 2.0 * value, w.z - value, w.w);
        w = creased;
        d = vec4(kept.y, d.y + 2.0 * slope, d.z - slope, d.w);
    }
    return LeafWeights(w, d);
}

// On the line itself: the share of a point beside it. The point on it has what is left.
float besideLine(float sharpness) {
    if (sharpness > 0.0) return sharpWeight(sharpness, 0.0).x;
    return 1.0 / 6.0;
}
