// Bicubic patches at levels: samples lie where the patch's record says instead of at i / rate (docs/lod.md). The four sides of a patch
// have levels of their own, and so have samples inside. So a patch is a number of lines: its sides, each from one corner up to the
// next, and those that run across it inside, from which two mirrored samples are made at once. A lane of the narrow mapping goes
// through all lines of a patch, one of the wide mapping takes a line. Lines inside run along v, so that neighboring lanes store
// neighboring samples; those of polar patches run along u, as their derivatives need it.
const bool kColumns = !kPolar;

void storeSample(const PatchPlace at, uint own, vec3 position, Frame frame) {
    uint vertex = at.vertex + own;
    storeSurfaceVertex(vertex, vertex, at.empty ? vec3(0.0) : position, frame);
}

// A side as a row of its own, whose slopes point inwards. h: of perturbed patches, the side's two coefficients and those next to them.
Row sideRow(Corner from, Corner to, bool isApex, vec3 h[4]) {
    Row row;
    row.g = vec3[4](from.point, placed(from.point, from.next), placed(to.point, to.last), to.point);
    row.gu = vec3[3](from.next, (to.point - from.point) + (to.last - from.next), -to.last);
    if (kPolar && isApex) row.gu = vec3[3](3.0 * (from.face - from.last), 3.0 * (to.face - from.face), 3.0 * (to.next - to.face));
    row.gv = vec3[4](3.0 * from.last, 3.0 * (from.face - from.next), 3.0 * (to.face - to.last), 3.0 * to.next);
    if (kPerturbed) {
        row.inner = vec3[2](h[0], h[1]);
        row.innerV = vec3[2](5.0 * (h[2] - h[0]), 5.0 * (h[3] - h[1]));
    }
    return row;
}
// Weights of the derivative inwards. Sides 1 and 3 of a polar patch end and begin at the apex: there it is Du without its factor.
vec4 inwardsWeights(uint side, vec2 u) {
    if (!kPolar || (side & 1u) == 0u) return bernstein3(u);
    bool ends = side == 1u;
    vec3 w = polarWeights(SELECT2(ends, u, u.yx));
    return SELECT4(ends, vec4(w, 0.0), vec4(0.0, w.zyx));
}
void sideSample(Row row, uint side, vec2 u, out vec3 position, out Frame frame) {
    vec3 p = sum4(bernstein3(u), row.g[0], row.g[1], row.g[2], row.g[3]);
    vec3 along = blend3(derivativeWeights3(u), row.gu[0], row.gu[1], row.gu[2]);
    vec3 inwards = blend4(inwardsWeights(side, u), row.gv[0], row.gv[1], row.gv[2], row.gv[3]);
    if (kPerturbed) {
        vec2 w = bernstein5(u).inner, d = bernsteinDerivative5(u).inner;
        p = placed(p, sum2(w, row.inner[0], row.inner[1]));
        along += blend2(d, row.inner[0], row.inner[1]);
        inwards += blend2(w, row.innerV[0], row.innerV[1]);
    }
    position = p;
    vec3 normal = cross(along, inwards);
    turnBack(side, along, inwards);
    frame = Frame(along, inwards, normal);
}
// Loops are tested at the bottom: one tested at the top costs lavapipe one more time round with nothing to do.
void evaluateSide(const PatchPlace at, Row row, uint side, LodPattern pattern, uvec4 slots) {
    uint k = 0u;
    SampleRow samples = sideRowOf(side, at.capacity);
    bool isApex = kPolar && side == 2u;
    do {
        vec3 position;
        Frame frame;
        sideSample(row, side, lodPair(pattern, k, at.capacity), position, frame);
        if (isApex) position = row.g[0];
        if (kCornerNormals && k == 0u) frame = withCornerNormal(frame, side, slots, at.base);
        storeSample(at, samples.first, position, frame);
        samples.first += samples.step;
    } while (++k < at.capacity);
}

// Columns are the rows of a patch whose u and v have changed places.
Patch transposed(Patch c) {
    Patch t;
    t.c0 = mirrored(c.c0);
    t.c1 = mirrored(c.c3);
    t.c2 = mirrored(c.c2);
    t.c3 = mirrored(c.c1);
    t.left = c.bottom;
    t.right = between(c.c3.point, c.c2.point);
    t.bottom = c.left;
    if (kPerturbed) {
        for (uint k = 0u; k < 4u; ++k) {
            t.h[k] = c.h[8u + 2u * k];
            t.h[4u + k] = c.h[9u + 2u * k];
            t.h[8u + 2u * k] = c.h[k];
            t.h[9u + 2u * k] = c.h[4u + k];
        }
    }
    return t;
}
Frame turned(Frame f) { return kColumns ? Frame(f.dv, f.du, -f.normal) : f; }

// Line n inside of a patch, n = 1 .. capacity - 1. Capacities are odd, so no sample is its own mirror image. `c`: transposed, where
// lines are columns.
void evaluateLine(const PatchPlace at, Patch c, uint n, LodPattern across, LodPattern along) {
    SampleRow samples = innerRowOf(n, at.capacity, kColumns);
    uint last = at.capacity, near = samples.first, far = near + (last - 2u) * samples.step, k = 1u;
    Row row = collapse(c, lodPair(across, n, last), kInnerRow);
    PointHalves points = pointHalves(row);
    SlopeHalves slopes = slopeHalves(row);
    do {
        vec3 position, farPosition;
        Frame frame, farFrame;
        mirroredSamples(row, points, slopes, lodPair(along, k, last), true, position, frame, farPosition, farFrame);
        storeSample(at, near, position, turned(frame));
        storeSample(at, far, farPosition, turned(farFrame));
        near += samples.step;
        far -= samples.step;
    } while (2u * ++k < last);
}
uint acrossPattern() { return kColumns ? 0u : 1u; }

#ifdef WIDE
// A lane loads what its line needs.
void evaluateSideOf(const PatchPlace at, uint place, uint side) {
    NetRecord net = netRecord(at.record);
    vec3 h[4];
    if (kPerturbed) {
        uint edge = componentOf(tableElement(at.record + 2u), side);
        for (uint s = 0u; s < 4u; ++s) h[s] = coefficient(at.base + SUPPLE_PREP_EDGE_INDEX(edge, s), at.isNew);
    }
    Row row = sideRow(loadCorner(at, net, side), loadCorner(at, net, (side + 1u) & 3u), side == 2u, h);
    evaluateSide(at, row, side, localPattern(place, 2u + side), normalSlots(at.record));
}
void evaluateWide() {
    Share share = shareOfGroup();
    QuadLine line = quadLineOfLane(share);
    if (line.place >= share.count) return;
    PatchPlace at = PATCH_IN_PLACE(share, line.place);
    if (line.isSide) {
        evaluateSideOf(at, line.place, line.n);
    } else {
        Patch c = loadPatch(at);
        if (kColumns) c = transposed(c);
        evaluateLine(at, c, line.n + 1u, localPattern(line.place, acrossPattern()), localPattern(line.place, 1u - acrossPattern()));
    }
}
#else
#define OF_SIDE(side, a, b, c, d) SELECT3((side) == 0u, a, SELECT3((side) == 1u, b, SELECT3((side) == 2u, c, d)))
Corner cornerAt(Patch c, uint k) {
    return Corner(OF_SIDE(k, c.c0.point, c.c1.point, c.c2.point, c.c3.point), OF_SIDE(k, c.c0.next, c.c1.next, c.c2.next, c.c3.next),
                  OF_SIDE(k, c.c0.last, c.c1.last, c.c2.last, c.c3.last), OF_SIDE(k, c.c0.face, c.c1.face, c.c2.face, c.c3.face));
}
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    Patch c = loadPatch(at);
    uvec4 slots = normalSlots(at.record);
    uint side = 0u, n = 1u;
    do {
        vec3 h[4];
        if (kPerturbed) {
            h[0] = OF_SIDE(side, c.h[0], c.h[14], c.h[7], c.h[9]);
            h[1] = OF_SIDE(side, c.h[4], c.h[15], c.h[3], c.h[8]);
            h[2] = OF_SIDE(side, c.h[1], c.h[12], c.h[6], c.h[11]);
            h[3] = OF_SIDE(side, c.h[5], c.h[13], c.h[2], c.h[10]);
        }
        Row row = sideRow(cornerAt(c, side), cornerAt(c, (side + 1u) & 3u), side == 2u, h);
        evaluateSide(at, row, side, recordPattern(lodRecord, 2u + side, at.capacityIndex), slots);
    } while (++side < 4u);
    if (at.capacity == 1u) return; // nothing lies inside
    LodPattern across = recordPattern(lodRecord, acrossPattern(), at.capacityIndex);
    LodPattern along = recordPattern(lodRecord, 1u - acrossPattern(), at.capacityIndex);
    if (kColumns) c = transposed(c);
    do {
        evaluateLine(at, c, n, across, along);
    } while (++n < at.capacity);
}
#endif
