// Lines on a patch, as wide as asked in pixels whatever the distance, fading where they would run together.

/// Coverage of a line of half width `half` pixels at `distance` pixels.
float lineCoverage(float distance, float halfWidth) {
    return 1.0 - smoothstep(max(halfWidth - 0.6, 0.0), halfWidth + 0.6, distance);
}

/// Lines at whole numbers of `at`; `perPixel` is its change from pixel to pixel.
float gridLines(vec2 at, vec2 perPixel, float halfWidth) {
    vec2 distance = abs(fract(at - 0.5) - 0.5) / max(perPixel, vec2(1e-6));
    vec2 fade = 1.0 - smoothstep(vec2(0.16), vec2(0.45), perPixel * halfWidth);
    return max(lineCoverage(distance.x, halfWidth) * fade.x, lineCoverage(distance.y, halfWidth) * fade.y);
}

/// The border of the square 0..side.
float borderLine(vec2 at, vec2 perPixel, float side, float halfWidth) {
    vec2 distance = min(at, side - at) / max(perPixel, vec2(1e-6));
    vec2 fade = 1.0 - 0.7 * smoothstep(vec2(0.12), vec2(0.5), perPixel * halfWidth / side);
    return max(lineCoverage(distance.x, halfWidth) * fade.x, lineCoverage(distance.y, halfWidth) * fade.y);
}
