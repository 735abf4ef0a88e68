// A single sample of a Loop patch (docs/loop.md). Before the include, what triangle.glsl needs; with LOCAL_NET also
//   vec3 netPoint(const PatchPlace at, uint k)        point k of the triangle's own points, from workgroup memory: of a regular
//                                                     one the vertices, of an irregular one its net
#include "shaders/loop/triangle.glsl"

#ifdef ONE_TRIANGLE // a lane has one alone, and loads its vertices once
LeafPoints laneCage;
LeafPoints cageOf(const PatchPlace at, Triangle t) { return laneCage; }
#else
LeafPoints cageOf(const PatchPlace at, Triangle t) { return cageLeaf(at, t); }
#endif

LeafPoints leafInCell(const PatchPlace at, NetSource net, bool own, uint cell) {
    LeafPoints leaf;
    uint indices[kTriangleNetPoints] = netIndices(net);
    [[unroll]] for (uint k = 0u; k < kLeafPoints; ++k) {
#ifdef LOCAL_NET
        if (own) {
            leaf.p[k] = netPoint(at, cell < 2u ? kCellPoints[cell == 0u ? 0 : 1][k] : kCellPoints[cell == 2u ? 2 : 3][k]);
            continue;
        }
#endif
        leaf.p[k] = poolPoint(at, OF_CELL(SELECT, cell, indices, k));
    }
    mirrorInCell(leaf, net, cell);
    return leaf;
}

// Where a sample lies: weights of the corners, distance from the nearest one; side 3 is inside, else the pair along it.
struct TrianglePoint {
    vec3 w;
    float distance;
    uint side;
    vec2 along;
};
const uint kInside = 3u;

vec3 onWholeSide(const PatchPlace at, Triangle t, uint side, vec2 along) {
    return onSide(leafSide(cageOf(at, t), side, false, hasFlag(t, kSharpTriangleSide, side)), along);
}
// The corner that a sample is, 3 if it is none.
uint cornerAt(TrianglePoint s) {
    if (s.side != kInside) return s.along.x == 0.0 ? s.side : s.along.y == 0.0 ? nextOf(s.side) : 3u;
    return s.w.x == 1.0 ? 0u : s.w.y == 1.0 ? 1u : s.w.z == 1.0 ? 2u : 3u;
}

vec3 middleOfSide(NetSource net, LeafPoints leaf, uint side) {
    vec3 p[12];
    uint v = lastOf(side); // of the leaf in the middle
    [[unroll]] for (uint k = 0u; k < 12u; ++k) {
        const uint row = k / 3u * 3u, at = k % 3u;
        p[k] = SELECT3(v == 0u, leaf.p[k], SELECT3(v == 1u, leaf.p[row + (at + 1u) % 3u], leaf.p[row + (at + 2u) % 3u]));
    }
    bool sharp = (net.sides >> side & 1u) != 0u;
    float sharpness = kSemiSharp ? componentOf3(net.sharpness, side) : 0.0;
    sharp = sharp || sharpness > 0.0;
    precise vec3 first = sharp ? p[8] + p[0] : p[11] + p[2], second = sharp ? p[0] + p[6] : p[3] + p[1];
    vec3 middle = onLine(p[8], p[0], p[6], first, second);
    if (!kSemiSharp) return middle;
    vec3 creased = onCreasedLine(middle, excessOf(p[11], p[2], p[8], p[0]), excessOf(p[3], p[1], p[0], p[6]), sharpness);
    return SELECT3(sharpness > 0.0, creased, middle);
}

// Where a sample of an irregular triangle lies in a leaf: in a cell of a net, the triangle's own or a chain's at `corner`.
struct LeafPlace {
    NetSource net;
    bool own;
    uint corner, cell;
    float x, y;            // in the leaf
    float scale, distance; // of the net; from the nearest corner along the side
    float way;             // to the rim of the last cell, 1 beyond it
};
bool isMiddle(TrianglePoint s) { return s.side != kInside && s.along.x == s.along.y; }
LeafPlace leafPlace(const PatchPlace at, Triangle t, TrianglePoint s, bool isCorner) {
    bool onBorder = s.side != kInside;
    LeafPlace place;
    place.corner = s.w.x > 0.5 ? 0u : s.w.y > 0.5 ? 1u : s.w.z > 0.5 ? 2u : 3u;
    if (onBorder && !isCorner && !isMiddle(s)) place.corner = s.along.x > s.along.y ? nextOf(s.side) : s.side;
    place.net = ownNet(at, t);
    Chain chain = chainOf(at, t, place.corner == 3u ? 0u : place.corner);
    place.own = place.corner == 3u || chain.netLists == 0u;
    place.cell = place.corner;
    place.scale = 2.0, place.way = 1.0;
    float a = s.w.y, b = s.w.z;
    place.distance = onBorder ? min(s.along.x, s.along.y) : 0.0;
    if (!place.own) {
        a = place.corner == 0u ? s.w.y : place.corner == 1u ? s.w.z : s.w.x;
        b = place.corner == 0u ? s.w.z : place.corner == 1u ? s.w.x : s.w.y;
        float nearest = s.distance;
#ifdef LEVELS
        nearest = onBorder ? place.distance : a + b;
        float rim = powerOfTwo(-float(chain.lastLevel));
        if (nearest > 0.0 && nearest < rim) {
            precise float of = nearest * powerOfTwo(float(chain.lastLevel)), back = rim / nearest;
            place.way = of;
            a *= back, b *= back;
            if (onBorder) { // without rounding
                place.distance = rim;
                a = a > 0.0 ? rim : 0.0, b = b > 0.0 ? rim : 0.0;
            }
            nearest = rim;
        }
#endif
        ChainPlace level = chainPlace(nearest, chain.lastLevel);
        place.scale = level.scale;
        place.net = chainNet(at, t, chain, place.corner, level.level);
    }
    precise float x = a * place.scale, y = b * place.scale;
    if (!place.own) place.cell = isCorner || x >= 1.0 ? 1u : y >= 1.0 ? 2u : kMiddleCell;
    bool reversed = place.cell == kMiddleCell;
    precise float inX = reversed ? 1.0 - x : place.cell == 1u ? x - 1.0 : x, inY = reversed ? 1.0 - y : place.cell == 2u ? y - 1.0 : y;
    place.x = inX, place.y = inY;
    return place;
}

// On a side that has two halves. `leaf`: the one there.
vec3 onHalves(LeafPlace place, LeafPoints leaf, TrianglePoint s) {
    if (isMiddle(s)) return middleOfSide(place.net, leaf, s.side);
    bool far = s.along.x > s.along.y; // nearer to where the side ends
    uint begin = place.own ? place.cell : 0u;
    uint side = far ? lastOf(begin) : begin; // of the net
    bool endless = (place.net.sides >> side & 1u) != 0u;
    float sharpness = kSemiSharp ? componentOf3(place.net.sharpness, side) : 0.0;
    precise float x = place.distance * place.scale - (place.own ? 0.0 : 1.0), rest = 1.0 - x;
    precise vec3 p = place.net.origin + onCreasedSide(leafSide(leaf, begin, far, endless), sharpness, vec2(x, rest));
    return p;
}

vec3 inLeaf(vec3 origin, Leaf leaf, LeafRow row, float x, CreaseSum more) {
    precise vec3 p = leaf.first + rowOffset(row, x);
    if (kSemiSharp) p = p + more.p;
    precise vec3 position = origin + p;
    return position;
}

void irregularTriangle(const PatchPlace at, Triangle t, TrianglePoint s, uint to, out vec3 position, out Frame frame) {
    uint isCorner = cornerAt(s);
    LeafPlace place = leafPlace(at, t, s, isCorner != 3u);
    uint from = place.own ? 0u : place.corner;
    LeafPoints points = leafInCell(at, place.net, place.own, place.cell);
    LeafPoints mirrored = points;
    CreaseSum more;
    if (kSemiSharp) more = creaseSum(takeCreases(mirrored, place.net.sharpness, place.cell), place.cell, place.x, place.y);
    Leaf leaf = leafOf(mirrored);
    LeafRow row = leafRow(leaf, place.y);
    vec3 da = rowAlongX(row, place.x), db = rowAlongY(row, place.x);
    if (kSemiSharp) da += more.dx, db += more.dy;
    if (isCorner != 3u) {
        position = cornerLimit(at, t, isCorner);
        if (!place.own) da = points.p[0] - points.p[11], db = points.p[8] - points.p[11]; // chords of the last level
        frame = seenFrom(from, to, da, db);
        if (!place.own) frame = withCornerNormal(at, t, place.corner, frame);
        return;
    }
    bool reversed = place.cell == kMiddleCell;
    frame = seenFrom(from, to, reversed ? -da : da, reversed ? -db : db);
    if (s.side == kInside) {
        position = inLeaf(place.net.origin, leaf, row, place.x, more);
    } else if (hasFlag(t, kWholeTriangleSide, s.side)) {
        position = onWholeSide(at, t, s.side, s.along);
    } else {
        position = onHalves(place, points, s);
    }
#ifdef LEVELS
    if (place.way < 1.0) position = onCone(cornerLimit(at, t, place.corner), position, place.way);
#endif
}

void regularTriangle(const PatchPlace at, Triangle t, LeafPoints points, Leaf leaf, TrianglePoint s, uint to, out vec3 position,
                     out Frame frame) {
    LeafRow row = leafRow(leaf, s.w.z);
    frame = seenFrom(0u, to, rowAlongX(row, s.w.y), rowAlongY(row, s.w.y));
    uint isCorner = cornerAt(s);
    if (isCorner != 3u) {
        position = cornerLimit(at, t, isCorner);
    } else if (s.side != kInside) {
        position = onSide(leafSide(points, s.side, false, hasFlag(t, kSharpTriangleSide, s.side)), s.along);
    } else {
        precise vec3 p = leaf.first + rowOffset(row, s.w.y);
        position = p;
    }
}

// A point of a side with two halves alone; not a corner.
vec3 pointOnHalves(const PatchPlace at, Triangle t, TrianglePoint s) {
    LeafPlace place = leafPlace(at, t, s, false);
    vec3 p = onHalves(place, leafInCell(at, place.net, place.own, place.cell), s);
#ifdef LEVELS
    if (place.way < 1.0) p = onCone(cornerLimit(at, t, place.corner), p, place.way);
#endif
    return p;
}

// A pair along side r as weights of the corners.
vec3 weightsOnSide(uint side, vec2 along) {
    return side == 0u ? vec3(along.y, along.x, 0.0) : side == 1u ? vec3(0.0, along.yx) : vec3(along.x, 0.0, along.y);
}
TrianglePoint pointOnSide(uint side, vec2 along) {
    return TrianglePoint(weightsOnSide(side, along), min(along.x, along.y), side, along);
}
