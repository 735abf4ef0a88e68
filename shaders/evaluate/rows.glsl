// Samples of a bicubic patch: the patch is collapsed in v to rows, and a row is sampled in u. Needs basis.glsl, frame.glsl and
// kClass.
//
// Positions on borders come from the coefficients as they are, by the sums of basis.glsl, so that neighbors agree bit for bit.
// Inside a patch no neighbor looks. There a row is made of offsets from the first corner, and a sample of halves that mirrored
// samples share. Derivatives come from offsets everywhere: far from the origin that keeps normals many times more exact.
const bool kPerturbed = kClass == kPerturbedPatch;
const bool kPolar = kClass == kPolarPatch;

#include "shaders/surface/corner.glsl"
Corner mirrored(Corner c) { return Corner(c.point, c.last, c.next, c.face); }
// Corners in their order round the patch: (0, 0), (1, 0), (1, 1), (0, 1). A polar patch has its apex twice.
// Order of the 16 perturbation coefficients: h_2j then h_3j for j = 0, 1, 4, 5, then h_i2, h_i3 for i = 0, 1, 4, 5.
struct Patch {
    Corner c0, c1, c2, c3;
    vec3 left, right, bottom; // from one corner to another
    vec3 h[16];
};

vec3 placed(vec3 corner, vec3 offset) {
    precise vec3 p = corner + offset;
    return p;
}
vec3 between(vec3 from, vec3 to) {
    precise vec3 p = to - from;
    return p;
}
// A row of the patch at one v: the cubic row points, their differences and their v-derivatives, and the same for the perturbation.
// The perturbation rows are h_i., i = 0, 1, 4, 5 (outer) and 2, 3 (inner).
struct Row {
    vec3 g[4], gu[3], gv[4];
    vec3 outer[4], outerV[4];
    vec3 inner[2], innerV[2];
};

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

void collapsePerturbation(vec3 h[16], vec2 v, inout Row row) {
    for (uint i = 0u; i < 2u; ++i)
        collapseInner(v, vec3[4](h[4u * i], h[4u * i + 1u], h[4u * i + 2u], h[4u * i + 3u]), row.inner[i], row.innerV[i]);
    for (uint i = 0u; i < 4u; ++i) collapseOuter(v, vec3[2](h[8u + 2u * i], h[9u + 2u * i]), row.outer[i], row.outerV[i]);
}

// Column i of the coefficients: the points of its lower and its upper corner, and the offsets from them. Columns 0 and 3 have the
// corners themselves at their ends.
struct Column {
    vec3 lower, upper, offsets[4];
    vec3 side, fromFirst; // from the lower to the upper corner; from the patch's first corner to the lower one
};
Column columnOf(Patch c, uint i) {
    if (i == 0u) return Column(c.c0.point, c.c3.point, vec3[4](vec3(0.0), c.c0.last, c.c3.next, vec3(0.0)), c.left, vec3(0.0));
    if (i == 1u) return Column(c.c0.point, c.c3.point, vec3[4](c.c0.next, c.c0.face, c.c3.face, c.c3.last), c.left, vec3(0.0));
    if (i == 2u) return Column(c.c1.point, c.c2.point, vec3[4](c.c1.last, c.c1.face, c.c2.face, c.c2.next), c.right, c.bottom);
    return Column(c.c1.point, c.c2.point, vec3[4](vec3(0.0), c.c1.next, c.c2.last, vec3(0.0)), c.right, c.bottom);
}

// A row's place in the patch: v = 0, v = 1, or between.
const uint kBottomRow = 0u, kTopRow = 1u, kInnerRow = 2u;
uint rowKind(uint j, uint last) { return j == 0u ? kBottomRow : j == last ? kTopRow : kInnerRow; }

// Du of a polar patch has the factor 1 - v, which vanishes at the apex. Without it, it has these weights of rows 0 to 2.
vec3 polarWeights(vec2 v) { return vec3(v.y * v.y, 3.0 * (v.x * v.y), 3.0 * (v.x * v.x)); }

// What column i gives to a row: its point; in two parts, of its own corners and of its offsets, how far that lies from the patch's
// first corner; and its slope in v. `first`: the point of the first corner.
void collapseColumn(Column c, uint i, vec2 v, uint kind, vec3 first, out vec3 point, out vec3 fromCorners, out vec3 fromOffsets,
                    out vec3 slope) {
    vec4 b = bernstein3(v);
    bool isBorder = i == 0u || i == 3u;
    precise float w = b.z + b.w;
    precise vec3 corners = w * c.side;
    if (i > 1u) corners = fma(vec3(w), c.side, c.fromFirst);
    precise vec3 offset = b.y * c.offsets[1];
    if (!isBorder) offset = fma(vec3(b.y), c.offsets[1], b.x * c.offsets[0]);
    offset = fma(vec3(b.z), c.offsets[2], offset);
    if (!isBorder) offset = fma(vec3(b.w), c.offsets[3], offset);
    if (isBorder) {
        point = sum4(b, c.lower, placed(c.lower, c.offsets[1]), placed(c.upper, c.offsets[2]), c.upper);
    } else {
        bool isTop = kind == kTopRow;
        vec3 end = placed(SELECT3(isTop, c.upper, c.lower), SELECT3(isTop, c.offsets[3], c.offsets[0]));
        point = SELECT3(kind == kInnerRow, placed(first, placed(corners, offset)), end);
    }
    fromCorners = corners;
    fromOffsets = offset;
    if (kPolar) {
        vec3 along = polarWeights(v);
        fromCorners = (along.x + along.y) * c.fromFirst;
        fromOffsets = blend3(along, c.offsets[0], c.offsets[1], c.offsets[2]);
    }
    vec3 d = derivativeWeights3(v);
    slope = d.y * c.side + (d.x - d.y) * c.offsets[1] + (d.y - d.z) * c.offsets[2];
    if (!isBorder) slope += d.z * c.offsets[3] - d.x * c.offsets[0];
}

// Columns 0 and 1 have their corners in common, and so have 2 and 3.
void differences(vec3 corners[4], vec3 offsets[4], inout Row row) {
    row.gu[0] = offsets[1] - offsets[0];
    row.gu[1] = (corners[2] - corners[1]) + (offsets[2] - offsets[1]);
    row.gu[2] = offsets[3] - offsets[2];
}
Row collapse(Patch c, vec2 v, uint kind) {
    Row row;
    vec3 corners[4], offsets[4];
    for (uint i = 0u; i < 4u; ++i)
        collapseColumn(columnOf(c, i), i, v, kind, c.c0.point, row.g[i], corners[i], offsets[i], row.gv[i]);
    differences(corners, offsets, row);
    if (kPerturbed) collapsePerturbation(c.h, v, row);
    return row;
}

// The same of a row on a border: nothing needs a sum there but what is perturbed.
Row borderRow(Patch c, bool isTop) {
    Row row;
    vec3 from = SELECT3(isTop, c.c3.point, c.c0.point), to = SELECT3(isTop, c.c2.point, c.c1.point);
    vec3 fromOffset = SELECT3(isTop, c.c3.last, c.c0.next), toOffset = SELECT3(isTop, c.c2.next, c.c1.last);
    row.g = vec3[4](from, placed(from, fromOffset), placed(to, toOffset), to);
    row.gu = vec3[3](fromOffset, (to - from) + (toOffset - fromOffset), -toOffset);
    vec3 fromFace = SELECT3(isTop, c.c3.face, c.c0.face), toFace = SELECT3(isTop, c.c2.face, c.c1.face);
    vec3 fromAcross = SELECT3(isTop, c.c3.next, c.c0.last), toAcross = SELECT3(isTop, c.c2.last, c.c1.next);
    if (kPolar && isTop) row.gu = vec3[3](3.0 * (fromFace - fromAcross), 3.0 * (toFace - fromFace), 3.0 * (toAcross - toFace));
    float inwards = SELECT(isTop, -3.0, 3.0);
    row.gv = vec3[4](inwards * fromAcross, inwards * (fromFace - fromOffset), inwards * (toFace - toOffset), inwards * toAcross);
    if (kPerturbed) collapsePerturbation(c.h, SELECT2(isTop, vec2(1.0, 0.0), vec2(0.0, 1.0)), row);
    return row;
}

// The perturbation is added to the bicubic total last.
vec3 perturbed(Row row, Basis5 b5, vec3 position) {
    precise vec3 h = sum2(b5.inner, row.inner[0], row.inner[1]) +
                     sum4(b5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
    return placed(position, h);
}
void perturb(Row row, vec2 u, inout vec3 position, inout vec3 du, inout vec3 dv) {
    if (!kPerturbed) return;
    Basis5 b5 = bernstein5(u), d5 = bernsteinDerivative5(u);
    position = perturbed(row, b5, position);
    du += blend2(d5.inner, row.inner[0], row.inner[1]) +
          blend4(d5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
    dv += blend2(b5.inner, row.innerV[0], row.innerV[1]) +
          blend4(b5.outer, row.outerV[0], row.outerV[1], row.outerV[2], row.outerV[3]);
}

// Halves of a row's perturbation, for derivatives: of h_0 and h_5, h_1 and h_4, h_2 and h_3.
struct PerturbationHalves {
    vec3 even[3], odd[3];
};
PerturbationHalves perturbationHalves(vec3 outer[4], vec3 inner[2]) {
    return PerturbationHalves(vec3[3](outer[0] + outer[3], outer[1] + outer[2], inner[0] + inner[1]),
                              vec3[3](outer[3] - outer[0], outer[2] - outer[1], inner[1] - inner[0]));
}
vec3 evenPerturbation(Basis5 b, PerturbationHalves h) {
    return 0.5 * (b.outer.x + b.outer.w) * h.even[0] + 0.5 * (b.outer.y + b.outer.z) * h.even[1] +
           0.5 * (b.inner.x + b.inner.y) * h.even[2];
}
vec3 oddPerturbation(Basis5 b, PerturbationHalves h) {
    return 0.5 * (b.outer.w - b.outer.x) * h.odd[0] + 0.5 * (b.outer.z - b.outer.y) * h.odd[1] +
           0.5 * (b.inner.y - b.inner.x) * h.odd[2];
}

// Halves of a row inside the patch: sums and differences of what is mirrored.
struct PointHalves {
    vec3 even[2], odd[2];
};
PointHalves pointHalves(Row row) {
    return PointHalves(vec3[2](placed(row.g[0], row.g[3]), placed(row.g[1], row.g[2])),
                       vec3[2](between(row.g[0], row.g[3]), between(row.g[1], row.g[2])));
}
struct SlopeHalves {
    vec3 evenV[2], oddV[2];
    vec3 evenU, middleU, oddU;
    PerturbationHalves point, slope;
};
SlopeHalves slopeHalves(Row row) {
    PerturbationHalves point, slope;
    if (kPerturbed) point = perturbationHalves(row.outer, row.inner), slope = perturbationHalves(row.outerV, row.innerV);
    return SlopeHalves(vec3[2](row.gv[0] + row.gv[3], row.gv[1] + row.gv[2]), vec3[2](row.gv[3] - row.gv[0], row.gv[2] - row.gv[1]),
                       row.gu[0] + row.gu[2], row.gu[1], row.gu[2] - row.gu[0], point, slope);
}

// Their weights, of Bernstein weights. At the swapped pair the even ones are the same, and the odd ones have the other sign.
vec2 evenWeights(vec4 b) {
    precise vec2 w = 0.5 * vec2(b.x + b.w, b.y + b.z);
    return w;
}
vec2 oddWeights(vec4 b) {
    precise vec2 w = 0.5 * vec2(b.w - b.x, b.z - b.y);
    return w;
}
vec3 weighted(vec2 w, vec3 a, vec3 b) {
    precise vec3 r = fma(vec3(w.x), a, w.y * b);
    return r;
}
vec3 pointInside(vec4 b, PointHalves h) {
    return placed(weighted(evenWeights(b), h.even[0], h.even[1]), weighted(oddWeights(b), h.odd[0], h.odd[1]));
}

// The sample of a row at u. `isInside`: neither the row nor the sample is on a border. Only there `h` counts.
void sampleOf(Row row, PointHalves h, vec2 u, bool isInside, out vec3 position, out Frame frame) {
    vec4 b = bernstein3(u);
    vec3 p = SELECT3(isInside, pointInside(b, h), sum4(b, row.g[0], row.g[1], row.g[2], row.g[3]));
    vec3 du = blend3(derivativeWeights3(u), row.gu[0], row.gu[1], row.gu[2]);
    vec3 dv = blend4(b, row.gv[0], row.gv[1], row.gv[2], row.gv[3]);
    perturb(row, u, p, du, dv);
    position = p;
    frame = frameOf(du, dv);
}
void borderSample(Row row, vec2 u, out vec3 position, out Frame frame) {
    sampleOf(row, pointHalves(row), u, false, position, frame);
}
// The end of a row: it lies on the border u = 0, or u = 1.
void endSample(Row row, bool isRight, out vec3 position, out Frame frame) {
    vec3 p = SELECT3(isRight, row.g[3], row.g[0]), dv = SELECT3(isRight, row.gv[3], row.gv[0]);
    vec3 du = 3.0 * SELECT3(isRight, row.gu[2], row.gu[0]);
    if (kPerturbed) {
        p = placed(p, SELECT3(isRight, row.outer[3], row.outer[0]));
        du += 5.0 * SELECT3(isRight, row.outer[3] - row.outer[2], row.outer[1] - row.outer[0]);
        dv += SELECT3(isRight, row.outerV[3], row.outerV[0]);
    }
    position = p;
    frame = frameOf(du, dv);
}

// The samples of a row at u and at the swapped pair. Inside the patch one is the sum of two halves and the other is their
// difference, and so are derivatives in every row. `isInside`: the row is on no border.
void mirroredSamples(Row row, PointHalves h, SlopeHalves s, vec2 u, bool isInside, out vec3 position, out Frame frame,
                     out vec3 farPosition, out Frame farFrame) {
    vec4 b = bernstein3(u);
    vec3 d = derivativeWeights3(u);
    vec2 even = evenWeights(b), odd = oddWeights(b);
    vec3 p, q;
    if (isInside) {
        vec3 e = weighted(even, h.even[0], h.even[1]), o = weighted(odd, h.odd[0], h.odd[1]);
        p = placed(e, o);
        q = between(o, e);
    } else {
        p = sum4(b, row.g[0], row.g[1], row.g[2], row.g[3]);
        q = sum4(b, row.g[3], row.g[2], row.g[1], row.g[0]);
    }
    vec3 evenU = fma(vec3(0.5 * (d.x + d.z)), s.evenU, d.y * s.middleU), oddU = 0.5 * (d.z - d.x) * s.oddU;
    vec3 evenV = fma(vec3(even.x), s.evenV[0], even.y * s.evenV[1]), oddV = fma(vec3(odd.x), s.oddV[0], odd.y * s.oddV[1]);
    if (kPerturbed) {
        Basis5 b5 = bernstein5(u), d5 = bernsteinDerivative5(u);
        p = perturbed(row, b5, p);
        q = perturbed(row, bernstein5(u.yx), q);
        // The derivative's weights have the other sign at the swapped pair.
        oddU += evenPerturbation(d5, s.point), evenU += oddPerturbation(d5, s.point);
        evenV += evenPerturbation(b5, s.slope), oddV += oddPerturbation(b5, s.slope);
    }
    vec3 du = evenU + oddU, dv = evenV + oddV, farU = evenU - oddU, farV = evenV - oddV;
    position = p;
    frame = frameOf(du, dv);
    farPosition = q;
    farFrame = frameOf(farU, farV);
}
