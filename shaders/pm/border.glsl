// The border of a sector of a P_m patch (docs/pm.md), for its normals. Everything comes from offsets: beside sharp creases they
// are small. `along` and `across` are Bernstein-Bezier coefficients of the derivatives, less a common factor.
// v0, v1: the corners; t0, t1: the tangents along the border; before, after: those of the sides beside it, at v0 and at v1;
// o211, o121: what the facet stage has put behind the border, from v0 and from v1.

vec3[3] alongBorder(vec3 chord, vec3 t0, vec3 t1) { return vec3[3](t0, chord + t1 - t0, -t1); }

// From the row 400 .. 130 of the coefficients to the row 301 .. 031.
vec3[4] acrossSector(float raySide, vec3 chord, vec3 t0, vec3 t1, vec3 before, vec3 after, vec3 o211, vec3 o121) {
    return vec3[4](0.75 * raySide * (t0 + before), o211 - 0.75 * t0, o121 + 0.5 * (chord - (t0 + t1)),
                   0.75 * (raySide * (t1 + after) - t1));
}

// Where t0 and `before` are parallel: the limit of the normals on the way from v0 to the middle. last121: o121 of the side
// before.
vec3 singularNormal(float raySide, vec3 chord, vec3 t0, vec3 t1, vec3 across, vec3 o211, vec3 last121) {
    vec3 first = 0.75 * t0;
    vec3 firstStep = -2.0 * first + (0.5 * (chord + t1) - 0.25 * t0) + (o211 - across);
    vec3 acrossStep = -2.0 * across + (o211 - first) + raySide * (o211 + last121 - 2.0 * across);
    return cross(firstStep, across) + cross(first, acrossStep);
}
