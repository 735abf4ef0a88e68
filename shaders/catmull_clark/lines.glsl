// Irregular quads at levels in the wide mapping: a lane takes a line of samples (docs/catmull_clark.md). A line inside is a row of a
// quarter and that of the quarter opposite, which alone runs along the same parameter: the quarters beside collapse nets the other way.
// The other lines are sides. Before the include: what half_line.glsl needs.
#include "shaders/catmull_clark/half_line.glsl"

LodPattern laneAlong; // the pattern along the half
vec2 linePair(uint k) { return lodPair(laneAlong, k, last); }
uint frameCorner(HalfLine h) { return h.corner; }
void store(const PatchPlace at, HalfLine h, uint k, vec3 position, Frame frame) {
    uint vertex = at.vertex + h.samples.first + k * h.samples.step;
    storeSurfaceVertex(vertex, vertex, SELECT3(at.empty, vec3(0.0), position), frame);
}

// Row n of the quarters at corners 0 and 2, then of those at 1 and 3.
HalfLine innerHalf(uint place, uint n, bool isSecond) {
    uint rows = last / 2u, odd = n < rows ? 0u : 1u, b = n - odd * rows + 1u, corner = odd + (isSecond ? 2u : 0u);
    uvec2 zero = placeInQuad(corner, 0u, b), one = placeInQuad(corner, 1u, b);
    SampleRow samples;
    samples.first = zero.y * (last + 1u) + zero.x;
    samples.step = one.y * (last + 1u) + one.x - samples.first;
    return HalfLine(corner, 1u, rows + 1u, false, false, localPair(place, 1u - odd, b, last).x, 0.0, samples);
}
HalfLine sideHalf(uint place, uint side, bool isSecond) {
    SampleRow samples = sideRowOf(side, last);
    if (isSecond) {
        samples.first += last * samples.step;
        samples.step = 0u - samples.step;
    }
    float nearest = 0.0;
    if (kTangents) {
        vec2 inside = vec2(localPair(place, 0u, 1u, last).x, localPair(place, 1u, 1u, last).x);
        vec2 onSides = vec2(localPair(place, 2u + side, 1u, last).x, localPair(place, 2u + ((side + 3u) & 3u), 1u, last).x);
        nearest = min(min(inside.x, inside.y), min(onSides.x, onSides.y));
    }
    return HalfLine(isSecond ? (side + 1u) & 3u : side, isSecond ? 1u : 0u, last / 2u + 1u, true, isSecond, 0.0, nearest, samples);
}
void evaluateWide() {
    Share share = shareOfGroup();
    QuadLine line = quadLineOfLane(share);
    if (line.place >= share.count) return;
    PatchPlace at = PATCH_IN_PLACE(share, line.place);
    IrregularQuad quad = quadOf(at.record);
    last = at.capacity;
    [[dont_unroll]] for (uint k = 0u; k < 2u; ++k) {
        HalfLine h;
        if (line.isSide) h = sideHalf(line.place, line.n, k == 1u);
        else h = innerHalf(line.place, line.n, k == 1u);
        laneAlong = localPattern(line.place, line.isSide ? 2u + line.n : h.corner & 1u);
        evaluateHalf(at, quad, h);
    }
}
