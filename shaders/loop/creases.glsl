// Semi-sharp creases of Loop patches are weights (docs/loop.md, "Semi-sharp creases"). As at an endless crease, what lies across is
// taken to be the mirror image of what lies on this side. What the points beside the crease are more than that, its excess, is added
// with weights. Before the include: box_spline.glsl, chain_level.glsl and
//   const bool kSemiSharp                             whether a leaf may have such creases

float componentOf3(vec3 v, uint k) { return SELECT(k == 0u, v.x, SELECT(k == 1u, v.y, v.z)); }

// What the two points beside a segment of the crease are more than its ends. Both triangles at it have the same bits.
vec3 excessOf(vec3 one, vec3 other, vec3 begin, vec3 end) {
    precise vec3 excess = (one + other) - (begin + end);
    return excess;
}
vec3 sumOf(vec3 a, vec3 b) {
    precise vec3 sum = a + b;
    return sum;
}

// The excess along a crease is a quadratic B-spline. In powers of the distance from a point of the lattice; `bend` is half of the
// second derivative. All are zero where there is no crease.
struct Crease {
    vec3 own, along, bend;
    float sharpness;
};
// From the excess of the segment before the point and of both behind it.
Crease creaseOf(vec3 before, vec3 behind, vec3 further, float sharpness) {
    precise vec3 own = 0.5 * (before + behind), along = behind - before, bend = 0.5 * ((before + further) - 2.0 * behind);
    bool sharp = sharpness > 0.0;
    return Crease(SELECT3(sharp, own, vec3(0.0)), SELECT3(sharp, along, vec3(0.0)), SELECT3(sharp, bend, vec3(0.0)), sharpness);
}

// The weights of a crease's three vectors, and their derivatives along the crease and across it.
struct CreaseWeights {
    vec3 w, along, across;
};
// When `steps` steps were sharp, and all others smooth. `at`: the distance along the crease, from the same point and in the
// directions of the lattice, and from the crease.
CreaseWeights weightsAfter(float steps, vec2 at) {
    precise float scale = powerOfTwo(steps), h = powerOfTwo(-steps), hh = h * h;
    precise float a = max(0.0, 1.0 - at.y * scale), aa = a * a, middle = at.x + 0.5 * at.y;
    // Where it lies in a segment of the finer lattice, and in which of its two triangles.
    precise float whole = at.x * scale, part = whole - min(floor(whole), scale - 1.0), x = part - 0.5 * a, xx = x * x;
    bool touches = part <= a;
    precise float near = aa * aa * (1.0 / 32.0) + xx * (0.25 * aa - (xx + a * aa) * (1.0 / 6.0));
    precise float far = a * aa * (x - xx) * (1.0 / 6.0);
    precise float ripple = SELECT(touches, near, far), own = h * (a * aa) * (1.0 / 6.0), square = middle * middle - 0.25 * hh;
    precise float alongX = SELECT(touches, x * (0.5 * aa - (2.0 * xx + a * aa) * (1.0 / 3.0)), a * aa * (1.0 - 2.0 * x) * (1.0 / 6.0));
    precise float alongA = SELECT(touches, a * (0.125 * aa + 0.5 * xx * (1.0 - a)), 0.5 * aa * (x - xx)), slope = -0.5 * aa;
    precise vec3 w = vec3(own, own * middle, own * square + h * hh * ripple);
    precise vec3 along = vec3(0.0, own, 2.0 * own * middle + hh * alongX);
    precise vec3 across =
        vec3(slope, slope * middle + 0.5 * own, slope * square + own * middle + hh * (0.5 * alongX - alongA));
    return CreaseWeights(w, along, across);
}
// The last step of a sharpness that is no whole number is sharp by its fraction.
CreaseWeights creaseWeights(float sharpness, vec2 at) {
    precise float steps = floor(sharpness), sharp = sharpness - steps, rest = 1.0 - sharp;
    CreaseWeights few = weightsAfter(steps, at), more = weightsAfter(steps + 1.0, at);
    precise vec3 w = rest * few.w + sharp * more.w;
    precise vec3 along = rest * few.along + sharp * more.along, across = rest * few.across + sharp * more.across;
    return CreaseWeights(w, along, across);
}
vec3 weighted(Crease c, vec3 w) {
    precise vec3 sum = (w.x * c.own + w.y * c.along) + w.z * c.bend;
    return sum;
}

// The creases of a leaf: of a leaf at a corner of a net the one on its side, of the leaf in the middle one a corner, which passes it.
struct Creases {
    Crease of[3];
};
struct CreaseSum {
    vec3 p, dx, dy;
};
CreaseSum addedTo(CreaseSum sum, Crease crease, vec2 at, vec2 along, vec2 across) {
    CreaseWeights weights = creaseWeights(crease.sharpness, at);
    precise vec3 p = sum.p + weighted(crease, weights.w);
    vec3 slope = weighted(crease, weights.along), steepness = weighted(crease, weights.across);
    return CreaseSum(p, sum.dx + along.x * slope + across.x * steepness, sum.dy + along.y * slope + across.y * steepness);
}
// What is added to a leaf and to its derivatives. `x`, `y`: weights of its corners 1 and 2.
CreaseSum creaseSum(Creases creases, uint cell, float x, float y) {
    precise float rest = 1.0 - x - y, alongX = x + y, fromX = 1.0 - x, fromY = 1.0 - y;
    bool middle = cell == kMiddleCell, back = cell == 2u;
    vec2 at = SELECT2(middle, vec2(-y, alongX), SELECT2(back, vec2(y, x), vec2(x, y)));
    vec2 along = SELECT2(middle, vec2(0.0, -1.0), SELECT2(back, vec2(0.0, 1.0), vec2(1.0, 0.0)));
    vec2 across = SELECT2(middle, vec2(1.0), SELECT2(back, vec2(1.0, 0.0), vec2(0.0, 1.0)));
    CreaseSum sum = addedTo(CreaseSum(vec3(0.0), vec3(0.0), vec3(0.0)), creases.of[0], at, along, across);
    sum = addedTo(sum, creases.of[1], vec2(-rest, fromX), vec2(1.0), vec2(-1.0, 0.0));
    return addedTo(sum, creases.of[2], vec2(-x, fromY), vec2(-1.0, 0.0), vec2(0.0, -1.0));
}

// Takes from the points across what they are more than mirror images. `sharpness`: of the sides of the net.
Creases takeCreases(inout LeafPoints leaf, vec3 sharpness, uint cell) {
    LeafPoints from = leaf;
    bool middle = cell == kMiddleCell, back = cell == 2u;
    Creases creases;
    [[unroll]] for (uint v = 0u; v < 3u; ++v) {
        const uint next = (v + 1u) % 3u, last = (v + 2u) % 3u;
        float own = SELECT(middle, sharpness[next], 0.0); // of the side that the leaf's corner lies on
        vec3 before = excessOf(from.p[9u + last], from.p[last], from.p[v], from.p[6u + last]);
        vec3 behind = excessOf(from.p[3u + v], from.p[next], from.p[v], from.p[6u + v]);
        leaf.p[9u + last] = SELECT3(own > 0.0, offsetFrom(before, from.p[9u + last]), leaf.p[9u + last]);
        leaf.p[3u + v] = SELECT3(own > 0.0, offsetFrom(behind, from.p[3u + v]), leaf.p[3u + v]);
        // It only reaches half of each segment there, and so is a line.
        creases.of[v] = creaseOf(before, behind, behind, own);
        creases.of[v].bend = vec3(0.0);
    }
    float own = SELECT(middle, 0.0, SELECT(cell == 1u, sharpness.x, SELECT(back, sharpness.z, 0.0)));
    LeafSide side = leafSide(from, 0u, back, false);
    vec3 excess[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        excess[i] = excessOf(side.beside[i], vec3(0.0), side.line[i], side.line[i + 1u]);
        const uint front = 3u + 3u * i, behind = 11u - 3u * i; // the point across the first side, and across the last
        leaf.p[front] = SELECT3(own > 0.0 && !back, offsetFrom(excess[i], from.p[front]), leaf.p[front]);
        leaf.p[behind] = SELECT3(own > 0.0 && back, offsetFrom(excess[i], from.p[behind]), leaf.p[behind]);
    }
    Crease onSide = creaseOf(excess[0], excess[1], excess[2], own), passing = creases.of[0];
    creases.of[0] = Crease(SELECT3(middle, passing.own, onSide.own), SELECT3(middle, passing.along, onSide.along), onSide.bend,
                           SELECT(middle, passing.sharpness, onSide.sharpness));
    return creases;
}

// On a side of a leaf, as onSide(). It may be a crease itself.
vec3 onCreasedSide(LeafSide side, float sharpness, vec2 pair) {
    if (!kSemiSharp) return onSide(side, pair);
    bool sharp = sharpness > 0.0;
    vec3 excess[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        excess[i] = excessOf(side.beside[i], vec3(0.0), side.line[i], side.line[i + 1u]);
        side.beside[i] = SELECT3(sharp, sumOf(side.line[i], side.line[i + 1u]), side.beside[i]);
    }
    vec3 line = onSide(side, pair);
    Crease crease = creaseOf(excess[0], excess[1], excess[2], sharpness);
    precise vec3 p = line + weighted(crease, creaseWeights(sharpness, vec2(pair.x, 0.0)).w);
    return SELECT3(sharp, p, line);
}
// The same at a point of the lattice, of the excess of the two segments there.
vec3 onCreasedLine(vec3 line, vec3 before, vec3 behind, float sharpness) {
    Crease crease = creaseOf(before, behind, behind, sharpness);
    precise vec3 p = line + creaseWeights(sharpness, vec2(0.0)).w.x * crease.own;
    return p;
}
