#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 0) out vec4 outColor;

// Cobbles in rows that are shifted against each other: x is the height of the stone, y its number, zw its slope.
vec4 cobbles(vec2 p) {
    p /= vec2(0.30, 0.22);
    float row = floor(p.y);
    p.x += 0.5 * mod(row, 2.0) + 0.22 * hash(vec2(row, 3.0));
    vec2 cell = vec2(floor(p.x), row), f = fract(p) - 0.5;
    float number = hash(cell);
    f += 0.07 * (vec2(hash(cell + 7.0), hash(cell + 13.0)) - 0.5);
    vec2 edge = pow(abs(f) * 2.05, vec2(4.0));
    float inside = 1.0 - smoothstep(0.55, 1.0, edge.x + edge.y);
    return vec4(inside, number, -sign(f) * pow(abs(f) * 2.0, vec2(3.0)));
}

void main() {
    float away = length(inPosition - scene.eye.xyz), fade = 1.0 - smoothstep(14.0, 34.0, away);
    vec4 stone = cobbles(inPosition.xz);
    float patches = noise(inPosition.xz * 0.35), dirt = noise(inPosition.xz * 1.9 + 5.0), grain = noise(inPosition.xz * 38.0);
    vec3 albedo = mix(vec3(0.20, 0.175, 0.15), vec3(0.33, 0.30, 0.26), mix(0.5, stone.y, fade));
    albedo *= mix(0.82, 1.12, patches) * mix(0.9, 1.08, grain * fade + 0.5 * (1.0 - fade));
    vec3 joints = mix(vec3(0.10, 0.085, 0.065), vec3(0.11, 0.12, 0.055), smoothstep(0.55, 0.8, dirt)); // moss here and there
    albedo = mix(joints, albedo, mix(0.86, stone.x, fade));
    float worn = smoothstep(0.35, 0.75, noise(inPosition.xz * 0.8 + 11.0));
    vec3 n = normalize(vec3(-0.30 * stone.zw * stone.x * fade, 1.0).xzy);
    outColor = shown(hazed(lit(albedo, 0.0, mix(0.85, 0.55, worn * stone.x), inPosition, n,
                               openness(inPosition) * mix(0.75, 1.0, stone.x), 0.0), inPosition));
}
