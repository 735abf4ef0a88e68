// The measure that levels come from (docs/lod.md, section "Levels"). LOD_CAMERA: the LodCamera it is made for.

float lengthOf(vec3 v) {
    precise float s = v.x * v.x + v.y * v.y + v.z * v.z;
    return sqrt(s);
}

// Pixels a unit of length at a point, for a thing of this radius round it. Turning the camera changes nothing.
float pixelsPerUnit(vec3 point, float radius) {
    if (LOD_CAMERA.orthographic != 0u) return LOD_CAMERA.focal;
    vec3 away = point - vec3(LOD_CAMERA.position[0], LOD_CAMERA.position[1], LOD_CAMERA.position[2]);
    precise float pixels = LOD_CAMERA.focal / max(lengthOf(away) - radius, LOD_CAMERA.nearest);
    return pixels;
}

// The level of something of this length and of these second differences, the larger one; finite and not negative.
float levelOf(float curveLength, float bend, float pixels) {
    precise float level = curveLength * pixels * LOD_CAMERA.lengthScale, square = LOD_CAMERA.errorScale * bend * pixels;
    if (LOD_CAMERA.errorScale > 0.0) level = min(level, sqrt(square));
    return level < 256.0 ? max(level, 0.0) : 256.0; // NaN as the largest: better too fine than gone
}
