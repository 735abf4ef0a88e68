// A single sample of an irregular quad (docs/catmull_clark.md): a point of a side, by which levels are measured, and all that texture
// coordinates want of a sample. Before the include, what quad.glsl needs.
#include "shaders/catmull_clark/quad.glsl"

// Where a net's points come from, as they are seen from a corner.
struct NetSource {
    uint netList, first;
    uint corner; // 0 for a chain: its net lists are the corner's
};
NetSource ownNet(const PatchPlace at, IrregularQuad quad, uint corner) {
    return NetSource(at.record + kQuadNetElement, quad.first, corner);
}
NetSource chainNet(Chain chain, uint level) { return NetSource(chain.netLists, levelPoints(chain, level), 0u); }
vec3 sourcePoint(const PatchPlace at, NetSource net, uint k) {
    uint place = SUPPLE_QUAD_NET_PLACE(net.corner, k % kNetSide, k / kNetSide);
    return poolPoint(at, net.first + netListPoint(net.netList, place));
}

// A point of a side that has two halves, at a pair of the quad's own parameter.
vec3 pointOnHalves(const PatchPlace at, IrregularQuad quad, uint side, vec2 pair) {
    bool far = pair.x > pair.y, alongU = (side & 1u) == 0u, rising = side < 2u;
    uint corner = far == rising ? (side + 1u) & 3u : side;
    Chain chain = chainOf(at, quad, corner);
    bool middle = pair.x == pair.y, own = middle || chain.netLists == 0u;
    bool onFirst = corner == side; // of the corner's two edges
    uint beside = onFirst ? (corner + 3u) & 3u : corner, step = onFirst ? 1u : kNetSide, across = onFirst ? kNetSide : 1u;
    float distance = far ? pair.y : pair.x;
    NetSource net = ownNet(at, quad, corner);
    uint begin = 0u, level = 1u;
    vec4 w = quarterWeights(distance, sharpnessOf(quad, beside, 1u)).w;
    vec3 origin = vec3(0.0);
    float way = 1.0; // to the rim of the last cell
    if (!own) {
#ifdef LEVELS
        float rim = powerOfTwo(-float(chain.lastLevel));
        if (distance < rim) {
            precise float of = distance * powerOfTwo(float(chain.lastLevel));
            way = of;
            distance = rim;
        }
#endif
        ChainPlace place = chainPlace(distance, chain.lastLevel);
        precise float x = distance * place.scale;
        bool second = x >= 1.0;
        level = place.level;
        net = chainNet(chain, level);
        begin = second ? 1u : 0u;
        w = chainWeights(second, x, sharpnessOf(quad, beside, level)).w;
        origin = chainOrigin(at, chain);
    }
    float share = besideLine(sharpnessOf(quad, side, level));
    vec3 e[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint on = across + (begin + k) * step;
        e[k] = onLine(sourcePoint(at, net, on), sourcePoint(at, net, on - across), sourcePoint(at, net, on + across), share);
    }
    if (middle) return middleOfLine(e[1], e[2], e[3]);
    precise vec3 p = origin + sum4(w, e[0], e[1], e[2], e[3]);
#ifdef LEVELS
    if (way < 1.0) p = onCone(poolPoint(at, componentOf(quad.points, corner)), p, way);
#endif
    return p;
}
vec3 sidePoint(const PatchPlace at, IrregularQuad quad, uint side, vec2 pair) {
    if (isCubic(quad, side)) return onCubic(sideCubic(at, quad, side), side, pair);
    return pointOnHalves(at, quad, side, pair);
}

// The leaf in a cell, from the net's middle.
struct Leaf {
    vec3 first, offset, alongX, alongY;
};
Leaf leafAt(const PatchPlace at, NetSource net, bool secondX, bool secondY, LeafWeights x, LeafWeights y) {
    uint begin = (secondY ? kNetSide : 0u) + (secondX ? 1u : 0u);
    vec3 first = sourcePoint(at, net, kNetMiddle), point[4], slope[4];
    for (uint i = 0u; i < 4u; ++i) {
        vec3 p[4];
        for (uint j = 0u; j < 4u; ++j) {
            precise vec3 d = sourcePoint(at, net, begin + kNetSide * j + i) - first;
            p[j] = d;
        }
        point[i] = sumInside(y.w, p[0], p[1], p[2], p[3]);
        slope[i] = blend4(y.d, p[0], p[1], p[2], p[3]);
    }
    return Leaf(first, sumInside(x.w, point[0], point[1], point[2], point[3]), blend4(x.d, point[0], point[1], point[2], point[3]),
                blend4(x.w, slope[0], slope[1], slope[2], slope[3]));
}

// For texture coordinates: nobody reads the frame's normal.
void irregularSample(const PatchPlace at, IrregularQuad quad, vec2 u, vec2 v, out vec3 position, out Frame frame) {
    bool right = u.x > u.y, up = v.x > v.y;
    uint corner = up ? (right ? 2u : 3u) : (right ? 1u : 0u);
    float fromU = right ? u.y : u.x, fromV = up ? v.y : v.x;
    bool onU = fromU == 0.0, onV = fromV == 0.0; // on a side
    Chain chain = chainOf(at, quad, corner);

    NetSource net = ownNet(at, quad, corner);
    bool secondX = false, secondY = false, turned = (corner & 1u) != 0u;
    float a = turned ? fromV : fromU, b = turned ? fromU : fromV;
    LeafWeights x, y;
    vec3 origin = vec3(0.0);
    float way = 1.0;
    if (chain.netLists == 0u) {
        x = quarterWeights(a, sharpnessOf(quad, (corner + 3u) & 3u, 1u));
        y = quarterWeights(b, sharpnessOf(quad, corner, 1u));
    } else {
#ifdef LEVELS
        float far = max(a, b), rim = powerOfTwo(-float(chain.lastLevel));
        if (far > 0.0 && far < rim) {
            precise float back = rim / far, of = far * powerOfTwo(float(chain.lastLevel));
            way = of;
            a = a == far ? rim : a * back, b = b == far ? rim : b * back;
        }
#endif
        ChainPlace place = chainPlace(max(a, b), chain.lastLevel);
        precise float xx = a * place.scale, yy = b * place.scale;
        if (onU && onV) xx = 1.0; // at the corner the directions of the nearest leaves stand in
        secondX = xx >= 1.0, secondY = yy >= 1.0;
        x = chainWeights(secondX, xx, sharpnessOf(quad, (corner + 3u) & 3u, place.level));
        y = chainWeights(secondY, yy, sharpnessOf(quad, corner, place.level));
        net = chainNet(chain, place.level);
        origin = chainOrigin(at, chain);
    }

    Leaf leaf = leafAt(at, net, secondX, secondY, x, y);
    position = placed(origin, leaf.first, leaf.offset);
    if (chain.netLists != 0u && onU && onV) { // those along the second edge
        LeafWeights begin = leafWeights(0.0, 0.0), across = leafWeights(0.0, sharpnessOf(quad, (corner + 3u) & 3u, chain.lastLevel));
        leaf.alongY = leafAt(at, net, false, true, across, begin).alongY;
    }
    frame = turnedFrame(corner, leaf.alongX, leaf.alongY);

    if (onU && onV) {
        position = poolPoint(at, componentOf(quad.points, corner));
    } else if (onU || onV) {
        position = sidePoint(at, quad, onV ? (up ? 2u : 0u) : (right ? 1u : 3u), onV ? u : v);
    } else if (way < 1.0) {
#ifdef LEVELS
        position = onCone(poolPoint(at, componentOf(quad.points, corner)), position, way);
#endif
    }
}

// The sample of a side at t, from where the side begins. The frame is turned so that the side comes first, then inwards.
void sampleOnSide(const PatchPlace at, uint side, vec2 t, out vec3 position, out Frame f) {
    vec2 begin = vec2(0.0, 1.0);
    vec2 u = side == 0u ? t : side == 1u ? begin.yx : side == 2u ? t.yx : begin;
    vec2 v = side == 0u ? begin : side == 1u ? t : side == 2u ? begin.yx : t.yx;
    irregularSample(at, quadOf(at.record), u, v, position, f);
    if ((side & 1u) != 0u) f = Frame(f.dv, -f.du, f.normal);
    if (side >= 2u) f = Frame(-f.du, -f.dv, f.normal);
}
