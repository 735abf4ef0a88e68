// Views of dark and bright stripes: a kink in a stripe is a kink in the surface's normals, and a bend that is not smooth is a jump
// in its curvature.

bool hasStripes(uint view) { return view >= kViewZebra && view <= kViewIsophotes; }

/// Where a place is among light tubes all round the viewer: from one tube to the next it grows by one.
float amongTubes(vec3 position, vec3 n) {
    vec3 r = mat3(frame.view) * reflect(normalize(position - frame.eye.xyz), n);
    return acos(clamp(dot(r, normalize(vec3(0.35, 0.93, 0.1))), -1.0, 1.0)) * (frame.eye.w / kPi);
}

/// Highlight lines (Beier and Chen, Computer-Aided Design 26, 1994): the normal's line meets a line of light. Lines of light are
/// parallel to the x axis and lie on a cylinder round the figure. Where a normal's line meets it: from one light to the next it
/// grows by one.
float amongLights(vec3 position, vec3 n) {
    const float kLightRadius = 4.0; // in radii of the scene
    vec2 p = (position - frame.target.xyz).yz / (kLightRadius * frame.target.w), d = n.yz;
    float a = max(dot(d, d), 1e-12), b = dot(p, d), c = dot(p, p) - 1.0;
    vec2 hit = p + d * ((sqrt(max(b * b - a * c, 0.0)) - b) / a);
    return atan(hit.x, hit.y) * (float(kHighlightCount) / (2.0 * kPi));
}

/// The angle between the normal and a direction: from one bright band to the next it grows by one.
float amongIsophotes(vec3 n) {
    return degrees(acos(clamp(dot(n, vec3(1.0, 2.0, 2.0) / 3.0), -1.0, 1.0))) / kIsophoteDegrees;
}

float amongStripes(uint view, vec3 position, vec3 n) {
    switch (view) {
    case kViewZebra: return amongTubes(position, n);
    case kViewHighlights: return amongLights(position, n);
    default: return amongIsophotes(n);
    }
}

/// Where this pixel is among them, and how far away its neighbors are. A derivative of amongStripes() would not do: pixels beside
/// the triangle help to take derivatives, and lavapipe reads zeros for them from storage buffers, which the frame is in. So only
/// what is interpolated is derived, and this pixel looks at the stripes for its neighbors.
vec2 stripesAt(uint view, vec3 position, vec3 n) {
    float at = amongStripes(view, position, n);
    vec2 apart = vec2(amongStripes(view, position + dFdx(position), n + dFdx(n)),
                      amongStripes(view, position + dFdy(position), n + dFdy(n))) - at;
    if (view == kViewHighlights) // the last light is beside the first
        apart -= float(kHighlightCount) * round(apart / float(kHighlightCount));
    return vec2(at, abs(apart.x) + abs(apart.y));
}

vec3 stripes(vec2 at, vec3 n, vec3 v) {
    float width = max(at.y, 1e-4);
    float stripe = smoothstep(-width, width, abs(fract(at.x) - 0.5) - 0.25);
    stripe = mix(stripe, 0.5, smoothstep(0.35, 0.9, width));
    float form = 0.72 + 0.28 * clamp(dot(n, v), 0.0, 1.0);
    return mix(vec3(0.012, 0.014, 0.02), vec3(0.82, 0.83, 0.84), stripe) * form;
}
