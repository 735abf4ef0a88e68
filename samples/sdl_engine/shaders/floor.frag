#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec4 inNow;
layout(location = 2) in vec4 inBefore;

layout(location = 0) out vec4 outColor;
layout(location = 1) out vec2 outMotion;

/// The share of a pixel that thin lines every unit take, filtered.
float lines(vec2 at, float width) {
    vec2 span = max(fwidth(at), 1e-5);
    vec2 off = abs(fract(at - 0.5) - 0.5);
    vec2 covered = clamp((width - off) / span + 0.5, 0.0, 1.0) * clamp(width / span, 0.0, 1.0);
    return max(covered.x, covered.y);
}

void main() {
    const vec3 n = vec3(0.0, 1.0, 0.0);
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 albedo = vec3(0.46, 0.43, 0.40);
    vec2 tile = floor(inPosition.xz / 0.6);
    albedo *= 0.97 + 0.06 * fract(sin(dot(tile, vec2(12.9898, 78.233))) * 43758.5453);
    albedo *= 1.0 - 0.35 * lines(inPosition.xz / 0.6, 0.012);
    float away = length(inPosition.xz);
    float sun = away < 4.0 ? sunVisibility(inPosition, n, gl_FragCoord.xy) : 1.0;
    vec3 light = kSun * (sun * frame.sunDirection.y / kPi * 1.6) + kSkyAbove * 0.75 * skyVisibility(inPosition);
    vec3 color = albedo * light + kSun * (sun * 0.5 / kPi) * mirroredLight(n, v, frame.sunDirection.xyz, 0.55, vec3(0.04));
    outColor = vec4(mix(color, background(gl_FragCoord.xy), smoothstep(2.6, 8.5, away)), 1.0);
    outMotion = motion(inNow, inBefore);
}
