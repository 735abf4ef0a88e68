// Lines on a patch, as wide as asked in pixels whatever the distance, fading where they would run together.

/// Coverage of a line of half width `half` pixels at `distance` pixels.
float lineCoverage(float distance, float halfWidth) {
    return 1.0 - smoothstep(max(halfWidth - 0.6, 0.0), halfWidth + 0.6, distance);
}

float strongest(vec3 v) { return max(v.x, max(v.y, v.z)); }

/// Lines at whole numbers of `at`; `perPixel` is its change from pixel to pixel. A coordinate that stands still draws none.
float gridLines(vec3 at, vec3 perPixel, float halfWidth) {
    vec3 distance = abs(fract(at - 0.5) - 0.5) / max(perPixel, vec3(1e-6));
    vec3 fade = (1.0 - smoothstep(vec3(0.16), vec3(0.45), perPixel * halfWidth)) * step(vec3(1e-5), perPixel);
    return strongest(vec3(lineCoverage(distance.x, halfWidth), lineCoverage(distance.y, halfWidth),
                          lineCoverage(distance.z, halfWidth)) * fade);
}

/// Lines where `inside`, the distance from a border in segments, is 0 (vec3(1e9) leaves a side out).
float borderLine(vec3 inside, vec3 perPixel, float side, float halfWidth) {
    vec3 distance = inside / max(perPixel, vec3(1e-6));
    vec3 fade = 1.0 - 0.7 * smoothstep(vec3(0.12), vec3(0.5), perPixel * halfWidth / side);
    return strongest(vec3(lineCoverage(distance.x, halfWidth), lineCoverage(distance.y, halfWidth),
                          lineCoverage(distance.z, halfWidth)) * fade);
}
