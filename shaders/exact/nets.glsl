// Irregular quads net by net, for lanes that have a whole quad (docs/catmull_clark.md). A net is loaded once and collapsed row by row.
// Before the include: what quad.glsl needs, pairs.glsl, and
//   const bool kChains                                whether some corner has a chain
//   const bool kInside                                whether samples inside are stored
//   const uint kSides                                 how many sides' samples are stored, from the first one on; 0, 1 or 4
//   uint last                                         number of the last sample along a side
//   void store(const PatchPlace at, bool own, uint i, uint j, vec3 position, Frame frame)
//
// On lavapipe lanes go through both sides of every `if`, and once more through a loop that is tested at the top. So borders are not
// told apart sample by sample, loops are tested at the bottom, and what must not be stored is computed all the same. What is
// called `right` or `upper` is a constant: lanes have nets in registers, which they cannot index.
#include "shaders/exact/quad.glsl"

struct Net {
    vec3 p[kNetPoints];
};
Net quadNet(const PatchPlace at) {
    Net net;
    [[unroll]] for (uint e = 0u; e < 7u; ++e) {
        uvec4 words = tableElement(at.record + kExactNetElement + e);
        [[unroll]] for (uint c = 0u; c < 4u; ++c) {
            uint k = 4u * e + c; // behind the flags
            if (k > 0u && k <= kNetPoints) net.p[k - 1u] = poolPoint(at, words[c]);
        }
    }
    return net;
}
Net chainNet(const PatchPlace at, Chain chain, uint level) {
    uint first = levelPoints(chain, level);
    Net net;
    [[unroll]] for (uint e = 0u; e < kWindowElements; ++e) {
        uvec4 words = tableElement(chain.windows + e);
        [[unroll]] for (uint c = 0u; c < 8u; ++c) {
            uint k = 8u * e + c;
            if (k < kNetPoints) net.p[k] = poolPoint(at, first + ((c & 1u) == 0u ? words[c / 2u] & 0xFFFFu : words[c / 2u] >> 16u));
        }
    }
    return net;
}

// All columns of a net at one y, in the lower or the upper cells; from the net's middle.
struct NetRow {
    vec3 point[kNetSide], slope[kNetSide];
};
NetRow netRow(Net net, uint upper, LeafWeights y) {
    NetRow row;
    [[unroll]] for (uint i = 0u; i < kNetSide; ++i) {
        vec3 p[4];
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            precise vec3 d = net.p[kNetSide * (j + upper) + i] - net.p[kNetMiddle];
            p[j] = d;
        }
        row.point[i] = sum4(y.w, p[0], p[1], p[2], p[3]);
        row.slope[i] = blend4(y.d, p[0], p[1], p[2], p[3]);
    }
    return row;
}
vec3 rowPoint(NetRow row, uint right, vec4 w) {
    return sum4(w, row.point[right], row.point[right + 1u], row.point[right + 2u], row.point[right + 3u]);
}
vec3 rowAlongX(NetRow row, uint right, vec4 d) {
    return blend4(d, row.point[right], row.point[right + 1u], row.point[right + 2u], row.point[right + 3u]);
}
vec3 rowAlongY(NetRow row, uint right, vec4 w) {
    return blend4(w, row.slope[right], row.slope[right + 1u], row.slope[right + 2u], row.slope[right + 3u]);
}

#ifdef LEVELS
LodPattern patterns[6];
const bool kOwnBorders = true; // whose samples lie elsewhere than those of the rows inside
#else
const bool kOwnBorders = false;
#endif
const uint kInsideU = 0u, kInsideV = 1u, kSide = 2u;
vec2 pairOf(uint pattern, uint k) {
#ifdef LEVELS
    return lodPair(patterns[pattern], k, last);
#else
    return parameterPair(k, last, push.pairs);
#endif
}
const vec2 kBegin = vec2(0.0, 1.0), kEnd = vec2(1.0, 0.0);

// Four points for either half of a side, in ascending order; of a cubic they are the same.
struct Side {
    bool cubic;
    vec3 low[4], high[4], middle;
};
Side netSide(Net net, uint begin, uint step, uint across, float share) {
    vec3 e[kNetSide];
    [[unroll]] for (uint k = 0u; k < kNetSide; ++k) {
        uint own = begin + k * step;
        e[k] = onLine(net.p[own], net.p[own - across], net.p[own + across], share);
    }
    return Side(false, vec3[4](e[0], e[1], e[2], e[3]), vec3[4](e[1], e[2], e[3], e[4]), middleOfLine(e[1], e[2], e[3]));
}
Side quadSide(const PatchPlace at, IrregularQuad quad, Net net, uint side) {
    const uint kFirst[4] = uint[4](kNetSide, 3u, 3u * kNetSide, 1u);
    bool alongU = (side & 1u) == 0u;
    Side s = netSide(net, kFirst[side], alongU ? 1u : kNetSide, alongU ? kNetSide : 1u, besideLine(sharpnessOf(quad, side, 1u)));
    vec3 g[4] = sideCubic(at, quad, side);
    if (side >= 2u) g = vec3[4](g[3], g[2], g[1], g[0]);
    s.cubic = isCubic(quad, side);
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        s.low[k] = s.cubic ? g[k] : s.low[k];
        s.high[k] = s.cubic ? g[k] : s.high[k];
    }
    return s;
}
// `w`: of the leaf, along the side.
vec3 onSide(Side s, uint second, vec2 pair, vec4 w) {
    w = s.cubic ? bernstein3(pair) : w;
    vec3 p = second == 0u ? sum4(w, s.low[0], s.low[1], s.low[2], s.low[3]) : sum4(w, s.high[0], s.high[1], s.high[2], s.high[3]);
    return !s.cubic && pair.x == pair.y ? s.middle : p;
}

// The quad's own net: what its rows are made of.
struct QuadCells {
    IrregularQuad quad;
    Net net;
    Side sides[4];
    vec3[4] limits; // of the corners
};
vec3[4] cornerLimits(const PatchPlace at, IrregularQuad quad) {
    return vec3[4](poolPoint(at, quad.points.x), poolPoint(at, quad.points.y), poolPoint(at, quad.points.z),
                   poolPoint(at, quad.points.w));
}
LeafWeights alongU(QuadCells q, uint right, vec2 u) {
    return quadWeights(right != 0u, u, sharpnessOf(q.quad, 3u, 1u), sharpnessOf(q.quad, 1u, 1u));
}
LeafWeights alongV(QuadCells q, uint upper, vec2 v) {
    return quadWeights(upper != 0u, v, sharpnessOf(q.quad, 0u, 1u), sharpnessOf(q.quad, 2u, 1u));
}
uint cornerOf(uint right, uint upper) { return upper == 0u ? right : 3u - right; }
bool isOwn(QuadCells q, uint right, uint upper) { return !kChains || !hasChain(q.quad, cornerOf(right, upper)); }

// At levels segments may have no length: such a sample is the corner, to the bit. `u`, `v`: its pairs.
vec3 orCorner(QuadCells q, uint right, uint upper, vec2 u, vec2 v, vec3 position) {
    if (!kOwnBorders) return position;
    return max(right == 0u ? u.x : u.y, upper == 0u ? v.x : v.y) == 0.0 ? q.limits[cornerOf(right, upper)] : position;
}

Frame quadFrame(NetRow row, uint right, LeafWeights x) {
    vec3 du = rowAlongX(row, right, x.d), dv = rowAlongY(row, right, x.w);
    return frameOf(du, dv);
}
void storeCorner(const PatchPlace at, QuadCells q, NetRow row, uint right, uint upper) {
    uint corner = cornerOf(right, upper);
    Frame frame = withStoredNormal(at, q.quad, corner, quadFrame(row, right, alongU(q, right, right == 0u ? kBegin : kEnd)));
    store(at, isOwn(q, right, upper), right * last, upper * last, q.limits[corner], frame);
}
// Samples i to before `end` of the bottom or the top.
void storeAlong(const PatchPlace at, QuadCells q, NetRow row, uint right, uint upper, uint i, uint end) {
    bool own = isOwn(q, right, upper);
    do {
        vec2 u = pairOf(kOwnBorders ? kSide + 2u * upper : kInsideU, i);
        LeafWeights x = alongU(q, right, u);
        vec3 position = orCorner(q, right, upper, u, upper == 0u ? kBegin : kEnd, onSide(q.sides[2u * upper], right, u, x.w));
        store(at, own && i < end, i, upper * last, position, quadFrame(row, right, x));
    } while (++i < end);
}
// One of the left or the right side.
void storeAcross(const PatchPlace at, QuadCells q, NetRow row, uint right, uint upper, bool own, uint j, vec2 v, LeafWeights y) {
    vec2 u = right == 0u ? kBegin : kEnd;
    vec3 position = orCorner(q, right, upper, u, v, onSide(q.sides[3u - 2u * right], upper, v, y.w));
    Frame frame = quadFrame(row, right, alongU(q, right, u));
    store(at, own && isOwn(q, right, upper), right * last, j, position, frame);
}
void storeInside(const PatchPlace at, QuadCells q, NetRow row, uint right, uint upper, bool own, uint j, vec2 v, uint i, uint end) {
    own = own && isOwn(q, right, upper);
    do {
        vec2 u = pairOf(kInsideU, i);
        LeafWeights x = alongU(q, right, u);
        vec3 position = placed(vec3(0.0), q.net.p[kNetMiddle], rowPoint(row, right, x.w));
        position = orCorner(q, right, upper, u, v, position);
        store(at, own && i < end, i, j, position, quadFrame(row, right, x));
    } while (++i < end);
}

// The lower or the upper cells.
void storeCells(const PatchPlace at, QuadCells q, uint upper) {
    uint upperFirst = last / 2u + 1u, j = upper == 0u ? 1u : upperFirst, end = upper == 0u ? upperFirst : last;
    if (kSides > 0u) {
        NetRow border = netRow(q.net, upper, alongV(q, upper, upper == 0u ? kBegin : kEnd));
        storeCorner(at, q, border, 0u, upper);
        if (kSides > 1u) storeCorner(at, q, border, 1u, upper);
        storeAlong(at, q, border, 0u, upper, 1u, min(upperFirst, last));
        storeAlong(at, q, border, 1u, upper, upperFirst, last);
    }
    if (!kInside) return;
    do {
        bool own = j < end;
        vec2 v = pairOf(kInsideV, j);
        LeafWeights y = alongV(q, upper, v);
        NetRow row = netRow(q.net, upper, y);
        storeInside(at, q, row, 0u, upper, own, j, v, 1u, min(upperFirst, last));
        storeInside(at, q, row, 1u, upper, own, j, v, upperFirst, last);
        if (kSides == 0u) continue;
        if (kOwnBorders) {
            vec2 left = pairOf(kSide + 3u, j), right = pairOf(kSide + 1u, j);
            LeafWeights onLeft = alongV(q, upper, left), onRight = alongV(q, upper, right);
            storeAcross(at, q, netRow(q.net, upper, onLeft), 0u, upper, own, j, left, onLeft);
            storeAcross(at, q, netRow(q.net, upper, onRight), 1u, upper, own, j, right, onRight);
        } else {
            storeAcross(at, q, row, 0u, upper, own, j, v, y);
            storeAcross(at, q, row, 1u, upper, own, j, v, y);
        }
    } while (++j < end);
}

// A quarter with a chain. Samples are counted from its corner, along its two edges.
struct Quarter {
    uint corner;
    Chain chain;
    vec3 origin, limit, normal;
    vec3 middleA, middleB; // of the sides
    uint countA, countB;   // of samples that are its own
};
Quarter quarterOf(const PatchPlace at, IrregularQuad quad, uint corner, vec3 middleA, vec3 middleB) {
    Quarter own;
    own.corner = corner;
    own.chain = chainOf(quad, corner);
    own.origin = chainOrigin(at, own.chain);
    own.normal = poolPoint(at, componentOf(quad.normals, corner));
    own.limit = poolPoint(at, componentOf(quad.points, corner));
    own.middleA = middleA, own.middleB = middleB;
    // What lies in the middle belongs to the lower quarters.
    bool turned = (corner & 1u) != 0u;
    uint below = last / 2u + 1u, above = (last + 1u) / 2u;
    uint countU = corner == 1u || corner == 2u ? above : below, countV = corner >= 2u ? above : below;
    own.countA = turned ? countV : countU;
    own.countB = turned ? countU : countV;
    return own;
}
Quarter quarterOf(const PatchPlace at, QuadCells q, uint corner) {
    vec3 bottom = q.sides[0].middle, right = q.sides[1].middle, top = q.sides[2].middle, left = q.sides[3].middle;
    return quarterOf(at, q.quad, corner, corner < 2u ? (corner == 0u ? bottom : right) : (corner == 2u ? top : left),
                     corner < 2u ? (corner == 0u ? left : bottom) : (corner == 2u ? right : top));
}
#ifdef WIDE
vec3 middleOf(const PatchPlace at, IrregularQuad quad, uint side) {
    float share = besideLine(sharpnessOf(quad, side, 1u));
    vec3 e[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 p[3];
        [[unroll]] for (uint j = 0u; j < 3u; ++j) p[j] = ownPoint(at, SUPPLE_EXACT_NET_PLACE(side, i + 1u, j));
        e[i] = onLine(p[1], p[0], p[2], share);
    }
    return middleOfLine(e[0], e[1], e[2]);
}
#endif
uvec2 placeInQuad(uint corner, uint a, uint b) {
    uint x = (corner & 1u) == 0u ? a : b, y = (corner & 1u) == 0u ? b : a;
    return uvec2(corner == 1u || corner == 2u ? last - x : x, corner >= 2u ? last - y : y);
}

// What a level of a chain has, and which samples are its own: from `first` to before `end`.
struct ChainLevel {
    Net net;
    Side lineA, lineB;
    float scale, sharpA, sharpB;
    uint firstA, endA, firstB, endB;
};
// The first sample along a pattern that is 2^-level or further from the corner; `before`: the first one of the level before.
uint firstOfLevel(uint pattern, uint before, uint level, uint lastLevel) {
#ifdef LEVELS
    float least = level == lastLevel ? 0.0 : powerOfTwo(-float(level));
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
float parameterOf(Quarter q, ChainLevel l, float distance) {
    precise float x = (kOwnBorders ? withinChain(distance, q.chain.lastLevel) : distance) * l.scale;
    return x;
}

// Sample (a, b) on a border: of its first edge, or of its second.
void storeOnBorder(const PatchPlace at, Quarter q, bool own, uint a, uint b, float distance, vec3 offset, vec3 middle, Frame frame) {
    precise vec3 p = q.origin + offset;
    p = distance == 0.5 ? middle : p;
    if (kOwnBorders) { // segments may have no length
        bool atCorner = distance == 0.0;
        p = atCorner ? q.limit : p;
        Frame stored = withNormal(frame, q.normal);
        if (atCorner) frame = stored;
    }
    uvec2 place = placeInQuad(q.corner, a, b);
    store(at, own, place.x, place.y, p, frame);
}
void storeAlongA(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, uint pattern) {
    uint a = l.firstA;
    do {
        float distance = pairOf(pattern, a).x;
        LeafWeights x = chainWeights(true, parameterOf(q, l, distance), 0.0);
        Frame frame = turnedFrame(q.corner, rowAlongX(row, 1u, x.d), rowAlongY(row, 1u, x.w));
        vec3 offset = sum4(x.w, l.lineA.high[0], l.lineA.high[1], l.lineA.high[2], l.lineA.high[3]);
        storeOnBorder(at, q, a < l.endA, a, 0u, distance, offset, q.middleA, frame);
    } while (++a < l.endA);
}
void storeOnB(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, bool own, uint b, float distance, LeafWeights y) {
    LeafWeights x = leafWeights(0.0, l.sharpB);
    Frame frame = turnedFrame(q.corner, rowAlongX(row, 0u, x.d), rowAlongY(row, 0u, x.w));
    vec3 offset = sum4(y.w, l.lineB.high[0], l.lineB.high[1], l.lineB.high[2], l.lineB.high[3]);
    storeOnBorder(at, q, own, 0u, b, distance, offset, q.middleB, frame);
}
void storeChainRow(const PatchPlace at, Quarter q, ChainLevel l, NetRow row, uint right, bool own, float fromA, uint b, uint a, uint end) {
    do {
        float distance = pairOf(q.corner & 1u, a).x;
        LeafWeights x = chainWeights(right != 0u, parameterOf(q, l, distance), l.sharpB);
        vec3 position = placed(q.origin, l.net.p[kNetMiddle], rowPoint(row, right, x.w));
        Frame frame = turnedFrame(q.corner, rowAlongX(row, right, x.d), rowAlongY(row, right, x.w));
        if (kOwnBorders) position = max(distance, fromA) == 0.0 ? q.limit : position;
        uvec2 place = placeInQuad(q.corner, a, b);
        store(at, own && a < end, place.x, place.y, position, frame);
    } while (++a < end);
}

// The cells of a level but for borders that have patterns of their own.
void storeLevel(const PatchPlace at, Quarter q, ChainLevel l) {
    uint acrossA = 1u - (q.corner & 1u), b = 1u;
    do {
        float distance = pairOf(acrossA, b).x;
        NetRow row = netRow(l.net, 0u, chainWeights(false, parameterOf(q, l, distance), l.sharpA));
        storeChainRow(at, q, l, row, 1u, b < l.firstB, distance, b, l.firstA, l.endA);
    } while (++b < l.firstB);
    b = l.firstB;
    do {
        bool own = b < l.endB;
        float distance = pairOf(acrossA, b).x;
        LeafWeights y = chainWeights(true, parameterOf(q, l, distance), 0.0);
        NetRow row = netRow(l.net, 1u, y);
        if (!kOwnBorders && kSides > 0u) storeOnB(at, q, l, row, own, b, distance, y);
        storeChainRow(at, q, l, row, 0u, own, distance, b, 1u, l.firstA);
        storeChainRow(at, q, l, row, 1u, own, distance, b, l.firstA, l.endA);
    } while (++b < l.endB);
}

// The samples of a level on the second edge by themselves.
void storeAlongB(const PatchPlace at, Quarter q, ChainLevel l, uint pattern) {
    uint b = l.firstB;
    do {
        float distance = pairOf(pattern, b).x;
        LeafWeights y = chainWeights(true, parameterOf(q, l, distance), 0.0);
        storeOnB(at, q, l, netRow(l.net, 1u, y), b < l.endB, b, distance, y);
    } while (++b < l.endB);
}

ChainLevel chainLevel(const PatchPlace at, IrregularQuad quad, Quarter q, uint level, uint endA, uint endB) {
    uint corner = q.corner, before = (corner + 3u) & 3u;
    ChainLevel l;
    l.net = chainNet(at, q.chain, level);
    l.scale = powerOfTwo(float(level));
    l.sharpA = sharpnessOf(quad, corner, level), l.sharpB = sharpnessOf(quad, before, level);
    l.lineA = netSide(l.net, kNetSide, 1u, kNetSide, besideLine(l.sharpA));
    l.lineB = netSide(l.net, 1u, kNetSide, 1u, besideLine(l.sharpB));
    l.endA = endA, l.endB = endB;
    l.firstA = firstOfLevel(corner & 1u, endA, level, q.chain.lastLevel);
    l.firstB = firstOfLevel(1u - (corner & 1u), endB, level, q.chain.lastLevel);
    return l;
}

// `onA`, `onB`: constants, whether the samples on the quarter's two borders are stored, and the corner's with the first.
void storeQuarter(const PatchPlace at, IrregularQuad quad, Quarter q, bool onA, bool onB) {
    uint corner = q.corner, before = (corner + 3u) & 3u, lastLevel = q.chain.lastLevel, level = 2u;
    uvec2 first = uvec2(q.countA, q.countB), side = first; // the same of the borders
    bool more;
    do {
        ChainLevel l = chainLevel(at, quad, q, level, first.x, first.y);
        first = uvec2(l.firstA, l.firstB);
        if (kInside) storeLevel(at, q, l);
        more = level < lastLevel;
        if (kOwnBorders) {
            l.endA = side.x, l.endB = side.y;
            side = uvec2(firstOfLevel(kSide + corner, side.x, level, lastLevel), firstOfLevel(kSide + before, side.y, level, lastLevel));
            l.firstA = side.x, l.firstB = side.y;
            more = more && max(max(first.x, first.y), max(side.x, side.y)) > 1u;
        }
        if (onB && (kOwnBorders || !kInside)) storeAlongB(at, q, l, kSide + before); // else with the rows inside
        if (onA) {
            NetRow row = netRow(l.net, 0u, leafWeights(0.0, l.sharpA));
            storeAlongA(at, q, l, row, kSide + corner);
            // At the corner the directions of the nearest leaves on its edges stand in.
            LeafWeights begin = leafWeights(0.0, 0.0);
            vec3 alongB = rowAlongY(row, 1u, begin.w);
            if (kTangents) alongB = rowAlongY(netRow(l.net, 1u, begin), 0u, leafWeights(0.0, l.sharpB).w);
            Frame frame = turnedFrame(corner, rowAlongX(row, 1u, begin.d), alongB);
            uvec2 place = placeInQuad(corner, 0u, 0u);
            store(at, !more, place.x, place.y, q.limit, withNormal(frame, q.normal));
        }
        ++level;
    } while (more);
}

QuadCells quadCells(const PatchPlace at) {
    QuadCells q;
    q.quad = quadOf(at.record);
    q.net = quadNet(at);
    q.limits = cornerLimits(at, q.quad);
    return q;
}

#ifndef WIDE
void evaluateQuad(const PatchPlace at) {
    QuadCells q = quadCells(at);
    q.sides[0] = quadSide(at, q.quad, q.net, 0u);
    q.sides[1] = quadSide(at, q.quad, q.net, 1u);
    q.sides[2] = quadSide(at, q.quad, q.net, 2u);
    q.sides[3] = quadSide(at, q.quad, q.net, 3u);
    storeCells(at, q, 0u);
    storeCells(at, q, 1u);
    if (!kChains) return;
    uint corners = 0u;
    for (uint corner = 0u; corner < 4u; ++corner) corners |= hasChain(q.quad, corner) ? 1u << corner : 0u;
    do {
        storeQuarter(at, q.quad, quarterOf(at, q, uint(findLSB(corners))), kSides > 0u, kSides > 0u);
        corners &= corners - 1u;
    } while (corners != 0u);
}
#else
// One cell of the quad's own net, with the samples on its part of the border.
void storeCell(const PatchPlace at, uint right, uint upper) {
    QuadCells q = quadCells(at);
    uint begin = last / 2u + 1u; // of the second half
    if (kSides > 0u) {
        uint along = 2u * upper, across = 3u - 2u * right;
        q.sides[along] = quadSide(at, q.quad, q.net, along);
        q.sides[across] = quadSide(at, q.quad, q.net, across);
        NetRow border = netRow(q.net, upper, alongV(q, upper, upper == 0u ? kBegin : kEnd));
        storeCorner(at, q, border, right, upper);
        storeAlong(at, q, border, right, upper, right == 0u ? 1u : begin, right == 0u ? min(begin, last) : last);
    }
    uint j = upper == 0u ? 1u : begin, end = upper == 0u ? min(begin, last) : last;
    for (; j < end; ++j) {
        vec2 v = pairOf(kInsideV, j);
        LeafWeights y = alongV(q, upper, v);
        NetRow row = netRow(q.net, upper, y);
        storeInside(at, q, row, right, upper, true, j, v, right == 0u ? 1u : begin, right == 0u ? min(begin, last) : last);
        if (kSides > 0u) storeAcross(at, q, row, right, upper, true, j, v, y);
    }
}
void evaluateQuarter(const PatchPlace at, uint corner) {
    IrregularQuad quad = quadOf(at.record);
    if (kChains && hasChain(quad, corner))
        storeQuarter(at, quad, quarterOf(at, quad, corner, middleOf(at, quad, corner), middleOf(at, quad, (corner + 3u) & 3u)),
                     kSides > 0u, kSides > 0u);
    else if (corner == 0u) storeCell(at, 0u, 0u);
    else if (corner == 1u) storeCell(at, 1u, 0u);
    else if (corner == 2u) storeCell(at, 1u, 1u);
    else storeCell(at, 0u, 1u);
}
#endif
