// The sample of a bicubic patch: the patch is collapsed in v to rows, and a row is sampled in u. Needs basis.glsl, frame.glsl and
// kClass.
const bool kPerturbed = kClass == kPerturbedPatch;
const bool kPolar = kClass == kPolarPatch;

// Positions come from the coefficients as they are, so that neighbours, whose g00 differ, agree bit for bit. Derivatives
// come from coefficients relative to g00: far from the origin that keeps normals many times more exact.
// Order of the 16 perturbation coefficients: h_2j then h_3j for j = 0, 1, 4, 5, then h_i2, h_i3 for i = 0, 1, 4, 5.
struct Patch {
    vec3 g[16], relative[16], h[16];
};

vec3 placed(vec3 corner, vec3 offset) {
    precise vec3 p = corner + offset;
    return p;
}
vec3 relativeTo(vec3 first, vec3 corner, vec3 offset) {
    precise vec3 p = (corner - first) + offset;
    return p;
}

// A row of the patch at one v: the cubic row points and their v-derivatives, and the same for the perturbation.
// The perturbation rows are h_i., i = 0, 1, 4, 5 (outer) and 2, 3 (inner).
struct Row {
    vec3 g[4], gu[3], gv[4];
    vec3 outer[4], outerV[4];
    vec3 inner[2], innerV[2];
};

// What column i of the coefficients gives to a row: points, and what derivatives come from.
void collapseColumn(vec2 v, vec3 g[4], vec3 relative[4], out vec3 point, out vec3 fromFirst, out vec3 slope) {
    vec4 b = bernstein3(v);
    // Du of a polar patch has the factor 1 - v, which vanishes at the apex: it is left out.
    vec4 along = kPolar ? vec4(v.y * v.y, 3.0 * (v.x * v.y), 3.0 * (v.x * v.x), 0.0) : b;
    precise vec3 p = sum4(b, g[0], g[1], g[2], g[3]);
    point = p;
    fromFirst = blend4(along, relative[0], relative[1], relative[2], relative[3]);
    slope = blend3(derivativeWeights3(v), relative[1] - relative[0], relative[2] - relative[1], relative[3] - relative[2]);
}

// h: h_i2, h_i3 of i = 0, 1, 4, 5.
void collapseOuter(vec2 v, vec3 h[2], out vec3 point, out vec3 slope) {
    precise vec3 p = sum2(bernstein5(v).inner, h[0], h[1]);
    point = p;
    slope = blend2(bernsteinDerivative5(v).inner, h[0], h[1]);
}
// h: h_i0, h_i1, h_i4, h_i5 of i = 2, 3.
void collapseInner(vec2 v, vec3 h[4], out vec3 point, out vec3 slope) {
    precise vec3 p = sum4(bernstein5(v).outer, h[0], h[1], h[2], h[3]);
    point = p;
    slope = blend4(bernsteinDerivative5(v).outer, h[0], h[1], h[2], h[3]);
}

Row collapse(Patch c, vec2 v) {
    Row row;
    vec3 relative[4];
    for (uint i = 0u; i < 4u; ++i)
        collapseColumn(v, vec3[4](c.g[i], c.g[4u + i], c.g[8u + i], c.g[12u + i]),
                       vec3[4](c.relative[i], c.relative[4u + i], c.relative[8u + i], c.relative[12u + i]), row.g[i],
                       relative[i], row.gv[i]);
    for (uint i = 0u; i < 3u; ++i) row.gu[i] = relative[i + 1u] - relative[i];
    if (kPerturbed) {
        for (uint i = 0u; i < 2u; ++i)
            collapseInner(v, vec3[4](c.h[4u * i], c.h[4u * i + 1u], c.h[4u * i + 2u], c.h[4u * i + 3u]), row.inner[i],
                          row.innerV[i]);
        for (uint i = 0u; i < 4u; ++i)
            collapseOuter(v, vec3[2](c.h[8u + 2u * i], c.h[9u + 2u * i]), row.outer[i], row.outerV[i]);
    }
    return row;
}

// The sample of a row at u. The perturbation is added to the bicubic total last.
void finish(Row row, vec2 u, out vec3 position, out Frame frame) {
    vec4 b = bernstein3(u);
    precise vec3 p = sum4(b, row.g[0], row.g[1], row.g[2], row.g[3]);
    vec3 du = blend3(derivativeWeights3(u), row.gu[0], row.gu[1], row.gu[2]);
    vec3 dv = blend4(b, row.gv[0], row.gv[1], row.gv[2], row.gv[3]);
    if (kPerturbed) {
        Basis5 b5 = bernstein5(u), d5 = bernsteinDerivative5(u);
        precise vec3 h = sum2(b5.inner, row.inner[0], row.inner[1]) +
                         sum4(b5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
        p = p + h;
        du += blend2(d5.inner, row.inner[0], row.inner[1]) +
              blend4(d5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
        dv += blend2(b5.inner, row.innerV[0], row.innerV[1]) +
              blend4(b5.outer, row.outerV[0], row.outerV[1], row.outerV[2], row.outerV[3]);
    }
    position = p;
    frame = frameOf(du, dv);
}
