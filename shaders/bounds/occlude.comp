// Occlusion: takes instances out of sight whose bounds lie behind what a depth pyramid has everywhere they would be drawn.
// One lane an instance, between the bounds pass and the list pass.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#define PUSH_CONSTANTS OcclusionPush
#include "shaders/bounds/cull.glsl"

BUFFER(readonly, Bounds, kBoundsBinding, std430, vec4, bounds)
layout(set = 0, binding = kPyramidBinding) uniform texture2D pyramid;

// Pixels of level 0, and depth: more than the rounding from clip space on.
const float kPixelSlack = 0.02;
const float kDepthSlack = 1e-7, kRelativeDepthSlack = 2e-6;
// Of the projection, as a part of the sum of its terms' sizes: a sum of four products is rounded by 4 * 2^-24 of that at
// most, and what drew the picture may have rounded as much.
const float kProjectionSlack = 1.0 / 2097152.0;

// `slack`: of each coordinate.
vec4 clip(vec3 p, out vec4 slack) {
    vec4 q;
    for (uint r = 0u; r < 4u; ++r) {
        vec4 terms = vec4(push.columns[r], push.columns[4u + r], push.columns[8u + r], push.columns[12u + r]) * vec4(p, 1.0);
        q[r] = terms.x + terms.y + terms.z + terms.w;
        slack[r] = kProjectionSlack * dot(abs(terms), vec4(1.0));
    }
    return q;
}

bool isHidden(vec3 low, vec3 high) {
    // Depths so that near is less, whichever way the pyramid has them.
    float turn = push.reversed != 0u ? -1.0 : 1.0;
    vec2 least = vec2(1e30), most = vec2(-1e30);
    float nearest = 1e30;
    for (uint k = 0u; k < 8u; ++k) {
        vec4 slack;
        vec4 q = clip(vec3((k & 1u) != 0u ? high.x : low.x, (k & 2u) != 0u ? high.y : low.y,
                           (k & 4u) != 0u ? high.z : low.z), slack);
        float w = q.w - slack.w;
        if (!(w > 1e-6)) return false; // reaches behind the eye
        vec3 p = q.xyz / q.w, off = (slack.xyz + abs(p) * slack.w) / w;
        least = min(least, p.xy - off.xy);
        most = max(most, p.xy + off.xy);
        nearest = min(nearest, turn * p.z - off.z);
    }
    vec2 size = vec2(push.width, push.height);
    vec2 from = (0.5 * least + 0.5) * size - kPixelSlack, to = (0.5 * most + 0.5) * size + kPixelSlack;
    // What lies outside the picture is not known.
    if (!(all(greaterThanEqual(from, vec2(0.0))) && all(lessThan(to, size)))) return false;

    vec2 extent = to - from;
    uint level = 0u; // at which no side is longer than seven texels: eight by eight then cover it
    while (level + 1u < push.levels && max(extent.x, extent.y) > 7.0 * float(1u << level)) ++level;
    ivec2 texels = max(ivec2(push.width, push.height) >> level, ivec2(1));
    ivec2 first = ivec2(floor(from / size * vec2(texels))), last = ivec2(floor(to / size * vec2(texels)));
    if (any(greaterThan(last - first, ivec2(7)))) return false;
    first = clamp(first, ivec2(0), texels - 1);
    last = clamp(last, ivec2(0), texels - 1);
    float farthest = -1e30;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x)
            farthest = max(farthest, turn * texelFetch(pyramid, ivec2(x, y), int(level)).x);
    }
    return nearest - (kDepthSlack + kRelativeDepthSlack * abs(nearest)) > farthest;
}

void main() {
    uint index = min(invocationIndex(), push.instanceCount - 1u);
    uint slot = hostEntry(push.firstEntry + index) & kInstanceSlotMask;
    vec4 low = bounds.at[2u * slot], high = bounds.at[2u * slot + 1u];
    if (states.at[slot].x != 0u && high.w == 0.0 && isHidden(low.xyz, high.xyz)) states.at[slot] = uvec2(0u, kOccluded);
}
