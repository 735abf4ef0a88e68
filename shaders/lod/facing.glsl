// Whether a patch surely shows its back (docs/lod.md, "Back faces").
//
// Its normal Du x Dv is a sum, with weights that are not negative, of the products a x b of a difference a along u and a
// difference b along v of its net; what it is seen along, w, lies in every pyramid from the camera that holds the net.
// So it shows its back wherever w . (a x b) > 0 for all a, all b, all w. Seen along w they are plane vectors: with m along
// and n across, a = x m + y n has the slope y / x, b = z m + t n the slope z / t, and a x b > 0 where x, t > 0 and the slopes'
// product is below 1.
//
// Triangles are not the surface. Those whose sides run along u and v are sums of such products too. Those between a border
// and the first inner row are not: either has samples of its own. The corner that lies across is the end of a difference b
// over the row's distance 1 / Li, from a point that lies off the line through the two corners by |q| e, e being second
// differences along the border and |q| the product of the point's distances from them. With the border's level Le patterns
// keep |q| Li below max(1, Li / (3.4 max(Le, 1))) (tests/surface/lod/pattern_test.cpp). So it is enough that d x b exceeds
// that many d x e for all differences d along the border; with its chord c and what leads inwards from it, n: d = x c + y n,
// that c x b less y/x b x n exceeds so many c x e plus y/x e x n.

const float kMostSlopes = 0.97;
const float kMostBend = 0.97;
const float kBorderReach = 3.4;
float reachOfBorder(float level, float across) { return min(kBorderReach * max(level, 1.0) / max(across, 3.0), 1.0); }

// Rows: to the right, up, away from the camera. `towards`: from the camera to the patch, of any length.
mat3 frameTowards(vec3 towards) {
    vec3 away = towards / max(lengthOf(towards), 1e-30);
    vec3 right = cross(away, abs(away.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
    right /= lengthOf(right);
    return transpose(mat3(right, cross(away, right), away));
}

// The pyramid: w = (x, y, 1), x and y between low and high.
struct Pyramid {
    vec2 low, high;
    float nearest; // of what it holds
};
void hold(inout Pyramid p, vec3 point, float radius) { // in the frame, from the camera
    p.nearest = min(p.nearest, point.z - radius);
    vec2 at = point.xy / point.z, slack = vec2(radius / max(point.z - radius, 1e-30)) * (1.0 + abs(at)) + 1e-6;
    p.low = min(p.low, at - slack);
    p.high = max(p.high, at + slack);
}

struct Facing {
    vec2 middle, spread; // of the pyramid
    vec3 m, n;
    float leastArea, mostArea; // w . (m x n)
    // For differences along, x and |y|; across, t and |z|: times that.
    float leastX, mostY, leastT, mostZ;
    float slopeAlong, slopeAcross;
};

// Half of what w . c ranges over, with the middle (least = x - y, most = x + y).
vec2 seen(Facing f, vec3 c) { return vec2(dot(c.xy, f.middle) + c.z, dot(abs(c.xy), f.spread)); }
// w . (m x n) for m and n at hand: the least, and the most by amount.
float least(Facing f, vec3 a, vec3 b) {
    vec2 s = seen(f, cross(a, b));
    return s.x - s.y;
}
float most(Facing f, vec3 a, vec3 b) {
    vec2 s = seen(f, cross(a, b));
    return abs(s.x) + s.y;
}
float seenSize(Facing f, vec3 v) { return lengthOf(v) * (1.0 + dot(abs(f.middle) + f.spread, vec2(1.0))); }

Facing facingOf(Pyramid p, vec3 m, vec3 n) {
    Facing f;
    f.middle = 0.5 * (p.low + p.high);
    f.spread = 0.5 * (p.high - p.low);
    f.m = m;
    f.n = n;
    f.leastX = f.leastT = 1e30;
    f.mostY = f.mostZ = f.slopeAlong = f.slopeAcross = 0.0;
    f.leastArea = least(f, m, n);
    f.mostArea = most(f, m, n);
    return f;
}

// A difference, in the frame. `slack`: of the products with m and n.
void addAlong(inout Facing f, vec3 a, vec2 slack) {
    float x = least(f, a, f.n) - slack.y, y = most(f, f.m, a) + slack.x;
    f.leastX = min(f.leastX, x);
    f.mostY = max(f.mostY, y);
    f.slopeAlong = max(f.slopeAlong, y / x);
}
void addAcross(inout Facing f, vec3 b, vec2 slack) {
    float t = least(f, f.m, b) - slack.x, z = most(f, b, f.n) + slack.y;
    f.leastT = min(f.leastT, t);
    f.mostZ = max(f.mostZ, z);
    f.slopeAcross = max(f.slopeAcross, z / t);
}
bool showsBack(Facing f) {
    return min(f.leastX, f.leastT) > 0.0 && f.slopeAlong * f.slopeAcross < kMostSlopes;
}

// How much the patch rises at least from a border along it or across, whose ends lie `chord` apart.
float riseAlong(Facing f, vec3 chord) {
    return least(f, chord, f.n) / f.mostArea * f.leastT - most(f, f.m, chord) / f.leastArea * f.mostZ;
}
float riseAcross(Facing f, vec3 chord) {
    return least(f, f.m, chord) / f.mostArea * f.leastX - most(f, chord, f.n) / f.leastArea * f.mostY;
}

// A border, and what runs beside it.
struct Border {
    vec3 chord, inwards;
    float slope, bend, stretch; // of differences, y / x; of second differences, by what turns and by what does not
};
Border borderOf(vec3 chord, vec3 inwards) { return Border(chord, inwards, 0.0, 0.0, 0.0); }
// A difference that addAlong or addAcross has taken; one less the one before. `slack`: of their lengths.
void addDifference(inout Border b, Facing f, vec3 d, float slack) {
    float x = least(f, d, b.inwards) - slack * seenSize(f, b.inwards);
    b.slope = max(b.slope, (most(f, b.chord, d) + slack * seenSize(f, b.chord)) / x);
}
void addSecondDifference(inout Border b, Facing f, vec3 e, float slack) {
    b.bend = max(b.bend, most(f, b.chord, e) + slack * seenSize(f, b.chord));
    b.stretch = max(b.stretch, most(f, e, b.inwards) + slack * seenSize(f, b.inwards));
}
// `shift`: the most that differences across go along. `second`: what the second derivative's factor is of the first one's, as
// a part of a cubic's.
bool isStraight(Border b, float rise, float shift, float reach, float second) {
    return second * (b.bend + b.slope * b.stretch) < reach * (kMostBend * rise - b.slope * shift);
}
