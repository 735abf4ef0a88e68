// Irregular quads net by net, for lanes that have a whole quad (docs/catmull_clark.md). A net is loaded once and collapsed row by row.
// Before the include: what quad.glsl needs, pairs.glsl, and
//   const bool kChains                                whether some corner has a chain
//   const bool kInside                                whether samples inside are stored
//   const bool kSides                                 whether samples on its sides are stored
//   uint last                                         number of the last sample along a side
//   void store(const PatchPlace at, bool own, uint i, uint j, vec3 position, Frame frame)
//
// A quad is evaluated quarter by quarter, from each of its corners. Between them the quad is turned, so that a quarter is always the
// one at corner 0: lanes have nets in registers, which they cannot index, and code for each corner would take drivers four times as
// long to compile. On lavapipe lanes go through both sides of every `if`, and once more through a loop that is tested at the top. So
// borders are not told apart sample by sample, loops are tested at the bottom, and what must not be stored is computed all the same.
#include "shaders/chains/offset.glsl"
#include "shaders/catmull_clark/rows.glsl"

struct Net {
    vec3 p[kNetPoints];
};
Net netOf(const PatchPlace at, uint netList, uint first) {
    NetIndices indices = netIndices(netList, first);
    Net net;
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) net.p[k] = poolPoint(at, indices.of[k]);
    return net;
}
Net quadNet(const PatchPlace at, IrregularQuad quad) { return netOf(at, at.record + kQuadNetElement, quad.first); }
Net chainNet(const PatchPlace at, Chain chain, uint level) { return netOf(at, chain.netLists, levelPoints(chain, level)); }
// Seen from the next corner, and from any.
Net turnedOnce(Net net) {
    Net turned;
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) turned.p[k] = net.p[SUPPLE_QUAD_NET_PLACE(1u, k % kNetSide, k / kNetSide)];
    return turned;
}
Net turnedNet(const PatchPlace at, IrregularQuad quad, uint corner) {
    Net net;
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k)
        net.p[k] = ownPoint(at, quad.first, SUPPLE_QUAD_NET_PLACE(corner, k % kNetSide, k / kNetSide));
    return net;
}
uvec4 turned(uvec4 v, uint corner) {
    uvec4 once = SELECT4((corner & 1u) != 0u, v.yzwx, v);
    return SELECT4((corner & 2u) != 0u, once.zwxy, once);
}
IrregularQuad turnedQuad(IrregularQuad quad, uint corner) {
    uint flags = quad.flags >> kCubicSide & 15u;
    return IrregularQuad(turned(quad.points, corner), turned(quad.spokes, corner), turned(quad.netLists, corner),
                         uintBitsToFloat(turned(floatBitsToUint(quad.sharpness), corner)),
                         (flags >> corner | flags << (4u - corner)) << kCubicSide, quad.first, turned(quad.normals, corner));
}

// The same, as offsets from its middle.
struct NetOffsets {
    vec3 middle, p[kNetPoints];
};
NetOffsets offsetsOf(Net net) {
    NetOffsets offsets;
    offsets.middle = net.p[kNetMiddle];
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) offsets.p[k] = offsetFrom(net.p[kNetMiddle], net.p[k]);
    return offsets;
}

NetRow netRow(NetOffsets net, bool upper, LeafWeights y) {
    NetRow row;
    [[unroll]] for (uint i = 0u; i < kNetSide; ++i) {
        vec3 p[4];
        [[unroll]] for (uint j = 0u; j < 4u; ++j) p[j] = SELECT3(upper, net.p[kNetSide * (j + 1u) + i], net.p[kNetSide * j + i]);
        row.point[i] = sumInside(y.w, p[0], p[1], p[2], p[3]);
        row.slope[i] = blend4(y.d, p[0], p[1], p[2], p[3]);
    }
    return row;
}
#ifdef LEVELS
LodPattern patterns[6];
const bool kOwnBorders = true; // whose samples lie elsewhere than those of the rows inside
#else
const bool kOwnBorders = false;
#endif
const uint kSide = 2u; // pattern of the first side, behind those inside in u and in v
vec2 pairOf(uint pattern, uint k) {
#ifdef LEVELS
    return lodPair(patterns[pattern], k, last);
#else
    return parameterPair(k, last);
#endif
}

// What positions on half of a side are made of, from the corner outwards.
struct Half {
    bool cubic;
    vec3 p[4], middle; // the middle of the side
};
Half halfOf(Net net, uint along, uint across, float share) {
    vec3 e[kNetSide];
    [[unroll]] for (uint k = 0u; k < kNetSide; ++k) {
        uint own = across + k * along;
        e[k] = onLine(net.p[own], net.p[own - across], net.p[own + across], share);
    }
    return Half(false, vec3[4](e[0], e[1], e[2], e[3]), middleOfLine(e[1], e[2], e[3]));
}
Half firstHalf(Net net, float share) { return halfOf(net, 1u, kNetSide, share); }
Half secondHalf(Net net, float share) { return halfOf(net, kNetSide, 1u, share); }
void setCubic(inout Half h, bool cubic, vec3 g[4]) {
    h.cubic = cubic;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) h.p[k] = SELECT3(cubic, g[k], h.p[k]);
}
// `w`: of the leaf, along the side.
vec3 onHalf(Half h, vec2 pair, vec4 w) {
    w = SELECT4(h.cubic, bernstein3(pair), w);
    vec3 p = sum4(w, h.p[0], h.p[1], h.p[2], h.p[3]);
    return SELECT3(!h.cubic && pair.x == pair.y, h.middle, p);
}

// Where a quarter's samples stand: counted from its corner, along its two edges.
struct QuarterPlace {
    uint corner;
    uint countA, countB; // of samples that are its own
};
QuarterPlace quarterPlace(uint corner) {
    // What lies in the middle belongs to the lower quarters.
    bool turned = (corner & 1u) != 0u;
    uint below = last / 2u + 1u, above = (last + 1u) / 2u;
    uint countU = isRight(corner) ? above : below, countV = isUpper(corner) ? above : below;
    return QuarterPlace(corner, turned ? countV : countU, turned ? countU : countV);
}
void storeInQuarter(const PatchPlace at, bool own, uint corner, uint a, uint b, vec3 position, vec3 da, vec3 db) {
    uvec2 place = placeInQuad(corner, a, b);
    store(at, own, place.x, place.y, position, turnedFrame(corner, da, db));
}

// A quarter without a chain: of the quad's own net, turned.
struct OwnQuarter {
    IrregularQuad quad;
    NetOffsets net;
    Half first, second; // of the two edges
    QuarterPlace place;
    vec3 limit;
    bool own; // its samples are stored
};
// At levels segments may have no length: such a sample is the corner, to the bit.
vec3 orLimit(vec3 limit, float distance, vec3 position) { return kOwnBorders && distance == 0.0 ? limit : position; }
LeafWeights ownAcross(OwnQuarter q, float distance) { return quarterWeights(distance, sharpnessOf(q.quad, 0u, 1u)); }
LeafWeights ownAlong(OwnQuarter q, float distance) { return quarterWeights(distance, sharpnessOf(q.quad, 3u, 1u)); }

void storeOwnFirst(const PatchPlace at, OwnQuarter q) {
    uint corner = q.place.corner, a = 1u;
    NetRow row = netRow(q.net, false, ownAcross(q, 0.0));
    LeafWeights begin = ownAlong(q, 0.0);
    Frame frame = turnedFrame(corner, rowAlongX(row, false, begin.d), rowAlongY(row, false, begin.w));
    uvec2 place = placeInQuad(corner, 0u, 0u);
    store(at, q.own, place.x, place.y, q.limit, withStoredNormal(at, q.quad, 0u, frame));
    do {
        vec2 pair = pairOf(kOwnBorders ? kSide + corner : 0u, a);
        LeafWeights x = ownAlong(q, pair.x);
        vec3 position = orLimit(q.limit, pair.x, onHalf(q.first, pair, x.w));
        storeInQuarter(at, q.own && a < q.place.countA, corner, a, 0u, position, rowAlongX(row, false, x.d), rowAlongY(row, false, x.w));
    } while (++a < q.place.countA);
}
void storeOwnSecond(const PatchPlace at, OwnQuarter q, NetRow row, bool own, uint b, vec2 pair, LeafWeights y) {
    LeafWeights x = ownAlong(q, 0.0);
    vec3 position = orLimit(q.limit, pair.x, onHalf(q.second, pair, y.w));
    storeInQuarter(at, own, q.place.corner, 0u, b, position, rowAlongX(row, false, x.d), rowAlongY(row, false, x.w));
}
// `onA`, `onB`: constants, whether the samples on the quarter's two borders are stored, and the corner's with the first.
void storeOwnQuarter(const PatchPlace at, OwnQuarter q, bool onA, bool onB) {
    uint corner = q.place.corner, alongA = corner & 1u;
    if (onA) storeOwnFirst(at, q);
    bool apart = onB && (kOwnBorders || !kInside);
    if (kInside || onB) {
        uint b = 1u;
        do {
            bool own = q.own && b < q.place.countB;
            vec2 across = pairOf(1u - alongA, b);
            if (kInside) {
                LeafWeights y = ownAcross(q, across.x);
                NetRow row = netRow(q.net, false, y);
                if (onB && !apart) storeOwnSecond(at, q, row, own, b, across, y);
                uint a = 1u;
                do {
                    vec2 pair = pairOf(alongA, a);
                    LeafWeights x = ownAlong(q, pair.x);
                    vec3 position = placed(vec3(0.0), q.net.middle, rowPoint(cellRow(row, false), x.w));
                    position = orLimit(q.limit, max(pair.x, across.x), position);
                    storeInQuarter(at, own && a < q.place.countA, corner, a, b, position, rowAlongX(row, false, x.d), rowAlongY(row, false, x.w));
                } while (++a < q.place.countA);
            }
            if (apart) {
                vec2 pair = pairOf(kOwnBorders ? kSide + ((corner + 3u) & 3u) : 0u, b);
                LeafWeights y = ownAcross(q, pair.x);
                storeOwnSecond(at, q, netRow(q.net, false, y), own, b, pair, y);
            }
        } while (++b < q.place.countB);
    }
}
// The quad is turned, and so is the net.
OwnQuarter ownQuarter(const PatchPlace at, IrregularQuad quad, Net net, uint corner) {
    OwnQuarter q;
    q.quad = quad;
    q.net = offsetsOf(net);
    q.place = quarterPlace(corner);
    q.limit = poolPoint(at, quad.points.x);
    q.own = !kChains || !hasChain(quad, 0u);
    return q;
}
Half ownFirst(const PatchPlace at, IrregularQuad quad, Net net, vec3 g[4]) {
    Half h = firstHalf(net, besideLine(sharpnessOf(quad, 0u, 1u)));
    setCubic(h, isCubic(quad, 0u), g);
    return h;
}
Half ownSecond(const PatchPlace at, IrregularQuad quad, Net net, vec3 g[4]) {
    Half h = secondHalf(net, besideLine(sharpnessOf(quad, 3u, 1u)));
    setCubic(h, isCubic(quad, 3u), vec3[4](g[3], g[2], g[1], g[0]));
    return h;
}

// A quarter with a chain.
struct Quarter {
    QuarterPlace place;
    Chain chain;
    vec3 origin, limit, normal;
    vec3 middleA, middleB; // of the sides
};
Quarter quarterOf(const PatchPlace at, IrregularQuad quad, uint corner, vec3 middleA, vec3 middleB) {
    Quarter own;
    own.place = quarterPlace(corner);
    own.chain = chainOf(at, quad, corner);
    own.origin = chainOrigin(at, own.chain);
    own.normal = poolPoint(at, componentOf(quad.normals, corner));
    own.limit = poolPoint(at, componentOf(quad.points, corner));
    own.middleA = middleA, own.middleB = middleB;
    return own;
}
#ifdef WIDE
vec3 middleOf(const PatchPlace at, IrregularQuad quad, uint side) {
    float share = besideLine(sharpnessOf(quad, side, 1u));
    vec3 e[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 p[3];
        [[unroll]] for (uint j = 0u; j < 3u; ++j) p[j] = ownPoint(at, quad.first, SUPPLE_QUAD_NET_PLACE(side, i + 1u, j));
        e[i] = onLine(p[1], p[0], p[2], share);
    }
    return middleOfLine(e[0], e[1], e[2]);
}
#endif

// The second half of a level's line. Its first half belongs to the levels that follow.
Half chainLine(Net net, uint along, uint across, float share) {
    vec3 e[4];
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        uint own = across + (k + 1u) * along;
        e[k] = onLine(net.p[own], net.p[own - across], net.p[own + across], share);
    }
    return Half(false, e, vec3(0.0));
}

// What a level of a chain has, and which samples are its own: from `first` to before `end`.
struct ChainLevel {
    NetOffsets net;
    Half lineA, lineB;
    float scale, sharpA, sharpB;
    uint firstA, endA, firstB, endB;
};
// The first sample along a pattern that is 2^-level or further from the corner; `before`: the first one of the level before.
uint firstOfLevel(uint pattern, uint before, uint level) {
#ifdef LEVELS
    float least = powerOfTwo(-float(level));
    bool more;
    do {
        more = before > 1u && pairOf(pattern, before - 1u).x >= least;
        before -= more ? 1u : 0u;
    } while (more);
    return before;
#else
    return min(before, (last + (1u << level) - 1u) >> level);
#endif
}
float parameterOf(ChainLevel l, float distance) {
    precise float x = distance * l.scale;
    return x;
}

// Sample (a, b) on a border: of its first edge, or of its second.
void storeOnBorder(const PatchPlace at, Quarter q, bool own, uint a, uint b, float distance, vec3 offset, vec3 middle, Frame frame) {
    precise vec3 p = q.origin + offset;
    p = distance == 0.5 ? middle : p;
    uvec2 place = placeInQuad(q.place.corner, a, b);
    store(at, own, place.x, place.y, p, frame);
}
void storeAlongA(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, uint pattern) {
    uint a = l.firstA;
    do {
        float distance = pairOf(pattern, a).x;
        LeafWeights x = chainWeights(true, parameterOf(l, distance), 0.0);
        Frame frame = turnedFrame(q.place.corner, rowAlongX(row, true, x.d), rowAlongY(row, true, x.w));
        vec3 offset = sum4(x.w, l.lineA.p[0], l.lineA.p[1], l.lineA.p[2], l.lineA.p[3]);
        storeOnBorder(at, q, a < l.endA, a, 0u, distance, offset, q.middleA, frame);
    } while (++a < l.endA);
}
void storeOnB(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, bool own, uint b, float distance, LeafWeights y) {
    LeafWeights x = leafWeights(0.0, l.sharpB);
    Frame frame = turnedFrame(q.place.corner, rowAlongX(row, false, x.d), rowAlongY(row, false, x.w));
    vec3 offset = sum4(y.w, l.lineB.p[0], l.lineB.p[1], l.lineB.p[2], l.lineB.p[3]);
    storeOnBorder(at, q, own, 0u, b, distance, offset, q.middleB, frame);
}
void storeInLevel(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, bool own, uint a, uint b) {
    bool right = a >= l.firstA;
    LeafWeights x = chainWeights(right, parameterOf(l, pairOf(q.place.corner & 1u, a).x), l.sharpB);
    CellRow cell = cellRow(row, right);
    vec3 position = placed(q.origin, l.net.middle, rowPoint(cell, x.w));
    Frame frame = turnedFrame(q.place.corner, rowAlongX(cell, x.d), rowAlongY(cell, x.w));
    uvec2 place = placeInQuad(q.place.corner, a, b);
    store(at, own && a < l.endA, place.x, place.y, position, frame);
}

// The cells of a level but for borders that have patterns of their own. One loop for all three: at most rates a cell has few samples.
void storeLevel(const PatchPlace at, Quarter q, ChainLevel l) {
    uint b = 1u;
    do {
        bool own = b < l.endB, upper = b >= l.firstB;
        float distance = pairOf(1u - (q.place.corner & 1u), b).x;
        LeafWeights y = chainWeights(upper, parameterOf(l, distance), l.sharpA);
        NetRow row = netRow(l.net, upper, y);
        if (!kOwnBorders && kSides) storeOnB(at, q, l, row, own && upper, b, distance, y);
        uint a = upper ? 1u : l.firstA;
        do {
            storeInLevel(at, q, l, row, own, a, b);
        } while (++a < l.endA);
    } while (++b < l.endB);
}

// The samples of a level on the second edge by themselves.
void storeAlongB(const PatchPlace at, Quarter q, ChainLevel l, uint pattern) {
    uint b = l.firstB;
    do {
        float distance = pairOf(pattern, b).x;
        LeafWeights y = chainWeights(true, parameterOf(l, distance), 0.0);
        storeOnB(at, q, l, netRow(l.net, true, y), b < l.endB, b, distance, y);
    } while (++b < l.endB);
}

ChainLevel chainLevel(const PatchPlace at, IrregularQuad quad, Quarter q, uint level, uint endA, uint endB) {
    uint corner = q.place.corner, before = (corner + 3u) & 3u;
    ChainLevel l;
    Net net = chainNet(at, q.chain, level);
    l.net = offsetsOf(net);
    l.scale = powerOfTwo(float(level));
    l.sharpA = sharpnessOf(quad, corner, level), l.sharpB = sharpnessOf(quad, before, level);
    l.lineA = chainLine(net, 1u, kNetSide, besideLine(l.sharpA));
    l.lineB = chainLine(net, kNetSide, 1u, besideLine(l.sharpB));
    l.endA = endA, l.endB = endB;
    l.firstA = firstOfLevel(corner & 1u, endA, level);
    l.firstB = firstOfLevel(1u - (corner & 1u), endB, level);
    return l;
}

#ifdef LEVELS
// The last cell at the corner (chain_level.glsl): its rim is where the net's parameters are 0..1 and one of them is 1. Full segments
// are at least as long as the rim is far away. So at most one segment of a pattern ends in the cell, the first one, while it grows
// from nothing; those that are not born have no length, and all samples of a pattern in the cell are in one place. Stores these, from
// `first` to before `end`.
void storeOnCone(const PatchPlace at, Quarter q, uvec2 first, uvec2 end, float share, vec3 rim, Frame frame) {
    vec3 position = onCone(q.limit, rim, share);
    Frame atCorner = withNormal(frame, q.normal);
    if (share == 0.0) frame = atCorner;
    uint b = first.y;
    do {
        uint a = first.x;
        do {
            uvec2 place = placeInQuad(q.place.corner, a, b);
            store(at, a < end.x && b < end.y, place.x, place.y, position, frame);
        } while (++a < end.x);
    } while (++b < end.y);
}

void storeInCone(const PatchPlace at, Quarter q, ChainLevel l, uvec2 end) {
    float a = pairOf(q.place.corner & 1u, 1u).x, b = pairOf(1u - (q.place.corner & 1u), 1u).x, far = max(a, b);
    bool right = a >= b, upper = b >= a;
    precise float inX = right ? 1.0 : a / far, inY = upper ? 1.0 : b / far;
    LeafWeights x = chainWeights(right, inX, l.sharpB), y = chainWeights(upper, inY, l.sharpA);
    CellRow cell = cellRow(netRow(l.net, upper, y), right);
    storeOnCone(at, q, uvec2(1u), end, parameterOf(l, far), placed(q.origin, l.net.middle, rowPoint(cell, x.w)),
                turnedFrame(q.place.corner, rowAlongX(cell, x.d), rowAlongY(cell, x.w)));
}
// `row`: of the first edge; `end`: of the samples on the two edges.
void storeBordersOfCone(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, uvec2 end) {
    uint corner = q.place.corner, before = (corner + 3u) & 3u;
    LeafWeights begin = chainWeights(true, 1.0, 0.0), across = leafWeights(0.0, l.sharpB);
    precise vec3 rimA = q.origin + sum4(begin.w, l.lineA.p[0], l.lineA.p[1], l.lineA.p[2], l.lineA.p[3]);
    precise vec3 rimB = q.origin + sum4(begin.w, l.lineB.p[0], l.lineB.p[1], l.lineB.p[2], l.lineB.p[3]);
    storeOnCone(at, q, uvec2(1u, 0u), uvec2(end.x, 1u), parameterOf(l, pairOf(kSide + corner, 1u).x), rimA,
                turnedFrame(corner, rowAlongX(row, true, begin.d), rowAlongY(row, true, begin.w)));
    NetRow second = netRow(l.net, true, begin);
    storeOnCone(at, q, uvec2(0u, 1u), uvec2(1u, end.y), parameterOf(l, pairOf(kSide + before, 1u).x), rimB,
                turnedFrame(corner, rowAlongX(second, false, across.d), rowAlongY(second, false, across.w)));
}
#endif

void storeCorner(const PatchPlace at, Quarter q, ChainLevel l, NetRow row) {
    // The directions of the nearest leaves on its edges stand in.
    LeafWeights begin = leafWeights(0.0, 0.0);
    vec3 alongB = rowAlongY(row, true, begin.w);
    if (kTangents) alongB = rowAlongY(netRow(l.net, true, begin), false, leafWeights(0.0, l.sharpB).w);
    Frame frame = turnedFrame(q.place.corner, rowAlongX(row, true, begin.d), alongB);
    uvec2 place = placeInQuad(q.place.corner, 0u, 0u);
    store(at, true, place.x, place.y, q.limit, withNormal(frame, q.normal));
}

// `onA`, `onB`: constants, whether the samples on the quarter's two borders are stored, and the corner's with the first.
void storeQuarter(const PatchPlace at, IrregularQuad quad, Quarter q, bool onA, bool onB) {
    uint corner = q.place.corner, before = (corner + 3u) & 3u, lastLevel = q.chain.lastLevel, level = 2u;
    uvec2 end = uvec2(q.place.countA, q.place.countB), first;
    uvec2 sideEnd = end, side; // the same of the borders
    ChainLevel l;
    NetRow row; // of the first edge
    bool more;
    do {
        l = chainLevel(at, quad, q, level, end.x, end.y);
        first = uvec2(l.firstA, l.firstB);
        if (kInside) storeLevel(at, q, l);
        more = level < lastLevel;
        if (kOwnBorders) {
            l.endA = sideEnd.x, l.endB = sideEnd.y;
            side = uvec2(firstOfLevel(kSide + corner, sideEnd.x, level), firstOfLevel(kSide + before, sideEnd.y, level));
            l.firstA = side.x, l.firstB = side.y;
            more = more && max(max(first.x, first.y), max(side.x, side.y)) > 1u;
        }
        if (onB && (kOwnBorders || !kInside)) storeAlongB(at, q, l, kSide + before); // else with the rows inside
        if (onA) {
            row = netRow(l.net, false, leafWeights(0.0, l.sharpA));
            storeAlongA(at, q, l, row, kSide + corner);
        }
        // What is used behind the loop is that of the last level, even if lavapipe goes on with lanes that have finished.
        level += more ? 1u : 0u;
        end = SELECT2(more, first, end);
        sideEnd = SELECT2(more, side, sideEnd);
    } while (more);
    if (onA) storeCorner(at, q, l, row);
#ifdef LEVELS
    storeInCone(at, q, l, first);
    storeBordersOfCone(at, q, l, row, side);
#endif
}

#ifndef WIDE
void evaluateQuad(const PatchPlace at) {
    IrregularQuad record = quadOf(at.record), quad = record;
    Net net = quadNet(at, quad);
    vec3 middles[4], before[4] = sideCubic(at, quad, 3u); // of the side that ends in the corner
    uint corner = 0u;
    do {
        vec3 after[4] = sideCubic(at, quad, 0u);
        OwnQuarter q = ownQuarter(at, quad, net, corner);
        q.first = ownFirst(at, quad, net, after);
        q.second = ownSecond(at, quad, net, before);
        storeOwnQuarter(at, q, kSides, kSides);
        middles = vec3[4](middles[1], middles[2], middles[3], q.first.middle);
        before = after;
        quad = turnedQuad(quad, 1u);
        net = turnedOnce(net);
    } while (++corner < 4u);
    if (!kChains) return;
    uint corners = 0u;
    for (corner = 0u; corner < 4u; ++corner) corners |= hasChain(record, corner) ? 1u << corner : 0u;
    do {
        corner = uint(findLSB(corners));
        vec3 middleA = corner < 2u ? (corner == 0u ? middles[0] : middles[1]) : (corner == 2u ? middles[2] : middles[3]);
        vec3 middleB = corner < 2u ? (corner == 0u ? middles[3] : middles[0]) : (corner == 2u ? middles[1] : middles[2]);
        storeQuarter(at, record, quarterOf(at, record, corner, middleA, middleB), kSides, kSides);
        corners &= corners - 1u;
    } while (corners != 0u);
}
#else
void evaluateQuarter(const PatchPlace at, uint corner) {
    IrregularQuad quad = quadOf(at.record);
    if (kChains && hasChain(quad, corner)) {
        storeQuarter(at, quad, quarterOf(at, quad, corner, middleOf(at, quad, corner), middleOf(at, quad, (corner + 3u) & 3u)),
                     kSides, kSides);
        return;
    }
    quad = turnedQuad(quad, corner);
    Net net = turnedNet(at, quad, corner);
    OwnQuarter q = ownQuarter(at, quad, net, corner);
    q.first = ownFirst(at, quad, net, sideCubic(at, quad, 0u));
    q.second = ownSecond(at, quad, net, sideCubic(at, quad, 3u));
    storeOwnQuarter(at, q, kSides, kSides);
}
#endif
