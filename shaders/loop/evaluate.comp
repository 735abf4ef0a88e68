// Evaluates Loop patches (docs/loop.md): every sample is that of a leaf.
//
// Narrow mapping, and the wide one where a rate has patches enough for all lanes of a GPU (kLanePatch): a lane a triangle, leaf by leaf,
// first what lies inside of it, then what lies on its sides. Regular triangles at levels in the wide mapping: a lane takes a line. Else
// the wide mapping, and irregular triangles at levels: sample by sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#ifdef LEVELS
#define CHOOSES_WIDE
#else
#define LANE_PATCH
#endif
#include "shaders/surface/tables.glsl"
#include "shaders/shared/chains.h"
#include "shaders/shared/lod.h"

layout(constant_id = kKindConstant) const uint kClass = kLoopIrregularPatch;
const bool kIrregular = kClass != kLoopRegularPatch, kSemiSharp = kClass == kLoopIrregularSharpPatch;
const uint kRecordElements = kSemiSharp ? kSharpTriangleElements : kIrregular ? kIrregularTriangleElements : kTriangleElements;
const uint kForm = kLodTriangleForm;
const uint kParts = kIrregular ? kTriangleNetPoints : kLeafPoints;
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/domain.glsl"
#include "shaders/surface/net.glsl"

vec3 poolPoint(const PatchPlace at, uint i) { return coefficient(at.base + i, at.isNew); }
#ifdef LEVELS
#define DEPTH_OF_INSTANCE
#endif

#ifdef WIDE
#ifdef LEVELS
const bool kLanePatch = false;
#endif
shared vec4 localPoints[kLanePatch || kLines ? 1u : kMaxPatchesPerGroup * kParts];
uint localPlace; // of the lane's patch

vec3 netPoint(const PatchPlace at, uint k) { return localPoints[localPlace * kParts + k].xyz; }
#define LOCAL_NET
#elif defined(LEVELS)
#define ONE_TRIANGLE
#endif
#include "shaders/loop/place.glsl"

#ifdef WIDE
vec4 netPart(const PatchPlace at, uint k) {
    uint index = triangleOf(at.record, true).first + netListPoint(at.record + kTriangleNetElement, k);
    return vec4(poolPoint(at, index), 0.0);
}
#ifdef LEVELS
void loadPart(uint to, const PatchPlace at, uint k) { localPoints[to] = netPart(at, k); }
// Of an irregular triangle.
void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    localPlace = place;
    RingSample ring = ringSample(3u, at.capacity, index);
    vec2 along;
    vec3 w = ringWeights(place, at.capacity, ring, along);
    TrianglePoint s = ringPoint(ring.side, ring.ring == 0u, along, w);
    irregularTriangle(at, triangleOf(at.record, true), s, ring.side, position, frame);
    frame = ofSector(frame);
}
#else
void loadPart(uint to, const PatchPlace at, uint k) {
    localPoints[to] = kIrregular ? netPart(at, k) : vec4(poolPoint(at, tableWord(4u * (at.record + kTriangleCageElement) + k)), 0.0);
}
void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    localPlace = place;
    Triangle t = triangleOf(at.record, kIrregular);
    TrianglePoint s = gridPoint(gridSample(kTriangleDomain, fixedRate(), index).xy, fixedRate());
    if (kIrregular) {
        irregularTriangle(at, t, s, 0u, position, frame);
    } else {
        LeafPoints points;
        [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k) points.p[k] = netPoint(at, k);
        mirror(points, triangleFlags(t, kSharpTriangleSide), triangleFlags(t, kCreasedTriangleCorner));
        regularTriangle(at, t, points, leafOf(points), s, 0u, position, frame);
    }
}
#endif
#endif
#if defined(WIDE) && defined(LEVELS)
// Of a regular triangle.
void evaluateLine(const PatchPlace at, RingLine line) {
    Triangle t = triangleOf(at.record, false);
    LeafPoints points = cageLeaf(at, t);
    Leaf leaf = leafOf(points);
    LeafSide side = leafSide(points, line.sector, false, hasFlag(t, kSharpTriangleSide, line.sector));
    LodPattern inside = localPattern(line.place, 0u), border = localPattern(line.place, 1u + line.sector);
    uint last = at.capacity, k = line.n;
    vec3 position;
    Frame frame;
    do {
        TrianglePoint s = pointOnSide(line.sector, lodPair(border, k, last));
        LeafRow row = leafRow(leaf, s.w.z);
        frame = seenFrom(0u, line.sector, rowAlongX(row, s.w.y), rowAlongY(row, s.w.y));
        uint corner = cornerAt(s);
        if (corner == 3u) position = onSide(side, s.along);
        else position = cornerLimit(at, t, corner);
        uint own = at.vertex + line.sector * last + k;
        storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, ofSector(frame));
        k += line.lines;
    } while (k < last);
    RingStep step = firstRingStep(line.n, last);
    while (step.ring <= step.last) {
        vec3 w = ringWeights(lodPair(inside, step.k, last), lodPair(inside, step.ring, last).x);
        regularTriangle(at, t, points, leaf, ringPoint(line.sector, false, vec2(0.0), w), line.sector, position, frame);
        uint own = at.vertex + ringSideStart(3u, step.ring, line.sector, last) + step.k - step.ring;
        storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, ofSector(frame));
        step = nextRingStep(step, last - step.ring);
    }
}
void evaluateLines() {
    Share share = shareOfGroup();
    RingLine line = ringLineOfLane(share);
    if (line.place < share.count) evaluateLine(PATCH_IN_PLACE(share, line.place), line);
}
void evaluateWide() {
    if (kLines) evaluateLines(); // kLoopRegularPatch
    else evaluateWideSamples();
}
#endif
#if !defined(WIDE) && defined(LEVELS)
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    Triangle t = triangleOf(at.record, kIrregular);
    uint last = at.capacity, rings = (last + 1u) / 2u;
    laneCage = cageLeaf(at, t);
    Leaf leaf;
    if (!kIrregular) leaf = leafOf(laneCage);
    LodPattern inside = recordPattern(lodRecord, 0u, at.capacityIndex);
    uint sector = 0u;
    do {
        LodPattern side = recordPattern(lodRecord, 1u + sector, at.capacityIndex);
        uint ring = 0u;
        do {
            float across = lodPair(inside, ring, last).x;
            uint vertex = at.vertex + ringSideStart(3u, ring, sector, last), k = ring;
            do {
                vec2 along = lodPair(side, k, last);
                TrianglePoint s = ringPoint(sector, ring == 0u, along, ringWeights(along, across));
                vec3 position;
                Frame frame;
                if (kIrregular) irregularTriangle(at, t, s, sector, position, frame);
                else regularTriangle(at, t, laneCage, leaf, s, sector, position, frame);
                uint own = vertex + k - ring;
                storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, ofSector(frame));
            } while (++k < last - ring);
            side = inside;
        } while (++ring < rings);
    } while (++sector < 3u);
}
#endif
#ifndef LEVELS
uint last; // segments along a side

vec2 pairOf(uint k) { return parameterPair(k, last); }
// `counts`: of the weights of corners 1 and 2.
void store(const PatchPlace at, bool own, uvec2 counts, vec3 position, Frame frame) {
    uint to = kInterior ? rowStart(last - 2u, counts.y - 1u) + counts.x - 1u : rowStart(last + 1u, counts.y) + counts.x;
    if (own) storeSurfaceVertex(at.vertex + to, at.own + to, position, frame);
}
// So many steps from a corner along its two edges.
uvec2 countsFrom(uint corner, uint a, uint b) {
    uint rest = last - a - b;
    return SELECT2(corner == 0u, uvec2(a, b), SELECT2(corner == 1u, uvec2(rest, a), uvec2(b, rest)));
}

void storeRegular(const PatchPlace at, Triangle t) {
    LeafPoints points = cageLeaf(at, t);
    Leaf leaf = leafOf(points);
    uint j = 1u;
    do {
        LeafRow row = leafRow(leaf, pairOf(j).x);
        uint i = 1u;
        do {
            float x = pairOf(i).x;
            precise vec3 p = leaf.first + rowOffset(row, x);
            store(at, i + j < last, uvec2(i, j), p, seenFrom(0u, 0u, rowAlongX(row, x), rowAlongY(row, x)));
        } while (++i + j < last);
    } while (++j + 1u < last);
    if (kInterior) return;
    uint side = 0u;
    do {
        LeafSide own = leafSide(points, side, false, hasFlag(t, kSharpTriangleSide, side));
        vec3 limit = cornerLimit(at, t, side);
        uint k = 0u;
        do {
            vec2 along = pairOf(k);
            vec3 w = weightsOnSide(side, along);
            LeafRow row = leafRow(leaf, w.z);
            store(at, true, countsFrom(side, k, 0u), k == 0u ? limit : onSide(own, along),
                  seenFrom(0u, 0u, rowAlongX(row, w.y), rowAlongY(row, w.y)));
        } while (++k < last);
    } while (++side < 3u);
}

// The samples that the leaves of a net have, i and j steps from its corner along the two edges. The cell at the corner has those
// with i + j below `least`, the others those below `end`. The cells further along an edge begin at `split`.
struct NetSamples {
    uint corner; // the net is seen from: of the triangle's own, 0
    uint split, least, end;
    float scale; // from distances to parameters of the net
};
float netParameter(NetSamples s, uint k) {
    precise float x = pairOf(k).x * s.scale;
    return x;
}

void storeInside(const PatchPlace at, NetSource net, NetSamples s, uint cell, Leaf leaf, Creases creases) {
    bool middle = cell == kMiddleCell;
    uint j = cell == 2u ? s.split : 1u;
    uint endJ = cell == 0u ? s.least : cell == 1u ? s.end + 1u - min(s.split, s.end) : middle ? min(s.split, s.end) : s.end;
    do { // to before endJ - 1, but the middle's to before endJ
        bool ownRow = middle ? j < endJ : j + 1u < endJ;
        precise float y = netParameter(s, j), inY = middle ? 1.0 - y : cell == 2u ? y - 1.0 : y;
        LeafRow row = leafRow(leaf, inY);
        uint i = cell == 1u ? s.split : middle ? uint(max(int(s.least) - int(j), 1)) : 1u;
        uint endI = !ownRow ? 0u : cell == 0u ? s.least - j : middle ? min(s.split, s.end - j) : s.end - j;
        do {
            precise float x = netParameter(s, i), inX = middle ? 1.0 - x : cell == 1u ? x - 1.0 : x;
            vec3 da = rowAlongX(row, inX), db = rowAlongY(row, inX);
            CreaseSum more;
            if (kSemiSharp) {
                more = creaseSum(creases, cell, inX, inY);
                da += more.dx, db += more.dy;
            }
            Frame frame = seenFrom(s.corner, 0u, middle ? -da : da, middle ? -db : db);
            store(at, i < endI, countsFrom(s.corner, i, j), inLeaf(net.origin, leaf, row, inX, more), frame);
        } while (++i < endI);
        ++j;
    } while (middle ? j < endJ : j + 1u < endJ);
}

Frame leafFrame(Leaf leaf, vec2 w) {
    LeafRow row = leafRow(leaf, w.y);
    return seenFrom(0u, 0u, rowAlongX(row, w.x), rowAlongY(row, w.x));
}
// Of a plain corner, half of a side: of its first edge or, with `back`, of its second.
void storeHalfSide(const PatchPlace at, Triangle t, NetSamples s, uint cell, LeafPoints points, Leaf leaf,
                   LeafPoints cage, bool back) {
    if (kInterior) return;
    uint corner = min(cell, 2u), side = back ? lastOf(corner) : corner;
    bool whole = !kSemiSharp && hasFlag(t, kWholeTriangleSide, side);
    LeafPoints from;
    [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k) from.p[k] = SELECT3(whole, cage.p[k], points.p[k]);
    LeafSide line = leafSide(from, corner, back, hasFlag(t, kSharpTriangleSide, side));
    uint k = 1u;
    do {
        precise float x = netParameter(s, k), rest = 1.0 - x;
        vec3 position = onSide(line, whole ? pairOf(k) : vec2(x, rest));
        vec3 w = back ? weightsOnSide(side, vec2(rest, x)) : weightsOnSide(side, vec2(x, rest));
        store(at, cell < 3u && k < s.least, back ? countsFrom(corner, 0u, k) : countsFrom(corner, k, 0u), position,
              leafFrame(leaf, w.yz));
    } while (++k < s.least);
}
// The middles of the sides, at even rates: the corners of the leaf in the middle.
void storeMiddles(const PatchPlace at, Triangle t, NetSource net, LeafPoints points, Leaf leaf, Creases creases, LeafPoints cage) {
    if (kInterior) return;
    uint side = 0u;
    do {
        uint v = lastOf(side);
        bool whole = !kSemiSharp && hasFlag(t, kWholeTriangleSide, side), sharp = hasFlag(t, kSharpTriangleSide, side);
        vec3 position = whole ? onSide(leafSide(cage, side, false, sharp), vec2(0.5)) : middleOfSide(net, points, side);
        vec2 w = vec2(v == 1u, v == 2u);
        LeafRow row = leafRow(leaf, w.y);
        vec3 da = rowAlongX(row, w.x), db = rowAlongY(row, w.x);
        if (kSemiSharp) {
            CreaseSum more = creaseSum(creases, kMiddleCell, w.x, w.y);
            da += more.dx, db += more.dy;
        }
        Frame frame = seenFrom(0u, 0u, da, db);
        store(at, last % 2u == 0u, countsFrom(side, last / 2u, 0u), position, Frame(-frame.du, -frame.dv, frame.normal));
    } while (++side < 3u);
}

struct NetPoints {
    vec3 p[kTriangleNetPoints];
};
NetPoints netPoints(const PatchPlace at, NetSource net) {
    NetPoints points;
    uint indices[kTriangleNetPoints] = netIndices(net);
    [[unroll]] for (uint k = 0u; k < kTriangleNetPoints; ++k) points.p[k] = poolPoint(at, indices[k]);
    return points;
}
LeafPoints leafOfNet(NetPoints net, NetSource source, uint cell) {
    LeafPoints leaf;
    [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k) leaf.p[k] = OF_CELL(SELECT3, cell, net.p, k);
    mirrorInCell(leaf, source, cell);
    return leaf;
}

// What lies across semi-sharp creases stays as it is in `points`, for the samples on them.
Leaf creasedLeaf(LeafPoints points, NetSource net, uint cell, out Creases creases) {
    LeafPoints mirrored = points;
    if (kSemiSharp) creases = takeCreases(mirrored, net.sharpness, cell);
    return leafOf(mirrored);
}

// The triangle's own net: the leaf in the middle, which comes last, and those at plain corners.
void storeOwnNet(const PatchPlace at, Triangle t) {
    uint nearer = (last + 1u) / 2u, cells = 1u << kMiddleCell | triangleFlags(t, kPlainTriangleCorner);
    NetSamples s = NetSamples(0u, last - nearer + 1u, nearer, last, 2.0);
    NetSource net = ownNet(at, t);
    NetPoints all = netPoints(at, net);
    LeafPoints points, cage; // sides of sharp triangles are never whole
    if (!kSemiSharp) cage = cageLeaf(at, t);
    Leaf leaf;
    Creases creases;
    bool more;
    do {
        uint cell = uint(findLSB(cells));
        points = leafOfNet(all, net, cell);
        leaf = creasedLeaf(points, net, cell, creases);
        storeInside(at, net, s, cell, leaf, creases);
        storeHalfSide(at, t, s, cell, points, leaf, cage, false);
        storeHalfSide(at, t, s, cell, points, leaf, cage, true);
        store(at, !kInterior && cell < 3u, countsFrom(min(cell, 2u), 0u, 0u), cornerLimit(at, t, min(cell, 2u)),
              leafFrame(leaf, vec2(cell == 1u, cell == 2u)));
        // What is used behind the loop is that of the last cell, even if lavapipe goes on with lanes that have finished.
        uint rest = cells & (cells - 1u);
        more = rest != 0u;
        cells = more ? rest : cells;
    } while (more);
    if (kSemiSharp) { // made anew: with creases, lavapipe does not keep it in lanes that have finished
        points = leafOfNet(all, net, kMiddleCell);
        leaf = creasedLeaf(points, net, kMiddleCell, creases);
    }
    storeMiddles(at, t, net, points, leaf, creases, cage);
}

// What a level has of the corner's two edges: the first has samples in cell 1, the second in cell 2.
void storeOnEdge(const PatchPlace at, NetSource net, NetSamples s, uint cell, LeafPoints points, Leaf leaf, Creases creases) {
    if (kInterior) return;
    bool back = cell == 2u;
    LeafSide line = leafSide(points, 0u, back, (net.sides >> (back ? 2u : 0u) & 1u) != 0u);
    float sharpness = back ? net.sharpness.z : net.sharpness.x;
    vec3 first = back ? leaf.c01 : leaf.c10, second = 2.0 * (back ? leaf.c02 : leaf.c20), third = 3.0 * (back ? leaf.c03 : leaf.c30);
    vec3 fourth = 4.0 * (back ? leaf.c04 : leaf.c40), mixed = back ? leaf.c12 : leaf.c21, across = back ? leaf.c10 : leaf.c01;
    uint k = s.split;
    do {
        precise float x = netParameter(s, k) - 1.0, rest = 1.0 - x;
        precise vec3 p = net.origin + onCreasedSide(line, sharpness, vec2(x, rest));
        vec3 d = first + x * (second + x * (third + x * fourth)), e = across + x * (leaf.c11 + x * (mixed + x * 0.5 * fourth));
        if (kSemiSharp) {
            CreaseWeights weights = creaseWeights(sharpness, vec2(x, 0.0));
            d += weighted(creases.of[0], weights.along), e += weighted(creases.of[0], weights.across);
        }
        store(at, cell < 3u && k < s.end, back ? countsFrom(s.corner, 0u, k) : countsFrom(s.corner, k, 0u), p,
              seenFrom(s.corner, 0u, back ? e : d, back ? d : e));
    } while (++k < s.end);
}

void storeChains(const PatchPlace at, Triangle t) {
    uint chains = ~triangleFlags(t, kPlainTriangleCorner) & 7u, level = 2u;
    do {
        uint corner = uint(findLSB(chains));
        Chain chain = chainOf(at, t, corner);
        NetSource net = chainNet(at, t, chain, corner, level);
        uint split = (last + (1u << level) - 1u) >> level, end = (last + (1u << level - 1u) - 1u) >> level - 1u;
        NetSamples s = NetSamples(corner, split, split, end, powerOfTwo(float(level)));
        NetPoints all = netPoints(at, net);
        uint cell = 1u;
        do {
            LeafPoints points = leafOfNet(all, net, cell);
            Creases creases;
            Leaf leaf = creasedLeaf(points, net, cell, creases);
            storeInside(at, net, s, cell, leaf, creases);
            storeOnEdge(at, net, s, cell, points, leaf, creases);
        } while (++cell < 4u);
        // At the corner the chords of the last level stand in for directions.
        bool isLast = level == chain.lastLevel;
        Frame frame = seenFrom(corner, 0u, all.p[3] - all.p[0], all.p[5] - all.p[0]);
        store(at, !kInterior && isLast, countsFrom(corner, 0u, 0u), cornerLimit(at, t, corner), withCornerNormal(at, t, corner, frame));
        chains &= isLast ? chains - 1u : 7u;
        level = isLast ? 2u : level + 1u;
    } while (chains != 0u);
}

void evaluatePatch(const PatchPlace at) {
    last = fixedRate();
    Triangle t = triangleOf(at.record, kIrregular);
    if (kIrregular) {
        storeOwnNet(at, t);
        storeChains(at, t);
    } else {
        storeRegular(at, t);
    }
}
#endif
