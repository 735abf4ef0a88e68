#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) centroid in vec3 inPosition;
layout(location = 1) centroid in vec3 inNormal;
layout(location = 2) in vec2 inUv; // u away from the pinned edge
layout(location = 3) flat in uint inSlot;

layout(location = 0) out vec4 outColor;

float inside(float distance_) {
    float w = max(fwidth(distance_), 1e-5);
    return clamp(0.5 - distance_ / w, 0.0, 1.0);
}

/// A sun over bands of water; and a banner with a hem.
vec3 painted() {
    const vec3 cream = vec3(0.86, 0.80, 0.66), red = vec3(0.62, 0.07, 0.05), blue = vec3(0.04, 0.16, 0.34);
    const vec3 gold = vec3(0.85, 0.50, 0.10);
    vec2 at = vec2(1.5, 1.0) * inUv; // square units: the sheet is three by two
    if (inSlot == 0u) {
        float wave = at.y - 0.70 - 0.025 * sin(16.0 * at.x);
        vec3 color = mix(cream, blue, inside(-wave));
        color = mix(color, cream, inside(abs(wave - 0.12) - 0.018));
        vec2 off = at - vec2(0.62, 0.37);
        float angle = atan(off.y, off.x), rays = 0.235 + 0.035 * cos(16.0 * angle);
        color = mix(color, gold, inside(length(off) - rays));
        color = mix(color, red, inside(length(off) - 0.165));
        return color;
    }
    vec3 color = mix(red, cream, inside(abs(at.y - 0.5) - 0.17));
    color = mix(color, gold, inside(abs(abs(at.y - 0.5) - 0.17) - 0.012));
    color = mix(color, gold, inside(abs(at.x - 0.75) + abs(at.y - 0.5) - 0.12));
    float hem = min(min(at.y, 1.0 - at.y), 1.5 - at.x);
    return mix(color, gold * 0.8, inside(hem - 0.03));
}

void main() {
    vec3 v = normalize(scene.eye.xyz - inPosition), l = scene.sunDirection.xyz;
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    vec3 lit = dot(n, l) > 0.0 ? n : -n; // the side that the sun sees
    float sun = sunVisibility(inPosition + lit * 0.025);
    float weave = 0.96 + 0.04 * sin(inUv.x * 900.0) * sin(inUv.y * 600.0) * (1.0 - smoothstep(0.0, 0.003, fwidth(inUv.x)));
    vec3 albedo = painted() * weave;
    float nl = dot(n, l);
    // What falls on the other side comes through, warmer.
    vec3 through = albedo * albedo * (0.75 * max(-nl, 0.0));
    vec3 color = kSun * sun * (albedo * max(nl, 0.0) * 0.62 + through) + albedo * skyLight(n);
    float sheen = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 3.0);
    outColor = developed(color + skyLight(n) * sheen * 0.18);
}
