#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 0) out vec4 outColor;

float hash(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453); }

float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f *= f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}

void main() {
    float grain = 0.6 * noise(inPosition.xz * 0.9) + 0.3 * noise(inPosition.xz * 4.0) + 0.1 * noise(inPosition.xz * 19.0);
    vec3 albedo = mix(vec3(0.17, 0.19, 0.09), vec3(0.36, 0.31, 0.19), grain);
    float sun = sunVisibility(inPosition);
    vec3 color = albedo * (kSun * sun * scene.sunDirection.y * 1.1 + skyLight(vec3(0.0, 1.0, 0.0)));
    float away = length(inPosition.xz - scene.eye.xz);
    outColor = developed(mix(color, sky(gl_FragCoord.xy), smoothstep(12.0, 55.0, away)));
}
