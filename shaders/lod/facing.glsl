// Whether a patch surely shows its back (docs/lod.md, section "Back faces").
//
// Its normal Du x Dv is a sum, with weights that are not negative, of the products of a difference a along u and a
// difference b along v of its net; what it is seen along, w, lies in every pyramid from the camera that holds the net.
// So it shows its back wherever det(w, a, b) > 0 for all a, all b, and the four corner rays w of a pyramid. Seen along one
// ray these are plane vectors: with m along and n across, a = x m + y n has the slope y / x, b = z m + t n the slope z / t,
// and a x b > 0 where x, t > 0 and the slopes' product is below 1.
//
// Triangles are not the surface. Those whose sides run along u and v are sums of such products too; those between a border
// and the inside, which have other levels, are askew: there the border, and what runs beside it, must bend less off its
// chord than the patch rises from it (Strip).

const float kMostSlopes = 0.9;
const float kMostBend = 0.9;
const float kNever = 1e30;

// Rows: to the right, up, away from the camera. `towards`: from the camera to the patch, of any length.
mat3 frameTowards(vec3 towards) {
    vec3 away = towards / max(lengthOf(towards), 1e-30);
    vec3 right = cross(away, abs(away.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
    right /= lengthOf(right);
    return transpose(mat3(right, cross(away, right), away));
}

// What the rays must hold between them.
struct Pyramid {
    vec2 low, high;
    float nearest;
};
void hold(inout Pyramid p, vec3 point, float radius) { // in the frame, from the camera
    p.nearest = min(p.nearest, point.z - radius);
    vec2 at = point.xy / point.z, slack = vec2(radius / max(point.z - radius, 1e-30)) * (1.0 + abs(at)) + 1e-6;
    p.low = min(p.low, at - slack);
    p.high = max(p.high, at + slack);
}

// The corner rays (x, y, 1).
struct Rays {
    vec4 x, y;
};
Rays raysOf(Pyramid p) {
    return Rays(vec4(p.low.x, p.high.x, p.low.x, p.high.x), vec4(p.low.y, p.low.y, p.high.y, p.high.y));
}
// A vector as it is seen along them.
struct Flat {
    vec4 x, y;
};
Flat flatten(Rays r, vec3 v) { return Flat(v.x - v.z * r.x, v.y - v.z * r.y); }
vec4 times(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }
vec4 size(Flat a) { return abs(a.x) + abs(a.y); }
// How far off a product with `a` can be where a vector is known to a radius.
vec4 slack(Rays r, Flat a, float radius) { return radius * (1.0 + abs(r.x) + abs(r.y)) * size(a); }

struct Facing {
    Rays rays;
    Flat m, n;
    vec4 along, across; // the largest slopes
};
Facing facingOf(Rays rays, vec3 m, vec3 n) { return Facing(rays, flatten(rays, m), flatten(rays, n), vec4(0.0), vec4(0.0)); }

vec4 slopes(vec4 aside, vec4 ahead) { return mix(vec4(kNever), aside / ahead, greaterThan(ahead, vec4(0.0))); }
void addAlong(inout Facing f, vec3 a, float radius) { // give or take
    Flat seen = flatten(f.rays, a);
    vec4 ahead = times(seen, f.n) - slack(f.rays, f.n, radius), aside = abs(times(f.m, seen)) + slack(f.rays, f.m, radius);
    f.along = max(f.along, slopes(aside, ahead));
}
void addAcross(inout Facing f, vec3 b, float radius) {
    Flat seen = flatten(f.rays, b);
    vec4 ahead = times(f.m, seen) - slack(f.rays, f.m, radius), aside = abs(times(seen, f.n)) + slack(f.rays, f.n, radius);
    f.across = max(f.across, slopes(aside, ahead));
}
bool showsBack(Facing f) { return all(lessThan(f.along * f.across, vec4(kMostSlopes))); }

// Along a border: how far differences along it point off its chord, and how far those across it rise at least.
struct Strip {
    Rays rays;
    Flat chord;
    vec4 bend, rise;
};
Strip stripOf(Rays rays, vec3 chord) { return Strip(rays, flatten(rays, chord), vec4(0.0), vec4(kNever)); }
void addAlong(inout Strip s, vec3 a, float radius) {
    s.bend = max(s.bend, abs(times(s.chord, flatten(s.rays, a))) + slack(s.rays, s.chord, radius));
}
void addAcross(inout Strip s, vec3 b, float radius) {
    s.rise = min(s.rise, times(s.chord, flatten(s.rays, b)) - slack(s.rays, s.chord, radius));
}
bool holds(Strip s) { return all(lessThan(s.bend, kMostBend * s.rise)); }
