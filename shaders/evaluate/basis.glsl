// Bernstein weights and reversal-symmetric sums: what makes shared borders agree bit for bit (docs/prep.md).
// A neighbor may run along a border in the opposite direction: then its pair is the swapped pair and its coefficients
// stand in the reverse order, and every expression here gives the same bits. `precise` stands on every local, because it
// stops at function boundaries.

vec4 bernstein3(vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s;
    precise vec4 b = vec4(ss * s, 3.0 * (t * ss), 3.0 * (s * tt), tt * t);
    return b;
}

// The derivative of a cubic is a quadratic of the differences of its coefficients. It feeds normals only.
vec3 derivativeWeights3(vec2 pair) { return vec3(3.0 * (pair.y * pair.y), 6.0 * (pair.x * pair.y), 3.0 * (pair.x * pair.x)); }

struct Basis5 {
    vec4 outer; // B0, B1, B4, B5
    vec2 inner; // B2, B3
};

Basis5 bernstein5(vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s;
    precise float t3 = tt * t, s3 = ss * s, t4 = tt * tt, s4 = ss * ss;
    precise vec4 outer = vec4(s4 * s, 5.0 * (t * s4), 5.0 * (s * t4), t4 * t);
    precise vec2 inner = vec2(10.0 * (tt * s3), 10.0 * (ss * t3));
    precise Basis5 b = Basis5(outer, inner);
    return b;
}

Basis5 bernsteinDerivative5(vec2 pair) {
    float t = pair.x, s = pair.y;
    float tt = t * t, ss = s * s;
    float a = ss * ss, b = 4.0 * (t * (ss * s)), c = 6.0 * (tt * ss), d = 4.0 * (s * (tt * t)), e = tt * tt; // quartic basis
    return Basis5(5.0 * vec4(-a, a - b, d - e, e), 5.0 * vec2(b - c, c - d));
}

vec3 sum4(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = (w.x * a + w.w * d) + (w.y * b + w.z * c);
    return r;
}

vec3 sum2(vec2 w, vec3 a, vec3 b) {
    precise vec3 r = w.x * a + w.y * b;
    return r;
}

// The same sums for derivatives. They feed normals only, so the compiler may arrange them as it likes.
vec3 blend4(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) { return (w.x * a + w.w * d) + (w.y * b + w.z * c); }
vec3 blend3(vec3 w, vec3 a, vec3 b, vec3 c) { return w.x * a + w.y * b + w.z * c; }
vec3 blend2(vec2 w, vec3 a, vec3 b) { return w.x * a + w.y * b; }
