// Whether a patch surely shows its back (docs/lod.md, section "Back faces").
//
// Its normal Du x Dv is a sum, with weights that are not negative, of the products of a difference a along u and a
// difference b along v of its net; what it is seen along, w, lies in every pyramid from the camera that holds the net.
// So it shows its back wherever det(w, a, b) > 0 for all a, all b, and the four corner rays w of a pyramid. Seen along one
// ray these are plane vectors: with m along and n across, a = x m + y n has the slope y / x, b = y n + x m the slope
// x / y, and a x b > 0 where x, y > 0 respectively and the slopes' product is below 1.
struct Facing {
    mat3 frame;          // rows: to the right, up, away from the camera
    vec4 x, y;           // the rays (x, y, 1) in the frame
    vec4 mx, my, nx, ny; // m and n seen along each ray
    vec4 along, across;  // the largest slopes
};

// Below 1, because triangles are not the surface: those between a border and the inside lie askew by the chord error.
const float kMostSlopes = 0.7;
const float kNever = 1e30;

// `towards`: from the camera to the patch, any length.
mat3 frameTowards(vec3 towards) {
    vec3 away = towards / max(lengthOf(towards), 1e-30);
    vec3 right = cross(away, abs(away.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
    right /= lengthOf(right);
    return transpose(mat3(right, cross(away, right), away));
}

// What the pyramid must hold.
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

Facing facingOf(mat3 frame, Pyramid p, vec3 m, vec3 n) {
    Facing f;
    f.frame = frame;
    f.x = vec4(p.low.x, p.high.x, p.low.x, p.high.x);
    f.y = vec4(p.low.y, p.low.y, p.high.y, p.high.y);
    f.mx = m.x - m.z * f.x;
    f.my = m.y - m.z * f.y;
    f.nx = n.x - n.z * f.x;
    f.ny = n.y - n.z * f.y;
    f.along = f.across = p.nearest > 0.0 ? vec4(0.0) : vec4(kNever);
    return f;
}

vec4 slopes(vec4 aside, vec4 ahead) { return mix(vec4(kNever), aside / ahead, greaterThan(ahead, vec4(0.0))); }

// A difference, in the frame, give or take `radius`.
void addAlong(inout Facing f, vec3 a, float radius) {
    vec4 x = a.x - a.z * f.x, y = a.y - a.z * f.y, off = radius * (1.0 + abs(f.x) + abs(f.y));
    vec4 ahead = x * f.ny - y * f.nx - off * (abs(f.nx) + abs(f.ny));
    vec4 aside = abs(f.mx * y - f.my * x) + off * (abs(f.mx) + abs(f.my));
    f.along = max(f.along, slopes(aside, ahead));
}
void addAcross(inout Facing f, vec3 b, float radius) {
    vec4 x = b.x - b.z * f.x, y = b.y - b.z * f.y, off = radius * (1.0 + abs(f.x) + abs(f.y));
    vec4 ahead = f.mx * y - f.my * x - off * (abs(f.mx) + abs(f.my));
    vec4 aside = abs(x * f.ny - y * f.nx) + off * (abs(f.nx) + abs(f.ny));
    f.across = max(f.across, slopes(aside, ahead));
}

bool showsBack(Facing f) { return all(lessThan(f.along * f.across, vec4(kMostSlopes))); }
