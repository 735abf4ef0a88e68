// Attributes of a pentagon: bilinear on the five quads round its centre that a step of Catmull-Clark makes of it, so that they are
// the same under all schemes. The centre has the mean of the corners, the middle of a side that of its ends.

// Where a point of a regular pentagon lies in the quad of its nearest corner. Seen from the centre, the corner is at (1, 1), the
// middle of the point's own side at (1, 0), that of the other side at (0, 1).
struct PentagonPlace {
    vec2 at;
    uint corner, own, other; // at the ends of the own side and of the other one
    bool first;              // the corner is the first one of the own side
    vec2 slope;              // of `at.y`, per weight of the corner and of the middle of the own side
};
// `l`: the weights of a sector's corners and of the centre. In its half of the sector the point is corner A + middle M, seen from
// the centre, with M the middle of the own side. With M + M' = 2 cos^2(36) A, the bilinear map a M + b M' + ab (A - M - M') is
// that point where
//   a = b + middle,   (1 - m) b^2 + (m + (1 - m) middle) b = corner,   m = 2 cos^2(36)
PentagonPlace pentagonPlace(uint sector, vec3 l) {
    const float kMiddles = 1.3090169943749475, kRest = 1.0 - kMiddles;
    PentagonPlace place;
    uint next = sector == 4u ? 0u : sector + 1u;
    place.first = l.x >= l.y;
    place.corner = place.first ? sector : next;
    place.own = place.first ? next : sector;
    place.other = place.first ? (sector + 4u) % 5u : (sector + 2u) % 5u;
    float corner = abs(l.x - l.y), middle = 2.0 * min(l.x, l.y), linear = kMiddles + kRest * middle;
    float b = 2.0 * corner / (linear + sqrt(max(linear * linear + 4.0 * kRest * corner, 0.0)));
    place.at = vec2(b + middle, b);
    place.slope = vec2(1.0, -kRest * b) / (2.0 * kRest * b + linear);
    return place;
}

float[5] pentagonWeights(uint sector, vec3 l) {
    // Along a side only its ends count, so that neighbors agree in every bit.
    bool inside = l.z > 0.0;
    PentagonPlace place = pentagonPlace(sector, l);
    vec2 p = place.at, q = 1.0 - p;
    float own = 0.5 * (p.x * q.y), other = 0.5 * (p.y * q.x), centre = 0.2 * (q.x * q.y), w[5];
    for (uint c = 0u; c < 5u; ++c) {
        float here = centre;
        if (c == place.corner) here += p.x * p.y + own + other;
        if (c == place.own) here += own;
        if (c == place.other) here += other;
        w[c] = inside ? here : c == sector ? l.x : c == (sector + 1u) % 5u ? l.y : 0.0;
    }
    return w;
}

// Derivatives of the texture coordinates along the sector's side, and from its first corner towards the centre.
void pentagonSlopes(vec2 uv[5], uint sector, vec3 l, out vec2 along, out vec2 inwards) {
    PentagonPlace place = pentagonPlace(sector, l);
    vec2 centre = 0.2 * (uv[0] + uv[1] + uv[2] + uv[3] + uv[4]), corner = uv[place.corner];
    vec2 own = 0.5 * (corner + uv[place.own]), other = 0.5 * (corner + uv[place.other]), q = 1.0 - place.at;
    vec2 a = q.y * (own - centre) + place.at.y * (corner - other), b = q.x * (other - centre) + place.at.x * (corner - own);
    // How the weights of the corner and of the middle change: l.x falls in both directions, and l.y grows along the side.
    vec2 alongStep = place.first ? vec2(-2.0, 2.0) : vec2(2.0, -2.0);
    vec2 inwardStep = place.first ? vec2(-1.0, 0.0) : vec2(1.0, -2.0);
    float alongB = dot(place.slope, alongStep), inwardB = dot(place.slope, inwardStep);
    along = (alongB + alongStep.y) * a + alongB * b;
    inwards = (inwardB + inwardStep.y) * a + inwardB * b;
}
