// Levels before the budget, in an instance's scratch (shared/lod.h), and the measure they come from (docs/lod.md, section 4).
layout(set = 0, binding = kScratchBinding, std430) buffer Scratch { uint scratchWords[]; };
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;

uint levelBase(uint instance) { return 4u * instance * push.scratchStride; }

uint levelWord(uint i) {
    if (kWide) return scratchWords[i];
    return floatBitsToUint(texelFetch(scratchTexels, int(i >> 2u))[i & 3u]);
}

float lengthOf(vec3 v) {
    precise float s = v.x * v.x + v.y * v.y + v.z * v.z;
    return sqrt(s);
}

// Pixels a unit of length at a point, for a thing of this radius round it. Turning the camera changes nothing.
float pixelsPerUnit(vec3 point, float radius) {
    if ((push.flags & kLodOrthographic) != 0u) return push.focal;
    vec3 away = point - vec3(push.camera[0], push.camera[1], push.camera[2]);
    return push.focal / max(lengthOf(away) - radius, push.nearest);
}

// The level of something of this length and of these second differences, the larger one; finite and not negative.
float levelOf(float curveLength, float bend, float pixels) {
    float level = curveLength * pixels * push.lengthScale;
    if (push.errorScale > 0.0) level = min(level, sqrt(push.errorScale * bend * pixels));
    return level < 256.0 ? max(level, 0.0) : 256.0; // NaN as the largest: better too fine than gone
}
