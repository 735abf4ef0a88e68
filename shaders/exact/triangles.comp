// Evaluates Loop patches (docs/loop.md): every sample is that of a leaf.
//
// Narrow mapping: leaf by leaf, first what lies inside of it, then what lies on its sides. Wide mapping, and irregular triangles at
// levels: sample by sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/exact.h"
#include "shaders/shared/lod.h"

layout(constant_id = kKindConstant) const uint kClass = kLoopIrregularPatch;
const bool kIrregular = kClass == kLoopIrregularPatch;
const uint kRecordElements = kIrregular ? kIrregularTriangleElements : kTriangleElements;
const uint kForm = kLodTriangleForm;
const uint kParts = kIrregular ? kTriangleNetPoints : kLeafPoints;
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/domain.glsl"
#include "shaders/surface/net.glsl"

vec3 poolPoint(const PatchPlace at, uint i) { return coefficient(at.base + i, at.isNew); }

#ifdef WIDE
shared vec4 localPoints[kMaxPatchesPerGroup * kParts];
uint localPlace; // of the lane's patch

vec3 netPoint(const PatchPlace at, uint k) { return localPoints[localPlace * kParts + k].xyz; }
#define LOCAL_NET
#endif
#include "shaders/exact/triangle_sample.glsl"

#ifdef LEVELS
// Where a sample of a ring lies, and its derivatives as those of a sector: along the side and towards the centre.
TrianglePoint ringPoint(RingSample ring, vec2 along, vec3 w) {
    if (ring.ring == 0u) return pointOnSide(ring.side, along);
    float third = w.z / 3.0;
    vec3 own = vec3(w.x + third, w.y + third, third);
    vec3 weights = ring.side == 0u ? own : ring.side == 1u ? own.zxy : own.yzx;
    return TrianglePoint(weights, 0.0, kInside, vec2(0.0));
}
Frame ofSector(Frame f) { return Frame(f.du, (f.du + f.dv) / 3.0, f.normal); }
#else
TrianglePoint gridPoint(uvec2 at) {
    uint rate = fixedRate(), rest = rate - at.x - at.y;
    uint side = at.y == 0u ? 0u : rest == 0u ? 1u : at.x == 0u ? 2u : kInside;
    if (side == 0u) return pointOnSide(0u, parameterPair(at.x, rate, push.pairs));
    if (side == 1u) return pointOnSide(1u, parameterPair(at.y, rate, push.pairs));
    if (side == 2u) return pointOnSide(2u, parameterPair(rest, rate, push.pairs));
    vec3 w = vec3(parameterPair(rest, rate, push.pairs).x, parameterPair(at.x, rate, push.pairs).x,
                  parameterPair(at.y, rate, push.pairs).x);
    return TrianglePoint(w, parameterPair(rate - max(max(at.x, at.y), rest), rate, push.pairs).x, kInside, vec2(0.0));
}
#endif

#ifdef WIDE
void loadPart(uint to, const PatchPlace at, uint k) {
    uint first = kIrregular ? kTriangleNetElement : kTriangleCageElement;
    localPoints[to] = vec4(poolPoint(at, tableWord(4u * (at.record + first) + k)), 0.0);
}
void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    localPlace = place;
    Triangle t = triangleOf(at.record, kIrregular);
#ifdef LEVELS
    RingSample ring = ringSample(3u, at.capacity, index);
    vec2 along;
    vec3 w = ringWeights(place, at.capacity, ring, along);
    TrianglePoint s = ringPoint(ring, along, w);
    uint to = ring.side;
#else
    TrianglePoint s = gridPoint(gridSample(kTriangleDomain, fixedRate(), index).xy);
    const uint to = 0u;
#endif
    if (kIrregular) {
        irregularTriangle(at, t, s, to, position, frame);
    } else {
        LeafPoints points;
        [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k) points.p[k] = netPoint(at, k);
        mirror(points, triangleFlags(t, kSharpTriangleSide), triangleFlags(t, kCreasedTriangleCorner));
        regularTriangle(at, t, points, leafOf(points), s, to, position, frame);
    }
#ifdef LEVELS
    frame = ofSector(frame);
#endif
}
#elif defined(LEVELS)
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    Triangle t = triangleOf(at.record, kIrregular);
    uint last = at.capacity, rings = (last + 1u) / 2u;
    LeafPoints points;
    Leaf leaf;
    if (!kIrregular) {
        points = cageLeaf(at, t);
        leaf = leafOf(points);
    }
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
                TrianglePoint s = ringPoint(RingSample(ring, sector, k), along, ringWeights(along, across));
                vec3 position;
                Frame frame;
                if (kIrregular) irregularTriangle(at, t, s, sector, position, frame);
                else regularTriangle(at, t, points, leaf, s, sector, position, frame);
                uint own = vertex + k - ring;
                storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, ofSector(frame));
            } while (++k < last - ring);
            side = inside;
        } while (++ring < rings);
    } while (++sector < 3u);
}
#else
uint last; // segments along a side

vec2 pairOf(uint k) { return parameterPair(k, last, push.pairs); }
// `counts`: of the weights of corners 1 and 2.
void store(const PatchPlace at, bool own, uvec2 counts, vec3 position, Frame frame) {
    if (!own) return;
    uint to = rowStart(last + 1u, counts.y) + counts.x;
    storeSurfaceVertex(at.vertex + to, at.own + to, position, frame);
}
// So many steps from a corner along its two edges.
uvec2 countsFrom(uint corner, uint a, uint b) {
    uint rest = last - a - b;
    return corner == 0u ? uvec2(a, b) : corner == 1u ? uvec2(rest, a) : uvec2(b, rest);
}

void evaluateRegular(const PatchPlace at) {
    Triangle t = triangleOf(at.record, false);
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

// The samples that the leaves of a net have: i and j steps from its corner along the two edges. The cell at the corner has those
// with i + j below `least`; the others have those below `end`, and those from `split` on are in the cells further along an edge.
struct NetSamples {
    uint corner, split, least, end;
    float scale; // from distances to parameters of the net
    bool own;    // of the triangle's own net: all corners are its
};
float netParameter(NetSamples s, uint k) {
    precise float x = pairOf(k).x * s.scale;
    return x;
}

void storeInside(const PatchPlace at, NetSource net, NetSamples s, uint cell, Leaf leaf) {
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
            precise vec3 p = net.origin + (leaf.first + rowOffset(row, inX));
            vec3 da = rowAlongX(row, inX), db = rowAlongY(row, inX);
            Frame frame = seenFrom(s.own ? 0u : s.corner, 0u, middle ? -da : da, middle ? -db : db);
            store(at, i < endI, countsFrom(s.own ? 0u : s.corner, i, j), p, frame);
        } while (++i < endI);
        ++j;
    } while (middle ? j < endJ : j + 1u < endJ);
}

Frame leafFrame(Leaf leaf, NetSamples s, vec2 w) {
    LeafRow row = leafRow(leaf, w.y);
    return seenFrom(s.own ? 0u : s.corner, 0u, rowAlongX(row, w.x), rowAlongY(row, w.x));
}
// Half of a side, seen from the corner that has it: of the corner's first edge or, with `back`, of its second.
void storeHalfSide(const PatchPlace at, Triangle t, NetSource net, NetSamples s, uint cell, LeafPoints points, Leaf leaf, bool back) {
    uint begin = s.own ? cell : 0u, netSide = back ? lastOf(begin) : begin;
    uint corner = s.own ? cell : s.corner, side = back ? lastOf(corner) : corner;
    bool sharp = (net.sides >> netSide & 1u) != 0u, whole = s.own && hasFlag(t, kWholeTriangleSide, side);
    LeafSide line = leafSide(points, begin, back, sharp);
    if (whole) line = leafSide(cageLeaf(at, t), begin, back, sharp);
    uint k = s.own ? 1u : s.split, end = s.own ? s.least : s.end;
    bool has = s.own ? cell < 3u : cell == (back ? 2u : 1u);
    do {
        precise float x = netParameter(s, k) - (s.own ? 0.0 : 1.0), rest = 1.0 - x;
        precise vec3 p = net.origin + onSide(line, whole ? pairOf(k) : vec2(x, rest));
        vec3 w = back ? weightsOnSide(netSide, vec2(rest, x)) : weightsOnSide(netSide, vec2(x, rest));
        store(at, has && k < end, back ? countsFrom(corner, 0u, k) : countsFrom(corner, k, 0u), p, leafFrame(leaf, s, w.yz));
    } while (++k < end);
}
// A corner: of a chain's last level, or plain.
void storeCorner(const PatchPlace at, Triangle t, NetSamples s, uint cell, LeafPoints points, Leaf leaf, bool own) {
    uint corner = s.own ? cell : s.corner;
    Frame frame;
    if (s.own) frame = leafFrame(leaf, s, vec2(cell == 1u, cell == 2u));
    else frame = withNormal(seenFrom(corner, 0u, points.p[0] - points.p[11], points.p[8] - points.p[11]), cornerNormal(at, corner));
    store(at, own, countsFrom(corner, 0u, 0u), cornerLimit(at, t, corner), frame);
}
// The middles of the sides, at even rates: the corners of the leaf in the middle.
void storeMiddles(const PatchPlace at, Triangle t, NetSource net, NetSamples s, LeafPoints points, Leaf leaf) {
    uint side = 0u;
    do {
        uint v = lastOf(side);
        vec3 position = middleOfSide(net, points, side);
        if (hasFlag(t, kWholeTriangleSide, side)) position = onWholeSide(at, t, side, vec2(0.5));
        Frame frame = leafFrame(leaf, s, vec2(v == 1u, v == 2u));
        store(at, true, countsFrom(side, last / 2u, 0u), position, Frame(-frame.du, -frame.dv, frame.normal));
    } while (++side < 3u);
}

LeafPoints leafOfNet(vec3 p[kTriangleNetPoints], NetSource net, uint cell) {
    const uint kPoints[4][12] = uint[4][12](uint[12](0u, 3u, 5u, 6u, 1u, 11u, 9u, 4u, 14u, 12u, 2u, 17u),
                                            uint[12](3u, 1u, 4u, 9u, 7u, 2u, 12u, 10u, 5u, 15u, 13u, 0u),
                                            uint[12](5u, 4u, 2u, 0u, 10u, 8u, 3u, 13u, 11u, 1u, 16u, 14u),
                                            uint[12](4u, 5u, 3u, 13u, 14u, 12u, 2u, 0u, 1u, 11u, 9u, 10u));
    LeafPoints leaf;
    [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k)
        leaf.p[k] = cell < 2u ? (cell == 0u ? p[kPoints[0][k]] : p[kPoints[1][k]])
                              : (cell == 2u ? p[kPoints[2][k]] : p[kPoints[3][k]]);
    mirrorInCell(leaf, net, cell);
    return leaf;
}

void storeNet(const PatchPlace at, Triangle t, NetSource net, NetSamples s, bool lastLevel) {
    vec3 p[kTriangleNetPoints];
    [[unroll]] for (uint e = 0u; e < kTriangleWindowElements; ++e) {
        uvec4 words = tableElement(net.element + e);
        [[unroll]] for (uint c = 0u; c < 4u; ++c) {
            uint k = 4u * e + c;
            if (k < kTriangleNetPoints) p[k] = poolPoint(at, net.first + words[c]);
        }
    }
    uint cells = s.own ? 8u | triangleFlags(t, kPlainTriangleCorner) : 14u;
    do {
        uint cell = uint(findLSB(cells));
        LeafPoints points = leafOfNet(p, net, cell);
        Leaf leaf = leafOf(points);
        storeInside(at, net, s, cell, leaf);
        if (cell == kMiddleCell) {
            if (s.own && last % 2u == 0u) storeMiddles(at, t, net, s, points, leaf);
        } else {
            storeHalfSide(at, t, net, s, cell, points, leaf, false);
            storeHalfSide(at, t, net, s, cell, points, leaf, true);
            storeCorner(at, t, s, cell, points, leaf, s.own || (lastLevel && cell == 1u));
        }
        cells &= cells - 1u;
    } while (cells != 0u);
}

void evaluateIrregular(const PatchPlace at) {
    Triangle t = triangleOf(at.record, true);
    uint chains = ~triangleFlags(t, kPlainTriangleCorner) & 7u, level = 1u, corner = 0u, half_ = (last + 1u) / 2u;
    bool more;
    do {
        bool own = level == 1u;
        Chain chain = chainOf(at, corner);
        NetSource net = ownNet(at, t);
        NetSamples s = NetSamples(0u, last - half_ + 1u, half_, last, 2.0, true);
        if (!own) {
            net = chainNet(at, t, chain, corner, level);
            uint split = (last + (1u << level) - 1u) >> level, end = (last + (1u << level - 1u) - 1u) >> level - 1u;
            s = NetSamples(corner, split, split, end, powerOfTwo(float(level)), false);
        }
        bool lastLevel = !own && level == chain.lastLevel;
        storeNet(at, t, net, s, lastLevel);
        ++level;
        more = !own && !lastLevel;
        if (own || lastLevel) { // the next chain
            more = chains != 0u;
            corner = more ? uint(findLSB(chains)) : 0u;
            chains &= chains - 1u;
            level = 2u;
        }
    } while (more);
}

void evaluatePatch(const PatchPlace at) {
    last = fixedRate();
    if (kIrregular) evaluateIrregular(at);
    else evaluateRegular(at);
}
#endif
