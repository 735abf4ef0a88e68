#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec4 inNormal; // w: the part of the sky that is seen
layout(location = 0) out vec4 outColor;

/// The share of a pixel that thin lines every unit take, filtered.
float lines(vec2 at, float width) {
    vec2 span = max(fwidth(at), 1e-5), off = abs(fract(at - 0.5) - 0.5);
    vec2 covered = clamp((width - off) / span + 0.5, 0.0, 1.0) * clamp(width / span, 0.0, 1.0);
    return max(covered.x, covered.y);
}

/// Where the player wants the character to go.
float ring(vec3 position) {
    float off = abs(length(position.xz - scene.mark.xz) - 0.16);
    return scene.mark.w * (1.0 - smoothstep(0.012, 0.012 + max(fwidth(off), 1e-5), off));
}

void main() {
    vec3 n = normalize(inNormal.xyz);
    vec2 tile = inPosition.xz / 0.42; // kTile of ground.cpp
    float level = smoothstep(0.7, 0.95, n.y); // a step's side is of one piece
    float odd = fract(sin(dot(floor(tile), vec2(12.9898, 78.233))) * 43758.5453);
    vec3 albedo = vec3(0.33, 0.30, 0.27) * (0.93 + 0.14 * odd) * (1.0 - 0.4 * level * lines(tile, 0.012));
    albedo = mix(albedo, vec3(0.80, 0.36, 0.10), 0.9 * ring(inPosition));
    float open = skyVisibility(inPosition, n) * inNormal.w;
    vec3 color = lit(plainMaterial(albedo, 0.8), inPosition, n, n, open);
    float away = length(inPosition.xz);
    outColor = shown(mix(color, background(gl_FragCoord.xy), smoothstep(3.8, 7.2, away)));
}
