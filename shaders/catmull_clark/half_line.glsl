// Half of a line of samples of an irregular quad (docs/catmull_clark.md): half of a side, from its middle to a corner, or a row of a
// quarter, from the middle of the quad outwards. A net is collapsed once for all samples that lie in one level. They have the bits that
// they have in nets.glsl, whose functions do the same for a whole quarter: what changes here changes there.
// Before the include: what rows.glsl needs, lod/lines.h, and
//   const bool kChains                                whether some corner has a chain
//   const bool kTangents
//   DEPTH_OF_INSTANCE                                 a macro, at levels (chains/chain_place.glsl)
// Behind it the functions that are declared here.
#include "shaders/chains/offset.glsl"
#include "shaders/catmull_clark/rows.glsl"

// A half, as its corner sees it: steps count from the edge that it crosses, or on a side from the corner. Where it runs along the
// corner's second edge, both edges change places, so that this is the first.
struct HalfLine {
    uint corner, firstStep, endStep;
    bool isSide, isSwapped;
    float across;      // how far it lies from the edge beside it
    float nearest;     // of a side: how near samples come to the corner, where tangents want to know
    SampleRow samples; // that of step 0, and the way to the next
};
// How far step k lies from where steps begin, and from the line's other end.
vec2 linePair(uint k);
// The corner that frames are turned from (turnedFrame()).
uint frameCorner(HalfLine h);
void store(const PatchPlace at, HalfLine h, uint k, vec3 position, Frame frame);
uint edgeOf(HalfLine h) { return h.isSwapped ? (h.corner + 3u) & 3u : h.corner; }
uint otherEdgeOf(HalfLine h) { return h.isSwapped ? h.corner : (h.corner + 3u) & 3u; }

NetIndices seenFrom(NetIndices net, uint corner, bool isSwapped) {
    NetIndices once, twice, swapped;
    bool isOdd = (corner & 1u) != 0u, isBeyond = corner >= 2u;
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k)
        once.of[k] = SELECT(isOdd, net.of[SUPPLE_QUAD_NET_PLACE(1u, k % kNetSide, k / kNetSide)], net.of[k]);
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) twice.of[k] = SELECT(isBeyond, once.of[kNetPoints - 1u - k], once.of[k]);
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k)
        swapped.of[k] = SELECT(isSwapped, twice.of[k % kNetSide * kNetSide + k / kNetSide], twice.of[k]);
    return swapped;
}

// Where a sample of a half lies.
struct LinePlace {
    uint level;  // 1 is the quad's own net
    float x, y;  // in the net, along the line and across
    float share; // of the way to the rim of the last cell, 1 beyond it
};
// `lastLevel`: 1 where there is no chain.
LinePlace linePlace(HalfLine h, uint lastLevel, uint k, vec2 pair) {
    float a = pair.x, b = h.across;
    precise float ownX = 2.0 * a, ownY = 2.0 * b;
    if (lastLevel == 1u || (h.isSide && a == pair.y)) return LinePlace(1u, ownX, ownY, 1.0);
    // At the corner the directions of the nearest leaf that has samples stand in. Without tangents nobody asks for them.
    if (kTangents && h.isSide && k == 0u) return LinePlace(chainPlace(h.nearest, lastLevel).level, 1.0, 0.0, 1.0);
    float far = max(a, b), scale = powerOfTwo(float(lastLevel));
    precise float share = far * scale;
    if (share < 1.0) {
        precise float x = a >= b ? 1.0 : a / far, y = h.isSide ? 0.0 : b >= a ? 1.0 : b / far;
        return LinePlace(lastLevel, x, y, share);
    }
    ChainPlace place = chainPlace(far, lastLevel);
    precise float x = a * place.scale, y = b * place.scale;
    return LinePlace(place.level, x, y, 1.0);
}

// What the samples of a half are made of as long as they lie in one level, and at one y of it.
struct LineLevel {
    uint level;
    float y, sharpness; // of the edge that the line runs to
    vec3 middle, point[kNetSide], slope[kNetSide];
    vec3 side[4]; // what positions on a side are made of
};
// As netRow().
NetRow lineRow(const PatchPlace at, NetIndices net, vec3 middle, bool upper, LeafWeights y) {
    NetRow row;
    [[unroll]] for (uint i = 0u; i < kNetSide; ++i) {
        vec3 p[4];
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            uint index = SELECT(upper, net.of[kNetSide * (j + 1u) + i], net.of[kNetSide * j + i]);
            p[j] = offsetFrom(middle, poolPoint(at, index));
        }
        row.point[i] = sumInside(y.w, p[0], p[1], p[2], p[3]);
        row.slope[i] = blend4(y.d, p[0], p[1], p[2], p[3]);
    }
    return row;
}
// Four points of a side, from the corner outwards, as halfOf() and chainLine() have them. Of a chain's level those of the line's second
// half; the first belongs to the levels that follow.
vec3[4] linePoints(const PatchPlace at, NetIndices net, bool second, float share) {
    vec3 e[4];
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        uint line = SELECT(second, net.of[kNetSide + k + 1u], net.of[kNetSide + k]);
        uint one = SELECT(second, net.of[k + 1u], net.of[k]);
        uint other = SELECT(second, net.of[2u * kNetSide + k + 1u], net.of[2u * kNetSide + k]);
        e[k] = onLine(poolPoint(at, line), poolPoint(at, one), poolPoint(at, other), share);
    }
    return e;
}
vec3[4] turnedCubic(vec3 g[4], bool back) {
    vec3 turned[4];
    [[unroll]] for (uint k = 0u; k < 4u; ++k) turned[k] = SELECT3(back, g[3u - k], g[k]);
    return turned;
}
NetIndices netOfLevel(const PatchPlace at, IrregularQuad quad, HalfLine h, Chain chain, uint level) {
    bool isOwn = level == 1u;
    NetIndices net = netIndices(isOwn ? at.record + kQuadNetElement : chain.netLists, isOwn ? quad.first : levelPoints(chain, level));
    return seenFrom(net, isOwn ? h.corner : 0u, h.isSwapped);
}
LineLevel lineLevel(const PatchPlace at, IrregularQuad quad, HalfLine h, Chain chain, uint level, float y) {
    bool isOwn = level == 1u, upper = !isOwn && y >= 1.0;
    float edge = sharpnessOf(quad, edgeOf(h), level);
    NetIndices net = netOfLevel(at, quad, h, chain, level);
    LineLevel l;
    l.level = level;
    l.y = y;
    l.sharpness = sharpnessOf(quad, otherEdgeOf(h), level);
    l.middle = poolPoint(at, net.of[kNetMiddle]);
    NetRow row = lineRow(at, net, l.middle, upper, chainWeights(upper, y, edge));
    l.point = row.point;
    l.slope = row.slope;
    if (h.isSide) {
        l.side = linePoints(at, net, !isOwn, besideLine(edge));
        if (isOwn && isCubic(quad, edgeOf(h))) l.side = turnedCubic(sideCubic(at, quad, edgeOf(h)), h.isSwapped);
    }
    return l;
}

vec3 pointInside(LineLevel l, CellRow cell, vec3 origin, vec4 w) { return placed(origin, l.middle, rowPoint(cell, w)); }
vec3 pointOnSide(LineLevel l, bool cubic, vec3 origin, vec2 pair, vec4 w) {
    if (cubic) w = bernstein3(pair);
    vec3 offset = sum4(w, l.side[0], l.side[1], l.side[2], l.side[3]);
    if (l.level > 1u) {
        precise vec3 p = origin + offset;
        return p;
    }
    return !cubic && pair.x == pair.y ? middleOfLine(l.side[1], l.side[2], l.side[3]) : offset;
}
Frame frameOnLine(HalfLine h, vec3 along, vec3 across) {
    return turnedFrame(frameCorner(h), SELECT3(h.isSwapped, across, along), SELECT3(h.isSwapped, along, across));
}
// At a corner with a chain: the direction of the nearest leaf on the other edge.
vec3 cornerAcross(const PatchPlace at, IrregularQuad quad, HalfLine h, Chain chain, LineLevel l) {
    NetRow row = lineRow(at, netOfLevel(at, quad, h, chain, l.level), l.middle, true, leafWeights(0.0, 0.0));
    return rowAlongY(row, false, leafWeights(0.0, l.sharpness).w);
}

void evaluateHalf(const PatchPlace at, IrregularQuad quad, HalfLine h) {
    Chain chain = Chain(0u, 0u, 0u, 1u);
    vec3 origin = vec3(0.0);
    if (kChains && hasChain(quad, h.corner)) {
        chain = chainOf(at, quad, h.corner);
        origin = chainOrigin(at, chain);
    }
    bool isChained = chain.netLists != 0u, cubic = isCubic(quad, edgeOf(h));
    vec3 limit = poolPoint(at, componentOf(quad.points, h.corner));
    if (!kTangents && h.isSide && isChained && h.firstStep == 0u) { // all that the corner has is stored: it needs no net
        store(at, h, 0u, limit, withStoredNormal(at, quad, h.corner, Frame(vec3(0.0), vec3(0.0), vec3(0.0))));
        h.firstStep = 1u;
    }
    LineLevel l;
    l.level = 0u;
    uint k = h.endStep;
    while (k > h.firstStep) {
        --k;
        vec2 pair = linePair(k);
        bool isCorner = h.isSide && k == 0u;
        LinePlace s = linePlace(h, chain.lastLevel, k, pair);
        if (s.level != l.level || s.y != l.y) l = lineLevel(at, quad, h, chain, s.level, s.y);
        bool right = s.level > 1u && s.x >= 1.0;
        LeafWeights x = chainWeights(right, s.x, l.sharpness);
        CellRow cell = cellRow(NetRow(l.point, l.slope), right);
        vec3 along = rowAlongX(cell, x.d), across = rowAlongY(cell, x.w), position;
        if (h.isSide) position = pointOnSide(l, cubic, origin, pair, x.w);
        else position = pointInside(l, cell, origin, x.w);
        if (s.share < 1.0) position = onCone(limit, position, s.share);
        if (isCorner || (!isChained && max(pair.x, h.across) == 0.0)) position = limit;
        if (kTangents && isCorner && isChained) across = cornerAcross(at, quad, h, chain, l);
        Frame frame = frameOnLine(h, along, across);
        if (isCorner || (isChained && s.share == 0.0)) frame = withStoredNormal(at, quad, h.corner, frame);
        store(at, h, k, position, frame);
    }
}
