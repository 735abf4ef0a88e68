// The sample of a sector (docs/pm.md). Needs sector.glsl, basis.glsl and frame.glsl.
//
// Inside a patch no neighbor looks. There a sample is summed up of halves: sums and differences of the coefficients that are
// mirrored if the sector's corners swap. The samples of (x, y, z) and (y, x, z) have them in common.

// Of 400 and 040, 310 and 130, 301 and 031, 211 and 121, 202 and 022, 103 and 013, less the centre. The last two even ones are 220
// and 112 themselves.
struct SectorHalves {
    vec3 centre;
    vec3 even[8], odd[6];
};
vec3 evenHalf(vec3 a, vec3 b) {
    precise vec3 p = a + b;
    return p;
}
vec3 oddHalf(vec3 a, vec3 b) {
    precise vec3 p = b - a;
    return p;
}
SectorHalves halvesOf(Sector s) {
    return SectorHalves(s.centre,
                        vec3[8](evenHalf(s.c[0], s.c[4]), evenHalf(s.c[1], s.c[3]), evenHalf(s.c[5], s.c[8]), evenHalf(s.c[6], s.c[7]),
                                evenHalf(s.c[9], s.c[11]), evenHalf(s.c[12], s.c[13]), s.c[2], s.c[10]),
                        vec3[6](oddHalf(s.c[0], s.c[4]), oddHalf(s.c[1], s.c[3]), oddHalf(s.c[5], s.c[8]), oddHalf(s.c[6], s.c[7]),
                                oddHalf(s.c[9], s.c[11]), oddHalf(s.c[12], s.c[13])));
}

// One step of de Casteljau's algorithm short of the point there are three cubics: p towards corner i, q towards corner i + 1, r towards
// the centre. The position is their blend, the derivatives are 4 times their differences. Halves of p + q, of q - p and of r, in the
// order 300 and 030, 210 and 120, 201 and 021, 102 and 012, then 111 and 003. Of r the last one is 0.
struct CubicHalves {
    vec3 even[6], odd[4];
};
struct SectorCubics {
    vec3 centre;
    CubicHalves sum, along, inwards;
};
SectorCubics cubicsOf(SectorHalves h) {
    vec3 middle = evenHalf(h.even[6], h.even[6]), behind = evenHalf(h.even[7], h.even[7]);
    return SectorCubics(
        h.centre,
        CubicHalves(vec3[6](evenHalf(h.even[0], h.even[1]), evenHalf(h.even[1], middle), evenHalf(h.even[2], h.even[3]),
                            evenHalf(h.even[4], behind), h.even[3], h.even[5]),
                    vec3[4](evenHalf(h.odd[0], h.odd[1]), h.odd[1], evenHalf(h.odd[2], h.odd[3]), h.odd[4])),
        CubicHalves(vec3[6](oddHalf(h.odd[1], h.odd[0]), h.odd[1], oddHalf(h.odd[3], h.odd[2]), h.odd[4], h.odd[3], h.odd[5]),
                    vec3[4](oddHalf(h.even[1], h.even[0]), oddHalf(middle, h.even[1]), oddHalf(h.even[3], h.even[2]),
                            oddHalf(behind, h.even[4]))),
        CubicHalves(vec3[6](h.even[2], h.even[3], h.even[4], h.even[5], h.even[7], vec3(0.0)),
                    vec3[4](h.odd[2], h.odd[3], h.odd[4], h.odd[5])));
}

// Their weights. If x and y swap, the even ones keep their bits, and the odd ones have the other sign.
struct CubicWeights {
    float even[6], odd[4];
};
CubicWeights cubicWeights(vec3 w) {
    precise float x = w.x, y = w.y, z = w.z;
    precise float xx = x * x, yy = y * y, s = x + y, d = y - x;
    precise float xy = 1.5 * (x * y), near = 1.5 * z, far = 1.5 * (z * z);
    precise float even[6] = float[6](0.5 * (xx * x + yy * y), xy * s, near * (xx + yy), far * s, 4.0 * (xy * z), (z * z) * z);
    precise float odd[4] = float[4](0.5 * (yy * y - xx * x), xy * d, near * (yy - xx), far * d);
    return CubicWeights(even, odd);
}
vec3 evenCubic(float w[6], vec3 p[6]) {
    precise vec3 r = w[0] * p[0];
    r = fma(vec3(w[1]), p[1], r);
    r = fma(vec3(w[2]), p[2], r);
    r = fma(vec3(w[3]), p[3], r);
    r = fma(vec3(w[4]), p[4], r);
    r = fma(vec3(w[5]), p[5], r);
    return r;
}
vec3 evenInwards(float w[6], vec3 p[6]) {
    precise vec3 r = w[0] * p[0];
    r = fma(vec3(w[1]), p[1], r);
    r = fma(vec3(w[2]), p[2], r);
    r = fma(vec3(w[3]), p[3], r);
    r = fma(vec3(w[4]), p[4], r);
    return r;
}
vec3 oddCubic(float w[4], vec3 p[4]) {
    precise vec3 r = w[0] * p[0];
    r = fma(vec3(w[1]), p[1], r);
    r = fma(vec3(w[2]), p[2], r);
    r = fma(vec3(w[3]), p[3], r);
    return r;
}

// From p + q, q - p and r.
vec3 pointOfCubics(vec3 centre, vec3 w, vec3 sum, vec3 along, vec3 inwards) {
    precise float s = 0.5 * (w.x + w.y), d = 0.5 * (w.y - w.x);
    precise vec3 p = centre + fma(vec3(s), sum, fma(vec3(d), along, w.z * inwards));
    return p;
}
Frame frameOfCubics(vec3 sum, vec3 along, vec3 inwards) {
    vec3 across = inwards - 0.5 * sum; // from the middle between both corners
    return Frame(along, across + 0.5 * along, cross(along, across));
}

// The sample of these weights of a sector's corners and the centre.
void finishInside(SectorCubics c, vec3 w, out vec3 position, out Frame frame) {
    CubicWeights b = cubicWeights(w);
    vec3 sum = evenHalf(evenCubic(b.even, c.sum.even), oddCubic(b.odd, c.sum.odd));
    vec3 along = evenHalf(evenCubic(b.even, c.along.even), oddCubic(b.odd, c.along.odd));
    vec3 inwards = evenHalf(evenInwards(b.even, c.inwards.even), oddCubic(b.odd, c.inwards.odd));
    position = pointOfCubics(c.centre, w, sum, along, inwards);
    frame = frameOfCubics(sum, along, inwards);
}
// That, and the one of the weights y, x, z.
void finishMirrored(SectorCubics c, vec3 w, out vec3 position, out Frame frame, out vec3 farPosition, out Frame farFrame) {
    CubicWeights b = cubicWeights(w);
    vec3 evenSum = evenCubic(b.even, c.sum.even), oddSum = oddCubic(b.odd, c.sum.odd);
    vec3 evenAlong = evenCubic(b.even, c.along.even), oddAlong = oddCubic(b.odd, c.along.odd);
    vec3 evenIn = evenInwards(b.even, c.inwards.even), oddIn = oddCubic(b.odd, c.inwards.odd);
    vec3 sum = evenHalf(evenSum, oddSum), along = evenHalf(evenAlong, oddAlong), inwards = evenHalf(evenIn, oddIn);
    position = pointOfCubics(c.centre, w, sum, along, inwards);
    frame = frameOfCubics(sum, along, inwards);
    sum = oddHalf(oddSum, evenSum), along = oddHalf(oddAlong, evenAlong), inwards = oddHalf(oddIn, evenIn);
    farPosition = pointOfCubics(c.centre, w.yxz, sum, along, inwards);
    farFrame = frameOfCubics(sum, along, inwards);
}
void finishCentre(SectorCubics c, out vec3 position, out Frame frame) {
    position = c.centre;
    frame = frameOfCubics(c.sum.even[5], c.along.even[5], vec3(0.0));
}

vec3 borderPosition(vec4 weights, vec3 border[4]) {
    precise vec3 p = sum4(weights, border[0], border[1], border[2], border[3]);
    return p;
}

// Where the derivatives at a corner are parallel, those of a step inside stand for them.
const float kSingularStep = SUPPLE_PM_SINGULAR_STEP / 3.0;
const vec3 kSingularWeights = vec3(1.0 - 2.0 * kSingularStep, kSingularStep, kSingularStep);
