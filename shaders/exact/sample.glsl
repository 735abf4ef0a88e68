// A sample of an irregular quad (docs/exact.md). Before the include: tables.glsl, basis.glsl, frame.glsl, net.glsl, and
//   vec3 poolPoint(const PatchPlace at, uint i)       of the pool, as motion wants it
//   vec3 netPoint(const PatchPlace at, uint k)        point k of the quad's 5 x 5 on level 1
#include "shaders/exact/leaf.glsl"

// Where a sample lies: the quarter's corner, and how far from it along the corner's two edges, as stored halves of the pairs.
struct QuarterPlace {
    uint corner;
    float a, b;
};
QuarterPlace quarterOf(vec2 u, vec2 v, uint flags) {
    bool right = u.x > u.y, up = v.x > v.y;
    float fromU = right ? u.y : u.x, fromV = up ? v.y : v.x;
    QuarterPlace q;
    q.corner = up ? (right ? 2u : 3u) : (right ? 1u : 0u);
    bool turned = (q.corner & 1u) != 0u;
    q.a = turned ? fromV : fromU;
    q.b = turned ? fromU : fromV;
    // The middle of a side belongs to the end with the smaller number, which both quads know.
    uint before = (q.corner + 3u) & 3u;
    if (q.b == 0.0 && q.a == 0.5 && (flags >> (kMiddleOfSecond + q.corner) & 1u) != 0u)
        return QuarterPlace((q.corner + 1u) & 3u, 0.0, 0.5);
    if (q.a == 0.0 && q.b == 0.5 && (flags >> (kMiddleOfSecond + before) & 1u) == 0u) return QuarterPlace(before, 0.5, 0.0);
    return q;
}

// The leaf that a place lies in, and where in it.
struct LeafPlace {
    uint level; // 1: the quarter is one leaf
    uint cell;  // of a chain
    float x, y;
    bool farA, farB; // from the corner: what happens on its edges does not reach the leaf
};
LeafPlace leafOf(QuarterPlace q, uint windows, uint lastLevel) {
    if (windows == 0u) return LeafPlace(1u, 0u, 2.0 * q.a, 2.0 * q.b, false, false);
    float far = max(q.a, q.b);
    uint level = uint(clamp(127 - int(floatBitsToUint(far) >> 23u), 2, int(lastLevel))); // 2^-level <= far < 2^(1 - level)
    float scale = powerOfTwo(float(level));
    precise float x = q.a * scale, y = q.b * scale;
    if (far == 0.0) x = 1.0; // at the corner the directions of the nearest leaf stand in
    bool farA = x >= 1.0, farB = y >= 1.0;
    precise float inX = farA ? x - 1.0 : x, inY = farB ? y - 1.0 : y;
    return LeafPlace(level, farA ? (farB ? 1u : 0u) : 2u, inX, inY, farA, farB);
}

struct LeafPoints {
    vec3 p[16]; // row by row in b
};
LeafPoints leafPoints(const PatchPlace at, uint corner, uint windows, uint cell, uint first) {
    LeafPoints points;
    if (windows == 0u) {
        for (uint k = 0u; k < 16u; ++k) points.p[k] = netPoint(at, SUPPLE_EXACT_NET_PLACE(corner, k & 3u, k >> 2u));
        return points;
    }
    uvec4 low = tableElement(windows + 2u * cell), high = tableElement(windows + 2u * cell + 1u);
    for (uint k = 0u; k < 16u; ++k) {
        uint word = (k < 8u ? low : high)[k / 2u & 3u];
        points.p[k] = poolPoint(at, first + ((k & 1u) == 0u ? word & 0xFFFFu : word >> 16u));
    }
    return points;
}

// A row of a leaf at one y: of the four columns the point and its derivative in b.
struct LeafRow {
    vec3 point[4], slope[4];
};
LeafRow collapseLeaf(LeafPoints l, LeafWeights y) {
    LeafRow row;
    vec3 first = l.p[5];
    for (uint i = 0u; i < 4u; ++i) {
        vec3 p[4];
        for (uint j = 0u; j < 4u; ++j) {
            precise vec3 d = l.p[4u * j + i] - first;
            p[j] = d;
        }
        row.point[i] = sum4(y.w, p[0], p[1], p[2], p[3]);
        row.slope[i] = blend4(y.d, p[0], p[1], p[2], p[3]);
    }
    return row;
}
// The sample of a row at x; the frame is that of the quad.
void finishLeaf(LeafRow row, LeafWeights x, uint corner, vec3 origin, vec3 first, out vec3 position, out Frame frame) {
    precise vec3 p = origin + (first + sum4(x.w, row.point[0], row.point[1], row.point[2], row.point[3]));
    position = p;
    vec3 da = blend4(x.d, row.point[0], row.point[1], row.point[2], row.point[3]);
    vec3 db = blend4(x.w, row.slope[0], row.slope[1], row.slope[2], row.slope[3]);
    if (corner == 0u) frame = frameOf(da, db);
    else if (corner == 1u) frame = frameOf(-db, da);
    else if (corner == 2u) frame = frameOf(-da, -db);
    else frame = frameOf(db, -da);
}

vec3 onLine(vec3 line, vec3 one, vec3 other, float share) {
    precise vec3 p = line + share * ((one + other) - 2.0 * line);
    return p;
}

// The four points that a border of two halves is made of. Both quads have the same words, but the points on the two sides of the
// line exchanged.
struct HalfLine {
    vec3 e[4];
};
HalfLine halfLine(LeafPoints l, bool alongA, float share) {
    HalfLine line;
    for (uint i = 0u; i < 4u; ++i)
        line.e[i] = alongA ? onLine(l.p[4u + i], l.p[i], l.p[8u + i], share)
                           : onLine(l.p[4u * i + 1u], l.p[4u * i], l.p[4u * i + 2u], share);
    return line;
}
vec3 onHalf(vec3 origin, HalfLine line, vec4 w) {
    precise vec3 p = origin + sum4(w, line.e[0], line.e[1], line.e[2], line.e[3]);
    return p;
}

// A border that is one cubic, between two plain ends; the side runs from its corner to the next.
struct SideCubic {
    vec3 g[4];
};
SideCubic sideCubic(const PatchPlace at, uvec4 points, uvec4 spokes, uint side) {
    uint next = (side + 1u) & 3u;
    vec3 a = poolPoint(at, componentOf(points, side)), b = poolPoint(at, componentOf(points, next));
    precise vec3 aTangent = a + poolPoint(at, push.tangents + SUPPLE_SPOKE(componentOf(spokes, side)));
    precise vec3 bTangent = b + poolPoint(at, push.tangents + SUPPLE_NEXT_SPOKE(componentOf(spokes, next)));
    return SideCubic(vec3[4](a, aTangent, bTangent, b));
}
vec3 onCubic(SideCubic c, vec2 pair) { return sum4(bernstein3(pair), c.g[0], c.g[1], c.g[2], c.g[3]); }

// What a record says of a quad.
struct IrregularQuad {
    uvec4 points, spokes, windows, sizes;
    vec4 sharpness;
    uint flags;
};
IrregularQuad quadOf(uint record) {
    return IrregularQuad(tableElement(record), tableElement(record + 1u), tableElement(record + kExactWindowElement),
                         tableElement(record + kExactSizeElement),
                         uintBitsToFloat(tableElement(record + kExactSharpnessElement)), tableElement(record + kExactNetElement).x);
}
float sharpnessOf(IrregularQuad quad, uint side, uint level) {
    vec4 s = quad.sharpness;
    return softened(side < 2u ? (side == 0u ? s.x : s.y) : side == 2u ? s.z : s.w, level - 1u);
}
bool isCubic(IrregularQuad quad, uint side) { return (quad.flags >> (kCubicSide + side) & 1u) != 0u; }
uint chainLevels(uint size) { return size >> kChainLevelShift; }
// Where the points of a level begin.
uint levelPoints(uint chain, uint size, uint level) { return chain + (level - 2u) * (size & ((1u << kChainLevelShift) - 1u)); }

void irregularSample(const PatchPlace at, IrregularQuad quad, vec2 u, vec2 v, out vec3 position, out Frame frame) {
    QuarterPlace q = quarterOf(u, v, quad.flags);
    uint corner = q.corner, before = (corner + 3u) & 3u;
    uint windows = componentOf(quad.windows, corner), size = componentOf(quad.sizes, corner);
    LeafPlace leaf = leafOf(q, windows, chainLevels(size));

    vec3 limit = poolPoint(at, componentOf(quad.points, corner));
    vec3 origin = windows == 0u ? vec3(0.0) : poolPoint(at, componentOf(quad.spokes, corner) - 1u);
    LeafPoints l =
        leafPoints(at, corner, windows, leaf.cell, levelPoints(componentOf(quad.spokes, corner), size, leaf.level));
    float lineA = sharpnessOf(quad, corner, leaf.level), lineB = sharpnessOf(quad, before, leaf.level);
    LeafWeights x = leafWeights(leaf.x, leaf.farA ? 0.0 : lineB), y = leafWeights(leaf.y, leaf.farB ? 0.0 : lineA);
    finishLeaf(collapseLeaf(l, y), x, corner, origin, l.p[5], position, frame);

    bool onA = q.b == 0.0, onB = q.a == 0.0; // on the corner's first edge, on its second
    if (onA && onB) {
        position = limit;
        uint normal = componentOf(tableElement(at.record + kExactNormalElement), corner);
        if (normal != kNoNormal) frame = withNormal(frame, poolPoint(at, normal));
    } else if (onA || onB) {
        uint side = onA ? corner : before;
        vec2 pair = (side & 1u) == 0u ? u : v;
        if (isCubic(quad, side)) position = onCubic(sideCubic(at, quad.points, quad.spokes, side), side < 2u ? pair : pair.yx);
        else position = onHalf(origin, halfLine(l, onA, besideLine(onA ? lineA : lineB)), onA ? x.w : y.w);
    }
}
