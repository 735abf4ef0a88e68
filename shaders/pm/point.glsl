// The sample of a sector (docs/pm.md). Needs sector.glsl, basis.glsl and frame.glsl.

// One step of de Casteljau's algorithm short of the point: the cubic blends towards corner i, corner i + 1 and the centre.
// The position is their blend, the derivatives are 4 times their differences.
void cubicBlends(Sector s, vec3 w, out vec3 first, out vec3 second, out vec3 inner) {
    precise float x = w.x, y = w.y, z = w.z;
    precise float b[10] = float[10](x * x * x, 3.0 * (x * x * y), 3.0 * (x * y * y), y * y * y, 3.0 * (x * x * z),
                                    6.0 * (x * y * z), 3.0 * (y * y * z), 3.0 * (x * z * z), 3.0 * (y * z * z), z * z * z);
    // Rows of the cubic's coefficients in the quartic's: from 400, from 310, from 301.
    precise vec3 p = ((b[0] * s.c[0] + b[1] * s.c[1]) + (b[2] * s.c[2] + b[3] * s.c[3])) +
                     ((b[4] * s.c[5] + b[5] * s.c[6]) + b[6] * s.c[7]) + ((b[7] * s.c[9] + b[8] * s.c[10]) + b[9] * s.c[12]);
    precise vec3 q = ((b[0] * s.c[1] + b[1] * s.c[2]) + (b[2] * s.c[3] + b[3] * s.c[4])) +
                     ((b[4] * s.c[6] + b[5] * s.c[7]) + b[6] * s.c[8]) + ((b[7] * s.c[10] + b[8] * s.c[11]) + b[9] * s.c[13]);
    precise vec3 r = ((b[0] * s.c[5] + b[1] * s.c[6]) + (b[2] * s.c[7] + b[3] * s.c[8])) +
                     ((b[4] * s.c[9] + b[5] * s.c[10]) + b[6] * s.c[11]) + (b[7] * s.c[12] + b[8] * s.c[13]); // 004 is 0
    first = p;
    second = q;
    inner = r;
}

// The sample of these weights of a sector's corners and the centre.
void finishInside(Sector s, vec3 w, out vec3 position, out Frame frame) {
    vec3 a, b, c;
    cubicBlends(s, w, a, b, c);
    precise vec3 p = s.centre + ((w.x * a + w.y * b) + w.z * c);
    position = p;
    frame = frameOf(b - a, c - a);
}
void finishCentre(Sector s, out vec3 position, out Frame frame) {
    position = s.centre;
    frame = frameOf(s.c[13] - s.c[12], -s.c[12]);
}

vec3 borderPosition(vec4 weights, vec3 border[4]) {
    precise vec3 p = sum4(weights, border[0], border[1], border[2], border[3]);
    return p;
}

// Where the derivatives at a corner are parallel, those of a step inside stand for them.
const float kSingularStep = SUPPLE_PM_SINGULAR_STEP / 3.0;
const vec3 kSingularWeights = vec3(1.0 - 2.0 * kSingularStep, kSingularStep, kSingularStep);
