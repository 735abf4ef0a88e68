// Regular faces of the blending surface: all four charts have k = 4 and no crease (docs/blend.md, "Regular faces"). There zeta is z,
// turned by quarters, so that each local geometry is a polynomial in the face's own parameters. What the four give to a row of
// samples is added up first. A sample of the row is then the blend of two quadratics.
//
// On a border only two corners count. Positions there come from their own coefficients, by the sums of blend.glsl, so that all
// classes of faces agree bit for bit. Inside no neighbor looks, and positions are seen from the first corner.
// Needs tables.glsl, frame.glsl, shared/blend.h and hermite() of blend.glsl.

// A parameter t of the face with what depends on it alone: 1 - t, eta of both, and eta'(t), which is eta'(1 - t) as well.
struct Along {
    float t, back, eta, etaBack, slope;
};

// Where coefficient n of a corner is among those of its chart, and its sign. Corners number theirs along the row and across it, at
// 3 a + b: a chart's own are told from these by whole quarters of a turn.
uint quarterSource(uint quarter, uint n) { return (quarter & kQuarterSwapped) != 0u ? n % 3u * 3u + n / 3u : n; }
vec3 withQuarterSign(uint quarter, uint n, vec3 c) {
    bool along = (quarter & kQuarterBackAlong) != 0u && n / 3u == 1u, across = (quarter & kQuarterBackAcross) != 0u && n % 3u == 1u;
    precise vec3 negative = -c;
    return SELECT3(along != across, negative, c);
}

// A row of samples: quadratics in the distance from either end, and their derivatives across the row. Seen from `origin`.
struct RegularRow {
    vec3 origin;
    vec3 left[3], right[3], leftAcross[3], rightAcross[3];
};

vec3 quadratic(float t, vec3 c0, vec3 c1, vec3 c2) {
    precise vec3 p = c0 + t * (c1 + t * c2);
    return p;
}
vec3 weightedPair(float a, vec3 p, float b, vec3 q) {
    precise vec3 sum = a * p + b * q;
    return sum;
}
vec3 seenFrom(vec3 origin, vec3 p) {
    precise vec3 d = p - origin;
    return d;
}
// `low`, `high`: a corner's coefficients of one power along the row.
void collapseTerm(vec3 low[3], vec3 high[3], Along v, out vec3 point, out vec3 across) {
    vec3 p = quadratic(v.t, low[0], low[1], low[2]), q = quadratic(v.back, high[0], high[1], high[2]);
    point = weightedPair(v.eta, p, v.etaBack, q);
    across = v.slope * (p - q) + v.eta * (low[1] + 2.0 * (v.t * low[2])) - v.etaBack * (high[1] + 2.0 * (v.back * high[2]));
}
// `net`: the coefficients of all corners.
vec3[3] termOf(vec3 net[36], uint corner, uint a) {
    uint from = 9u * corner + 3u * a;
    vec3 first = net[from];
    if (a == 0u) first = seenFrom(net[0], first);
    return vec3[3](first, net[from + 1u], net[from + 2u]);
}
RegularRow collapseRegular(vec3 net[36], Along v) {
    RegularRow row;
    row.origin = net[0];
    [[unroll]] for (uint a = 0u; a < 3u; ++a) {
        collapseTerm(termOf(net, 0u, a), termOf(net, 3u, a), v, row.left[a], row.leftAcross[a]);
        collapseTerm(termOf(net, 1u, a), termOf(net, 2u, a), v, row.right[a], row.rightAcross[a]);
    }
    return row;
}

// What the sample of a row is made of: its place inside the face, and its derivatives.
void regularSample(RegularRow row, Along u, out vec3 position, out vec3 du, out vec3 dv) {
    vec3 p = quadratic(u.t, row.left[0], row.left[1], row.left[2]), q = quadratic(u.back, row.right[0], row.right[1], row.right[2]);
    vec3 offset = weightedPair(u.eta, p, u.etaBack, q);
    precise vec3 placed = row.origin + offset;
    position = placed;
    du = u.slope * (p - q) + u.eta * (row.left[1] + 2.0 * (u.t * row.left[2])) -
         u.etaBack * (row.right[1] + 2.0 * (u.back * row.right[2]));
    dv = u.eta * (row.leftAcross[0] + u.t * (row.leftAcross[1] + u.t * row.leftAcross[2])) +
         u.etaBack * (row.rightAcross[0] + u.back * (row.rightAcross[1] + u.back * row.rightAcross[2]));
}

// A border from one corner to another: the coefficients of its quadratics in the distance from either. Its positions.
struct RegularBorder {
    vec3 from[3], to[3];
};
// `step`: how far apart the coefficients of the border's powers lie.
RegularBorder borderOf(vec3 net[36], uint from, uint to, uint step) {
    return RegularBorder(vec3[3](net[9u * from], net[9u * from + step], net[9u * from + 2u * step]),
                         vec3[3](net[9u * to], net[9u * to + step], net[9u * to + 2u * step]));
}
RegularBorder bottomBorder(vec3 net[36]) { return borderOf(net, 0u, 1u, 3u); }
RegularBorder topBorder(vec3 net[36]) { return borderOf(net, 3u, 2u, 3u); }
RegularBorder leftBorder(vec3 net[36]) { return borderOf(net, 0u, 3u, 1u); }
RegularBorder rightBorder(vec3 net[36]) { return borderOf(net, 1u, 2u, 1u); }
RegularBorder chosen(bool first, RegularBorder a, RegularBorder b) {
    RegularBorder c;
    [[unroll]] for (uint n = 0u; n < 3u; ++n) {
        c.from[n] = SELECT3(first, a.from[n], b.from[n]);
        c.to[n] = SELECT3(first, a.to[n], b.to[n]);
    }
    return c;
}
vec3 onBorder(RegularBorder border, Along along) {
    precise vec3 from = border.from[0] + along.t * (border.from[1] + along.t * border.from[2]);
    precise vec3 to = border.to[0] + along.back * (border.to[1] + along.back * border.to[2]);
    precise vec3 sum = along.eta * from + along.etaBack * to;
    return withPositiveZeros(sum);
}
