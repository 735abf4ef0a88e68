// Seconds as the sum of two floats, the first of which is the nearest to the sum: 48 bits, so that a phase is right after
// days. The sums and products are exact but for the last bit of the low part (Dekker 1971, Knuth); without `precise` a
// compiler would cancel them away.

vec2 exactSum(float a, float b) {
    precise float sum = a + b;
    precise float rest = sum - a;
    precise float error = (a - (sum - rest)) + (b - rest);
    return vec2(sum, error);
}

// |a| >= |b|, or a sum to which b adds little.
vec2 renormalized(float a, float b) {
    precise float sum = a + b;
    precise float error = b - (sum - a);
    return vec2(sum, error);
}

vec2 halves(float a) {
    precise float scaled = 4097.0 * a;
    precise float high = scaled - (scaled - a);
    precise float low = a - high;
    return vec2(high, low);
}

vec2 exactProduct(float a, float b) {
    precise float product = a * b;
    vec2 x = halves(a), y = halves(b);
    precise float error = ((x.x * y.x - product) + x.x * y.y + x.y * y.x) + x.y * y.y;
    return vec2(product, error);
}

vec2 timeSum(vec2 a, vec2 b) {
    vec2 sum = exactSum(a.x, b.x);
    precise float low = sum.y + (a.y + b.y);
    return renormalized(sum.x, low);
}

vec2 timeProduct(vec2 a, float b) {
    vec2 product = exactProduct(a.x, b);
    precise float low = product.y + a.y * b;
    return renormalized(product.x, low);
}

bool earlier(vec2 a, vec2 b) { return SELECT(a.x == b.x, a.y < b.y, a.x < b.x); }

// A time that runs on, as a time in the clip, 0 <= time < duration, and the number of whole loops before it.
struct LoopTime {
    vec2 time;
    float loops;
};
LoopTime loopTime(vec2 time, vec2 duration) {
    LoopTime result;
    result.time = vec2(0.0);
    result.loops = 0.0;
    if (duration.x > 0.0) {
        precise vec2 rest = time;
        precise float loops = 0.0;
        for (int i = 0; i < 2; ++i) { // of very many loops the first quotient is some off
            precise float whole = floor(rest.x / duration.x);
            rest = timeSum(rest, timeProduct(duration, -whole));
            loops = loops + whole;
        }
        if (earlier(rest, vec2(0.0))) {
            rest = timeSum(rest, duration);
            loops = loops - 1.0;
        }
        if (!earlier(rest, duration)) {
            rest = timeSum(rest, -duration);
            loops = loops + 1.0;
        }
        result.time = rest;
        result.loops = loops;
    }
    return result;
}
