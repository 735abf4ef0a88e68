// The rows of wide_rows.glsl of bicubic patches: a lane collapses one and evaluates all of its samples.

// The coefficients of a workgroup's patches: of every corner its point, tangent, next tangent and face coefficient (of a polar
// patch's last corner the point and what is behind it), then the perturbation's, four an edge. One element more keeps the same
// one of neighboring patches in different banks.
const uint kLocalStride = kPerturbed ? kWidePerturbedNetElements : kWideNetElements;
shared vec4 localElements[kLanePatch ? 1u : SUPPLE_WIDE_ELEMENTS(kVertexFormat)]; // positions of samples as well, when these are done with

vec3 localVector(uint at) { return localElements[at].xyz; }

// What corner and edge `corner` bring to the patch in a place.
void loadCorner(uint place, const PatchPlace at, uint corner) {
    uint to = place * kLocalStride + 4u * corner;
    Corner c = storedCorner(at, corner);
    localElements[to].xyz = c.point;
    localElements[to + 1u].xyz = c.next;
    localElements[to + 2u].xyz = c.last;
    localElements[to + 3u].xyz = c.face;
    if (!kPerturbed) return;
    uint edge = tableWord(4u * at.record + 8u + corner);
    for (uint s = 0u; s < 4u; ++s)
        localElements[to + 16u + s].xyz = coefficient(at.base + SUPPLE_PREP_EDGE_INDEX(edge, s), at.isNew);
}

// Where coefficient k is, and perturbation coefficient k.
uint localSlot(uint k) {
    if (!kPolar) return 4u * SUPPLE_NET_CORNER(k) + SUPPLE_NET_KIND(k);
    uint kind = SUPPLE_POLAR_NET_KIND(k);
    return 4u * SUPPLE_POLAR_NET_CORNER(k) + (kind == kNetBehind ? 1u : kind);
}
vec3 localPerturbation(uint from, uint k) { return localVector(from + 16u + SUPPLE_PREP_FACE_EDGE(k)); }

vec3 localCoefficient(uint from, uint k) { return localVector(from + localSlot(k)); }
// Column i of the coefficients, as columnOf() has it.
Column localColumn(uint from, uint i) {
    Column c;
    c.lower = localCoefficient(from, cornerOf(i));
    c.upper = localCoefficient(from, kPolar ? 12u : cornerOf(12u + i));
    for (uint j = 0u; j < 4u; ++j) {
        uint k = 4u * j + i;
        bool isCorner = k == cornerOf(k); // or the apex
        c.offsets[j] = vec3(0.0);
        if (!isCorner) c.offsets[j] = localCoefficient(from, k);
    }
    c.side = between(c.lower, c.upper);
    c.fromFirst = between(localCoefficient(from, 0u), c.lower);
    return c;
}
void localOuter(uint from, uint i, vec2 v, out vec3 point, out vec3 slope) {
    collapseOuter(v, vec3[2](localPerturbation(from, 8u + 2u * i), localPerturbation(from, 9u + 2u * i)), point, slope);
}
void localInner(uint from, uint i, vec2 v, out vec3 point, out vec3 slope) {
    collapseInner(v, vec3[4](localPerturbation(from, 4u * i), localPerturbation(from, 4u * i + 1u),
                             localPerturbation(from, 4u * i + 2u), localPerturbation(from, 4u * i + 3u)), point, slope);
}
Row collapseFrom(uint from, vec2 v, uint kind) {
    Row row;
    vec3 first = localCoefficient(from, 0u), corners[4], offsets[4];
    [[unroll]] for (uint i = 0u; i < 4u; ++i)
        collapseColumn(localColumn(from, i), i, v, kind, first, row.g[i], corners[i], offsets[i], row.gv[i]);
    differences(corners, offsets, row);
    if (kPerturbed) {
        [[unroll]] for (uint i = 0u; i < 2u; ++i) localInner(from, i, v, row.inner[i], row.innerV[i]);
        [[unroll]] for (uint i = 0u; i < 4u; ++i) localOuter(from, i, v, row.outer[i], row.outerV[i]);
    }
    return row;
}

const uint kRowParts = 4u; // corners
void loadRowPart(uint place, const PatchPlace at, uint corner) { loadCorner(place, at, corner); }

// The lane's row.
Row laneRow;
PointHalves laneHalves;
vec3 laneApex;
void makeRow(uint place, uint j, uint rate) {
    laneRow = collapseFrom(place * kLocalStride, parameterPair(j, rate), rowKind(j, rate));
    laneHalves = pointHalves(laneRow);
    if (kPolar) laneApex = localVector(place * kLocalStride + localSlot(12u));
}
void sampleOfRow(Share share, uint place, uint i, uint j, uint rate, out vec3 position, out Frame frame) {
    bool isInside = j > 0u && j < rate && i > 0u && i < rate;
    sampleOf(laneRow, laneHalves, parameterPair(i, rate), isInside, position, frame);
    if (kPolar && j == rate) position = laneApex;
    if (kCornerNormals && !kInterior && (i == 0u || i == rate) && (j == 0u || j == rate)) {
        PatchPlace at = PATCH_IN_PLACE(share, place);
        frame = withCornerNormal(frame, j == 0u ? (i == 0u ? 0u : 1u) : (i == 0u ? 3u : 2u), normalSlots(at.record), at.base);
    }
}
uint rowRate() { return fixedRate(); }
const bool kHasRows = !kLanePatch;
#include "shaders/evaluate/wide_rows.glsl"
